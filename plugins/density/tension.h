/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Density below ambient pressure: the law's tangent, bent so that it stays positive. */
#ifndef DENSITY_TENSION_H
#define DENSITY_TENSION_H

/* rho/rho0 from y = 1 + p/K0 < 1. The tangent y itself down to 1/2; below, 1/(4 (1 - y)), which
   joins it with the same value and slope and never reaches 0. */
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
