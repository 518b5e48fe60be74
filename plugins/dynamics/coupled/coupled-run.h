/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Integrates a gear pair on elastic bearings, like oscillator.h for rigid bearings. Steps end at
   the nodes of the excitation, where flanks meet or separate, and where a tooth pair enters or
   leaves. Each step is therefore within one smooth regime. */
#ifndef DYNAMICS_COUPLED_RUN_H
#define DYNAMICS_COUPLED_RUN_H

#include "../oscillator/oscillator.h"
#include "coupled-field.h"

typedef struct dynamics_coupled_run dynamics_coupled_run;

typedef struct dynamics_coupled_sample {
    dynamics_sample excitation;
    double overlap, overlap_rate; /* overlap of the driving flanks, and its rate */
    double centre, contact_ratio;
    double position[DYNAMICS_COORDINATES];
} dynamics_coupled_sample;

typedef struct dynamics_coupled_record {
    size_t per_cycle, count, capacity, cycles;
    dynamics_coupled_sample *samples;
} dynamics_coupled_record;

/* Returns NULL if out of memory. */
dynamics_coupled_run *dynamics_coupled_run_new(const dynamics_coupled *pair, double tolerance);
void dynamics_coupled_run_free(dynamics_coupled_run *run);

/* Starts at phase 0 of mesh cycles of duration T from coordinates and rates, and resets the
   clocks. */
void dynamics_coupled_start(dynamics_coupled_run *run, double T, const double *state);
/* Does the same; in addition, the derivatives of the state with respect to the start state will be
   integrated. */
void dynamics_coupled_start_varied(dynamics_coupled_run *run, double T, const double *state);
const double *dynamics_coupled_state(const dynamics_coupled_run *run);
/* Returns the derivatives of the state with respect to the start state: DYNAMICS_TAKEN rows of
   DYNAMICS_TAKEN. */
const double *dynamics_coupled_monodromy(const dynamics_coupled_run *run);

/* Integrates one mesh cycle. `record` may be NULL. Returns 0 if there are too many steps. */
int dynamics_coupled_cycle(dynamics_coupled_run *run, double T, dynamics_coupled_record *record);

/* Sets the times since the start: without contact, and with contact of the back flanks. */
void dynamics_coupled_clocks(const dynamics_coupled_run *run, double *parted, double *back);

/* Returns the kinetic energy, plus the potential of the load, plus the energy that the springs and
   dampers of mesh and bearings have taken since the start. The sum is constant. */
double dynamics_coupled_energy(const dynamics_coupled_run *run, double *kinetic);

int dynamics_coupled_record_init(dynamics_coupled_record *record, const dynamics_coupled *pair,
                                 size_t per_cycle, size_t cycles);

#endif
