/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * thermal: full. The temperatures across the film (energy.h) and what they make of the flow. While
 * the film of an instant is solved for, its mobility, density and carried mass are those of the
 * laws at the oil's temperature times factors that are held; the temperatures of that film give
 * the next factors, until neither changes.
 */
#ifndef EHL_THERMAL_H
#define EHL_THERMAL_H

#include "../equations/march.h"
#include "../solvers/anderson.h"
#include "energy.h"

/* Of the flow across a film, at each node: mobility, density and carried mass. */
enum { EHL_THERMAL_FACTORS = 3 };
/* Of a larger change of them a share is taken, of this size. */
static const double EHL_LARGE_FACTOR = 0.3;

/* What a run gives of the flanks and the oil. */
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
    ehl_energy_film film; /* that the temperatures are of */
    size_t width;         /* of a state: temperatures, modes and next factors of all nodes */
    double *memory, *past, *p_t, *through;
    double *moved[2];             /* the last two states where the nodes move with the oil */
    double *friction, *p_before;  /* heat of the asperities, W/m2; pressure of a state, moved */
    double *weight;               /* of a change at a node of a steady film */
    double coefficient;           /* of friction, of asperities in contact */
    double *ease, *swell, *carry; /* reynolds.h: of the film that is solved for */
    double rounds, solved;        /* counts: solutions for a film, and instants */
    double off;                   /* of the last round: what the factors were off */
    double damping;               /* share of their change that is taken */
    double share;                 /* of the change of temperatures that sweeps take */
    int idle;                     /* rounds since factors settled, of temperatures that did not */
    int round;                    /* solutions for the film of this instant */
    ehl_anderson anderson;        /* of the factors of a steady film */
    double *now, *change;         /* of them, as they are accelerated */
    int without;                  /* 1: films are solved for without heat */
    int cold_fails;               /* 1: the steady film was not found without heat either */
    double diffusivity[2];        /* of the flanks, m2/s */
    double least_peclet;          /* u a rho c/k of a flank, the least of loaded instants */
    double highest;               /* K */
    double by_nodes;  /* error of the flow by the nodes across, relative, worst looked at */
    double looked_at; /* rise of the temperature then, K */
    double unbalanced, elsewise; /* shares of the heat, worst of the instants looked at: of the
                                    equations, and by other sums */
} ehl_thermal;

/* Temperatures for the march, whose states hold them. FF_UNSUPPORTED where a flank moves against
   the oil. */
ff_status ehl_thermal_create(ehl_thermal *t, const ff_host *host, ehl_march *m,
                             const ehl_thermal_data *data);
void ehl_thermal_destroy(ehl_thermal *t);

/* Forgets the temperatures: another engagement starts, or a film is looked for anew. */
void ehl_thermal_restart(ehl_march *m);

/* Solves for the film of `step` as solver->solve does, with its temperatures. */
ff_status ehl_thermal_solve(ehl_march *m, const ehl_step *step, ehl_film *film, double time,
                            int limit);

/* The temperatures of the trial, which is a film without pressure. */
void ehl_thermal_rest(ehl_march *m, const ehl_step *step, double time);

/* Of the newest film. Mean temperature across the film at node i, highest one, and highest of the
   flanks over the bulk, K. */
double ehl_thermal_mean(const ehl_march *m, size_t i);
double ehl_thermal_highest(const ehl_march *m);
double ehl_thermal_flash(const ehl_march *m);

/* tau_m at node i, with the sign of u1 - u2, and the heat of the pressure flow of the newest
   film. */
double ehl_thermal_stress(const ehl_march *m, size_t i);
double ehl_thermal_pressure_flow(const ehl_march *m);

/* The parts of a state. */
ehl_temperature ehl_thermal_state(const ehl_thermal *t, double *heat);

/* The factors of the temperatures of a state: EHL_THERMAL_FACTORS arrays of nodes. */
double *ehl_thermal_factors(const ehl_thermal *t, double *heat);

/* Sets the weights of the film. */
void ehl_thermal_weigh(const ehl_thermal *t, const ehl_reynolds *r, const ehl_film *film);

/* Computes the factors; returns by how much they change the flow of mass, at most, relative to what
   the flanks carry along. */
double ehl_thermal_find_factors(ehl_thermal *t, const ehl_reynolds *r, const ehl_energy_film *f,
                                const ehl_film *film, double *next);

/* Changes them to what the rounds before make seem best. */
void ehl_thermal_accelerate(ehl_thermal *t, size_t count, double *next);

/* Looks at the heat balance of the newest film. */
void ehl_thermal_hold(ehl_march *m);

/* Looks at what the nodes across leave of the newest film, whose temperatures are `film`; of those
   that become hotter, smooth flanks. The flow must be that of the temperatures. */
void ehl_thermal_look_at_nodes(ehl_thermal *t, const ehl_energy_film *f,
                               const ehl_temperature *film, double alpha, double highest);

/* Its lines of the quality record. */
void ehl_thermal_report(const ehl_thermal *t, const ff_host *host, const ehl_march *m);

#endif
