/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "spring.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

/* Force at the knee, relative to the mean force F. Of the values from 0.1 to 0.75 this one
   reproduces the load distribution best from 0 to 1.2 F, with and without profile relief (theory,
   section 4). */
static const double knee = 0.5;

/* An offset below this share of the mean force is round-off; k then equals the chord F/(e_l -
   e). */
static const double round_off = 1e-6;

double dynamics_spring_knee_energy(const dynamics_piece *p, double since, int band)
{
    double energy = 0;
    for (int i = 1; p->lines && i <= abs(band); i++) {
        double offset = dynamics_piece_value(p->line[i].offset, p->degree, since) -
                        dynamics_piece_value(p->line[i - 1].offset, p->degree, since);
        double steeper = dynamics_piece_value(p->line[i].slope, p->degree, since) -
                         dynamics_piece_value(p->line[i - 1].slope, p->degree, since);
        energy += steeper > 0 ? 0.5 * offset * offset / steeper : 0;
    }
    return energy;
}

dynamics_spring dynamics_spring_at(const dynamics_piece *p, double since, double T, double bend,
                                   int band)
{
    const double *slope = dynamics_spring_slope(p, band), *offsets;
    double k = dynamics_piece_value(slope, p->degree, since);
    double k_rate = dynamics_piece_slope(slope, p->degree, since) / T;
    dynamics_spring s = {k * bend, 0.5 * k * bend * bend, 0.5 * k_rate * bend * bend};
    if (band == 0)
        return s;
    offsets = dynamics_spring_offset(p, band);
    double offset = dynamics_spring_sign(band) * dynamics_piece_value(offsets, p->degree, since);
    double offset_rate =
        dynamics_spring_sign(band) * dynamics_piece_slope(offsets, p->degree, since) / T;
    s.force -= offset;
    s.energy += dynamics_spring_knee_energy(p, since, band) - offset * bend;
    s.energy_rate -= offset_rate * bend;
    return s;
}

double dynamics_spring_force(const dynamics_piece *p, double since, double bend)
{
    int band = dynamics_spring_band(p, since, bend);
    double force = dynamics_piece_value(dynamics_spring_slope(p, band), p->degree, since) * bend;
    return band
               ? force - dynamics_spring_sign(band) *
                             dynamics_piece_value(dynamics_spring_offset(p, band), p->degree, since)
               : force;
}

static double way_at(const dynamics_mesh_curves *x, const double *loaded, size_t i)
{
    return loaded[i] - (x->error ? x->error[i] : 0);
}

/* Sets k and both lines of the spring at node i. */
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
    const dynamics_spring_row below = dynamics_spring_row_of(s, 0),
                              above = dynamics_spring_row_of(s, 1);
    s->stiffness[i] = above.slope[i] = k;
    above.offset[i] = fmax(offset, 0);
    below.slope[i] = k * knee * F / (knee * F + above.offset[i]);
    below.offset[i] = 0;
    s->steeper += share * above.offset[i] / F;
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
    *s = (dynamics_spring_nodes){.count = x->count};
    if (!is_needed(x, loaded, force))
        return 1;
    s->stiffness = malloc(x->count * sizeof *s->stiffness);
    s->rows = malloc(4 * x->count * sizeof *s->rows);
    s->lines = 2;
    if (!s->stiffness || !s->rows) {
        dynamics_spring_nodes_free(s);
        return 0;
    }
    for (size_t i = 0; i < x->count; i++)
        make_node(x, loaded, force, i, s);
    for (size_t i = 0; on_chord && i < x->count; i++) {
        double way = way_at(x, loaded, i);
        s->stiffness[i] = way > 0 ? force / way : x->stiffness[i];
    }
    if (on_chord)
        s->lines = 0;
    return 1;
}

size_t dynamics_spring_levels(const dynamics_force_levels *l, double force, int every,
                              size_t taken[DYNAMICS_LINES])
{
    size_t mean = 0, count = 0;
    assert(l->count <= DYNAMICS_LINES);
    while (mean + 1 < l->count && l->force[mean] < force * (1 - round_off))
        mean++;
    for (size_t i = 0; i < l->count; i++)
        if (i == 0 || i + 1 == l->count || (i + mean) % (size_t)every == 0)
            taken[count++] = i;
    return count;
}

/* Slopes of neighbouring lines must differ by at least this relative amount; otherwise their knee
   is not defined. */
static const double least_bend = 1e-5;

