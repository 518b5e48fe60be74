/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors that the cells add to a film on its way through the contact. */
#ifndef EHL_CARRIED_H
#define EHL_CARRIED_H

#include "../equations/march.h"

/* The nodes between which the oil is carried along and nothing else moves the film: from a build-up
 * length behind x = -a to 1.6 of them in front of x = a, where the outlet begins. */
typedef struct ehl_stretch {
    double begin, end;
} ehl_stretch;

ehl_stretch ehl_carrying_stretch(const ehl_reynolds *eq, double a, double buildup);

/* Returns the order of these errors. It is 1 for control volumes that may be cavitated, since the
 * change in time is then that of one node. */
int ehl_carrying_order(const ehl_reynolds *eq);

typedef struct ehl_carried {
    double *error, time; /* relative, at the nodes; time: of the instant that it belongs to */
    double *room;        /* for as many numbers */
    double part;         /* share of a cell by which the oil is ahead of the errors */
    size_t first, end;   /* the nodes of the stretch; upstream of it there is no error */
    int mirrored;
} ehl_carried;

/* Moves the errors on to the newest film, and adds those that the cells make there. */
void ehl_carried_add(ehl_carried *c, const ehl_march *m, const ehl_stretch *s);

/* Returns the error at a node; behind the stretch it is the error that arrives there. */
double ehl_carried_to(const ehl_carried *c, size_t node);

/* Returns how much these errors change the least film, relative. Where a dip is only shifted the
 * errors are large, but the depth of the dip stays. */
double ehl_carried_of_least(const ehl_carried *c, size_t nodes, const double *h, double least);

#endif
