/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The parts of one evaluation: the contact's history, flanks, oil, grid, equations and solver. */
#ifndef EHL_STAGE_RUN_H
#define EHL_STAGE_RUN_H

#include "outputs.h"
#include "stage.h"

#include "../contact/surface.h"
#include "../heat/heat.h"
#include "../heat/thermal.h"
#include "../time/error-transport.h"
#include "../time/step-control.h"

/* Members are in the order in which they are made. The struct starts zeroed. */
typedef struct ehl_run {
    ehl_history whole, history; /* history of all engagements, and of the current one */
    ehl_roughness rough;
    double hardness; /* hardness of rough flanks, Pa; 0: they stay elastic */
    int gears_tell;  /* whether the hardness comes from the gears */
    ehl_oil oil;
    const ehl_grid *like; /* the grid of a run that has twice the cells of this one; or NULL */
    ehl_grid grid;
    ehl_reynolds reynolds;
    double *kernel;
    ehl_solver solver;
    ehl_march march;
    ehl_transport transport;
    ehl_heat heat;
    ehl_thermal thermal;
    ehl_step_control control;
    ehl_results results;
} ehl_run;

/* Returns whether the film has asperities described by their statistics. */
int ehl_is_statistical(const ehl_model *m);

/* Returns the tolerance of Newton's method for the first film. */
double ehl_first_tolerance(const ehl_model *m, const ehl_run *r);

/* Makes all parts except heat, step control and results from r->history, which has been read.
   `judged`: the outputs whose errors are estimated, 0: none. Destroy it in any case. */
ff_status ehl_run_create(const ehl_model *m, uint64_t judged, const ff_array *in, ehl_run *r);
/* Makes the rough flanks again, for the current engagement in r->history. */
ff_status ehl_run_surface(const ehl_model *m, const ff_array *in, ehl_run *r);
void ehl_run_destroy(ehl_run *r);

#endif
