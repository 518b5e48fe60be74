/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The three laws of the liquid, as used by the film models. */
#ifndef EHL_LIQUID_H
#define EHL_LIQUID_H

#include "../../numerics/isothermal.h"

#include <flankfilm/density.h>
#include <flankfilm/rheology.h>
#include <flankfilm/viscosity.h>

typedef struct ehl_laws {
    const ff_viscosity *viscosity;
    const ff_density *density;
    const ff_rheology_3 *rheology;       /* NULL: Newtonian */
    const ff_rheology *rheology_ambient; /* the law of rheology without pressure, for solvers of
                                            other plugins */
    double temperature;        /* temperature of the oil, K; 0: no oil, each law uses its own
                                  temperature */
    numerics_answers *answers; /* records failures of the laws; NULL: not recorded */
} ehl_laws;

typedef struct ehl_rheology_at {
    ff_rheology_3 service;
    ff_rheology ambient;
    const ff_rheology *law;
    const ff_rheology_3 *at_pressure; /* NULL: the law does not provide it */
    const double *T; /* NUMERICS_POINTS equal temperatures, K; NULL: the law's own temperature */
    numerics_answers *answers;
} ehl_rheology_at;

/* The laws of a stage, at one temperature if an oil is wired. Their results are checked against the
   rules for laws. */
typedef struct ehl_isothermal {
    ehl_laws wired;
    numerics_viscosity_at viscosity;
    numerics_density_at density;
    ehl_rheology_at rheology;
    numerics_answers answers;
} ehl_isothermal;

enum { EHL_OIL_ROWS = 3 };

/* Sets the laws to the temperature in the input rows of the oil, if given, and compares the laws
   with the viscosity and density of the oil. The first call stores the wired laws. Failures are
   recorded in at->answers; the stage calls numerics_answers_end at its end. */
ff_status ehl_laws_at(ehl_isothermal *at, const ff_host *host, const ff_array *oil, ehl_laws *laws);

/* Changes the temperature of laws set by ehl_laws_at. */
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
    double *psi, *psi_l, *psi_h, *psi_p; /* fluidity and its derivatives with respect to ln eta, to
                                            h, and to p at fixed ln eta */
} ehl_liquid;

enum { EHL_LIQUID_ARRAYS = 8 };

/* Wraps the law in `to` with a check of the rules for laws. `to` is valid as long as *at. `wired`
   contains the law as rheology_ambient and, if the law provides it, as rheology. For `T` see
   ehl_rheology_at. */
void ehl_rheology_make(ehl_rheology_at *at, const ehl_laws *wired, const double *T, ehl_laws *to);

/* Returns whether one of the laws has failed, so that no film is possible. */
int ehl_laws_failed(const ehl_laws *laws);

/* Called after a film was not found. Records the first law whose values do not agree with its
   slopes at pressures up to `highest`. */
void ehl_laws_hold_slopes(const ehl_laws *laws, double highest);

ff_status ehl_fluid_oil(const ehl_laws *laws, ehl_oil *oil);

/* Whether the laws were used within their range (GOOD) or extrapolated (CONTINUED). */
typedef enum ehl_law_answer { EHL_LAW_GOOD, EHL_LAW_CONTINUED } ehl_law_answer;

void ehl_law_note(ehl_law_answer *worst, ff_status status);
void ehl_law_report(const ff_host *host, ehl_law_answer worst); /* writes a quality line */

/* Evaluates all members of `liquid` at n nodes; h > 0. Returns FF_DOMAIN if a law was extrapolated
   beyond its range. */
ff_status ehl_fluid_evaluate(const ehl_laws *laws, size_t n, const double *p, const double *h,
                             double sliding, const ehl_liquid *liquid);

/* Computes the mean shear stress tau at n nodes. T has n values, or is NULL for the laws'
   temperature. */
ff_status ehl_fluid_shear(const ehl_laws *laws, size_t n, const double *p, const double *T,
                          const double *h, double sliding, double *ln_eta, double *tau);

/* Returns the contribution to int eta0/eta dp of a pressure step in which ln(eta/eta0) changes from
   `left` to `right`. The result is exact if ln(eta) is linear. */
double ehl_fluidity_integral(double step, double left, double right);

/* Film-forming pressure-viscosity coefficient, alpha* = 1/int_0^inf eta0/eta dp (Blok 1963). */
typedef struct ehl_film_coefficient {
    double value; /* 1/Pa; 0 if the viscosity does not increase by a factor exp(40) */
    double error; /* relative error due to the quadrature */
} ehl_film_coefficient;

ehl_film_coefficient ehl_alpha_star(const ehl_laws *laws);

/* Writes alpha* and, as a quality line, its error. */
ff_status ehl_put_alpha_star(const ff_host *host, uint32_t output, ehl_film_coefficient alpha);

#endif
