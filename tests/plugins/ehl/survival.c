/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Every model far outside its range: it must give finite films with a correct quality record, or
 * stop with a reason. It must not give NaN or run for ever.
 *
 *   test-ehl-survival [long]      long: 8193 cells and 1e5 steps
 */
#include "balance.h"
#include "check.h"
#include "models.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void name(char *text, size_t size, const film_model *m, const char *what, const line *c,
                 ff_status status)
{
    snprintf(text, size, "%s, %s: %s", m->name, what,
             status == FF_OK ? "finite" : stage_why(c->film));
}

static int is_parted(const line *c, double time)
{
    size_t k = 1;
    while (k + 1 < c->count && c->time[k] < time)
        k++;
    const double share = (time - c->time[k - 1]) / (c->time[k] - c->time[k - 1]);
    return c->count > 1 && !(c->load[k - 1] + share * (c->load[k] - c->load[k - 1]) > 0);
}

/* Whether the film satisfies its balances, and the quality record reports unresolved or too thin
   films. */
static int is_honest(const film_model *m, const line *c)
{
    size_t n;
    const double *h = stage_get(c->film, "h_min", &n);
    double lowest = HUGE_VAL, error = 0;
    for (size_t i = 0; i < n; i++) {
        const double of_row = line_value(c, "h_min_error", i) / h[i];
        lowest = fmin(lowest, h[i]);
        if (!is_parted(c, line_value(c, "time", i)))
            error = fmax(error, of_row);
        else if (m->solves && isfinite(of_row))
            return 0; /* it is not known between parted flanks */
    }
    int thin = lowest < 1e-9, doubtful = stage_verdict(c->film) == FF_DOUBTFUL;
    if (isinf(error) && !(doubtful && isnan(stage_quality(c->film, "h_min_space_error"))))
        return 0; /* an unknown value is not reported */
    if (thin && !(stage_quality(c->film, "continuum") < 1e-9))
        return 0;
    if (m->solves && !(balance_of_instants(c, 20) < 1e-6)) /* a tenth of the tolerance */
        return 0;
    return doubtful || (!thin && (!m->solves || error < 0.1));
}

static size_t stops; /* runs of the model that stopped */

/* Largest number of runs that may stop, per model: the number found, and two more for other
   processors. */
static const double most_stops[FILM_MODELS] = {0, 0, 24, 16, 27};

/* may_stop: the equations need have no solution on this grid. */
static void survive(const film_model *m, line *c, const char *what, int may_stop)
{
    char text[400];
    ff_status status = line_run(c, model_outputs(m));
    name(text, sizeof text, m, what, c, status);
    if (status == FF_OK)
        check_true(text, model_is_finite(m, c) && is_honest(m, c));
    else
        check_true(text, may_stop && status == FF_NOCONV && strlen(stage_why(c->film)) > 40);
    stops += status != FF_OK;
    line_close(c);
}

typedef enum law { ROELANDS, BARUS, DOOLITTLE, LAWS } law;

static const char *const law_name[] = {"Roelands", "Barus", "Doolittle-Tait"};

static void choose(line *c, law which)
{
    if (which == BARUS)
        line_oil(c, "viscosity/barus", 5.006e-3, 11.03e-9);
    if (which == DOOLITTLE) {
        line_oil(c, "viscosity/doolittle-tait", 5.006e-3, 0);
        stage_set(c->oil, "B", 3.7303);
        stage_set(c->oil, "V_occ", 0.6132);
        stage_set(c->oil, "K0", 1.05e9);
        stage_set(c->oil, "K0_prime", 10.076);
    }
}

static void test_range(const film_model *m)
{
    static const double load[] = {1e-6, 1e-3, 1, 10, 100}, speed[] = {1e-4, 1e-2, 1, 100};
    char text[160];
    for (law which = ROELANDS; which < LAWS; which++)
        for (size_t i = 0; i < 5; i++)
            for (size_t k = 0; k < 4; k++) {
                line c;
                int hard = load[i] > 10 || (speed[k] < 0.1 && load[i] > 0.1);
                model_open(m, &c);
                choose(&c, which);
                line_eyring(&c, 5e6);
                c.load[0] *= load[i];
                c.u1[0] *= 1.2 * speed[k];
                c.u2[0] *= 0.8 * speed[k];
                snprintf(text, sizeof text, "%s, load x %g, speed x %g", law_name[which], load[i],
                         speed[k]);
                survive(m, &c, text, m->solves && hard);
            }
}

