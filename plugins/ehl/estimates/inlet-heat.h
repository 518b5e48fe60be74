/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reduction of the oil's resistance to pressure flow by the heat of shear in the inlet, as if only
   conduction to flanks of equal temperature removed the heat: the ratio R(F, S) of channel.h, from
   a table of solutions. At each point F = beta U^2/(k psi), U = u_r |1 - (rho h)_0/(rho h)|, S =
   beta tau_m u_s h/k for the film at the oil's temperature. (rho h)_0 is the value at the highest
   pressure. */
#ifndef EHL_INLET_HEAT_H
#define EHL_INLET_HEAT_H

#include "../contact/liquid.h"
#include "channel.h"

/* Indices of the words of `thermal`. */
enum { EHL_THERMAL_NONE, EHL_THERMAL_INLET, EHL_THERMAL_FULL };
enum { EHL_THERMAL_LOCAL = EHL_THERMAL_FULL }; /* used by the estimates */

/* Sets the conductivity of the oil at the temperature of its laws, W/(m K). Writes a quality line
   on whether the laws depend on temperature. Returns FF_INVALID if there is no conductivity. */
ff_status ehl_heat_conductivity(const ff_host *host, const ff_liquid *liquid, const ehl_laws *laws,
                                double *conductivity);

/* Increase of the conductivity with pressure by the factor 1 + rise p/(1 + bend p), both in 1/Pa;
   0: none. */
typedef struct ehl_conductivity_rise {
    double rise, bend;
} ehl_conductivity_rise;

/* Returns the increase that the oil gives, or 0 if the oil gives none. */
ehl_conductivity_rise ehl_heat_conductivity_rise(const ff_liquid *liquid, double T);

/* Returns R(F, S); outside the table, the value at the edge of the table. */
double ehl_heat_ratio(double F, double S);

/* A film with a heated inlet. */
typedef struct ehl_heated {
    double entrainment, sliding, conductivity;
    double middle; /* rho h at the highest pressure, kg/m2 */
} ehl_heated;

/* Computes R at n points from p, h and rho h of the film at the oil's temperature. Sets *most to
   the largest value of F and S. `room` is an array of 5 n numbers. Returns FF_DOMAIN if a law was
   extrapolated. */
ff_status ehl_inlet_ratio(const ehl_laws *laws, const ehl_heated *film, size_t n, const double *p,
                          const double *h, const double *mass, double *room, double *ratio,
                          double *most);

#endif
