/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares each density law with values computed elsewhere and with its limits. */
#include "check.h"
#include "stage.h"

#include <flankfilm/density.h>

#include <math.h>

static double relative(stage *s, double p)
{
    const ff_density *d = stage_service(s, FF_DENSITY_ID);
    double at[2] = {0, p}, rho[2];
    d->eval(d->self, 2, at, NULL, rho, NULL, NULL);
    return rho[1] / rho[0];
}

static stage *dowson(double a, double b)
{
    stage *s = stage_open("density/dowson-higginson");
    stage_set(s, "rho0", 917.8);
    if (a > 0) {
        stage_set(s, "a", a);
        stage_set(s, "b", b);
    }
    return s;
}

/* rho/rho0 at 1 GPa, in three usual forms of the same law, to the four published digits. */
static void dowson_higginson(void)
{
    stage *usual = dowson(0, 0);
    stage *fraction = dowson(0.34 / 0.59e9, 1 / 0.59e9); /* (0.59e9 + 1.34 p)/(0.59e9 + p) */
    stage *cardiff = dowson(2.266e-9 - 1.683e-9, 1.683e-9);
    check_near("a = 0.6, b = 1.7 by default, at 1 GPa", relative(usual, 1e9), 1.2222, 5e-5);
    check_near("as a fraction", relative(fraction, 1e9), 1.2138, 5e-5);
    check_near("Cardiff constants", relative(cardiff, 1e9), 1.2173, 5e-5);
    check_near("at most a/b denser", relative(usual, 1e30), 1 + 0.6 / 1.7, 1e-14);
    check_near("tangent in tension", relative(usual, -0.5e9), 0.7, 1e-14);
    stage_close(usual);
    stage_close(fraction);
    stage_close(cardiff);
}

static void tait(void)
{
    stage *s = stage_open("density/tait");
    stage_set(s, "rho0", 917.8);
    stage_set(s, "K0", 1.05e9);
    stage_set(s, "K0_prime", 10.076);
    check_near("at 1 GPa, V = 0.7791", relative(s, 1e9), 1.2835, 5e-5);
    /* K(p) = rho dp/drho = V (K0 + p (1 + K0')), with slope K0' at 0 */
    const ff_density *d = stage_service(s, FF_DENSITY_ID);
    double p[2] = {0, 1e3}, rho[2], slope[2];
    d->eval(d->self, 2, p, NULL, rho, slope, NULL);
    check_near("bulk modulus", rho[0] / slope[0], 1.05e9, 1e-14);
    check_near("its rise", (rho[1] / slope[1] - rho[0] / slope[0]) / 1e3, 10.076, 1e-5);
    check_near("rho0", rho[0], 917.8, 1e-15);
    stage_close(s);
}

static void incompressible(void)
{
    stage *s = stage_open("density/incompressible");
    stage_set(s, "rho0", 917.8);
    check_true("incompressible", relative(s, 3e9) == 1 && relative(s, -3e9) == 1);
    stage_close(s);
}

int main(void)
{
    dowson_higginson();
    tait();
    incompressible();
    return check_done();
}
