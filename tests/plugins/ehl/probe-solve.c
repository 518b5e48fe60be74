/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a probe solve says of a number of cells is what those cells are off by in a whole solution,
   and it costs nearly nothing. */
#include "check.h"
#include "line.h"

#include "../../../plugins/ehl/assess.h"

#include <math.h>
#include <stdio.h>

/* Errors below it are told with less care. */
static const double asked = 6e-3;

typedef struct films {
    double least, central;
} films;

static films solve(double M, double L, size_t cells)
{
    line c;
    line_open(&c, "ehl/finite-volume");
    line_moes(&c, M, L);
    stage_set(c.film, "cells", (double)cells);
    stage_set(c.film, "tolerance", 1e-7);
    if (line_run(&c, "h_min h_central") != FF_OK)
        check_true(stage_why(c.film), 0);
    films f = {line_value(&c, "h_min", 0), line_value(&c, "h_central", 0)};
    line_close(&c);
    return f;
}

static ehl_probe solve_probe(const line *c, size_t cells)
{
    const ehl_history h = {.count = 1,
                           .time = c->time,
                           .radius = c->radius,
                           .speed_1 = c->u1,
                           .speed_2 = c->u2,
                           .load = c->load,
                           .modulus = c->modulus,
                           .load_max = c->load[0]};
    const ehl_laws laws = {.viscosity = stage_service(c->oil, FF_VISCOSITY_ID),
                           .density = stage_service(c->rho, FF_DENSITY_ID)};
    const ehl_instant at = ehl_history_row(&h, 0);
    ehl_oil oil;
    ehl_probe probe = {0};
    check_true("an oil", ehl_fluid_oil(&laws, &oil) >= 0);
    check_true("probe solve", ehl_probe_solve(&h, &laws, &oil, &at, 1, cells, &probe) == FF_OK);
    return probe;
}

/* What is made of it for a film at rest with the cells that were tried. */
static double promised(double M, double L, ehl_probe probe)
{
    const ehl_conditions conditions = {.M_high = M,
                                       .L_high = L,
                                       .domain = 1,
                                       .buildup = 0.01,
                                       .mean_buildup = 0.01,
                                       .half_width = 0.3,
                                       .steady = 1,
                                       .probe = probe};
    ehl_tuning t = {.cells = probe.cells};
    ehl_tune(&conditions, 1, EHL_TUNE_CELLS, (ehl_error_targets){.lowest = 1}, &t);
    return t.lowest;
}

static void test_error(double M, double L, size_t cells)
{
    char what[96];
    line c;
    line_open(&c, "ehl/finite-volume");
    line_moes(&c, M, L);
    ehl_probe probe = solve_probe(&c, cells);
    line_close(&c);
    films coarse = solve(M, L, cells), fine = solve(M, L, 8 * cells);
    double least = fabs(coarse.least / fine.least - 1),
           central = fabs(coarse.central / fine.central - 1);
    double worst = fmax(least, central), told = fmax(probe.least, probe.central);
    snprintf(what, sizeof what, "M %g, L %g, %zu cells", M, L, cells);
    check_true(what, probe.cells == cells);
    if (worst > asked) {
        check_below("error of the films, over what was told", worst / told, 1.2);
        check_below("what was told, over it", told / worst, 1.4);
    } else {
        check_below("told to be small", told, 2 * asked);
    }
    if (least > asked)
        check_below("error of h_min, over what is promised", least / promised(M, L, probe), 1);
    check_below("work, in films of 30 deflections on twice the cells",
                probe.work / (2 * (double)cells * log2(2 * (double)cells)) / 30, 1);
}

/* Far too few cells for any film: nothing is said. */
static void test_too_coarse(void)
{
    line c;
    line_open(&c, "ehl/finite-volume");
    line_moes(&c, 1000, 15);
    check_true("nothing is measured", solve_probe(&c, 16).cells == 0);
    line_close(&c);
}

int main(void)
{
    static const double M[] = {1, 5, 20, 100}, L[] = {2, 6, 12};
    for (size_t i = 0; i < sizeof M / sizeof *M; i++)
        for (size_t j = 0; j < sizeof L / sizeof *L; j++)
            for (size_t cells = 192; cells <= 384; cells *= 2)
                test_error(M[i], L[j], cells);
    test_too_coarse();
    return check_done();
}
