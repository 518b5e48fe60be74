/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the film that enters a line contact through its inlet, after Ertel and Grubin. Upstream
   of x = -a the gap is that of the Hertzian contact plus the film thickness: h = h_e + (a^2/(2R))
   [s sqrt(s^2 - 1) - arcosh s], s = -x/a. The steady Reynolds equation dp/dx = 12 u (rho h - rho_e
   h_e)/(rho h^3 psi) is integrated up to x = -a with the laws of the oil. In the theory of Ertel
   and Grubin the pressure tends to infinity there. Here it tends to p_e, which combines two bounds.
   The first, p_d, is the pressure of the Hertzian contact at a depth of the order of the length l
   over which the gap grows by h_e (Greenwood 1972 joins inlet and contact in a similar way). The
   second bound, b/alpha-star, is the pressure at which the oil is so thick that the film no longer
   changes: 1/p_e = 1/p_d + alpha-star/b, p_d = p_H sqrt(2 y/(1 + 2 y)), y = c^2 l/a, l = a (3 h_e
   R/(2 sqrt(2) a^2))^(2/3). The first bound alone gives H ~ M^-1/5, the film of an oil whose
   viscosity does not depend on pressure; the second alone gives the film of Ertel and Grubin. The
   fitted constants c and b replace the deformation of the inlet by its own pressure, which is
   neglected. */
#ifndef EHL_INLET_H
#define EHL_INLET_H

#include "../contact/history.h"
#include "../contact/liquid.h"

enum { EHL_INLET_TABLE = 257 };

/* Tables of the oil over pressure, so that only the shear law must be evaluated for a film. */
typedef struct ehl_inlet {
    ehl_laws laws;
    ehl_oil oil;
    double alpha;        /* film-forming coefficient, 1/Pa */
    double conductivity; /* conductivity of the oil if it is heated, W/(m K); else 0 */
    double step;         /* pressure step between the rows of the tables, Pa */
    double p[EHL_INLET_TABLE];
    double q[EHL_INLET_TABLE]; /* reduced pressure, int eta0/eta dp, Pa */
    double rho[EHL_INLET_TABLE], ln_eta[EHL_INLET_TABLE];
    double slope[EHL_INLET_TABLE]; /* d ln eta/dT, 1/K, if the oil is heated */
} ehl_inlet;

/* Fills the tables for contacts with Hertz pressures up to `highest`; alpha: ehl_alpha_star;
   conductivity: as in ehl_inlet. Returns FF_DOMAIN if a law was extrapolated. */
ff_status ehl_inlet_fill(ehl_inlet *n, const ehl_laws *laws, const ehl_oil *oil, double alpha,
                         double conductivity, double highest);

/* Returns rho h of the oil that enters with `speed`, kg/m2. load, radius and speed must be above 0.
   guess: h_e to start from; *off: the remaining error of ln q at x = -a. */
double ehl_inlet_mass(const ehl_inlet *n, const ehl_instant *at, double speed, double modulus,
                      double guess, double *off);

/* Returns the minimum film at the exit over rho h/rho0 inside the contact: 0.725 if the viscosity
   increases strongly with pressure, otherwise 0.795. Fitted to full solutions of M 5 to 200 and L 0
   to 10, within 1 %. */
double ehl_exit_ratio(double alpha, double p_hertz);

/* Data for the share of the film that is lost by shear heating of the oil in the inlet. */
typedef struct ehl_inlet_heating {
    double conductivity; /* conductivity of the oil, W/(m K) */
    double slope;        /* -d ln eta/dT, 1/K; 0: that of the law, or 0.03 if the law does not
                            depend on temperature */
} ehl_inlet_heating;

/* Parameter rows for a model with a member `heating`. */
#define EHL_HEATING_PARAMS(type)                                                                   \
    FF_QUANTITY("oil_conductivity", "W/(m K)", type, heating.conductivity, 0, "0.14 W/(m K)",      \
                NULL, 1e-3, 1e3, 0, 0,                                                             \
                "thermal conductivity of the oil, used only for the quality line inlet_heating; "  \
                "oils have 0.1 to 0.17"),                                                          \
        FF_QUANTITY_OR("auto", "temperature_slope", "1/K", type, heating.slope, FF_MIN_OPEN,       \
                       "auto", NULL, 0, 10, 0, 0,                                                  \
                       "-d ln(eta)/dT of the oil, used only for inlet_heating; auto: that of the " \
                       "viscosity law, or 0.03 1/K if the law does not depend on temperature")

/* Returns the film with heating over the film without: Q = eta0 beta u^2/k, S = |u1 - u2|/u.
   Returns 0 if the fit is so far outside its range that it is negative. */
double ehl_gupta_factor(double p_hertz, double modulus, double Q, double S);

/* Writes the quality line with the largest share of the film lost at any loaded instant. `heated`:
   the film already includes the heat of its inlet. */
void ehl_inlet_heating_report(const ff_host *host, const ehl_inlet_heating *heating, int heated,
                              const ehl_history *h, const ehl_laws *laws, const ehl_oil *oil);

/* Returns the share of the film that is lost because the domain begins at x = -end, compared with
   an infinite inlet, from Reynolds' equation upstream of the domain. h is the central film. Returns
   1 if the domain begins inside the contact. The load and the radius of `at` must be above 0. */
double ehl_starvation(const ehl_oil *oil, const ehl_instant *at, double modulus, double h,
                      double end);

/* Returns the share of this starvation that remains if the domain begins with the pressure `fed`.
   The gap changes with the speed `closing` at x = 0 and with `closing` + `spreading` at x = -end,
   m/s. */
double ehl_unfed(const ehl_oil *oil, const ehl_instant *at, double modulus, double h, double end,
                 double fed, double closing, double spreading);

/* Shortest inlet in front of every contact that may begin with the pressure of a longer inlet, in
   units of S, the length over which the pressure of the inlet rises. Half of the pressure of a
   rigid cylinder arises within this inlet. */
#define EHL_FED_LENGTHS 2

/* The quality line `starvation` is doubtful above this share of the film. */
#define EHL_STARVED_LIMIT 0.01

/* Returns the distance from x = 0 at which a domain must begin so that ehl_starvation is below
   EHL_STARVED_LIMIT at every loaded instant, m. */
double ehl_inlet_supplied(const ehl_history *h, const ehl_oil *oil);

/* Returns the length of an inlet at which the film lost by starvation equals the error due to the
   cells, m. The cells fill the domain from the start of the inlet to `outlet` (m) behind x = 0. The
   result is at most `longest`. A shorter inlet loses more film, a longer inlet has coarser
   cells. */
double ehl_inlet_balanced(const ehl_history *h, const ehl_oil *oil, size_t cells, double outlet,
                          double longest);

#endif
