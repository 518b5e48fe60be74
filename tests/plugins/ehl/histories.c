/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Properties that the film of every model must have in time: it stays steady under constant
   conditions, and has the same film after every way to them, and, where the pressure is solved for,
   second order in time under sinusoidal and ramped loads and away from a jump. */
#include "balance.h"
#include "check.h"
#include "models.h"

#include <math.h>
#include <stdio.h>

static const double pi = 3.14159265358979323846;
static const double passage = 80e-6; /* s, of the film through the contact */

static double steady(const film_model *m, const char *output, double tolerance)
{
    line c;
    model_open(m, &c);
    if (m->solves)
        stage_set(c.film, "tolerance", tolerance);
    check_true(m->name, line_run(&c, output) == FF_OK);
    double h = line_value(&c, output, 0);
    line_close(&c);
    return h;
}

/* Makes 1.5 times the load, which changes to 1 at a fifth of the time, and four passages of the oil
   more. */
static void test_rest(const film_model *m, int falls)
{
    const double tolerance = 1e-8;
    line c;
    model_open(m, &c);
    line_last(&c, 41, 5 * passage);
    for (size_t i = 0; falls && i < 8; i++)
        c.load[i] *= 1.5 - 0.5 * (double)i / 8;
    stage_set(c.film, "steps", (double)m->steps);
    if (m->solves)
        stage_set(c.film, "tolerance", tolerance);
    check_true(m->name, line_run(&c, "h_min h_central") == FF_OK);
    /* the grid is that of the larger load: one cell's worth of the error in space */
    double within = falls && m->solves ? 4e-2 * pow(96. / (double)m->cells, 2) : 1e-5;
    check_near(falls ? "falls to the steady film" : "rests", line_value(&c, "h_min", m->steps),
               steady(m, "h_min", tolerance), within);
    check_near(falls ? "falls to the steady film" : "rests", line_value(&c, "h_central", m->steps),
               steady(m, "h_central", tolerance), within);
    line_close(&c);
}

typedef enum load { SINE, RAMP, JUMP } load;

static const char *const load_name[] = {"sine", "ramp", "jump"};

enum { INSTANTS = 321, TIMES = 40, FINEST = 32 };

/* Makes a load over five passages of the oil: a cosine; a ramp from a tenth to seven tenths of the
   time; or the cosine with a jump at a quarter, between two instants at the same time. */
static void vary(line *c, load what)
{
    size_t jump = (INSTANTS - 1) / 4;
    line_last(c, INSTANTS, 5 * passage);
    for (size_t i = 0; i < c->count; i++) {
        double t = c->time[i] / (5 * passage);
        c->load[i] *= what == RAMP ? 1 + fmax(0, fmin(0.6, t - 0.1)) : 1.3 - 0.3 * cos(2 * pi * t);
        c->load[i] *= what == JUMP && i > jump ? 1.2 : 1;
    }
    if (what == JUMP)
        c->time[jump + 1] = c->time[jump];
}

/* Computes h_min at TIMES times, with `fold` steps between them. */
static void films_of(const film_model *m, load what, size_t fold, double *h)
{
    line c;
    model_open(m, &c);
    stage_set(c.film, "cells", m->steps < 100 ? 96 : 192);
    vary(&c, what);
    stage_set(c.film, "steps", (double)(fold * TIMES));
    stage_set(c.film, "tolerance", 1e-9);
    ff_status status = line_run(&c, "h_min film pressure x time load_ahead");
    check_true(status == FF_OK ? m->name : stage_why(c.film), status == FF_OK);
    check_below("load and deflection", balance_of_instants(&c, TIMES), 1e-8);
    /* 0.8 of the squared cell size; not for a jump, which moves oil in no time */
    if (what != JUMP && fold == FINEST)
        check_below("oil that has come, gone and stayed, over what nodes leave",
                    balance_history(&c) * pow(balance_cells(&c), 2), 1);
    for (size_t k = 0; k < TIMES; k++)
        h[k] = line_value(&c, "h_min", fold * (k + 1));
    line_close(&c);
}

/* Returns the root mean square of the difference over the times. After a kink or a jump, the times
   begin when the film affected by it has left the contact, after 2 a/u at the load of that time,
   and end at the next kink or jump. */
static double distance(const double *a, const double *b, load what)
{
    double sum = 0;
    size_t first = what == SINE ? 0 : what == RAMP ? 14 : 26, last = what == RAMP ? 27 : TIMES - 1;
    for (size_t k = first; k <= last; k++)
        sum += pow(a[k] / b[k] - 1, 2);
    return sqrt(sum / (double)(last - first + 1));
}

static void test_order(const film_model *m, load what)
{
    static double exact[TIMES], h[TIMES];
    double error[3];
    char text[160];
    films_of(m, what, FINEST, exact);
    for (int k = 0; k < 3; k++) {
        films_of(m, what, (size_t)2 << k, h);
        error[k] = distance(h, exact, what);
    }
    double order = log2(error[0] / error[2]) / 2;
    snprintf(text, sizeof text, "%s, %s: errors %.2g, %.2g, %.2g, order %.2f", m->name,
             load_name[what], error[0], error[1], error[2], order);
    check_true(text, order > 1.5); /* halfway between first and second */
}

int main(void)
{
    for (int k = 0; k < FILM_MODELS; k++) {
        const film_model *m = &film_models[k];
        test_rest(m, 0);
        test_rest(m, 1);
        for (int what = SINE; what <= JUMP && m->solves; what++)
            test_order(m, (load)what);
    }
    return check_done();
}
