/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The heat of the film in a march. Its effect on the flow is held while the film of an instant is
 * solved for, and computed anew from that film, until neither changes. */
#ifndef EHL_HEAT_H
#define EHL_HEAT_H

#include "../equations/march.h"

typedef struct ehl_heat {
    double conductivity; /* of the oil, W/(m K) */
    double *ease;        /* of the nodes: psi over that of the laws at the oil's temperature */
    double *memory, *room;
    double middle;         /* kg/m2, rho h at the highest pressure of the film that gave `ease` */
    double ratio;          /* least ratio of that film upstream of the contact */
    double least, most;    /* of all films: least ratio in the inlet, and largest F or S */
    double rounds, solved; /* counts: solutions for a film, and instants */
    ff_status law_status;
} ehl_heat;

ff_status ehl_heat_create(ehl_heat *heat, size_t nodes, double conductivity);
void ehl_heat_destroy(ehl_heat *heat);

/* Solves for the film of `step` as solver->solve does, with the heat of the march. */
ff_status ehl_heat_solve(ehl_march *m, const ehl_step *step, ehl_film *film, double time,
                         int limit);

/* Writes the quality lines of the heat. */
void ehl_heat_report(const ehl_heat *heat, const ff_host *host);

#endif
