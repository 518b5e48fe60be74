/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ehl/finite-volume and ehl/dense-newton solve the same equations with different methods, as do
   ehl/finite-volume and ehl/control-volume with their first-order schemes: with a tolerance of
   1e-10, they must agree to 1e-6, in a steady film and during a change of load. */
#include "check.h"
#include "line.h"

#include <math.h>

typedef enum scene { STEADY, LOAD_STEP, LOSS, TORN_LOSS } scene;

static void prepare(line *c, const char *model, const char *wedge, scene what)
{
    line_open(c, model);
    line_eyring(c, 5e6);
    c->u1[0] *= 1.2;
    c->u2[0] *= 0.8;
    if (what != STEADY)
        line_last(c, 9, 40 * 2.5e-6);
    for (size_t i = 4; i < c->count; i++)
        c->load[i] *= what == LOSS ? (i < 7 ? 0 : 0.8) : 0.5;
    for (size_t i = 5; what >= LOSS && i < 6; i++)
        c->gap[i] = 2e-8;
    if (what == TORN_LOSS)
        stage_set_text(c->film, "cavitation", "mass-conserving");
    stage_set_text(c->film, "wedge", wedge);
    stage_set(c->film, "cells", 128);
    stage_set(c->film, "steps", 40);
    stage_set(c->film, "tolerance", 1e-10);
    check_true("runs", line_run(c, "h_min h_central p_max film pressure film_fraction "
                                   "friction_coefficient load_error") == FF_OK);
}

static double difference(const line *a, const line *b, const char *output)
{
    size_t n, m;
    const double *x = stage_get(a->film, output, &n), *y = stage_get(b->film, output, &m);
    double worst = 0, most = 0;
    for (size_t i = 0; i < n && i < m; i++) {
        worst = fmax(worst, fabs(x[i] - y[i]));
        most = fmax(most, fabs(y[i]));
    }
    return n == m ? worst / most : HUGE_VAL;
}

static void compare(const char *model, const char *other, const char *wedge, scene what)
{
    static const char *output[] = {
        "h_min", "h_central", "p_max", "film", "pressure", "film_fraction", "friction_coefficient"};
    static line a, b;
    prepare(&a, model, wedge, what);
    prepare(&b, other, wedge, what);
    for (size_t k = 0; k < sizeof output / sizeof output[0]; k++)
        check_below(output[k], difference(&a, &b, output[k]), 1e-6);
    line_close(&a);
    line_close(&b);
}

int main(void)
{
    for (int what = STEADY; what <= TORN_LOSS; what++) {
        compare("ehl/finite-volume", "ehl/dense-newton", "second", (scene)what);
        compare("ehl/finite-volume", "ehl/control-volume", "first", (scene)what);
    }
    return check_done();
}
