/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sharing.h"

#include <math.h>
#include <stdio.h>

/* A force between two levels: the index of the lower level, and the weight of the upper level in
   linear interpolation. */
typedef struct place {
    size_t low;
    double share;
} place;

static place place_of(const dynamics_force_levels *l, double force)
{
    size_t low = 0;
    while (low + 2 < l->count && l->force[low + 1] <= force)
        low++;
    double share = (force - l->force[low]) / (l->force[low + 1] - l->force[low]);
    return (place){low, fmin(fmax(share, 0), 1)};
}

static double value_at(const double *rows, size_t columns, const place *p, size_t column)
{
    const double *low = rows + p->low * columns + column, *high = low + columns;
    return p->share < 1 ? *low + p->share * (*high - *low) : *high;
}

/* Returns the deflection at node i under a force, N. */
static double deflection_of(const dynamics_spring_nodes *nodes, size_t i, double force)
{
    double g = INFINITY;
    for (size_t n = 0; n < nodes->lines; n++) {
        const dynamics_spring_row row = dynamics_spring_row_of(nodes, n);
        g = fmin(g, (force + row.offset[i]) / row.slope[i]);
    }
    return g;
}

/* Returns the force at node i and deflection g, N. */
static double force_of(const dynamics_spring_nodes *nodes, size_t i, double g)
{
    double force = 0;
    for (size_t n = 0; n < nodes->lines; n++) {
        const dynamics_spring_row row = dynamics_spring_row_of(nodes, n);
        force = fmax(force, row.slope[i] * g - row.offset[i]);
    }
    return force;
}

/* Three springs: from all levels, from every second level, and from the other levels. */
enum { SPRINGS = 3 };
typedef struct springs {
    dynamics_spring_nodes of[SPRINGS];
    size_t kept[SPRINGS][DYNAMICS_LINES], count[SPRINGS];
} springs;

/* Returns the largest change of the forces if only one half of the levels is used. Both halves are
   needed: near a level, the half that contains this level shows no change. */
static double largest_change(const dynamics_force_levels *l, const springs *s, double force)
{
    const dynamics_chosen_levels all = {l, s->kept[0], s->count[0]};
    double worst = 0;
    for (int k = 1; k < SPRINGS; k++) {
        const dynamics_chosen_levels half = {l, s->kept[k], s->count[k]};
        for (size_t i = 0; i < l->phases; i++) {
            double g = deflection_of(&s->of[0], i, force);
            worst = fmax(worst, fabs(force_of(&s->of[k], i, g) - force));
        }
        for (size_t i = 0; l->tooth_force && i < l->stations; i++)
            worst = fmax(worst, fabs(dynamics_tooth_force(&all, force, i) -
                                     dynamics_tooth_force(&half, force, i)));
    }
    return worst;
}

/* Returns the force of a level next to the level of the mean force. */
static double neighbour_of(const dynamics_force_levels *l, double mean)
{
    size_t i = 0;
    while (i + 1 < l->count && l->force[i] < mean * (1 - 1e-6))
        i++;
    return i + 1 < l->count ? l->force[i + 1] : l->force[i - 1];
}

/* Returns the change of mesh and tooth forces (N), at a force beyond the last level, if the last
   level is left out too. The last line is extended, and the last load shares are kept. Returns -1
   if out of memory. */
static double change_beyond(const dynamics_inputs *inputs, double force)
{
    const dynamics_force_levels *l = &inputs->levels;
    dynamics_force_levels fewer = *l;
    dynamics_spring_nodes s[2] = {{0}, {0}};
    double convex, worst = -1;
    size_t last = l->count - 1;
    if (last < 2)
        return force;
    fewer.count--;
    if (dynamics_spring_nodes_share(l, inputs->reference, 1, &s[0], &convex) &&
        dynamics_spring_nodes_share(&fewer, inputs->reference, 1, &s[1], &convex)) {
        worst = 0;
        for (size_t i = 0; i < l->phases; i++)
            worst = fmax(worst, fabs(force_of(&s[1], i, deflection_of(&s[0], i, force)) - force));
        for (size_t i = 0; l->tooth_force && i < l->stations; i++) {
            const double *W = l->tooth_force + last * l->stations + i;
            worst = fmax(
                worst, fabs(*W / l->force[last] - *(W - l->stations) / l->force[last - 1]) * force);
        }
    }
    dynamics_spring_nodes_free(&s[0]);
    dynamics_spring_nodes_free(&s[1]);
    return worst;
}

