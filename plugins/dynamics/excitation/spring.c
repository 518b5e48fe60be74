/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "spring.h"

#include <math.h>
#include <stdlib.h>

/* The force of the knee over the mean force. Of 0.1 to 0.75 it is the one with which the law stays
   nearest to the load distribution from 0 to 1.2 F, with and without relief (theory, section 4). */
static const double knee = 0.5;

/* An offset below this part of the mean force is round-off: k is the chord. */
static const double round_off = 1e-6;

double dynamics_spring_knee_energy(const dynamics_piece *p, double since, int band)
{
    if (!p->bends || band == 0)
        return 0;
    double offset = dynamics_piece_value(p->offset, p->degree, since);
    double steeper = dynamics_piece_value(p->k, p->degree, since) -
                     dynamics_piece_value(p->chord, p->degree, since);
    return steeper > 0 ? 0.5 * offset * offset / steeper : 0;
}

dynamics_spring dynamics_spring_at(const dynamics_piece *p, double since, double T, double bend,
                                   int band)
{
    const double *slope = dynamics_spring_slope(p, band);
    double k = dynamics_piece_value(slope, p->degree, since);
    double k_rate = dynamics_piece_slope(slope, p->degree, since) / T;
    dynamics_spring s = {k * bend, 0.5 * k * bend * bend, 0.5 * k_rate * bend * bend};
    if (!p->bends || band == 0)
        return s;
    double offset = band * dynamics_piece_value(p->offset, p->degree, since);
    double offset_rate = band * dynamics_piece_slope(p->offset, p->degree, since) / T;
    s.force -= offset;
    s.energy += dynamics_spring_knee_energy(p, since, band) - offset * bend;
    s.energy_rate -= offset_rate * bend;
    return s;
}

double dynamics_spring_force(const dynamics_piece *p, double since, double bend)
{
    double k = dynamics_piece_value(p->k, p->degree, since);
    int band = dynamics_spring_band(p, since, bend);
    if (!p->bends)
        return k * bend;
    return band ? k * bend - band * dynamics_piece_value(p->offset, p->degree, since)
                : dynamics_piece_value(p->chord, p->degree, since) * bend;
}

static double way_at(const dynamics_mesh_curves *x, const double *loaded, size_t i)
{
    return loaded[i] - (x->error ? x->error[i] : 0);
}

/* Sets k, chord and offset at node i. */
static void make_node(const dynamics_mesh_curves *x, const double *loaded, double F, size_t i,
                      dynamics_spring_nodes *s)
{
    double k = x->stiffness[i], way = way_at(x, loaded, i), share = 1 / (double)x->count;
    double offset = k * way - F;
    if (!(way > 0)) {
        s->unknown += share;
        offset = 0;
    } else if (offset < -round_off * F) {
        s->soft += share;
        k = F / way;
        offset = 0;
    }
    s->stiffness[i] = k;
    s->offset[i] = fmax(offset, 0);
    s->chord[i] = k * knee * F / (knee * F + s->offset[i]);
    s->steeper += share * s->offset[i] / F;
}

static int is_needed(const dynamics_mesh_curves *x, const double *loaded, double F)
{
    for (size_t i = 0; loaded && F > 0 && i < x->count; i++)
        if (!(fabs(x->stiffness[i] * way_at(x, loaded, i) - F) <= round_off * F))
            return 1;
    return 0;
}

int dynamics_spring_nodes_make(const dynamics_mesh_curves *x, const double *loaded, double force,
                               int on_chord, dynamics_spring_nodes *s)
{
    *s = (dynamics_spring_nodes){.stiffness = NULL};
    if (!is_needed(x, loaded, force))
        return 1;
    s->stiffness = malloc(3 * x->count * sizeof *s->stiffness);
    if (!s->stiffness)
        return 0;
    s->chord = s->stiffness + x->count;
    s->offset = s->chord + x->count;
    for (size_t i = 0; i < x->count; i++)
        make_node(x, loaded, force, i, s);
    for (size_t i = 0; on_chord && i < x->count; i++) {
        double way = way_at(x, loaded, i);
        s->stiffness[i] = way > 0 ? force / way : x->stiffness[i];
    }
    if (on_chord)
        s->chord = s->offset = NULL;
    return 1;
}

void dynamics_spring_nodes_free(dynamics_spring_nodes *s)
{
    free(s->stiffness);
    s->stiffness = s->chord = s->offset = NULL;
}
