/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Operating conditions of a stiffness model: the gears, the deviations of their flanks, their load,
   and the requested mesh cycle. */
#ifndef STIFFNESS_CONDITIONS_H
#define STIFFNESS_CONDITIONS_H

#include "deviations.h"
#include "gears.h"
#include "path-inputs.h"

typedef struct stiffness_conditions {
    stiffness_path path;
    stiffness_deviations deviations;
    stiffness_deviations back; /* deviations of the flanks opposite to those that carry the line
                                  force */
    bool same_back;            /* whether `back` equals `deviations` */
    stiffness_gears gears;
} stiffness_conditions;

/* The mesh cycles of the hunting period that the outputs describe. */
typedef struct stiffness_mesh_cycles {
    enum { STIFFNESS_CYCLE_NUMBER, STIFFNESS_CYCLE_WORST, STIFFNESS_CYCLE_ALL } which;
    size_t number;
} stiffness_mesh_cycles;

/* Sets the parameter mesh_cycle: a number, `worst` or `all`. */
stiffness_mesh_cycles stiffness_mesh_cycles_set(const ff_value *value);

/* Reads and checks the inputs. Refuses a mesh cycle beyond the hunting period. */
ff_status stiffness_conditions_read(const ff_host *host, const ff_array *in, const ff_reals *rim,
                                    stiffness_mesh_cycles cycles, stiffness_conditions *conditions);

#endif
