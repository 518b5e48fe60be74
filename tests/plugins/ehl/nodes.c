/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `thermal: full`: errors from the number of nodes across hot films, found with films that have
   many nodes across. */
#include "check.h"

#include "line.h"

#include <math.h>
#include <stdio.h>

/* A steady contact of flanks of different materials: mean speed, m/s, slide-roll ratio, oil, its
   temperature, K, and the Eyring stress, Pa; 0: measured flow laws of the base oil, whose stress
   depends on pressure and temperature. */
typedef struct hot {
    double speed, slip;
    const char *oil;
    double entry, stress;
} hot;

typedef struct found {
    double h, friction, error;
} found;

static void take_measured_laws(line *c)
{
    stage_close(c->oil);
    c->oil = stage_open("viscosity/modulus");
    stage_link(c->oil, "oil", c->liquid);
    c->flow = stage_open("rheology/ree-eyring");
    stage_set_text(c->flow, "tau0", "auto");
    stage_link(c->flow, "viscosity", c->oil);
    stage_link(c->flow, "oil", c->liquid);
}

static void open_hot(line *c, const hot *at, double nodes)
{
    line_open(c, "ehl/finite-volume");
    line_grade(c, at->oil, at->entry);
    if (at->stress > 0)
        line_eyring(c, at->stress);
    else
        take_measured_laws(c);
    stage_set_text(c->film, "thermal", "full");
    stage_set(c->film, "cells", 80);
    stage_set(c->film, "inlet", 5);
    stage_set(c->film, "outlet", 2);
    stage_set(c->film, "thermal_nodes", nodes);
    c->u1[0] = at->speed * (1 + at->slip / 2);
    c->u2[0] = at->speed * (1 - at->slip / 2);
}

static found film(const hot *at, double nodes)
{
    line c;
    found f = {NAN, NAN, NAN};
    char what[96];
    open_hot(&c, at, nodes);
    snprintf(what, sizeof what, "%g nodes, %g m/s, slide-roll ratio %g: found", nodes, at->speed,
             at->slip);
    if (check_true(what, line_run(&c, "h_central friction_coefficient") == FF_OK))
        f = (found){line_value(&c, "h_central", 0), line_value(&c, "friction_coefficient", 0),
                    stage_quality(c.film, "node_error")};
    line_close(&c);
    return f;
}

/* The true error of film and friction due to the nodes across must not exceed the stated error, and
   the stated error of the film must be at most four times the true one. */
static void test_errors(void)
{
    static const hot at[] = {
        {2, 1, "ISO VG 320", 333.15, 0},    {5, 0.3, "ISO VG 320", 333.15, 5e6},
        {5, 1.9, "ISO VG 100", 353.15, 0},  {10, 0, "ISO VG 320", 333.15, 5e6},
        {10, 0.2, "ISO VG 320", 333.15, 0}, {10, 1, "ISO VG 460", 333.15, 5e6},
        {20, 0, "ISO VG 320", 333.15, 5e6}, {20, 0.2, "ISO VG 320", 333.15, 5e6},
        {20, 0.3, "ISO VG 320", 333.15, 0}, {20, 1, "ISO VG 320", 333.15, 0},
    };
    for (size_t k = 0; k < sizeof at / sizeof at[0]; k++) {
        const found few = film(&at[k], 8), twin = film(&at[k], 20);
        char what[96];
        snprintf(what, sizeof what, "%g m/s, %g: off by %.2g, over node_error", at[k].speed,
                 at[k].slip, few.h / twin.h - 1);
        check_below(what, fabs(few.h / twin.h - 1) / few.error, 1);
        check_below("and node_error over it", few.error / fabs(few.h / twin.h - 1), 4);
        if (at[k].slip > 0) {
            snprintf(what, sizeof what, "%g m/s, %g: friction off by %.2g, over node_error",
                     at[k].speed, at[k].slip, few.friction / twin.friction - 1);
            check_below(what, fabs(few.friction / twin.friction - 1) / few.error, 1);
        }
    }
}

/* The error must decrease faster than any power of the number of nodes: with 1.5 times as many
   nodes, by a factor that increases. */
static void test_order(void)
{
    const hot at = {5, 1, "ISO VG 320", 333.15, 5e6};
    const double twin = film(&at, 28).h;
    double off[3];
    for (int k = 0; k < 3; k++)
        off[k] = fabs(film(&at, 8 + 4 * k).h / twin - 1);
    check_below("the error of 12 nodes, over that of 8", off[1] / off[0], 0.15);
    check_below("that of 16, over that of 12", off[2] / off[1], 0.5);
    check_below("and small", off[2], 1e-4);
}

/* The second of three engagements starts so hot, at 22 m/s, that its first film needs damping
   across the film. The third must again start without damping, and be equal to the first, which has
   the same conditions. */
static void test_hard_start(double speed)
{
    enum { EACH = 2, ENGAGEMENTS = 3 };
    const double engagement[ENGAGEMENTS * EACH] = {0, 0, 1, 1, 2, 2};
    size_t n;
    line c;
    open_hot(&c, &(hot){10, 0, "ISO VG 1000", 333.15, 0}, 8);
    line_last(&c, ENGAGEMENTS * EACH, 5e-6);
    c.u1[2] = c.u1[3] = c.u2[2] = c.u2[3] = speed;
    stage_give_series(c.film, "contact.engagement", c.count, engagement);
    stage_set(c.film, "steps", 5);
    int runs = line_run(&c, "h_central time") == FF_OK;
    printf("%g m/s: %s\n", speed, runs ? "found" : "not found");
    if (runs) {
        stage_get(c.film, "time", &n);
        check_near("a start after a hard one", line_value(&c, "h_central", n - 1),
                   line_value(&c, "h_central", 1), 1e-4);
    }
    line_close(&c);
}

int main(void)
{
    test_hard_start(16);
    test_hard_start(22);
    test_errors();
    test_order();
    return check_done();
}
