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

/* The conductivity of the oil at the temperature that its laws are called with, W/(m K), and
   whether they know temperature, which a quality line says; FF_INVALID. */
ff_status ehl_heat_conductivity(const ff_host *host, const ff_liquid *liquid, const ehl_laws *laws,
                                double *conductivity);

/* How the conductivity rises with pressure, 1 + rise p/(1 + bend p), in 1/Pa; 0: it does not. */
typedef struct ehl_conductivity_rise {
    double rise, bend;
} ehl_conductivity_rise;

/* That of the oil, which need not tell. */
ehl_conductivity_rise ehl_heat_conductivity_rise(const ff_liquid *liquid, double T);

/* R(F, S). Beyond the table it is that of its edge. */
double ehl_heat_ratio(double F, double S);

/* The film that heats itself. */
typedef struct ehl_heated {
    double entrainment, sliding, conductivity;
    double middle; /* rho h at the highest pressure, kg/m2 */
} ehl_heated;

/* R at n places of the film at the oil's temperature: of p, h and rho h. FF_DOMAIN: a law was
   continued. *most: the largest of F and S. `room`: 5 n numbers. */
ff_status ehl_inlet_ratio(const ehl_laws *laws, const ehl_heated *film, size_t n, const double *p,
                          const double *h, const double *mass, double *room, double *ratio,
                          double *most);

#endif
