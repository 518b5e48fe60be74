/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One mesh cycle of loaded teeth from the compliance of their pairs. */
#ifndef STIFFNESS_LOADED_CYCLE_H
#define STIFFNESS_LOADED_CYCLE_H

#include "equilibrium.h"

/* Corner contact is searched for within this many mesh cycles before SAP and after the tip. */
extern const double stiffness_corner_reach;

/* Solves the mesh cycle, gives the wanted outputs, and reports the quality of the solution. */
ff_status stiffness_loaded_cycle_publish(const stiffness_source *source, uint64_t wanted);

#endif