/* A given slope that is raised by more than this relative amount is reported. */
static const double much_softer = 1e-3;

/* The last line of the spring made so far at a node: deflection g and force at its level, and its
   slope. */
typedef struct last_line {
    double g, force, slope;
} last_line;

static last_line last_line_at(const dynamics_force_levels *l, const dynamics_spring_nodes *s,
                              size_t level, size_t i)
{
    const dynamics_spring_row row = dynamics_spring_row_of(s, s->lines - 1);
    double g = l->error[level * l->phases + i] - l->error[i];
    return (last_line){g, row.slope[i] * g - row.offset[i], row.slope[i]};
}

/* Makes a line at node i. If slopes are given, it is the tangent at the point (g, F) of the level.
   The tangent is raised if the last line is above it, and made steeper if its slope is below the
   chord between both points. Neither is needed if the levels are convex. Without slopes the line is
   the chord to the next level. Returns whether a given slope was raised. */
static int make_line(const dynamics_force_levels *l, const dynamics_spring_nodes *s,
                     const size_t level[3], size_t i, const dynamics_spring_row *row)
{
    size_t at = level[1] * l->phases + i, next = level[2] * l->phases + i;
    double g = l->error[at] - l->error[i], force = l->force[level[1]], slope;
    double way = l->error[next] - l->error[at], rise = l->force[level[2]] - force, over = 0;
    slope = l->stiffness ? l->stiffness[at] : rise / way;
    if (s->lines) {
        last_line last = last_line_at(l, s, level[0], i);
        double there = last.force + last.slope * (g - last.g);
        double least = last.slope * (1 + least_bend);
        over = fmax(there - force, 0);
        if (l->stiffness)
            slope = fmax(slope, (force + over - last.force) / (g - last.g));
        force = l->stiffness ? force + over : there;
        slope = fmax(l->stiffness ? slope : (rise - over) / way, least);
    }
    row->slope[i] = slope;
    row->offset[i] = s->lines ? slope * g - force : 0;
    return l->stiffness && slope > l->stiffness[at] * (1 + much_softer);
}

/* Returns whether, at any node, a line is steeper than the last one by more than `least_bend`. */
static int bends_up(const dynamics_spring_nodes *s, const dynamics_spring_row *row)
{
    static const double exact = 1e-9;
    const dynamics_spring_row last = dynamics_spring_row_of(s, s->lines - 1);
    for (size_t i = 0; i < s->count; i++)
        if (row->slope[i] > last.slope[i] * (1 + least_bend + exact))
            return 1;
    return 0;
}

/* Returns the largest difference (N) between the spring and the force of a level. */
static double largest_miss(const dynamics_force_levels *l, const dynamics_spring_nodes *s,
                           size_t level)
{
    double most = 0;
    for (size_t i = 0; i < s->count; i++) {
        double g = l->error[level * l->phases + i] - l->error[i], force = 0;
        for (size_t n = 0; n < s->lines; n++) {
            const dynamics_spring_row row = dynamics_spring_row_of(s, n);
            force = fmax(force, row.slope[i] * g - row.offset[i]);
        }
        most = fmax(most, fabs(force - l->force[level]));
    }
    return most;
}

int dynamics_spring_nodes_share(const dynamics_force_levels *l, double force, int every,
                                dynamics_spring_nodes *s, double *convex)
{
    size_t taken[DYNAMICS_LINES], count = dynamics_spring_levels(l, force, every, taken), last = 0;
    *s = (dynamics_spring_nodes){.count = l->phases};
    s->rows = malloc(2 * count * s->count * sizeof *s->rows);
    *convex = 0;
    for (size_t n = 0; s->rows && n + (l->stiffness ? 0 : 1) < count; n++) {
        const dynamics_spring_row row = dynamics_spring_row_of(s, s->lines);
        const size_t level[] = {last, taken[n], taken[n + 1 < count ? n + 1 : n]};
        for (size_t i = 0; i < s->count; i++)
            s->soft += make_line(l, s, level, i, &row) / (double)(count * s->count);
        if (s->lines && !bends_up(s, &row))
            continue;
        s->lines++;
        last = taken[n];
    }
    for (size_t n = 0; s->rows && n < count; n++)
        *convex = fmax(*convex, largest_miss(l, s, taken[n]) / force);
    return s->rows != NULL;
}

void dynamics_spring_nodes_free(dynamics_spring_nodes *s)
{
    free(s->stiffness);
    free(s->rows);
    s->stiffness = s->rows = NULL;
}
