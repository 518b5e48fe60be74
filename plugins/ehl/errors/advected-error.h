/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors due to the cells. A film accumulates them on its way through the contact. */
#ifndef EHL_ADVECTED_ERROR_H
#define EHL_ADVECTED_ERROR_H

#include "../equations/march.h"

/* The stretch of nodes in which the oil is only transported: from a build-up length downstream of x
   = -a to 1.6 build-up lengths upstream of x = a, where the outlet begins. */
typedef struct ehl_stretch {
    double begin, end;
} ehl_stretch;

ehl_stretch ehl_carrying_stretch(const ehl_reynolds *eq, double a, double buildup);

/* Returns the order of these errors. It is 1 for control volumes that may be cavitated, since the
   change in time is then taken at one node. */
int ehl_carrying_order(const ehl_reynolds *eq);

typedef struct ehl_carried {
    double *error, time; /* error: relative, at the nodes; time: instant of the errors */
    double *room;        /* workspace of the same length */
    double part; /* fraction of a cell that the oil is ahead of the errors, which move by whole
                    cells */
    size_t first, end; /* nodes of the stretch; upstream of it the error is 0 */
    int mirrored;
} ehl_carried;

/* Moves the errors to the newest film, and adds the errors due to the cells there. */
void ehl_carried_add(ehl_carried *c, const ehl_march *m, const ehl_stretch *s);

/* Returns the error at a node. Downstream of the stretch it is the error at the end of the
   stretch. */
double ehl_carried_to(const ehl_carried *c, size_t node);

/* Returns the relative change of the smallest film due to these errors. If a dip is only shifted,
   the errors are large, but the depth of the dip does not change. */
double ehl_carried_of_least(const ehl_carried *c, size_t nodes, const double *h, double least);

#endif
