/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors of films computed by their transport equation: compares the linear solution with a dense
   one, whose matrix comes from differences of the balances, and the stated errors of films with
   finer films. */
#include "check.h"
#include "line.h"

#include "../../../plugins/ehl/equations/deflection.h"
#include "../../../plugins/ehl/time/error-transport.h"
#include "../../../plugins/ehl/time/start.h"
#include "../../../plugins/ehl/time/time-stepper.h"
#include "../../../plugins/ehl/time/trial.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 96, NODES = CELLS + 1, SIZE = NODES + 1, ROWS = 3, STEPS = 12 };

static const double pi = 3.14159265358979323846;
static const double time_of[ROWS] = {0, 40e-6, 80e-6}, radius[ROWS] = {0.0128, 0.0128, 0.0128},
                    speed_1[ROWS] = {4.4, 4.4, 4.4}, speed_2[ROWS] = {3.6, 3.6, 3.6},
                    load[ROWS] = {1e5, 2e5, 1e5};
static const ehl_history swelling = {.count = ROWS,
                                     .time = time_of,
                                     .radius = radius,
                                     .speed_1 = speed_1,
                                     .speed_2 = speed_2,
                                     .load = load,
                                     .modulus = 226.4e9,
                                     .load_max = 2e5};

typedef struct scene {
    ehl_history history;
    ehl_grid grid;
    ehl_oil oil;
    ehl_reynolds reynolds;
    double kernel[NODES];
    ehl_solver solver;
    ehl_march march;
    ehl_transport transport;
    double p[NODES], v[NODES], matrix[SIZE][SIZE], answer[SIZE];
} scene;

static void make(scene *s, const ehl_laws *laws, const ehl_history *history)
{
    *s = (scene){.history = *history};
    ehl_fluid_oil(laws, &s->oil);
    ehl_grid_fit(&s->grid, CELLS, 4, 1.6, &s->history, &s->oil, 0, 0);
    ehl_reynolds_create(&s->reynolds, &s->grid, laws, &s->oil, 2);
    ehl_kernel_fill(NODES, s->grid.dx, s->history.modulus, s->grid.half_width, s->kernel);
    s->solver = (ehl_solver){.grid = &s->grid,
                             .reynolds = &s->reynolds,
                             .kernel = s->kernel,
                             .modulus = s->history.modulus,
                             .tolerance = 1e-9,
                             .maker = ehl_newton_krylov};
    check_true("a march",
               ehl_newton_krylov(&s->solver) == FF_OK &&
                   ehl_march_create(&s->march, &s->history, &s->solver, EHL_BDF2) == FF_OK &&
                   ehl_transport_create(&s->transport, NODES) == FF_OK);
    s->transport.accuracy = 1e-10;
    s->march.transport = &s->transport;
}

static void destroy(scene *s)
{
    ehl_transport_destroy(&s->transport);
    ehl_march_destroy(&s->march);
    s->solver.destroy(&s->solver);
    ehl_reynolds_destroy(&s->reynolds);
}

/* Writes the derivatives of the balances by unknown k, a pressure or h00, into column k. */
static void fill_column(scene *s, size_t k)
{
    const ehl_film *film = &s->march.state[0].film;
    ehl_reynolds *r = &s->reynolds;
    const double step = k < NODES ? 1e-5 * s->march.state[0].highest : 1e-5 * film->h00;
    for (int side = 1; side >= -1; side -= 2) {
        ehl_film moved = *film;
        moved.p = s->p;
        moved.v = s->v;
        memcpy(s->p, film->p, sizeof s->p);
        if (k < NODES)
            s->p[k] += side * step;
        else
            moved.h00 += side * step;
        ehl_kernel_direct(NODES, s->kernel, s->p, s->v);
        ehl_reynolds_evaluate(r, &s->march.step, &moved);
        for (size_t i = 0; i < NODES; i++)
            s->matrix[i][k] += film->full[i] ? side * r->residual[i] / (2 * step) : 0;
    }
}

