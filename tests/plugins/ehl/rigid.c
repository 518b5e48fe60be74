/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rigid cylinder, isoviscous oil (Martin 1916): w h0/(eta u R) = 4.86526 and rupture at 0.47509
   when the film begins at x = -20 sqrt(2 R h0); the pressure then peaks at 2.1509 (infinite inlet).
 */
#include "line.h"

#include <math.h>

int main(void)
{
    const double eta = 0.03, h0 = 1e-6, inlet = 20, pi = 3.14159265358979323846;
    line c;
    line_open(&c, "ehl/finite-volume");
    line_oil(&c, "viscosity/isoviscous", eta, 0);
    line_incompressible(&c);
    double R = c.radius[0], u = c.u1[0], S = sqrt(2 * R * h0);
    c.modulus = 1e18;
    c.load[0] = 4.86526 * eta * u * R / h0;
    double a = sqrt(8 * c.load[0] * R / (pi * c.modulus));
    stage_set(c.film, "cells", 2048);
    stage_set(c.film, "inlet", inlet * S / a);
    stage_set(c.film, "outlet", 2 * S / a);
    stage_set(c.film, "tolerance", 1e-8);
    check_true("converges", line_run(&c, "h_min p_max pressure x") == FF_OK);
    double h = line_value(&c, "h_min", 0), p = line_value(&c, "p_max", 0);
    check_near("load number", c.load[0] * h / (eta * u * R), 4.86526, 2e-3);
    check_near("pressure number", p * pow(h, 1.5) / (eta * u * sqrt(R)), 2.150942, 2e-3);
    size_t nodes, last = 0;
    const double *pressure = stage_get(c.film, "pressure", &nodes);
    for (size_t i = 0; i < nodes; i++)
        last = pressure[i] > 0 ? i : last;
    check_near("rupture", line_value(&c, "x", last) / sqrt(2 * R * h), 0.47509, 0.03);
    line_close(&c);
    return check_done();
}
