/* SPDX-License-Identifier: GPL-3.0-or-later */
/* thermal: full. The temperatures across the film (energy.h) and their effect on the flow. While
 * the film of an instant is solved for, its mobility, density and carried mass are those of the
 * laws at the oil's temperature times factors that are held. The temperatures of that film give the
 * next factors, until film and factors no longer change. */
#ifndef EHL_THERMAL_H
#define EHL_THERMAL_H

#include "../equations/march.h"
#include "../solvers/anderson.h"
#include "energy.h"

/* The factors of the flow across a film, at each node: of mobility, density and carried mass. */
enum { EHL_THERMAL_FACTORS = 3 };
/* Largest change of the factors that a round takes; a larger one is scaled down to it. */
static const double EHL_LARGE_FACTOR = 0.3;

/* Data of the flanks and the oil that a run gives. */
typedef struct ehl_thermal_data {
    size_t across;                      /* nodes */
    double conductivity, heat_capacity; /* of the oil */
    ehl_conductivity_rise conducts;     /* of the conductivity over p */
    double bulk;                        /* K, of the flanks and of the oil that enters */
    double flank_contact[2];            /* B = sqrt(k rho c), J/(m2 K s^0.5) */
    double flank_diffusivity[2];        /* k/(rho c), m2/s */
    double friction;                    /* coefficient of asperities in contact */
    const ff_rheology_2 *flow;          /* NULL: Newtonian */
} ehl_thermal_data;

typedef struct ehl_thermal {
    ehl_energy energy;
    ehl_energy_film film; /* the film that the temperatures belong to */
    size_t width; /* numbers of a state: temperatures, modes and next factors of all nodes */
    double *memory, *past, *p_t, *through;
    double *moved[2];             /* the last two states, if the nodes move with the oil */
    double *friction, *p_before;  /* heat of the asperities, W/m2; pressure of a state, moved */
    double *weight;               /* how much a change at a node of a steady film matters */
    double coefficient;           /* of friction, of asperities in contact */
    double *ease, *swell, *carry; /* reynolds.h: factors of the film that is solved for */
    double rounds, solved;        /* counts: solutions for a film, and instants */
    double off;                   /* error of the factors in the last round */
    double damping;               /* share of the change of the factors that is taken */
    double share;                 /* share of the change of the temperatures that a sweep takes */
    int idle;  /* rounds in which the factors had settled but the temperatures had not */
    int round; /* solutions for the film of this instant */
    ehl_anderson anderson; /* of the factors of a steady film */
    double *now, *change;  /* the factors, and their change, for the acceleration */
    int without;           /* 1: films are solved for without heat */
    int cold_fails;        /* 1: the steady film was not found without heat either */
    double diffusivity[2]; /* of the flanks, m2/s */
    double least_peclet;   /* u a rho c/k of a flank, least of all loaded instants */
    double highest;        /* K */
    double by_nodes;  /* relative error of the flow by the nodes across, largest of those checked */
    double looked_at; /* temperature rise of that instant, K */
    double unbalanced, elsewise; /* shares of the heat, worst of the instants looked at: of the
                                    equations, and by other sums */
} ehl_thermal;

/* Creates the temperatures of a march, whose states hold them. FF_UNSUPPORTED if a flank moves
 * against the oil. */
ff_status ehl_thermal_create(ehl_thermal *t, const ff_host *host, ehl_march *m,
                             const ehl_thermal_data *data);
void ehl_thermal_destroy(ehl_thermal *t);

/* Forgets the temperatures: another engagement starts, or a film is looked for anew. */
void ehl_thermal_restart(ehl_march *m);

/* Solves for the film of `step` as solver->solve does, with its temperatures. */
ff_status ehl_thermal_solve(ehl_march *m, const ehl_step *step, ehl_film *film, double time,
                            int limit);

/* Moves on the temperatures of a trial film without pressure. */
void ehl_thermal_rest(ehl_march *m, const ehl_step *step, double time);

/* Of the newest film: the mean temperature across it at node i; the highest temperature; and the
 * highest rise of the flanks over the bulk; K. */
double ehl_thermal_mean(const ehl_march *m, size_t i);
double ehl_thermal_highest(const ehl_march *m);
double ehl_thermal_flash(const ehl_march *m);

/* Of the newest film: tau_m at node i, with the sign of u1 - u2, and the heat of the pressure flow.
 */
double ehl_thermal_stress(const ehl_march *m, size_t i);
double ehl_thermal_pressure_flow(const ehl_march *m);

/* Returns the temperatures and modes in a state. */
ehl_temperature ehl_thermal_state(const ehl_thermal *t, double *heat);

/* Returns the factors in a state: EHL_THERMAL_FACTORS arrays of nodes. */
double *ehl_thermal_factors(const ehl_thermal *t, double *heat);

/* Sets the weights of changes of a steady film. */
void ehl_thermal_weigh(const ehl_thermal *t, const ehl_reynolds *r, const ehl_film *film);

/* Computes the next factors. Returns the largest change of the mass flow by them, relative to what
 * the flanks carry along. */
double ehl_thermal_find_factors(ehl_thermal *t, const ehl_reynolds *r, const ehl_energy_film *f,
                                const ehl_film *film, double *next);

/* Accelerates the factors of a steady film by those of earlier rounds. */
void ehl_thermal_accelerate(ehl_thermal *t, size_t count, double *next);

/* Checks the heat balance of the newest film. */
void ehl_thermal_hold(ehl_march *m);

/* Estimates the error by the nodes across of the newest film, whose temperatures are `film`, for
 * smooth flanks and if it is hotter than the films checked before. The flow must be that of the
 * temperatures. */
void ehl_thermal_look_at_nodes(ehl_thermal *t, const ehl_energy_film *f,
                               const ehl_temperature *film, double alpha, double highest);

/* Writes the quality lines of the temperatures. */
void ehl_thermal_report(const ehl_thermal *t, const ff_host *host, const ehl_march *m);

#endif
