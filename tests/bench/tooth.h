/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The path of contact of one tooth pair: operating point I of Li & Kahraman 2011, quasi-static load
 * with ramps of 0.2 deg, Doolittle-Tait and Ree-Eyring oil; for the benchmarks of the film models.
 */
#ifndef BENCH_TOOTH_H
#define BENCH_TOOTH_H

#include "stage.h"

enum { POINTS = 801 };

typedef struct path {
    double time[POINTS], radius[POINTS], u1[POINTS], u2[POINTS], load[POINTS];
} path;

typedef struct oil {
    stage *viscosity, *density, *rheology;
} oil;

/* At that share of 1500 rpm. */
void path_fill(path *c, double share);

void oil_open(oil *o);
void oil_close(oil *o);

/* The path and the oil keep their place until the stage is closed. */
stage *film_open(const char *model, const path *c, const oil *o, size_t cells, size_t steps);

#endif