/* Gaussian elimination with scaled rows; the pivot is the largest entry of a column. */
static void eliminate(scene *s)
{
    for (size_t k = 0; k < SIZE; k++) {
        size_t best = k;
        for (size_t i = k + 1; i < SIZE; i++)
            best = fabs(s->matrix[i][k]) > fabs(s->matrix[best][k]) ? i : best;
        for (size_t j = 0; j < SIZE; j++) {
            double kept = s->matrix[k][j];
            s->matrix[k][j] = s->matrix[best][j];
            s->matrix[best][j] = kept;
        }
        double kept = s->answer[k];
        s->answer[k] = s->answer[best];
        s->answer[best] = kept;
        for (size_t i = k + 1; i < SIZE; i++) {
            double share = s->matrix[i][k] / s->matrix[k][k];
            for (size_t j = k; j < SIZE; j++)
                s->matrix[i][j] -= share * s->matrix[k][j];
            s->answer[i] -= share * s->answer[k];
        }
    }
    for (size_t k = SIZE; k-- > 0;) {
        for (size_t j = k + 1; j < SIZE; j++)
            s->answer[k] -= s->matrix[k][j] * s->answer[j];
        s->answer[k] /= s->matrix[k][k];
    }
}

/* Compares the last solution with the dense one. */
static void check_twin(scene *s, const char *what)
{
    const ehl_film *film = &s->march.state[0].film;
    const ehl_answer *e = &s->transport.e;
    memset(s->matrix, 0, sizeof s->matrix);
    for (size_t k = 0; k < SIZE; k++)
        if (k == NODES || film->full[k])
            fill_column(s, k);
    const double unit = 1 / s->kernel[0], row = fabs(s->matrix[NODES / 2][NODES / 2]);
    for (size_t i = 0; i < NODES; i++) {
        s->matrix[i][i] += film->full[i] ? 0 : row;
        s->answer[i] = film->full[i] ? s->transport.rows[i] : 0;
        s->matrix[NODES][i] = row;
    }
    for (size_t i = 0; i < SIZE; i++) /* h00 is scaled to the size of a pressure */
        s->matrix[i][NODES] /= unit;
    s->matrix[NODES][NODES] = 0;
    s->answer[NODES] = 0;
    eliminate(s);
    double off = 0, most = 0;
    for (size_t i = 0; i < NODES; i++) {
        off = fmax(off, fabs(e->p[i] - s->answer[i]));
        most = fmax(most, fabs(s->answer[i]));
    }
    char text[96];
    snprintf(text, sizeof text, "%s: pressure against the dense solution", what);
    check_below(text, off / most, 1e-3);
    snprintf(text, sizeof text, "%s: h00", what);
    check_near(text, e->h00, s->answer[NODES] / unit, 1e-3);
    snprintf(text, sizeof text, "%s: there is an error", what);
    check_true(text, most > 0);
}

static void test_twin(const ehl_laws *laws)
{
    static scene s;
    make(&s, laws, &swelling);
    check_true("a steady film", ehl_march_start(&s.march) == FF_OK && s.transport.known);
    check_twin(&s, "steady");
    ff_status status = FF_OK;
    for (int k = 1; k <= STEPS && status == FF_OK; k++)
        status = ehl_march_to(&s.march, time_of[1] * k / STEPS);
    check_true("a history", status == FF_OK && s.transport.known);
    check_twin(&s, "a history");
    destroy(&s);
}

/* Computes the errors of the gap after some steps. */
static void errors_of(const ehl_laws *laws, double accuracy, double *of)
{
    static scene s;
    make(&s, laws, &swelling);
    s.transport.accuracy = accuracy;
    ff_status status = ehl_march_start(&s.march);
    for (int k = 1; k <= STEPS && status == FF_OK; k++)
        status = ehl_march_to(&s.march, time_of[1] * k / STEPS);
    check_true("a history", status == FF_OK && s.transport.known);
    memcpy(of, s.transport.h, NODES * sizeof *of);
    destroy(&s);
}

/* The residual of the linear solutions must not affect the errors. */
static void test_accuracy(const ehl_laws *laws)
{
    static double usual[NODES], exact[NODES];
    double off = 0, most = 0;
    errors_of(laws, 0.1, usual);
    errors_of(laws, 1e-8, exact);
    for (size_t i = 0; i < NODES; i++) {
        off = fmax(off, fabs(usual[i] - exact[i]));
        most = fmax(most, fabs(exact[i]));
    }
    check_below("linear solutions to 0.1 against 1e-8: errors of the gap", off / most, 0.05);
}