/* Hertz pressures up to 4 GPa; with Barus alpha p up to 80; the pole of Doolittle and Tait, where
   the free volume vanishes, lies near 6.5 GPa. */
static void test_pressure(const film_model *m)
{
    static const double pressure[] = {1e9, 2e9, 4e9, 6e9};
    const double pi = acos(-1);
    char text[160];
    for (law which = ROELANDS; which < LAWS; which++)
        for (int k = 0; k < 4; k++) {
            line c;
            model_open(m, &c);
            choose(&c, which);
            if (which == BARUS)
                line_oil(&c, "viscosity/barus", 5.006e-3, fmin(20e-9, 80 / pressure[k]));
            line_eyring(&c, 5e6);
            c.u1[0] *= 1.1;
            c.load[0] = 2 * pi * c.radius[0] / c.modulus * pow(pressure[k], 2);
            snprintf(text, sizeof text, "%s, p_H %g GPa", law_name[which], 1e-9 * pressure[k]);
            survive(m, &c, text, m->solves && (pressure[k] > 3e9 || m->cells < 200));
        }
}

static void test_slide(const film_model *m)
{
    static const double slide[] = {-2, -1, 0, 1, 2};
    char text[80];
    for (int k = 0; k < 5; k++) {
        line c;
        model_open(m, &c);
        line_eyring(&c, 2e6);
        double u = c.u1[0];
        c.u1[0] = u * (1 + slide[k] / 2);
        c.u2[0] = u * (1 - slide[k] / 2);
        snprintf(text, sizeof text, "slide-to-roll ratio %g", slide[k]);
        survive(m, &c, text, 0);
    }
}

static void test_cells(const film_model *m, size_t most)
{
    char text[80];
    for (size_t cells = 17; cells <= most; cells = cells < 32 ? 64 : 2 * cells + (cells == 4096)) {
        line c;
        model_open(m, &c);
        stage_set(c.film, "cells", (double)cells);
        snprintf(text, sizeof text, "%zu cells", cells);
        survive(m, &c, text, m->solves && cells < 64);
    }
}

static void test_steps(const film_model *m, size_t most)
{
    char text[80];
    for (size_t steps = 10; steps <= most; steps *= 10) {
        line c;
        model_open(m, &c);
        line_last(&c, 41, 400e-6);
        for (size_t i = 0; i < c.count; i++)
            c.load[i] *= 1 + 0.5 * sin((double)i);
        stage_set(c.film, "steps", (double)steps);
        snprintf(text, sizeof text, "%zu steps", steps);
        survive(m, &c, text, 0);
    }
}

/* The flanks separate for 100 us, then touch again at 1 m/s. */
static void test_impact(const film_model *m)
{
    line c;
    model_open(m, &c);
    line_eyring(&c, 5e6);
    line_last(&c, 61, 300e-6);
    for (size_t i = 20; i <= 40; i++) {
        double t = c.time[i] - c.time[20], fall = 100e-6 - t;
        c.load[i] = 0;
        c.gap[i] = fmin(0.25 * t, 1.0 * fall);
    }
    for (size_t i = 41; i < 50; i++)
        c.load[i] *= i < 45 ? 3 : 0.5;
    stage_set(c.film, "steps", 300);
    survive(m, &c, "contact again at 1 m/s", 0);
}

int main(int argc, char **argv)
{
    char text[96];
    int whole = argc > 1 && strcmp(argv[1], "long") == 0;
    for (int k = 0; k < FILM_MODELS; k++) {
        const film_model *m = &film_models[k];
        int dense = strstr(m->name, "dense") != NULL;
        if (!whole) {
            test_range(m);
            test_pressure(m);
            test_slide(m);
            test_impact(m);
        }
        test_cells(m, !whole ? 256 : dense ? 1024 : 8193);
        test_steps(m, !whole ? 100 : dense ? 10000 : 100000);
        snprintf(text, sizeof text, "%s: cases that stop with a reason", m->name);
        check_below(text, (double)stops, most_stops[k]);
        stops = 0;
    }
    return check_done();
}
