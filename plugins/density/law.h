/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parameter that every density law has: a member rho0 of its instance, kg/m3. */
#ifndef DENSITY_LAW_H
#define DENSITY_LAW_H

#include <flankfilm/author.h>
#include <flankfilm/laws.h>

#define DENSITY_RHO0_ROW(type, doc)                                                                \
    FF_QUANTITY("rho0", "kg/m3", type, rho0, FF_REQUIRED, NULL, NULL, 1, 1e5, 600, 2000, doc)

#endif
