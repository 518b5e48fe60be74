/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Implements thermal: inlet, the heat of the inlet in a march. While the film of an instant is
   solved for, the effect of heat on the flow is constant. This effect is then recomputed from the
   film, until film and heat no longer change. */
#ifndef EHL_HEAT_H
#define EHL_HEAT_H

#include "../equations/march.h"

typedef struct ehl_heat {
    double conductivity; /* conductivity of the oil, W/(m K) */
    double *ease;        /* at the nodes: fluidity psi over that of the laws at the oil's
                            temperature */
    double *memory, *room;
    double middle;         /* rho h at the highest pressure of the film from which `ease` was
                              computed, kg/m2 */
    double ratio;          /* smallest ratio R of this film upstream of the contact */
    double least, most;    /* over all films: smallest ratio in the inlet, and largest F or S */
    double rounds, solved; /* numbers of solutions for a film, and of instants */
    ff_status law_status;
} ehl_heat;

ff_status ehl_heat_create(ehl_heat *heat, size_t nodes, double conductivity);
void ehl_heat_destroy(ehl_heat *heat);

/* Solves for the film of `step` like solver->solve, including the heat of the march. */
ff_status ehl_heat_solve(ehl_march *m, const ehl_step *step, ehl_film *film, double time,
                         int limit);

/* Writes the quality lines of the heat. */
void ehl_heat_report(const ehl_heat *heat, const ff_host *host);

#endif
