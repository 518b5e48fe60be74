/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "results.h"

int ehl_loss_of_shear(uint64_t wanted)
{
    return (wanted &
            (FF_BIT(EHL_FRICTION_COEFFICIENT) | FF_BIT(EHL_TRACTION) | FF_BIT(EHL_POWER_LOSS) |
             FF_BIT(EHL_SLIDING_LOSS) | FF_BIT(EHL_ASPERITY_LOSS))) != 0;
}

int ehl_loss_of_flow(uint64_t wanted)
{
    return (wanted &
            (FF_BIT(EHL_POWER_LOSS) | FF_BIT(EHL_ROLLING_LOSS) | FF_BIT(EHL_SQUEEZE_LOSS))) != 0;
}

int ehl_wants_h_min(uint64_t wanted)
{
    static const uint64_t all = FF_BIT(EHL_H_MIN) | FF_BIT(EHL_H_MIN_ERROR) | FF_BIT(EHL_FILM) |
                                FF_BIT(EHL_H_MIN_LOWEST) | FF_BIT(EHL_H_MIN_LOWEST_AT) |
                                FF_BIT(EHL_H_MIN_LOWEST_MEAN) | FF_BIT(EHL_H_MIN_LOWEST_SPREAD) |
                                FF_BIT(EHL_FILM_AT_LANDING) | FF_BIT(EHL_FILM_AT_LANDING_ERROR);
    return (wanted & all) != 0;
}

int ehl_wants_h_central(uint64_t wanted)
{
    static const uint64_t all = FF_BIT(EHL_H_CENTRAL) | FF_BIT(EHL_H_CENTRAL_ERROR) |
                                FF_BIT(EHL_FILM) | FF_BIT(EHL_LAMBDA_RATIO) |
                                FF_BIT(EHL_LAMBDA_RATIO_LOWEST);
    return (wanted & all) != 0 || ehl_loss_of_shear(wanted);
}

int ehl_wants_p_max(uint64_t wanted)
{
    static const uint64_t all = FF_BIT(EHL_P_MAX) | FF_BIT(EHL_P_MAX_ERROR) |
                                FF_BIT(EHL_P_MAX_HIGHEST) | FF_BIT(EHL_P_MAX_AT_LANDING) |
                                FF_BIT(EHL_P_MAX_AT_LANDING_ERROR) | FF_BIT(EHL_PRESSURE);
    return (wanted & all) != 0;
}

int ehl_wants_lowest_alone(uint64_t wanted)
{
    static const uint64_t lowest = FF_BIT(EHL_H_MIN_LOWEST) | FF_BIT(EHL_H_MIN_LOWEST_AT);
    return ehl_wants_h_min(wanted & lowest) && !ehl_wants_h_min(wanted & ~lowest);
}

int ehl_wants_highest_alone(uint64_t wanted)
{
    static const uint64_t highest = FF_BIT(EHL_P_MAX_HIGHEST);
    return ehl_wants_p_max(wanted & highest) && !ehl_wants_p_max(wanted & ~highest);
}

/* Returns the least value of the parabola through the lowest node and its neighbours. With
   rough flanks, or if the parabola falls below half the value of the lowest node, the minimum is
   not resolved: returns the value of the node. Sets *at to the lowest node. */
double ehl_least_film(const ehl_reynolds *eq, size_t *at)
{
    const double *h = eq->h;
    size_t i = 0;
    for (size_t k = 1; k < eq->nodes; k++)
        if (h[k] < h[i])
            i = k;
    *at = i;
    if (i == 0 || i + 1 == eq->nodes || eq->rough)
        return h[i];
    double slope = (h[i + 1] - h[i - 1]) / 2, bend = h[i + 1] - 2 * h[i] + h[i - 1];
    double dip = bend > 0 ? slope * slope / (2 * bend) : 0;
    return dip < h[i] / 2 ? h[i] - dip : h[i];
}

/* Interpolates to x = 0 by a cubic through four nodes; with rough flanks by a line through two,
   since a cubic undershoots thin films, even below 0. */
double ehl_central_film(const ehl_grid *g, const ehl_reynolds *r)
{
    const double *y = r->h;
    double place = -r->first / g->dx;
    size_t i = (size_t)place;
    i = i < 1 ? 1 : i > g->nodes - 3 ? g->nodes - 3 : i;
    double t = place - (double)i;
    if (r->rough)
        return (1 - t) * y[i] + t * y[i + 1];
    return -t * (t - 1) * (t - 2) / 6 * y[i - 1] + (t + 1) * (t - 1) * (t - 2) / 2 * y[i] -
           (t + 1) * t * (t - 2) / 2 * y[i + 1] + (t + 1) * t * (t - 1) / 6 * y[i + 2];
}