double dynamics_level_error(const dynamics_inputs *inputs, double least, double largest)
{
    enum { FORCES = 32 };
    const dynamics_force_levels *l = &inputs->levels;
    springs s = {0};
    double convex, worst = -1, from[SPRINGS] = {inputs->reference, inputs->reference};
    double end = l->force[l->count - 1], beyond = 0;
    if (largest > end)
        beyond = change_beyond(inputs, largest);
    least = fmax(least, 0);
    largest = fmin(largest, end);
    int made = beyond >= 0;
    from[2] = neighbour_of(l, inputs->reference);
    for (int i = 0; i < SPRINGS && made; i++) {
        const int every = i ? 2 : 1;
        s.count[i] = dynamics_spring_levels(l, from[i], every, s.kept[i]);
        made = dynamics_spring_nodes_share(l, from[i], every, &s.of[i], &convex);
    }
    for (int i = 0; made && i <= FORCES; i++)
        worst = fmax(worst, largest_change(l, &s, least + (largest - least) * i / FORCES));
    for (int i = 0; i < SPRINGS; i++)
        dynamics_spring_nodes_free(&s.of[i]);
    return worst < 0 ? -1 : fmax(worst, beyond) / inputs->reference;
}

/* Names the load at which the curves of the stiffness were computed. */
static const char *load_of(const dynamics_inputs *inputs)
{
    return inputs->reference == inputs->line_force ? "mean" : "reference";
}

/* Returns the interpolation error of the force of the back flanks, which have their own curves,
   from 0 to `force` (N). */
static double error_of_back_levels(const dynamics_inputs *inputs, double force)
{
    dynamics_inputs back = *inputs;
    back.levels = inputs->back_levels;
    return dynamics_level_error(&back, 0, force);
}

static int reach(const dynamics_force_levels *l, double force)
{
    return force <= l->force[l->count - 1];
}

static void report_levels(const dynamics_inputs *inputs, double least, double largest,
                          const ff_host *host)
{
    static const double limit = 0.05;
    const dynamics_force_levels *l = &inputs->levels;
    double mean = inputs->reference, error = dynamics_level_error(inputs, least, largest);
    int known = reach(l, largest);
    char text[400];
    if (inputs->back_levels.count > 0 && least < 0) {
        const double back = error_of_back_levels(inputs, -least);
        error = error < 0 || back < 0 ? -1 : fmax(error, back);
        known = known && reach(&inputs->back_levels, -least);
    }
    snprintf(text, sizeof text,
             "change of mesh and tooth forces, over the %s load, if every second of the %zu force "
             "levels of the stiffness is left out; the mesh force of the motion is %.3g to %.3g "
             "times that load%s%s",
             load_of(inputs), l->count, least / mean, largest / mean,
             known ? "" : ", beyond the largest force level, which is then left out too",
             l->tooth_force ? ""
                            : "; the stiffness gives no tooth forces at these levels, so those of "
                              "the mean load are scaled in proportion");
    host->quality(host->ctx, "force_levels", fmax(error, 0), limit,
                  error >= 0 && error <= limit && known && l->tooth_force ? FF_GOOD : FF_DOUBTFUL,
                  text);
}

dynamics_sharing_change dynamics_sharing_change_at(const dynamics_force_levels *l, double mean,
                                                   double force)
{
    dynamics_sharing_change found = {0, 0};
    force = fmin(fmax(force, l->force[1]), l->force[l->count - 1]);
    place at = place_of(l, force), from = place_of(l, mean);
    for (size_t i = 0; i < l->stations; i++) {
        double share = value_at(l->tooth_force, l->stations, &at, i) / force;
        double usual = value_at(l->tooth_force, l->stations, &from, i) / mean;
        found.share = fmax(found.share, fabs(share - usual));
    }
    for (size_t i = 0; i < l->phases; i++) {
        double slope = value_at(l->stiffness, l->phases, &at, i);
        double usual = value_at(l->stiffness, l->phases, &from, i);
        found.slope = fmax(found.slope, fabs(slope / usual - 1));
    }
    return found;
}

