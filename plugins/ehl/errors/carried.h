/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the cells make of a film on its way through the contact. */
#ifndef EHL_CARRIED_H
#define EHL_CARRIED_H

#include "../equations/march.h"

/* Where the oil is carried along and nothing else moves the film, in nodes: from a build-up length
   behind x = -a on, to 1.6 in front of x = a, where the outlet begins. */
typedef struct ehl_stretch {
    double begin, end;
} ehl_stretch;

ehl_stretch ehl_carrying_stretch(const ehl_reynolds *eq, double a, double buildup);

/* Returns the order of the error that the cells make of a film on its way: of control volumes the
   change in time is that of one node where they may be cavitated, and it is 1. */
int ehl_carrying_order(const ehl_reynolds *eq);

typedef struct ehl_carried {
    double *error, time; /* relative, at the nodes; time: of the instant that it belongs to */
    double *room;        /* for as many numbers */
    double part;         /* of a cell, by which the oil is ahead of it */
    size_t first, end;   /* the nodes of the stretch; upstream of it there is no error */
    int mirrored;
} ehl_carried;

/* Moves the errors on to the newest film and adds what the cells make of it there. */
void ehl_carried_add(ehl_carried *c, const ehl_march *m, const ehl_stretch *s);

/* Returns that error at a node; behind the stretch it is that of what arrives there. */
double ehl_carried_to(const ehl_carried *c, size_t node);

/* Returns by how much these errors change the least film, relative: where a dip is only moved they
   are large, and its depth stays. */
double ehl_carried_of_least(const ehl_carried *c, size_t nodes, const double *h, double least);

#endif
