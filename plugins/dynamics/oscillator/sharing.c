/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sharing.h"

#include <math.h>
#include <stdio.h>

/* Straight lines between levels: the number of the lower one, and the share of the upper one. */
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

void dynamics_sharing_report(const dynamics_inputs *inputs, double least, double largest,
                             const ff_host *host)
{
    static const double limit = 0.02;
    const dynamics_force_levels *l = &inputs->levels;
    double mean = inputs->line_force;
    char text[320];
    if (l->count < 2 || !(mean > 0) || !(largest - least > 1e-9 * mean))
        return;
    dynamics_sharing_change low = dynamics_sharing_change_at(l, mean, least);
    dynamics_sharing_change high = dynamics_sharing_change_at(l, mean, largest);
    double share = fmax(low.share, high.share), slope = fmax(low.slope, high.slope);
    int known = largest <= l->force[l->count - 1];
    snprintf(text, sizeof text,
             "largest change of the share of a pair between the mean load, whose sharing and slope "
             "the motion takes, and its mesh forces, %.3g to %.3g times that load; the slope of "
             "the mesh changes by up to %.3g %%%s",
             fmax(least, l->force[1]) / mean, fmin(largest, l->force[l->count - 1]) / mean,
             100 * slope, known ? "" : "; larger forces are not known");
    host->quality(host->ctx, "sharing_change", share, limit,
                  share <= limit && known ? FF_GOOD : FF_RANGE, text);
}