/* If the equations of the errors are not solved, the errors must be unknown until the oil has left
   the contact. */
static void test_lost(const ehl_laws *laws)
{
    static scene s;
    make(&s, laws, &swelling);
    s.transport.accuracy = 1e-200;
    ff_status status = ehl_march_start(&s.march);
    check_true("errors of a steady film that are not found", status == FF_OK && !s.transport.known);
    s.transport.accuracy = 0.1;
    status = ehl_march_to(&s.march, time_of[1] / STEPS);
    check_true("nor those after them", status == FF_OK && !s.transport.known);
    const double passage = 4 * s.grid.half_width / 4; /* s, at 4 m/s */
    for (int k = 2; k <= 10 * STEPS && status == FF_OK && time_of[1] * k / STEPS < passage; k++)
        status = ehl_march_to(&s.march, time_of[1] * k / STEPS);
    check_true("up to the end of a passage", status == FF_OK && !s.transport.known);
    status = ehl_march_to(&s.march, passage + time_of[1] / STEPS);
    check_true("but known from there on", status == FF_OK && s.transport.known);
    destroy(&s);
}

/* If the entrainment reverses, the order of the nodes reverses, and so must the errors. */
static void test_turn(const ehl_laws *laws)
{
    static const double time[ROWS] = {0, 40e-6, 40.01e-6}, speed[ROWS] = {4, 0.2, -0.2};
    static double before[EHL_TRANSPORT_ARRAYS][NODES];
    static scene s;
    ehl_history turning = swelling;
    turning.time = time;
    turning.speed_1 = turning.speed_2 = speed;
    turning.turns = 1;
    make(&s, laws, &turning);
    ff_status status = ehl_march_start(&s.march);
    for (int k = 1; k <= STEPS && status == FF_OK; k++)
        status = ehl_march_to(&s.march, time[1] * k / STEPS);
    check_true("a history up to its turn", status == FF_OK && !s.march.mirrored);
    memcpy(before, s.transport.memory, sizeof before);
    const ehl_instant at = ehl_history_at(&s.history, time[2]);
    ehl_march_place(&s.march, &at);
    double off = 0, uneven = 0;
    for (size_t k = 0; k < EHL_TRANSPORT_ARRAYS; k++)
        for (size_t i = 0; i < NODES; i++) {
            double there = before[k][NODES - 1 - i];
            off = fmax(off, fabs(s.transport.memory[k * NODES + i] - there));
            uneven = fmax(uneven, fabs(before[k][i] - there));
        }
    check_true("errors turn with the nodes", s.march.mirrored && off <= 0 && uneven > 0);
    status = ehl_march_to(&s.march, time[2]);
    check_true("and go on", status == FF_OK && s.transport.known);
    destroy(&s);
}

/* Opens a steady film on a given domain, with M and L, or the contact of line_open. */
static void open_steady(line *c, double M, double L, size_t cells)
{
    line_open(c, "ehl/finite-volume");
    if (L > 0)
        line_moes(c, M, L);
    else if (M > 0)
        line_moes_isoviscous(c, M);
    stage_set(c->film, "cells", (double)cells);
    stage_set(c->film, "inlet", M > 0 && M < 10 ? 8 : 4);
    stage_set(c->film, "outlet", M > 0 && M < 10 ? 2.5 : 1.6);
    stage_set(c->film, "tolerance", 1e-9);
    check_true("runs", line_run(c, "h_min h_central h_min_error h_central_error") == FF_OK);
}

/* Error bars must be 1.5 times the error; those of h_central decrease with the square of the cell
   size. */
