/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The three laws of the liquid as the film uses them. */
#ifndef EHL_LIQUID_H
#define EHL_LIQUID_H

#include "../../numerics/isothermal.h"

#include <flankfilm/density.h>
#include <flankfilm/rheology.h>
#include <flankfilm/viscosity.h>

typedef struct ehl_laws {
    const ff_viscosity *viscosity;
    const ff_density *density;
    const ff_rheology_3 *rheology; /* NULL: Newtonian */
    const ff_rheology
        *rheology_ambient;     /* the law without pressure, for solvers of other plugins */
    double temperature;        /* K, of the oil; 0: none, each law uses its own temperature */
    numerics_answers *answers; /* failures of the laws to answer; NULL: not recorded */
} ehl_laws;

typedef struct ehl_rheology_at {
    ff_rheology_3 service;
    ff_rheology ambient;
    const ff_rheology *law;
    const ff_rheology_3 *at_pressure; /* NULL: the law does not offer it */
    const double *T; /* K, NUMERICS_POINTS equal values; NULL: the law's own temperature */
    numerics_answers *answers;
} ehl_rheology_at;

/* The laws of a stage, set to one temperature if an oil is wired, and checked against the contract
 * of a law. */
typedef struct ehl_isothermal {
    ehl_laws wired;
    numerics_viscosity_at viscosity;
    numerics_density_at density;
    ehl_rheology_at rheology;
    numerics_answers answers;
} ehl_isothermal;

enum { EHL_OIL_ROWS = 3 };

/* Sets the laws to the temperature in the oil's rows, if given, and checks them against the oil's
 * viscosity and density. The wired laws are kept at the first call. Failures are recorded in
 * at->answers; the stage ends with numerics_answers_end. */
ff_status ehl_laws_at(ehl_isothermal *at, const ff_host *host, const ff_array *oil, ehl_laws *laws);

/* Moves laws set by ehl_laws_at from the temperature of one oil to another temperature. */
void ehl_laws_move(ehl_isothermal *at, ehl_laws *laws, double T);

/* The liquid at ambient pressure. */
typedef struct ehl_oil {
    double density, viscosity, ln_viscosity;
    double alpha; /* d ln eta/dp at p = 0, 1/Pa */
} ehl_oil;

/* Arrays of one value per node. */
typedef struct ehl_liquid {
    double *rho, *rho_p; /* kg/m3 and d/dp */
    double *ln_eta, *ln_eta_p;
    double *psi, *psi_l, *psi_h,
        *psi_p; /* fluidity and its derivatives by ln eta, by h, and by p at fixed ln eta */
} ehl_liquid;

enum { EHL_LIQUID_ARRAYS = 8 };

/* Wraps the law, checked against its contract, in `to`, which lives as long as *at. `wired` has the
 * law as rheology_ambient and, if the law offers that, as rheology. `T` is as in ehl_rheology_at.
 */
void ehl_rheology_make(ehl_rheology_at *at, const ehl_laws *wired, const double *T, ehl_laws *to);

/* Returns whether one of the laws has failed, so that no film is possible. */
int ehl_laws_failed(const ehl_laws *laws);

/* After a film was not found: notes the first law whose values do not follow its slopes at
 * pressures up to `highest`. */
void ehl_laws_hold_slopes(const ehl_laws *laws, double highest);

ff_status ehl_fluid_oil(const ehl_laws *laws, ehl_oil *oil);

/* Returns the worst answer of the laws for a film. */
typedef enum ehl_law_answer { EHL_LAW_GOOD, EHL_LAW_CONTINUED } ehl_law_answer;

void ehl_law_note(ehl_law_answer *worst, ff_status status);
void ehl_law_report(const ff_host *host, ehl_law_answer worst); /* writes a quality line */

/* Evaluates all of `liquid` at n nodes; h > 0. FF_DOMAIN: a law was continued beyond its range. */
ff_status ehl_fluid_evaluate(const ehl_laws *laws, size_t n, const double *p, const double *h,
                             double sliding, const ehl_liquid *liquid);

/* Gives the mean shear stress tau at n nodes; T: n values, or NULL for the laws' temperature. */
ff_status ehl_fluid_shear(const ehl_laws *laws, size_t n, const double *p, const double *T,
                          const double *h, double sliding, double *ln_eta, double *tau);

/* Returns the part of int eta0/eta dp over one step in which ln(eta/eta0) goes from `left` to
 * `right`. It is exact for a linear ln(eta). */
double ehl_fluidity_integral(double step, double left, double right);

/* Film-forming pressure-viscosity coefficient, alpha* = 1/int_0^inf eta0/eta dp (Blok 1963). */
typedef struct ehl_film_coefficient {
    double value; /* 1/Pa; 0 where the viscosity does not rise by exp(40) */
    double error; /* of its quadrature, relative */
} ehl_film_coefficient;

ehl_film_coefficient ehl_alpha_star(const ehl_laws *laws);

/* Writes it with its error as a quality line. */
ff_status ehl_put_alpha_star(const ff_host *host, uint32_t output, ehl_film_coefficient alpha);

#endif
