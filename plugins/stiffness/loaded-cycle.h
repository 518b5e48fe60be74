/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves one mesh cycle of loaded teeth from the compliance of their pairs. */
#ifndef STIFFNESS_LOADED_CYCLE_H
#define STIFFNESS_LOADED_CYCLE_H

#include "equilibrium.h"

/* Corner contact is searched within this number of mesh cycles before SAP and after the tip. */
extern const double stiffness_corner_reach;

/* Solves the mesh cycle, writes the wanted outputs, and reports the quality of the solution. */
ff_status stiffness_loaded_cycle_publish(const stiffness_source *source, uint64_t wanted);

#endif
