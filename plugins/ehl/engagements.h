/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lowest films of the engagements of a history, one beside the other. */
#ifndef EHL_ENGAGEMENTS_H
#define EHL_ENGAGEMENTS_H

typedef struct ehl_lowest {
    double number, count;    /* of the engagement at hand, of all so far */
    double here;             /* lowest film of the one at hand, m */
    double sum, least, most; /* of those before it */
} ehl_lowest;

/* Takes the next film of a history, in its order. */
void ehl_lowest_add(ehl_lowest *l, double engagement, double h_min);

/* Mean of the lowest films, and the highest of them less the lowest. */
double ehl_lowest_mean(const ehl_lowest *l);
double ehl_lowest_spread(const ehl_lowest *l);

#endif
