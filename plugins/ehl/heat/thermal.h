/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Implements thermal: full, the temperatures across the film (energy.h) and their effect on the
   flow. While the film of an instant is solved for, its mobility, density and transported mass are
   those of the laws at the oil's temperature times constant factors. The next factors follow from
   the temperatures of this film; this is repeated until film and factors no longer change. */
#ifndef EHL_THERMAL_H
#define EHL_THERMAL_H

#include "../equations/march.h"
#include "../solvers/anderson.h"
#include "energy.h"

/* Factors of the flow across a film, at each node: factors on mobility, density and transported
   mass. */
enum { EHL_THERMAL_FACTORS = 3 };
/* Largest change of the factors in a round. A larger change is scaled down to it. */
static const double EHL_LARGE_FACTOR = 0.3;

/* Data of the flanks and the oil. */
typedef struct ehl_thermal_data {
    size_t across;                      /* number of nodes across the film */
    double conductivity, heat_capacity; /* of the oil, W/(m K) and J/(kg K) */
    ehl_conductivity_rise conducts;     /* increase of the conductivity with p */
    double bulk;                        /* temperature of the flanks and of the oil that enters,
                                           K */
    double flank_contact[2];            /* B = sqrt(k rho c), J/(m2 K s^0.5) */
    double flank_diffusivity[2];        /* k/(rho c), m2/s */
    double friction;                    /* friction coefficient of asperities in contact */
    const ff_rheology_2 *flow;          /* NULL: Newtonian */
} ehl_thermal_data;

typedef struct ehl_thermal {
    ehl_energy energy;
    ehl_energy_film film; /* film to which the temperatures belong */
    size_t width; /* number of values in a state: temperatures, modes and next factors of all
                     nodes */
    double *memory, *past, *p_t, *through;
    double *moved[2];             /* last two states, transported with the oil, if the nodes move
                                     with it */
    double *friction, *p_before;  /* heat of the asperities, W/m2; pressure of a state,
                                     transported with the oil */
    double *weight;               /* weight of a change at a node of a steady film */
    double coefficient;           /* friction coefficient of asperities in contact */
    double *ease, *swell, *carry; /* factors of the film that is solved for (reynolds.h) */
    double rounds, solved;        /* numbers of solutions for a film, and of instants */
    double off;                   /* change of the factors in the last round */
    double damping;               /* share of the change of the factors that is applied */
    double share;                 /* share of the change of the temperatures that a sweep applies */
    int idle;  /* number of rounds in which the factors had converged but the temperatures had
                  not */
    int round; /* number of solutions for the film of this instant */
    ehl_anderson anderson; /* acceleration of the factors of a steady film */
    double *now, *change;  /* the factors, and their change, for the acceleration */
    int without;           /* 1: films are solved without heat */
    int cold_fails;        /* 1: the steady film was not found even without heat */
    double diffusivity[2]; /* thermal diffusivity of the flanks, m2/s */
    double least_peclet;   /* smallest u a rho c/k of a flank over all loaded instants */
    double highest;        /* highest temperature, K */
    double by_nodes;  /* largest relative error of the flow due to the number of nodes across, of
                         the instants checked */
    double looked_at; /* largest temperature rise of the instants checked, K */
    double unbalanced, elsewise; /* largest imbalance of heat of the checked instants: from the
                                    equations, and from independent sums */
} ehl_thermal;

/* Makes the temperatures of a march. The states of the march contain them. Returns FF_UNSUPPORTED
   if a flank moves against the oil. */
ff_status ehl_thermal_create(ehl_thermal *t, const ff_host *host, ehl_march *m,
                             const ehl_thermal_data *data);
void ehl_thermal_destroy(ehl_thermal *t);

/* Removes the temperatures, before another engagement starts or a film is computed again. */
void ehl_thermal_restart(ehl_march *m);

/* Solves for the film of `step` like solver->solve, including its temperatures. */
ff_status ehl_thermal_solve(ehl_march *m, const ehl_step *step, ehl_film *film, double time,
                            int limit);

/* Advances the temperatures of a trial film without pressure. */
void ehl_thermal_rest(ehl_march *m, const ehl_step *step, double time);

/* Return, for the newest film, the mean temperature across it at node i, the highest temperature,
   and the highest rise of the flanks over the bulk temperature, K. */
double ehl_thermal_mean(const ehl_march *m, size_t i);
double ehl_thermal_highest(const ehl_march *m);
double ehl_thermal_flash(const ehl_march *m);

/* Return, for the newest film, tau_m at node i with the sign of u1 - u2, and the heat of the
   pressure flow. */
double ehl_thermal_stress(const ehl_march *m, size_t i);
double ehl_thermal_pressure_flow(const ehl_march *m);

/* Returns the temperatures and modes stored in a state. */
ehl_temperature ehl_thermal_state(const ehl_thermal *t, double *heat);

/* Returns the factors stored in a state: EHL_THERMAL_FACTORS arrays over the nodes. */
double *ehl_thermal_factors(const ehl_thermal *t, double *heat);

/* Sets the weights of changes along a steady film. */
void ehl_thermal_weigh(const ehl_thermal *t, const ehl_reynolds *r, const ehl_film *film);

/* Computes the next factors. Returns the largest change of the mass flow that they cause, relative
   to the mass transported with the flanks. */
double ehl_thermal_find_factors(ehl_thermal *t, const ehl_reynolds *r, const ehl_energy_film *f,
                                const ehl_film *film, double *next);

/* Accelerates the factors of a steady film with those of earlier rounds. */
void ehl_thermal_accelerate(ehl_thermal *t, size_t count, double *next);

/* Checks the heat balance of the newest film. */
void ehl_thermal_hold(ehl_march *m);

/* For smooth flanks, estimates the error of the newest film due to the number of nodes across, if
   it is hotter than the films checked before. `film` contains the temperatures, and the flow must
   have been computed for them. */
void ehl_thermal_look_at_nodes(ehl_thermal *t, const ehl_energy_film *f,
                               const ehl_temperature *film, double alpha, double highest);

/* Writes the quality lines of the temperatures. */
void ehl_thermal_report(const ehl_thermal *t, const ff_host *host, const ehl_march *m);

#endif
