/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Density below ambient pressure: follows the tangent of the law, but stays positive. */
#ifndef DENSITY_TENSION_H
#define DENSITY_TENSION_H

/* Returns rho/rho0 for y = 1 + p/K0 < 1. It is y down to 1/2, and 1/(4 (1 - y)) below, which has
   the same value and slope at 1/2 and never reaches 0. */
static inline double density_tension(double y)
{
    return y >= 0.5 ? y : 0.25 / (1 - y);
}

/* d(rho/rho0)/dy */
static inline double density_tension_slope(double y)
{
    return y >= 0.5 ? 1 : 0.25 / (1 - y) / (1 - y);
}

#endif
