/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The three laws of the liquid, seen from the film. */
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
    const ff_rheology *rheology_ambient; /* the same without the pressure, for solvers of others */
    double temperature;                  /* K, that of the oil; 0: none, laws answer at their own */
    numerics_answers *answers;           /* what they failed to answer; NULL: nobody looks */
} ehl_laws;

typedef struct ehl_rheology_at {
    ff_rheology_3 service;
    ff_rheology ambient;
    const ff_rheology *law;
    const ff_rheology_3 *at_pressure; /* NULL: the law does not offer it */
    const double *T;                  /* K, NUMERICS_POINTS equal ones; NULL: that of the law */
    numerics_answers *answers;
} ehl_rheology_at;

/* What stands behind the laws of a stage: at one temperature, where an oil is wired, and held to
   what a law owes. */
typedef struct ehl_isothermal {
    ehl_laws wired;
    numerics_viscosity_at viscosity;
    numerics_density_at density;
    ehl_rheology_at rheology;
    numerics_answers answers;
} ehl_isothermal;

enum { EHL_OIL_ROWS = 3 };

/* Sets the laws to the temperature that the rows of the oil give, if any, and holds them against
   its viscosity and density. The wired laws are kept at the first call. What they fail to answer is
   in at->answers: the stage ends with numerics_answers_end. */
ff_status ehl_laws_at(ehl_isothermal *at, const ff_host *host, const ff_array *oil, ehl_laws *laws);

/* Takes laws that ehl_laws_at has set to the temperature of an oil to another one. */
void ehl_laws_move(ehl_isothermal *at, ehl_laws *laws, double T);

/* The liquid at ambient pressure. */
typedef struct ehl_oil {
    double density, viscosity, ln_viscosity;
    double alpha; /* d ln eta/dp at p = 0, 1/Pa */
} ehl_oil;

/* Pointers into arrays of one value per node. */
typedef struct ehl_liquid {
    double *rho, *rho_p; /* kg/m3 and d/dp */
    double *ln_eta, *ln_eta_p;
    double *psi, *psi_l, *psi_h, *psi_p; /* fluidity and d/d(ln eta), d/dh, d/dp at fixed ln eta */
} ehl_liquid;

enum { EHL_LIQUID_ARRAYS = 8 };

/* Puts the law, held to what it owes, into `to`; it lives as long as *at. `wired` has the law as
   rheology_ambient and, where it offers that, as rheology. `T`: as in ehl_rheology_at. */
void ehl_rheology_make(ehl_rheology_at *at, const ehl_laws *wired, const double *T, ehl_laws *to);

/* Whether one of the laws has failed, so that no film can be had. */
int ehl_laws_failed(const ehl_laws *laws);

/* Where no film was found: notes the first law whose values do not follow its slopes at pressures
   up to `highest`. */
void ehl_laws_hold_slopes(const ehl_laws *laws, double highest);

ff_status ehl_fluid_oil(const ehl_laws *laws, ehl_oil *oil);

/* The worst that the laws have answered for a film. */
typedef enum ehl_law_answer { EHL_LAW_GOOD, EHL_LAW_CONTINUED } ehl_law_answer;

void ehl_law_note(ehl_law_answer *worst, ff_status status);
void ehl_law_report(const ff_host *host, ehl_law_answer worst); /* a line of the quality record */

/* All of `liquid` at n nodes; h > 0. FF_DOMAIN: a law was continued out of its range. */
ff_status ehl_fluid_evaluate(const ehl_laws *laws, size_t n, const double *p, const double *h,
                             double sliding, const ehl_liquid *liquid);

/* Mean shear stress tau at n nodes; T: n, or NULL: the temperature of the laws. */
ff_status ehl_fluid_shear(const ehl_laws *laws, size_t n, const double *p, const double *T,
                          const double *h, double sliding, double *ln_eta, double *tau);

/* Returns the part of int eta0/eta dp over one step in which ln(eta/eta0) goes from `left` to
   `right`, exact where it is linear. */
double ehl_fluidity_integral(double step, double left, double right);

/* Film-forming pressure-viscosity coefficient, alpha* = 1/int_0^inf eta0/eta dp (Blok 1963). */
typedef struct ehl_film_coefficient {
    double value; /* 1/Pa; 0 where the viscosity does not rise by exp(40) */
    double error; /* of its quadrature, relative */
} ehl_film_coefficient;

ehl_film_coefficient ehl_alpha_star(const ehl_laws *laws);

/* Puts it, with its error as a line of the quality record. */
ff_status ehl_put_alpha_star(const ff_host *host, uint32_t output, ehl_film_coefficient alpha);

#endif
