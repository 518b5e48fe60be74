/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rough flanks for the tests of the film models. */
#ifndef TEST_EHL_FLANK_H
#define TEST_EHL_FLANK_H

#include "line.h"

enum { FLANK_POINTS = 4096 };

typedef struct flank {
    double position[FLANK_POINTS], height[2][FLANK_POINTS], period, rq[2], origin;
} flank;

/* Makes waves of random phase, with amplitudes proportional to their lengths from `longest` to
   `shortest`. The record repeats after 2 mm. */
void flank_random(flank *f, unsigned seed, double rq, double shortest, double longest);

/* Makes flank 1 a sine, flank 2 flat. */
void flank_sine(flank *f, double amplitude, double length);

void flank_give(const flank *f, stage *film);

#endif
