/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Integrates a coupled gear pair by an embedded Runge-Kutta method (GSL). Steps end at the nodes of
 * the excitation and where flanks meet or part or a tooth pair comes or goes, so that each lies
 * within one smooth regime.
 */
#ifndef FF_DYNAMICS_COUPLED_RUN_H
#define FF_DYNAMICS_COUPLED_RUN_H

#include "coupled-pair.h"
#include "oscillator.h"

/* Coordinates, their rates, and the energy that mesh and bearings have taken. */
enum { FF_RATES = FF_COORDINATES, FF_TAKEN = 2 * FF_COORDINATES, FF_COUPLED_SIZE };

typedef struct ff_coupled_run ff_coupled_run;

typedef struct ff_coupled_sample {
    ff_sample mesh;
    double gap;
    double centre, contact_ratio;
    double position[FF_COORDINATES];
} ff_coupled_sample;

typedef struct ff_coupled_record {
    size_t per_cycle, count, capacity, cycles;
    ff_coupled_sample *samples;
} ff_coupled_record;

/* NULL: out of memory. */
ff_coupled_run *ff_coupled_run_new(const ff_coupled *pair, double tolerance);
void ff_coupled_run_free(ff_coupled_run *run);

/* At phase 0 of mesh cycles of duration T, from 2 * FF_COORDINATES numbers. Resets the clocks. */
void ff_coupled_start(ff_coupled_run *run, double T, const double *state);
const double *ff_coupled_state(const ff_coupled_run *run);

/* Goes on by one mesh cycle; `record` may be NULL. 0: too many steps. */
int ff_coupled_cycle(ff_coupled_run *run, double T, ff_coupled_record *record);

/* Time since the start without contact and with contact of the back flanks. */
void ff_coupled_clocks(const ff_coupled_run *run, double *parted, double *back);

/* Kinetic energy, that of the load, and what mesh and bearings took since the start. */
double ff_coupled_energy(const ff_coupled_run *run, double *kinetic);

int ff_coupled_record_init(ff_coupled_record *record, const ff_coupled *pair, size_t per_cycle,
                           size_t cycles);

#endif
