/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A line contact with its oil, for the tests of the film models. */
#ifndef TEST_EHL_LINE_H
#define TEST_EHL_LINE_H

#include "stage.h"

#include <stddef.h>

enum { LINE_INSTANTS = 400 };

typedef struct line {
    stage *film, *oil, *rho, *flow;
    stage *liquid; /* the oil over temperature, which the laws take their values from; or NULL */
    size_t count;  /* instants; 1: steady */
    double time[LINE_INSTANTS], radius[LINE_INSTANTS], u1[LINE_INSTANTS], u2[LINE_INSTANTS],
        load[LINE_INSTANTS], gap[LINE_INSTANTS];
    double modulus;
    double eta0;
} line;

/* A steady contact, Roelands and Dowson-Higginson oil: 177.4 N/mm on R = 12.826 mm at 4.03 m/s, the
   pitch point of the gear pair of Li & Kahraman 2011, M = 16, L = 4.8. */
void line_open(line *c, const char *model);
void line_close(line *c);

/* Replaces the law of the oil before the first run. */
void line_oil(line *c, const char *viscosity, double eta0, double alpha);
void line_incompressible(line *c);
void line_eyring(line *c, double tau0);

/* The mineral oil of that ISO grade at T, K, with Roelands' and Dowson and Higginson's laws. */
void line_grade(line *c, const char *grade, double T);

/* A steady contact given by Moes' M and L: alpha = 22/GPa and z = 0.68 as in the reference tables.
 */
void line_moes(line *c, double M, double L);
/* The same without pressure dependence, L = 0. */
void line_moes_isoviscous(line *c, double M);
/* h in Moes' scale. */
double line_moes_film(const line *c, double h);

/* `count` equal instants over `duration`; the caller changes what is to vary. */
void line_last(line *c, size_t count, double duration);

/* Wires all and runs with these outputs wanted. */
ff_status line_run(line *c, const char *outputs);
double line_value(const line *c, const char *output, size_t k);
/* Linear between the results. */
double line_at(const line *c, const char *output, double time);

#endif
