/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The end of the film must lie between a full node with pressure above 0 and a dry node that gains
   no mass. If asymmetric volumes of second order have no solution with this property, the run must
   report it. */
#include "check.h"
#include "line.h"

#include <math.h>
#include <stdio.h>

typedef struct ends {
    int films, undecided, silent; /* silent: films whose dry node gains mass without a report */
    double gain;                  /* largest gain of mass, over the flow */
} ends;

/* Solves steady films of loads that increase by a twentieth, so that the end of the film lies at
   many positions in a cell. */
static ends solve(const char *model, const char *wedge)
{
    ends out = {0};
    for (double share = 0.003; share < 0.03; share *= 1.05) {
        line c;
        line_open(&c, model);
        c.load[0] *= share;
        stage_set(c.film, "cells", 256);
        stage_set(c.film, "inlet", 40);
        stage_set(c.film, "outlet", 15);
        stage_set_text(c.film, "wedge", wedge);
        check_true(model, line_run(&c, "h_min") == FF_OK);
        int asks = model[4] == 'c', undecided = asks && stage_quality(c.film, "film_end") > 0;
        double gain = stage_quality(c.film, "complementarity");
        out.films++;
        out.undecided += undecided;
        out.silent += !undecided && gain > 1e-4;
        out.gain = fmax(out.gain, gain);
        line_close(&c);
    }
    return out;
}

static void test_decided(const char *model, const char *wedge)
{
    ends e = solve(model, wedge);
    char name[96];
    snprintf(name, sizeof name, "%s, %s: all of %d ends are decided, gain %.2g", model, wedge,
             e.films, e.gain);
    check_true(name, e.films > 40 && e.undecided == 0 && e.silent == 0);
}

int main(void)
{
    test_decided("ehl/finite-volume", "second");
    test_decided("ehl/finite-volume", "first");
    test_decided("ehl/control-volume", "first");
    ends e = solve("ehl/control-volume", "second");
    char name[96];
    snprintf(name, sizeof name, "%d of %d ends are undecided, and say so", e.undecided, e.films);
    check_true(name, e.undecided > 0 && e.undecided < e.films / 4 && e.silent == 0);
    check_below("what they gain, over the flow", e.gain, 0.02);
    return check_done();
}
