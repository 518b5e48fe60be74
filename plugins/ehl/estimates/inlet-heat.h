/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the heat of shear in the inlet takes off the resistance of the oil to its pressure flow, as
 * if conduction alone took it to flanks of one temperature: the ratio R(F, S) of channel.h, from a
 * table of its solutions, at each place with
 *
 *   F = beta U^2/(k psi),  U = u_r |1 - (rho h)_0/(rho h)|,   S = beta tau_m u_s h/k
 *
 * of the film at the oil's temperature; (rho h)_0 is that at the highest pressure.
 */
#ifndef EHL_INLET_HEAT_H
#define EHL_INLET_HEAT_H

#include "../contact/liquid.h"
#include "channel.h"

/* Ranks of the words of `thermal`. */
enum { EHL_THERMAL_NONE, EHL_THERMAL_INLET, EHL_THERMAL_FULL };
enum { EHL_THERMAL_LOCAL = EHL_THERMAL_FULL }; /* of the estimates */

/* Gives the conductivity of the oil at the temperature of its laws, W/(m K), and writes a quality
 * line that says whether the laws depend on temperature. FF_INVALID. */
ff_status ehl_heat_conductivity(const ff_host *host, const ff_liquid *liquid, const ehl_laws *laws,
                                double *conductivity);

/* Rise of the conductivity with pressure, 1 + rise p/(1 + bend p), both in 1/Pa; 0: none. */
typedef struct ehl_conductivity_rise {
    double rise, bend;
} ehl_conductivity_rise;

/* Gives the rise stated by the oil, 0 if it states none. */
ehl_conductivity_rise ehl_heat_conductivity_rise(const ff_liquid *liquid, double T);

/* Returns R(F, S); outside the table, its value at the edge. */
double ehl_heat_ratio(double F, double S);

/* A film with a heated inlet. */
typedef struct ehl_heated {
    double entrainment, sliding, conductivity;
    double middle; /* rho h at the highest pressure, kg/m2 */
} ehl_heated;

/* Gives R at n places from p, h and rho h of the film at the oil's temperature. *most is the
 * largest of F and S; `room` holds 5 n numbers. FF_DOMAIN: a law was continued. */
ff_status ehl_inlet_ratio(const ehl_laws *laws, const ehl_heated *film, size_t n, const double *p,
                          const double *h, const double *mass, double *room, double *ratio,
                          double *most);

#endif
