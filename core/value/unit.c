/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "unit.h"

bool ff_unit_is_si(const ff_unit *unit)
{
    return unit->factor == 1 && unit->offset == 0;
}