static void test_steady(const char *name, double M, double L)
{
    enum { LEVELS = 2 };
    double bar[LEVELS];
    char text[96];
    line fine;
    open_steady(&fine, M, L, 2048);
    for (size_t k = 0; k < LEVELS; k++) {
        line c;
        open_steady(&c, M, L, (size_t)256 << k);
        double off = fabs(line_value(&c, "h_central", 0) - line_value(&fine, "h_central", 0));
        bar[k] = line_value(&c, "h_central_error", 0);
        snprintf(text, sizeof text, "%s, %d cells: bar of h_central over its error %.3f", name,
                 256 << k, bar[k] / off);
        check_true(text, bar[k] > 1.3 * off && bar[k] < 1.9 * off);
        off = fabs(line_value(&c, "h_min", 0) - line_value(&fine, "h_min", 0));
        double least = line_value(&c, "h_min_error", 0);
        snprintf(text, sizeof text, "%s: bar of h_min over its error %.3f", name, least / off);
        check_true(text, least > off);
        line_close(&c);
    }
    snprintf(text, sizeof text, "%s: falls %.3f times with twice the cells", name, bar[0] / bar[1]);
    check_true(text, bar[0] / bar[1] > 3.5 && bar[0] / bar[1] < 6);
    line_close(&fine);
}

static const double span = 400e-6; /* s; the film passes the contact in 80e-6 s */

static void open_cycle(line *c, size_t cells, size_t steps)
{
    line_open(c, "ehl/finite-volume");
    line_last(c, 41, span);
    for (size_t i = 0; i < c->count; i++)
        c->load[i] *= 1 + 0.3 * (1 - cos(4 * pi * c->time[i] / span));
    stage_set(c->film, "cells", (double)cells);
    stage_set(c->film, "steps", (double)steps);
    stage_set(c->film, "inlet", 4);
    stage_set(c->film, "outlet", 1.6);
    stage_set(c->film, "tolerance", 1e-7);
    check_true("runs", line_run(c, "time h_min h_central h_min_error h_central_error") == FF_OK);
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* cells, steps: those of the film that is compared with `fine`. */
static void test_cycle(const line *fine, size_t cells, size_t steps, const char *film,
                       const char *error)
{
    static double ratio[LINE_INSTANTS];
    line c;
    char text[96];
    open_cycle(&c, cells, steps);
    size_t n = steps + 1, held = 0;
    double least = HUGE_VAL, most = 0;
    for (size_t k = 0; k < n; k++) {
        double h = line_value(&c, film, k), bar = line_value(&c, error, k);
        double off = fabs(h - line_at(fine, film, line_value(&c, "time", k)));
        held += bar >= off;
        ratio[k] = bar / off;
        least = fmin(least, bar / h);
        most = fmax(most, bar / h);
    }
    qsort(ratio, n, sizeof *ratio, compare);
    snprintf(text, sizeof text, "%s, %zu cells, %zu steps: %zu of %zu bars hold", film, cells,
             steps, held, n);
    check_true(text, 100 * held >= 95 * n);
    snprintf(text, sizeof text, "%s: median of bar over error %.3f", film, ratio[n / 2]);
    check_true(text, ratio[n / 2] < 5);
    snprintf(text, sizeof text, "%s: no bar is below %.3f of the largest", film, least / most);
    check_true(text, steps < 320 || least > 0.1 * most);
    line_close(&c);
}

int main(void)
{
    stage *oil = stage_open("viscosity/roelands"), *rho = stage_open("density/dowson-higginson"),
          *flow = stage_open("rheology/ree-eyring");
    stage_set(oil, "eta0", 0.005);
    stage_set(oil, "alpha", 11e-9);
    stage_set(rho, "rho0", 917.8);
    stage_set(flow, "tau0", 5e6);
    ehl_laws laws = {.viscosity = stage_service(oil, FF_VISCOSITY_ID),
                     .density = stage_service(rho, FF_DENSITY_ID),
                     .rheology = stage_service(flow, FF_RHEOLOGY_3_ID)};
    test_twin(&laws);
    test_accuracy(&laws);
    test_lost(&laws);
    test_turn(&laws);
    stage_close(oil);
    stage_close(rho);
    stage_close(flow);
    test_steady("gears", 0, 0);
    test_steady("M 5, L 8", 5, 8);
    test_steady("M 50, L 3", 50, 3);
    test_steady("isoviscous, M 20", 20, 0);
    line fine;
    open_cycle(&fine, 512, 320);
    test_cycle(&fine, 256, 320, "h_min", "h_min_error");
    test_cycle(&fine, 256, 320, "h_central", "h_central_error");
    test_cycle(&fine, 256, 80, "h_min", "h_min_error");
    test_cycle(&fine, 256, 80, "h_central", "h_central_error");
    line_close(&fine);
    return check_done();
}
