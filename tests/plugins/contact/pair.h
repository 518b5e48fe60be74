/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The gear pair and the loads that the tests of contact/tooth-pair share. */
#ifndef TEST_PAIR_H
#define TEST_PAIR_H

#include <stage.h>

typedef struct pair {
    stage *gear, *duty, *tooth;
} pair;

/* Opens a pair of 25 and 40 teeth with profile shift at 1250 Hz; `tooth` has no load yet. */
pair pair_open(void);
/* Opens this pair with exchanged gears, so that gear 1 has 40 teeth. */
pair pair_open_exchanged(void);
/* Opens Li & Kahraman's 50/50 pair, whose values are published. */
pair pair_open_printed(void);
/* Opens the 50/50 pair with other tip diameters. */
pair pair_open_long(const char *tip_diameter);
void pair_close(pair *p);

/* Returns the roll angles of the stations, and their number. */
const double *pair_stations(const pair *p, size_t *n);

/* Sets the tooth force: half the force where two pairs are in contact, all of it between LPSTC and
   HPSTC. */
void pair_share(const pair *p, double force, double *tooth_force);

/* All outputs except those that need an oil. */
extern const char pair_dry[];

#endif
