/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A gear pair and a mineral oil, for the ratings. */
#ifndef TEST_RATING_PAIR_H
#define TEST_RATING_PAIR_H

#include <stage.h>

typedef struct pair {
    double teeth[2], shift[2], tip_diameter[2],
        width;                          /* mm; module 4.5 mm, centre distance 91.5 mm */
    double torque, rpm, oil, roughness; /* N m, degC, mean Ra in um: flank 2 is half as rough again
                                           as flank 1 */
    const char *grade;
    double relief[2]; /* of the tips, um */
} pair;

/* FZG's test gears A and C (ISO 14635-1). */
extern const pair pair_a, pair_c;

/* The same gears at the same power, where gear 2 is entered first and drives. */
pair pair_reversed(const pair *p);

/* A rating of the pair, whose inputs it has; the caller closes both. */
stage *pair_open(const char *id, const pair *p, stage **oil);

/* Of the oil at a temperature in degC: mPa s and kg/m3. */
double oil_viscosity(stage *oil, double T);
double oil_density(stage *oil, double T);

#endif
