/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lowest films of the engagements of a history, one beside the other. */
#ifndef FF_EHL_ENGAGEMENTS_H
#define FF_EHL_ENGAGEMENTS_H

typedef struct ff_lowest {
    double number, count;    /* of the engagement at hand, of all so far */
    double here;             /* lowest film of the one at hand, m */
    double sum, least, most; /* of those before it */
} ff_lowest;

/* Takes the next film of a history, in its order. */
void ff_lowest_take(ff_lowest *l, double engagement, double h_min);

/* Mean of the lowest films, and the highest of them less the lowest. */
double ff_lowest_mean(const ff_lowest *l);
double ff_lowest_spread(const ff_lowest *l);

#endif
