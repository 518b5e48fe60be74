/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tooth.h"

#include <math.h>

static const double degree = 3.14159265358979323846 / 180;

/* Share of the load on the pair: 1/3 rising to 2/3 while two pairs carry, 1 between. */
static double load_share(double roll)
{
    const double sap = 14.537, lpstc = 19.971, hpstc = 21.737, tip = 27.171, ramp = 0.2;
    double early = (1 + fmin((roll - sap) / (lpstc - sap), 1)) / 3;
    double late = (1 + fmin((tip - roll) / (tip - hpstc), 1)) / 3;
    double up = fmin(fmax((roll - lpstc) / ramp + 0.5, 0), 1);
    double down = fmin(fmax((hpstc - roll) / ramp + 0.5, 0), 1);
    return roll < 20.854 ? early + up * (1 - early) : late + down * (1 - late);
}

void path_fill(path *c, double share)
{
    const double base = 70.476947e-3, sum = 51.3030e-3, speed = share * 1500 * 6 * degree;
    for (size_t i = 0; i < POINTS; i++) {
        double roll = 14.537 + (27.171 - 14.537) * (double)i / (POINTS - 1);
        double r1 = base * roll * degree, r2 = sum - r1;
        c->time[i] = (roll - 14.537) * degree / speed;
        c->radius[i] = r1 * r2 / sum;
        c->u1[i] = speed * r1;
        c->u2[i] = speed * r2;
        c->load[i] = 177.363e3 * load_share(roll);
    }
}

stage *film_open(const char *model, const path *c, const oil *o, size_t cells, size_t steps)
{
    stage *s = stage_open(model);
    stage_set(s, "cells", (double)cells);
    stage_set(s, "steps", (double)steps);
    stage_give_series(s, "contact.time", POINTS, c->time);
    stage_give_series(s, "contact.equivalent_radius", POINTS, c->radius);
    stage_give_series(s, "contact.speed_1", POINTS, c->u1);
    stage_give_series(s, "contact.speed_2", POINTS, c->u2);
    stage_give_series(s, "contact.load_per_width", POINTS, c->load);
    stage_give_scalar(s, "contact.reduced_modulus", 226.4e9);
    stage_link(s, "viscosity", o->viscosity);
    stage_link(s, "density", o->density);
    stage_link(s, "rheology", o->rheology);
    return s;
}

void oil_open(oil *o)
{
    *o = (oil){stage_open("viscosity/doolittle-tait"), stage_open("density/dowson-higginson"),
               stage_open("rheology/ree-eyring")};
    stage_set(o->viscosity, "eta0", 5.006e-3);
    stage_set(o->viscosity, "B", 3.7303);
    stage_set(o->viscosity, "V_occ", 0.6132);
    stage_set(o->viscosity, "K0", 1.05e9);
    stage_set(o->viscosity, "K0_prime", 10.076);
    stage_set(o->density, "rho0", 917.8);
    stage_set(o->rheology, "tau0", 5e6);
}

void oil_close(oil *o)
{
    stage_close(o->viscosity);
    stage_close(o->density);
    stage_close(o->rheology);
}
