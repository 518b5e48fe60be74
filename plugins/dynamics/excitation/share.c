/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "share.h"

#include <math.h>

static size_t level_of(const dynamics_chosen_levels *c, size_t i)
{
    return c->kept ? c->kept[i] : i;
}

static double force_at(const dynamics_chosen_levels *c, size_t i)
{
    return c->of->force[level_of(c, i)];
}

static double tooth_at(const dynamics_chosen_levels *c, size_t i, size_t station)
{
    return c->of->tooth_force[level_of(c, i) * c->of->stations + station];
}

static double rise_over(const dynamics_chosen_levels *c, size_t i, size_t station)
{
    return (tooth_at(c, i + 1, station) - tooth_at(c, i, station)) /
           (force_at(c, i + 1) - force_at(c, i));
}

double dynamics_tooth_force(const dynamics_chosen_levels *c, double force, size_t station)
{
    size_t low = 0;
    while (low + 2 < c->count && force_at(c, low + 1) <= force)
        low++;
    double rise = rise_over(c, low, station), from = tooth_at(c, low, station);
    double straight = from + rise * (force - force_at(c, low));
    if (low == 0 || low + 2 >= c->count)
        return straight;
    double before = rise_over(c, low - 1, station), behind = rise_over(c, low + 1, station);
    if (!((rise - before) * (behind - rise) > 0))
        return straight;
    double left = from + before * (force - force_at(c, low));
    double right = tooth_at(c, low + 1, station) - behind * (force_at(c, low + 1) - force);
    return before < behind ? fmax(left, right) : fmin(left, right);
}

double dynamics_back_share(const dynamics_inputs *inputs, size_t station, double force)
{
    const dynamics_force_levels *l = &inputs->back_levels;
    const dynamics_chosen_levels all = {l, NULL, l->count};
    if (!l->tooth_force || l->count < 2) /* gears that float */
        return 0;
    force = inputs->shared ? force : inputs->reference;
    force = fmin(fmax(force, l->force[1]), l->force[l->count - 1]);
    return dynamics_tooth_force(&all, force, station) / force;
}

double dynamics_share(const dynamics_inputs *inputs, size_t station, double force)
{
    const dynamics_force_levels *l = &inputs->levels;
    const dynamics_chosen_levels all = {l, NULL, l->count};
    if (inputs->shared && l->tooth_force) {
        force = fmin(fmax(force, l->force[1]), l->force[l->count - 1]);
        return dynamics_tooth_force(&all, force, station) / force;
    }
    if (inputs->line_force > 0)
        return inputs->tooth_force[station] / inputs->line_force;
    return inputs->load_share ? inputs->load_share[station] : 0;
}
