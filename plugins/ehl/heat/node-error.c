/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the nodes across a film leave of it. The transport across is damped in its highest modes
 * (energy.c): sweeps whose residual has no damping and whose matrix has it (deferred correction,
 * Stetter 1978) take the temperatures towards those without. What they change the film by is the
 * error of the damping; that of the polynomials is their last coefficients.
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

/* Mobility and mass of a flow along the film. */
typedef struct flow {
    double *mobility, *mass;
} flow;

/*
 * Returns the last two coefficients of ln(eta) across column i in Legendre's polynomials, by size:
 * what the nodes leave where nothing is damped. The weights of Gauss and Lobatto are 1/(N (N + 1)
 * P_N^2) at the nodes, where P_(N-1) is x P_N, N = nodes - 1.
 */
static double tail_of(const ehl_energy *e, size_t i)
{
    const ehl_across *a = &e->across;
    const size_t n = a->count;
    const double N = (double)(n - 1);
    double last = 0, before = 0;
    for (size_t k = 0; k < n; k++) {
        double part =
            (k % 2 > 0 ? -1 : 1) * sqrt(a->weight[k] / (N * (N + 1))) * e->ln_eta[i * n + k];
        last += N * part;
        before += (2 * N - 1) * (2 * a->z[k] - 1) * part;
    }
    return fabs(last) + fabs(before);
}

/*
 * Returns by how much the film is off, relative. The film is the one whose inlet takes
 * exp(-alpha p) from 1 to 0 (as 13.6), so that a mobility that is off counts by its part of this
 * way. The density counts by what is behind.
 */
static double change_of_film(const ehl_energy *e, const ehl_energy_film *f, double alpha,
                             const flow *kept)
{
    double film = 0, mass = 0, left = 1, most = 0;
    for (size_t i = 1; i < f->count; i++) {
        if (!f->full[i] || !(kept->mobility[i] > 0))
            continue;
        most = fmax(most, f->p[i]);
        const double next = exp(-alpha * most);
        film += (left - next) * (fabs(log(e->mobility[i] / kept->mobility[i])) + tail_of(e, i));
        mass = fmax(mass, (1 - next) * fabs(e->mass[i] / kept->mass[i] - 1));
        left = next;
    }
    return film + mass;
}

void ehl_thermal_look_at_nodes(ehl_thermal *t, const ehl_energy_film *f, const double *heat,
                               double alpha, double highest)
{
    ehl_energy *e = &t->energy;
    const size_t n = e->nodes, temperatures = n * e->across.count;
    double *now = t->moved[0], *room = t->moved[1], *flux = room + 2 * n;
    const flow kept = {room, room + n};
    if (f->frame > 0 || !(highest - e->T_in > HOTTER * t->looked_at))
        return;
    const double keep = e->keep, share = e->share, change = e->change;
    const ehl_temperature given = ehl_thermal_state(t, now);
    t->looked_at = highest - e->T_in;
    memcpy(now, heat, t->width * sizeof *now);
    for (size_t g = 0; g < 2; g++)
        memcpy(flux + g * n, e->flux[g], n * sizeof *flux);
    memcpy(kept.mobility, e->mobility, n * sizeof *room);
    memcpy(kept.mass, e->mass, n * sizeof *room);
    e->undamped = 1;
    e->share = 1;
    e->keep = 0;
    for (int turn = 0; turn < SWEEPS; turn++) {
        ehl_energy_sweep(e, f, &given);
        ehl_energy_flow(e, f, given.T);
    }
    ehl_worse(&t->by_nodes, change_of_film(e, f, alpha, &kept));
    e->undamped = 0;
    e->share = share;
    e->keep = keep;
    memcpy(now, heat, temperatures * sizeof *now);
    ehl_energy_flow(e, f, now);
    e->change = change;
    for (size_t g = 0; g < 2; g++)
        memcpy(e->flux[g], flux + g * n, n * sizeof *flux);
}
