/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Random difficult histories: loads that change by four decades within microseconds or at one
 * instant, flanks that separate and touch again at up to 1 m/s, speeds from very low to high.
 * Every history must run to its end, with the load carried, the flanks deflected by the
 * pressure, and the film thickness above 0; ehl/control-volume runs every third history.
 *
 *   test-ehl-violent [cases] [first seed]
 */
#include "balance.h"
#include "check.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static double random_share(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 33) / 2147483648.0;
}

static double between(uint64_t *state, double low, double high)
{
    return low + (high - low) * random_share(state);
}

/* Makes load 0 and a gap that closes at `speed`, from instant `from` to `to`. */
static void fly(line *c, size_t from, size_t to, double speed)
{
    double begin = c->time[from], span = c->time[to] - begin;
    for (size_t i = from; i <= to; i++) {
        double t = (c->time[i] - begin) / span;
        c->load[i] = 0;
        c->gap[i] = speed * span * t * (1 - t);
    }
}

static void invent(line *c, uint64_t *state, int with_flight)
{
    size_t count = 8 + (size_t)between(state, 0, 40);
    double span = pow(10, between(state, -5, -2.5)), load = c->load[0];
    line_last(c, count, span);
    double speed = pow(10, between(state, -1.5, 0.5)), slide = between(state, -1, 1);
    for (size_t i = 0; i < count; i++) {
        int dull = random_share(state) < 0.4;
        c->load[i] = dull && i > 0 ? c->load[i - 1] : load * pow(10, between(state, -3.5, 0.5));
        c->u1[i] *= speed * (1 + slide / 2);
        c->u2[i] *= speed * (1 - slide / 2);
        if (i > 0 && i + 1 < count && random_share(state) < 0.25)
            c->time[i] = random_share(state) < 0.5 ? c->time[i - 1] : c->time[i - 1] + 1e-6;
        if (i > 0 && c->time[i] < c->time[i - 1])
            c->time[i] = c->time[i - 1];
    }
    for (size_t i = 1; i + 1 < count; i++) /* a microsecond may be longer than the time to the next
                                              instant */
        c->time[i] = fmin(c->time[i], c->time[count - 1]);
    for (int k = 0; with_flight && k < 2; k++) {
        size_t from = (size_t)between(state, 0, (double)count - 4);
        size_t to = from + 1 + (size_t)between(state, 0, (double)(count - from) - 2);
        if (c->time[to] > c->time[from])
            fly(c, from, to, pow(10, between(state, -3, 0)));
    }
    for (size_t i = 1; i < count; i++)
        c->time[i] = fmax(c->time[i], c->time[i - 1]);
    if (!(c->time[count - 1] > c->time[count - 2])) /* the load after a jump at the end must last
                                                       for some time */
        c->time[count - 1] += 1e-6;
}

static void test_case(uint64_t seed)
{
    static line c;
    char name[600];
    uint64_t state = seed * 7919 + 1;
    for (int k = 0; k < 3; k++)
        random_share(&state);
    line_open(&c, seed % 3 ? "ehl/finite-volume" : "ehl/control-volume");
    if (random_share(&state) < 0.5)
        line_eyring(&c, 5e6);
    invent(&c, &state, random_share(&state) < 0.7);
    int own = random_share(&state) < 0.5;
    int conserving = random_share(&state) < 0.5;
    if (conserving)
        stage_set_text(c.film, "cavitation", "mass-conserving");
    stage_set(c.film, "cells", random_share(&state) < 0.5 ? 128 : 256);
    if (own)
        stage_set_text(c.film, "steps", "auto");
    else
        stage_set(c.film, "steps", 200);
    ff_status status = line_run(&c, "h_min_lowest time x film pressure load_ahead");
    int open = status == FF_OK && stage_scalar(c.film, "h_min_lowest") > 0;
    snprintf(name, sizeof name, "seed %d%s%s: %s", (int)seed, own ? ", own steps" : "",
             conserving ? ", mass-conserving" : "",
             status == FF_OK ? "film stays open" : stage_why(c.film));
    check_true(name, open);
    if (status == FF_OK)
        check_below("load and deflection", balance_of_instants(&c, 100),
                    1e-6); /* a tenth of the tolerance */
    line_close(&c);
}

int main(int argc, char **argv)
{
    int cases = argc > 1 ? atoi(argv[1]) : 40, first = argc > 2 ? atoi(argv[2]) : 1;
    for (int k = 0; k < cases; k++)
        test_case((uint64_t)(first + k));
    return check_done();
}
