/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A line contact with its oil laws, for the tests of the film models. */
#ifndef TEST_EHL_LINE_H
#define TEST_EHL_LINE_H

#include "stage.h"

#include <stddef.h>

enum { LINE_INSTANTS = 400 };

typedef struct line {
    stage *film, *oil, *rho, *flow;
    stage *liquid; /* the lubricant from which the laws get their data at a temperature, or NULL */
    size_t count;  /* number of instants; 1: steady */
    double time[LINE_INSTANTS], radius[LINE_INSTANTS], u1[LINE_INSTANTS], u2[LINE_INSTANTS],
        load[LINE_INSTANTS], gap[LINE_INSTANTS];
    double modulus;
    double eta0;
} line;

/* Opens a steady contact with the laws of Roelands and of Dowson and Higginson: 177.4 N/mm, R =
   12.826 mm, 4.03 m/s, as at the pitch point of the gear pair of Li & Kahraman 2011; Moes' M = 16,
   L = 4.8. */
void line_open(line *c, const char *model);
void line_close(line *c);

/* Replaces the viscosity law; to be called before the first run. */
void line_oil(line *c, const char *viscosity, double eta0, double alpha);
void line_incompressible(line *c);
void line_eyring(line *c, double tau0);

/* Uses a mineral oil of an ISO grade at T, K, with Roelands' and Dowson and Higginson's laws. */
void line_grade(line *c, const char *grade, double T);

/* Sets a steady contact from Moes' M and L, with alpha = 22/GPa and Roelands' z = 0.68 as in the
   reference tables. */
void line_moes(line *c, double M, double L);
/* Sets a steady contact from Moes' M, with a viscosity that does not depend on pressure, L = 0. */
void line_moes_isoviscous(line *c, double M);
/* Returns a film thickness h in Moes' dimensionless form. */
double line_moes_film(const line *c, double h);

/* Makes a history of `count` equal instants over `duration`, which the caller then changes. */
void line_last(line *c, size_t count, double duration);

/* Connects the stages and runs the film with the requested outputs. */
ff_status line_run(line *c, const char *outputs);
double line_value(const line *c, const char *output, size_t k);
/* Returns an output at a time, linearly interpolated between the results. */
double line_at(const line *c, const char *output, double time);

#endif
