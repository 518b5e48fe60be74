/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the error due to the number of nodes across a film. Temperatures and flow are
   recomputed with one and a half times as many nodes, at the same pressure and gap. The change is
   the estimated error: since the error decreases faster than any power of the number of nodes,
   nearly all of it is in the change. */
#include "thermal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Number of sweeps with the other number of nodes, starting from the temperatures of the film. */
enum { SWEEPS = 20 };

/* A further instant is checked if its temperature rise exceeds that of the instants checked so far
   by this factor. */
static const double HOTTER = 1.1;

/* Returns the relative error of the film, or of its friction, if the flow changes from `then` to
   `now`. The film forms where exp(-alpha p) decreases from 1 to 0 in the inlet (as in 13.6). The
   weight of an error of the mobility at a node is therefore the decrease at this node. The friction
   arises in the oil downstream. */
static double change_of_film(const ehl_energy *now, const ehl_energy *then,
                             const ehl_energy_film *f, double alpha)
{
    double film = 0, carried = 0, left = 1, most = 0, drag = 0, whole = 0;
    for (size_t i = 1; i < f->count; i++) {
        if (!f->full[i] || !(then->mobility[i] > 0))
            continue;
        most = fmax(most, f->p[i]);
        const double next = exp(-alpha * most);
        film += (left - next) * fabs(log(now->mobility[i] / then->mobility[i]));
        carried =
            fmax(carried, (1 - next) * fabs(now->carried[i] - then->carried[i]) / then->mass[i]);
        const double stress = then->tau_m[i] - then->excess[i];
        drag += now->tau_m[i] - now->excess[i] - stress;
        whole += stress;
        left = next;
    }
    drag = f->speed[0] > f->speed[1] || f->speed[0] < f->speed[1] ? fabs(drag / whole) : 0;
    return film + fmax(carried, drag);
}

/* Returns one and a half times the number of nodes, or three quarters of the number if this is too
   many. */
static size_t other_nodes(size_t n)
{
    return n + n / 2 <= EHL_ACROSS_MOST ? n + n / 2 : n - n / 4;
}

/* Returns the error due to the number of nodes across, or infinity if it is not known. */
static double error_of(ehl_energy *other, const ehl_energy *e, const ehl_energy_film *f,
                       const ehl_temperature *film, double alpha)
{
    const size_t n = e->nodes, fields = n * other->across.count;
    const size_t modes[2] = {n * e->flank[0].count, n * e->flank[1].count};
    double *T = calloc(2 * fields + modes[0] + modes[1], sizeof *T), *past = T + fields;
    if (!T)
        return HUGE_VAL;
    const ehl_temperature now = {T, {past + fields, past + fields + modes[0]}};
    ehl_energy_film held = *f;
    ehl_across_move(&e->across, &other->across, n, film->T, T);
    for (size_t g = 0; g < 2; g++)
        memcpy(now.modes[g], film->modes[g], modes[g] * sizeof *T);
    if (f->past) {
        ehl_across_move(&e->across, &other->across, n, f->past, past);
        held.past = past;
    }
    ehl_energy_flow(other, &held, T);
    for (int turn = 0; turn < SWEEPS; turn++) {
        ehl_energy_sweep(other, &held, &now);
        ehl_energy_flow(other, &held, T);
    }
    const double off = change_of_film(other, e, f, alpha);
    free(T);
    return isfinite(off) ? off : HUGE_VAL;
}

void ehl_thermal_look_at_nodes(ehl_thermal *t, const ehl_energy_film *f,
                               const ehl_temperature *film, double alpha, double highest)
{
    const ehl_energy *e = &t->energy;
    ehl_energy other;
    if (f->frame > 0 || !(highest - e->T_in > HOTTER * t->looked_at))
        return;
    t->looked_at = highest - e->T_in;
    double off = HUGE_VAL;
    if (ehl_energy_create(&other, e->nodes, other_nodes(e->across.count)) == FF_OK) {
        other.laws = e->laws;
        other.flow = e->flow;
        other.conductivity = e->conductivity;
        other.conducts = e->conducts;
        other.heat_capacity = e->heat_capacity;
        other.T_in = e->T_in;
        other.reach = e->reach;
        memcpy(other.flank, e->flank, sizeof other.flank);
        off = error_of(&other, e, f, film, alpha);
    }
    ehl_energy_destroy(&other);
    t->by_nodes = fmax(t->by_nodes, off);
}
