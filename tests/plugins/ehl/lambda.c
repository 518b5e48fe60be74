/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every model has the output lambda, film over roughness, with the roughness of the gears or of a
   surface. */
#include "check.h"
#include "flank.h"
#include "models.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *say(const film_model *m, const char *what)
{
    static char text[96];
    snprintf(text, sizeof text, "%s: %s", m->name, what);
    return text;
}

/* Opens a contact with a load that oscillates by a fifth. */
static void open_swing(const film_model *m, line *c)
{
    model_open(m, c);
    line_last(c, 20, 2e-4);
    for (size_t i = 0; i < c->count; i++)
        c->load[i] *= 1 + 0.2 * sin(2 * M_PI * (double)i / (double)c->count);
    if (m->solves)
        stage_set(c->film, "steps", (double)m->steps);
}

static void test_gears(const film_model *m)
{
    static line c;
    const double rough[2] = {0.03e-6, 0.04e-6};
    double off = 0, least = HUGE_VAL;
    size_t n;
    open_swing(m, &c);
    stage_give_series(c.film, "gear.roughness", 2, rough);
    ff_status status = line_run(&c, "h_central lambda_ratio lambda_ratio_lowest");
    if (check_true(say(m, "runs"), status == FF_OK)) {
        const double *lambda = stage_get(c.film, "lambda_ratio", &n),
                     *h = stage_get(c.film, "h_central", NULL);
        for (size_t i = 0; i < n; i++) {
            off = fmax(off, fabs(lambda[i] * 0.05e-6 / h[i] - 1));
            least = fmin(least, lambda[i]);
        }
        check_below(say(m, "h_central over the root of the sum of squares"), off, 1e-12);
        check_near(say(m, "lowest lambda ratio"), stage_scalar(c.film, "lambda_ratio_lowest"),
                   least, 1e-15);
        check_near(say(m, "its line of quality"), stage_quality(c.film, "lambda"), least, 1e-15);
    }
    line_close(&c);
}

static void test_refused(const film_model *m, const char *output, int known)
{
    static line c;
    const double none[2] = {0, 0};
    open_swing(m, &c);
    if (known)
        stage_give_series(c.film, "gear.roughness", 2, none);
    ff_status status = line_run(&c, output);
    check_true(say(m, output), status == FF_UNSUPPORTED &&
                                   !strcmp(stage_why_item(c.film), output) &&
                                   strstr(stage_why(c.film), "roughness_rq"));
    line_close(&c);
}

static void test_faulty(const film_model *m, size_t count, const double *rough, const char *what)
{
    static line c;
    open_swing(m, &c);
    stage_give_series(c.film, "gear.roughness", count, rough);
    ff_status status = line_run(&c, "h_min");
    check_true(say(m, what),
               status == FF_INVALID && !strcmp(stage_why_item(c.film), "gear.roughness"));
    line_close(&c);
}

/* The roughness of a surface must replace that of the gears. */
static void test_surface(const film_model *m)
{
    static line c;
    static flank f;
    const double gears[2] = {1e-6, 1e-6};
    open_swing(m, &c);
    stage_give_series(c.film, "gear.roughness", 2, gears);
    flank_sine(&f, 0.02e-6, 1e-4);
    if (m->solves)
        flank_give(&f, c.film);
    else {
        stage_give_scalar(c.film, "surface.rq_1", f.rq[0]);
        stage_give_scalar(c.film, "surface.rq_2", f.rq[1]);
    }
    ff_status status = line_run(&c, "h_central lambda_ratio");
    double implied =
        status == FF_OK ? line_value(&c, "h_central", 0) / line_value(&c, "lambda_ratio", 0) : 0;
    /* between rough flanks, lambda has the mean film, 0.13 um; the wave changes h_central by 0.02
       um at most */
    check_near(say(m, "the surface's roughness counts"), implied, hypot(f.rq[0], f.rq[1]),
               m->solves ? 0.16 : 1e-12);
    /* a film with roughness along the motion only does not contain the load on three-dimensional
       asperities, which matters if lambda is below 1 */
    check_near(say(m, "limit"), stage_quality_limit(c.film, "lambda"), m->solves ? 1 : 3, 0);
    line_close(&c);
}

int main(void)
{
    const double negative[2] = {1e-6, -1e-6}, endless[2] = {INFINITY, 1e-6};
    for (int k = 0; k < FILM_MODELS; k++) {
        const film_model *m = &film_models[k];
        test_gears(m);
        test_refused(m, "lambda_ratio", 0);
        test_refused(m, "lambda_ratio_lowest", 1);
        test_faulty(m, 2, negative, "negative roughness");
        test_faulty(m, 2, endless, "endless roughness");
        test_faulty(m, 1, negative, "one roughness");
        if (!m->solves || !strcmp(m->name, "finite-volume"))
            test_surface(m);
    }
    return check_done();
}
