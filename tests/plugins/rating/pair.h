/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A gear pair and a mineral oil, for the ratings. */
#ifndef TEST_RATING_PAIR_H
#define TEST_RATING_PAIR_H

#include <stage.h>

typedef struct pair {
    double teeth[2], shift[2], tip_diameter[2],
        width;                          /* mm; module 4.5 mm, centre distance 91.5 mm */
    double torque, rpm, oil, roughness; /* N m, 1/min, degC, mean Ra in um: flank 2 is 1.5 times as
                                           rough as flank 1 */
    const char *grade;
    double relief[2]; /* of the tips, um */
} pair;

/* FZG's test gears A and C (ISO 14635-1). */
extern const pair pair_a, pair_c;

/* Returns the same gears at the same power in reversed order, so that the former gear 2 drives. */
pair pair_reversed(const pair *p);

/* Opens a rating with the inputs of a pair; the caller closes the rating and the oil. */
stage *pair_open(const char *id, const pair *p, stage **oil);

/* Return viscosity, mPa s, and density, kg/m3, of the oil at a temperature in degC. */
double oil_viscosity(stage *oil, double T);
double oil_density(stage *oil, double T);

#endif
