/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Properties that the steady film of every model must have: similarity, symmetry, signs, monotony,
   shapes. */
#include "balance.h"
#include "check.h"
#include "models.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static ff_status run(const film_model *m, line *c)
{
    if (m->solves)
        stage_set(c->film, "tolerance", 1e-9);
    ff_status status = line_run(c, model_outputs(m));
    check_true(status == FF_OK ? m->name : stage_why(c->film), status == FF_OK);
    return status;
}

/* With Barus' law and an incompressible oil, the film depends only on M and L: R is multiplied by
   3, E' by 1/2, alpha by 2, eta0 by 7, and the speed and load are chosen for the same U, W and
   G. */
static void test_likeness(const film_model *m)
{
    line a, b;
    model_open(m, &a);
    line_oil(&a, "viscosity/barus", 0.01, 15e-9);
    line_incompressible(&a);
    model_open(m, &b);
    line_oil(&b, "viscosity/barus", 0.07, 30e-9);
    line_incompressible(&b);
    b.radius[0] *= 3;
    b.modulus /= 2;
    b.u1[0] = b.u2[0] = a.u1[0] * (3. / 2) / 7;
    b.load[0] *= 3. / 2;
    if (run(m, &a) == FF_OK && run(m, &b) == FF_OK) {
        check_near("alike: h_min/R", line_value(&b, "h_min", 0) / 3, line_value(&a, "h_min", 0),
                   1e-6);
        check_near("alike: h_central/R", line_value(&b, "h_central", 0) / 3,
                   line_value(&a, "h_central", 0), 1e-6);
        check_near("alike: p/E'", line_value(&b, "p_max", 0) * 2, line_value(&a, "p_max", 0), 1e-6);
    }
    line_close(&a);
    line_close(&b);
}

/* slide: (u1 - u2)/u. turn: -1 if both surfaces move towards -x, else 1. */
static void sliding(const film_model *m, line *c, double slide, double turn)
{
    model_open(m, c);
    line_eyring(c, 5e6);
    double u = c->u1[0];
    c->u1[0] = turn * u * (1 + slide / 2);
    c->u2[0] = turn * u * (1 - slide / 2);
    run(m, c);
}

static double least(const line *c)
{
    return line_value(c, "h_min", 0);
}

static double traction(const line *c)
{
    return line_value(c, "traction", 0);
}

static void test_signs(const film_model *m)
{
    line fast, slow, turned, pure, simple;
    sliding(m, &fast, 0.4, 1);
    sliding(m, &slow, -0.4, 1);
    sliding(m, &turned, 0.4, -1);
    sliding(m, &pure, 0, 1);
    sliding(m, &simple, 2, 1);
    check_near("film: sign of the sliding", least(&slow), least(&fast), 1e-12);
    check_near("film: mirrored", least(&turned), least(&fast), 1e-12);
    check_near("traction: sign of the sliding", traction(&slow), -traction(&fast), 1e-12);
    check_near("traction: mirrored", traction(&turned), -traction(&fast), 1e-12);
    check_near("pure rolling: no traction", 1 + traction(&pure), 1, 0);
    check_near("pure rolling: no sliding loss", 1 + line_value(&pure, "sliding_loss", 0), 1, 0);
    check_true("sliding: traction along u1 - u2", traction(&fast) > 0);
    check_true("sliding: loss", line_value(&fast, "sliding_loss", 0) > 0);
    check_true("an Eyring oil lets through less the more it slides",
               least(&simple) <= least(&fast) && least(&fast) <= least(&pure));
    size_t n;
    const double *h = stage_get(fast.film, "film", &n), *g = stage_get(turned.film, "film", NULL);
    double worst = 0;
    for (size_t i = 0; i < n; i++)
        worst = fmax(worst, fabs(h[i] - g[n - 1 - i]));
    check_below("the field is mirrored", worst / least(&fast), 1e-12);
    line_close(&fast);
    line_close(&slow);
    line_close(&turned);
    line_close(&pure);
    line_close(&simple);
}

static void test_monotony(const film_model *m)
{
    static const double factor[] = {0.3, 1, 3, 10};
    double h[2][4], p[4];
    for (int what = 0; what < 2; what++)
        for (int k = 0; k < 4; k++) {
            line c;
            model_open(m, &c);
            if (what == 0)
                c.u1[0] = c.u2[0] *= factor[k];
            else
                c.load[0] *= factor[k];
            run(m, &c);
            h[what][k] = least(&c);
            p[k] = line_value(&c, "p_max", 0);
            line_close(&c);
        }
    for (int k = 1; k < 4; k++) {
        check_true("thicker with speed", h[0][k] > h[0][k - 1]);
        check_true("thinner with load", h[1][k] < h[1][k - 1]);
        check_true("pressure grows with load", p[k] > p[k - 1]);
    }
}

static void test_outputs(const film_model *m)
{
    line c;
    uint32_t rank;
    model_open(m, &c);
    line_eyring(&c, 5e6);
    c.u1[0] *= 1.1;
    line_last(&c, 3, 20e-6);
    stage_set(c.film, "steps", 5);
    run(m, &c);
    check_true("all numbers are finite", model_is_finite(m, &c));
    const size_t *shape = stage_shape(c.film, "film", &rank);
    check_true("film: t x", rank == 2 && shape[0] == 6 && shape[1] == m->cells + 1);
    shape = stage_shape(c.film, "pressure", &rank);
    check_true("pressure: t x", rank == 2 && shape[0] == 6 && shape[1] == m->cells + 1);
    size_t times, places;
    stage_get(c.film, "h_min", &times);
    stage_get(c.film, "x", &places);
    check_true("series and positions", times == 6 && places == m->cells + 1);
    check_near("first time", 1 + line_value(&c, "time", 0), 1, 0);
    check_near("last time", line_value(&c, "time", 5), 20e-6, 1e-12);
    if (m->solves)
        check_below("load and deflection at every time", balance_of_instants(&c, 6), 1e-8);
    check_true("says how it went", stage_verdict(c.film) != FF_BAD);
    line_close(&c);
}

int main(void)
{
    for (int k = 0; k < FILM_MODELS; k++) {
        test_likeness(&film_models[k]);
        test_signs(&film_models[k]);
        test_monotony(&film_models[k]);
        test_outputs(&film_models[k]);
    }
    return check_done();
}
