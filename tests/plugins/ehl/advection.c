/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where high pressure makes the oil so viscous that no pressure flow is left, Reynolds' equation
   becomes d(rho h)/dt + u_r d(rho h)/dx = 0: the waves of the film travel unchanged at the mean
   speed u_r, although the rough flank that caused them moves at another speed. */
#include "check.h"
#include "flank.h"

#include <math.h>
#include <stdio.h>

static const double pi = 3.14159265358979323846;

/* Flank 1, with waves half a Hertz half-width long, is faster than flank 2 by `slide` mean speeds;
   the oil takes `parts` steps through a cell. Returns by how much the film in the middle of the
   contact differs from the film a quarter of the half-width upstream at the time when the oil was
   there, over the height of the film's waves. */
static double off_its_way(double slide, size_t cells, size_t parts)
{
    const size_t shift = cells / 16; /* a quarter of the half-width */
    static flank f;
    line c;
    line_open(&c, "ehl/finite-volume");
    line_moes(&c, 100, 11);
    line_incompressible(&c);
    double a = sqrt(8 * c.load[0] * c.radius[0] / (pi * c.modulus)), dx = 4 * a / (double)cells;
    double most = -HUGE_VAL, least = HUGE_VAL, off = 0, u = c.u1[0];
    c.u1[0] = u * (1 + slide / 2);
    c.u2[0] = u * (1 - slide / 2);
    flank_sine(&f, 2e-8, a / 2);
    flank_give(&f, c.film);
    line_last(&c, 2, (double)shift * dx / u);
    stage_set(c.film, "cells", (double)cells);
    stage_set(c.film, "inlet", 2.5);
    stage_set(c.film, "outlet", 1.5);
    stage_set(c.film, "steps", (double)(shift * parts));
    ff_status status = line_run(&c, "film x");
    if (check_true(status == FF_OK ? "waves pass" : stage_why(c.film), status == FF_OK)) {
        const double *x = stage_get(c.film, "x", NULL), *old = stage_get(c.film, "film", NULL);
        const double *now = old + shift * parts * (cells + 1);
        for (size_t i = shift; i <= cells; i++) {
            if (fabs(x[i]) > a / 2)
                continue;
            most = fmax(most, now[i]);
            least = fmin(least, now[i]);
            off = fmax(off, fabs(now[i] - old[i - shift]));
        }
    }
    line_close(&c);
    return off / (most - least);
}

int main(void)
{
    /* 32 steps, each of which converges to 1e-5 of the pressure */
    check_below("pure rolling, a cell a step", off_its_way(0, 512, 1), 3.2e-4);
    check_below("sliding, a cell a step", off_its_way(0.5, 512, 1), 3.2e-4);
    /* the nodes move with the oil: steps shorter than a cell do not smear the waves */
    check_below("sliding, three steps a cell", off_its_way(0.5, 512, 3), 3 * 3.2e-4);
    check_below("sliding, three steps a coarse cell", off_its_way(0.5, 256, 3), 3 * 1.6e-4);
    return check_done();
}
