/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the nodes across a film leave of it. The transport across is damped in its highest modes
 * (energy.c), which is where few nodes go wrong: sweeps whose residual has no damping and whose
 * matrix has it (deferred correction, Stetter 1978) take the temperatures towards those without,
 * and what they change the flow of mass by is the error.
 */
#include "thermal.h"

#include <math.h>
#include <string.h>

/* Sweeps: what one hands on to columns against the entrainment the next one sees, and a correction
   that goes to and fro at first has settled by then. */
enum { SWEEPS = 20 };

/* Rise of the temperature, over that of the hottest instant that was looked at, from which on
   another one is. */
static const double HOTTER = 1.1;

/* Mobility, and mass over the gap, of the flow of e. */
static void keep_flow(const ehl_energy *e, size_t count, double *kept)
{
    memcpy(kept, e->mobility, count * sizeof *kept);
    memcpy(kept + count, e->mass, count * sizeof *kept);
}

/* Returns by how much the flow of mass has changed since, at most, relative to what the flanks
   carry along. */
static double change_of_flow(const ehl_energy *e, const ehl_energy_film *f, const double *kept)
{
    const double u = (f->speed[0] + f->speed[1]) / 2 + f->frame;
    double most = 0;
    for (size_t i = 1; i < f->count; i++) {
        double mass = kept[f->count + i], driven = fabs(kept[i] * e->p_x[i]) / (u * mass);
        double off = fabs(log(e->mobility[i] / kept[i])) * driven / (1 + driven) +
                     fabs(e->mass[i] / mass - 1);
        if (f->full[i] && kept[i] > 0 && !(off <= most))
            most = isfinite(off) ? off : HUGE_VAL;
    }
    return most;
}

void ehl_thermal_look_at_nodes(ehl_thermal *t, const ehl_energy_film *f, const double *heat,
                               double highest)
{
    ehl_energy *e = &t->energy;
    const size_t n = e->nodes, temperatures = n * e->across.count;
    double *now = t->moved[0], *kept = t->moved[1], *flux = kept + 2 * n;
    if (f->frame > 0 || !(highest - e->T_in > HOTTER * t->looked_at))
        return;
    const double keep = e->keep, share = e->share, change = e->change;
    const ehl_temperature given = ehl_thermal_state(t, now);
    t->looked_at = highest - e->T_in;
    memcpy(now, heat, t->width * sizeof *now);
    for (size_t g = 0; g < 2; g++)
        memcpy(flux + g * n, e->flux[g], n * sizeof *flux);
    keep_flow(e, f->count, kept);
    e->undamped = 1;
    e->share = 1;
    e->keep = 0;
    for (int turn = 0; turn < SWEEPS; turn++) {
        ehl_energy_sweep(e, f, &given);
        ehl_energy_flow(e, f, given.T);
    }
    ehl_worse(&t->by_nodes, change_of_flow(e, f, kept));
    e->undamped = 0;
    e->share = share;
    e->keep = keep;
    memcpy(now, heat, temperatures * sizeof *now);
    ehl_energy_flow(e, f, now);
    e->change = change;
    for (size_t g = 0; g < 2; g++)
        memcpy(e->flux[g], flux + g * n, n * sizeof *flux);
}