/* Returns the force of a frozen spring at node i and deflection g, N. */
static double frozen_force(const dynamics_mesh_curves *curves, const dynamics_spring_nodes *nodes,
                           size_t i, double g)
{
    const double *k = nodes->stiffness ? nodes->stiffness : curves->stiffness;
    return nodes->lines ? force_of(nodes, i, g) : k[i] * g;
}

/* Returns whether the levels meet the preconditions of dynamics_spring_nodes_share. */
static int make_a_spring(const dynamics_force_levels *l)
{
    int made = l->count >= 2 && l->count <= DYNAMICS_LINES && l->error;
    for (size_t at = 0; made && at < l->count * l->phases; at++)
        made = (at < l->phases || l->error[at] > l->error[at - l->phases]) &&
               (!l->stiffness || l->stiffness[at] > 0);
    return made;
}

double dynamics_slope_change(const dynamics_inputs *inputs, int on_chord, double least,
                             double largest)
{
    const dynamics_force_levels *l = &inputs->levels;
    dynamics_spring_nodes mesh, frozen = {0};
    double convex, mean = inputs->reference, of_mesh = 0, of_frozen = 0;
    int made =
        dynamics_spring_nodes_share(l, mean, 1, &mesh, &convex) &&
        dynamics_spring_nodes_make(&inputs->curves, inputs->loaded_error, mean, on_chord, &frozen);
    least = fmax(least, 0);
    largest = fmin(largest, l->force[l->count - 1]);
    for (size_t i = 0; made && i < l->phases; i++) {
        double from = deflection_of(&mesh, i, least), to = deflection_of(&mesh, i, largest);
        of_mesh += (largest - least) / (to - from);
        of_frozen += (frozen_force(&inputs->curves, &frozen, i, to) -
                      frozen_force(&inputs->curves, &frozen, i, from)) /
                     (to - from);
    }
    dynamics_spring_nodes_free(&mesh);
    dynamics_spring_nodes_free(&frozen);
    return made ? of_mesh / of_frozen - 1 : NAN;
}

static void report_slope(const dynamics_inputs *inputs, int on_chord, double least, double largest,
                         const ff_host *host)
{
    static const double limit = 0.02;
    double change = dynamics_slope_change(inputs, on_chord, least, largest);
    int known = largest <= inputs->levels.force[inputs->levels.count - 1];
    char text[400];
    snprintf(text, sizeof text,
             "between the smallest and the largest mesh force of the motion the mesh is on average "
             "%.3g %% %s than the mesh spring used, which is that of the %s load, so its "
             "resonances are about %.2g %% %s%s",
             100 * fabs(change), change < 0 ? "softer" : "steeper", load_of(inputs),
             50 * fabs(change), change < 0 ? "lower" : "higher",
             known ? "" : "; the stiffness gives no larger forces");
    host->quality(host->ctx, "slope_change", fabs(change), limit,
                  fabs(change) <= limit && known ? FF_GOOD : FF_RANGE, text);
}

void dynamics_sharing_report(const dynamics_inputs *inputs, int on_chord, double least,
                             double largest, const ff_host *host)
{
    static const double limit = 0.02;
    const dynamics_force_levels *l = &inputs->levels;
    double mean = inputs->reference;
    char text[400];
    if (inputs->shared) {
        report_levels(inputs, least, largest, host);
        return;
    }
    if (l->count < 2 || !(mean > 0) || !(largest - least > 1e-9 * mean))
        return;
    if (make_a_spring(l))
        report_slope(inputs, on_chord, least, largest, host);
    if (!l->stiffness || !l->tooth_force)
        return;
    dynamics_sharing_change low = dynamics_sharing_change_at(l, mean, least);
    dynamics_sharing_change high = dynamics_sharing_change_at(l, mean, largest);
    double share = fmax(low.share, high.share), slope = fmax(low.slope, high.slope);
    int known = largest <= l->force[l->count - 1];
    snprintf(text, sizeof text,
             "largest change of a pair's load share between the %s load, whose load sharing and "
             "stiffness the motion uses, and the mesh forces of the motion, %.3g to %.3g times "
             "that load; the tangent stiffness changes by up to %.3g %%%s",
             load_of(inputs), fmax(least, l->force[1]) / mean,
             fmin(largest, l->force[l->count - 1]) / mean, 100 * slope,
             known ? "" : "; the stiffness gives no larger forces");
    host->quality(host->ctx, "sharing_change", share, limit,
                  share <= limit && known ? FF_GOOD : FF_RANGE, text);
}
