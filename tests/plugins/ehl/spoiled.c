/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The residuals of a film's balances must be small, and each error in a film must increase the
   residual meant to detect it. */
#include "check.h"
#include "stage.h"

#include "../../../plugins/ehl/equations/deflection.h"
#include "../../../plugins/ehl/errors/balance.h"
#include "../../../plugins/ehl/stage/stage.h"
#include "../../../plugins/ehl/time/start.h"
#include "../../../plugins/ehl/time/time-stepper.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CELLS = 256, ROWS = 3, STEPS = 24 };

static const double time_of[ROWS] = {0, 40e-6, 80e-6}, radius[ROWS] = {0.0128, 0.0128, 0.0128},
                    speed_1[ROWS] = {4.4, 4.4, 4.4}, speed_2[ROWS] = {3.6, 3.6, 3.6},
                    load[ROWS] = {1e5, 2e5, 1e5};

/* A film in the middle of a history. */
typedef struct scene {
    ehl_history history;
    ehl_grid grid;
    ehl_oil oil;
    ehl_reynolds reynolds;
    double *kernel;
    ehl_solver solver;
    ehl_march march;
    ehl_balance balance;
} scene;

static void make(scene *s, const ehl_laws *laws)
{
    *s = (scene){.history = {.count = ROWS,
                             .time = time_of,
                             .radius = radius,
                             .speed_1 = speed_1,
                             .speed_2 = speed_2,
                             .load = load,
                             .modulus = 226.4e9,
                             .load_max = 2e5}};
    ehl_fluid_oil(laws, &s->oil);
    ehl_grid_fit(&s->grid, CELLS, 6, 2, &s->history, &s->oil, 0, 0);
    ehl_reynolds_create(&s->reynolds, &s->grid, laws, &s->oil, 2);
    s->kernel = malloc((CELLS + 1) * sizeof *s->kernel);
    ehl_kernel_fill(CELLS + 1, s->grid.dx, s->history.modulus, s->grid.half_width, s->kernel);
    s->solver = (ehl_solver){.grid = &s->grid,
                             .reynolds = &s->reynolds,
                             .kernel = s->kernel,
                             .tolerance = 1e-8,
                             .maker = ehl_newton_krylov};
    check_true("a solver",
               ehl_newton_krylov(&s->solver) == FF_OK &&
                   ehl_march_create(&s->march, &s->history, &s->solver, EHL_BDF2) == FF_OK);
    ff_status status = ehl_march_start(&s->march);
    for (int k = 1; k <= STEPS && status == FF_OK; k++)
        status = ehl_march_to(&s->march, time_of[1] * k / STEPS + 1e-6);
    check_true("a film", status == FF_OK);
}

static void destroy(scene *s)
{
    ehl_balance_destroy(&s->balance);
    ehl_march_destroy(&s->march);
    s->solver.destroy(&s->solver);
    ehl_reynolds_destroy(&s->reynolds);
    free(s->kernel);
}

/* Computes the residuals of the film, with the gap of its state. */
static const ehl_imbalance *hold(scene *s)
{
    ehl_balance_destroy(&s->balance);
    ehl_balance_create(&s->balance, &s->march);
    ehl_reynolds_gap(&s->reynolds, s->march.step.radius, &s->march.state[0].film);
    ehl_balance_hold(&s->balance, &s->march, 1);
    return &s->balance.worst;
}

static double largest(const ehl_imbalance *w)
{
    return fmax(fmax(fmax(w->conditions, w->load), fmax(w->gap, w->mass)),
                fmax(fmax(w->cavitated, w->energy), w->moment));
}

/* Multiplies a number by a factor, checks the residual, and restores the number. */
static void spoil(scene *s, const char *what, double *value, double factor, const double *figure)
{
    double kept = *value;
    *value *= factor;
    hold(s);
    check_true(what, *figure > 1e-4);
    *value = kept;
}

static void test_spoiled(scene *s)
{
    const ehl_imbalance *w = hold(s);
    check_below("a sound film", largest(w), 1e-7);
    ehl_march *m = &s->march;
    size_t centre = (size_t)(s->grid.inlet / s->grid.dx);
    spoil(s, "another radius", &m->step.radius, 1.001, &w->conditions);
    spoil(s, "another load", &m->step.load, 1.001, &w->conditions);
    spoil(s, "another entrainment", &m->step.entrainment, 1.001, &w->conditions);
    spoil(s, "speeds swapped", &m->step.sliding, -1, &w->conditions);
    spoil(s, "an asymmetric deflection", &m->state[0].film.v[centre - 30], 0.99, &w->moment);
    spoil(s, "a deflection that is not that of p", &m->state[0].film.v[centre], 0.99, &w->mass);
    spoil(s, "a pressure that is off", &m->state[0].film.p[centre], 1.01, &w->load);
    spoil(s, "a step of another length", &m->state[0].time, 1.001, &w->mass);
    spoil(s, "another film before", &m->state[1].gap[centre], 1.01, &w->mass);
    spoil(s, "masses that are not those of the film", &m->state[0].mass[centre], 1.01, &w->mass);
    spoil(s, "an oil that is 1 % faster", &m->step.entrainment, 1.01, &w->energy);
    for (size_t i = 0; i <= CELLS; i++)
        m->state[0].film.v[i] *= 1.01;
    hold(s);
    check_true("flanks that are 1 % too soft", w->gap > 0.01);
    for (size_t i = 0; i <= CELLS; i++)
        m->state[0].film.v[i] /= 1.01;
    unsigned char *full = &m->state[0].film.full[centre - 40];
    double p = m->state[0].film.p[centre - 40];
    *full = 0;
    m->state[0].film.p[centre - 40] = 0;
    hold(s);
    check_true("a dry cell in the film", w->cavitated > 1e-4);
    *full = 1;
    m->state[0].film.p[centre - 40] = p;
    check_below("and sound again", largest(hold(s)), 1e-7);
}

/* One number of the film is NaN. */
static void test_no_number(scene *s)
{
    static double row[EHL_SERIES];
    ehl_film *film = &s->march.state[0].film;
    const ehl_imbalance *w = hold(s);
    size_t centre = (size_t)(s->grid.inlet / s->grid.dx);
    double *place[] = {&film->p[centre], &film->p[centre - 40], &film->v[centre - 30]};
    for (int k = 0; k < 3; k++) {
        double kept = *place[k];
        *place[k] = NAN;
        hold(s);
        check_true("the moment", w->moment > 1);
        check_true("the mass", w->mass > 1);
        check_true("the energy", w->energy > 1);
        ehl_balance_outputs(&s->balance, &s->march, row, FF_BIT(EHL_POWER_LOSS), 0.1);
        check_true("the dissipation", w->dissipation > 1);
        *place[k] = kept;
    }
    check_below("and sound again", largest(hold(s)), 1e-7);
}

/* A film that loses its pressure: residuals of the energy from the film before must not remain. */
static void test_no_pressure(scene *s)
{
    ehl_march *m = &s->march;
    double kept[CELLS + 1], *p = m->state[0].film.p;
    hold(s);
    check_true("the energy of cells", s->balance.unbalanced > 0);
    memcpy(kept, p, sizeof kept);
    memset(p, 0, sizeof kept);
    ehl_balance_hold(&s->balance, m, 1);
    check_near("nothing without pressure", s->balance.unbalanced, 0, 0);
    memcpy(p, kept, sizeof kept);
}

/* Returns the residual of the mass balance over all steps, with a fraction of the oil lost in
   each. */
static double lost(scene *s, double share)
{
    ehl_march *m = &s->march;
    hold(s);
    for (int k = 1; k <= STEPS; k++) {
        ehl_march_to(m, time_of[1] + (time_of[2] - time_of[1]) * k / STEPS);
        for (size_t i = 0; i <= CELLS; i++)
            m->state[0].mass[i] *= 1 - share;
        ehl_reynolds_gap(&s->reynolds, m->step.radius, &m->state[0].film);
        ehl_balance_hold(&s->balance, m, 0);
    }
    return s->balance.worst.history;
}

/* A row of outputs, one of them wrong. */
static void test_outputs(scene *s)
{
    static double row[EHL_SERIES];
    const ehl_reynolds *eq = &s->reynolds;
    const double *p = s->march.state[0].film.p;
    const ehl_imbalance *w = hold(s);
    ehl_balance_outputs(&s->balance, &s->march, row, 0, 0.1);
    check_true("nothing given for a film", w->outputs > 0.9);
    hold(s);
    for (size_t i = 0; i <= CELLS; i++)
        row[EHL_P_MAX] = fmax(row[EHL_P_MAX], p[i]);
    row[EHL_H_MIN] = HUGE_VAL;
    for (size_t i = 0; i <= CELLS; i++)
        row[EHL_H_MIN] = fmin(row[EHL_H_MIN], eq->h[i]);
    size_t centre = (size_t)(s->grid.inlet / s->grid.dx);
    row[EHL_H_CENTRAL] = eq->h[centre];
    ehl_balance_outputs(&s->balance, &s->march, row, 0, 0.1);
    check_below("about the film's", w->outputs, 0.05);
    row[EHL_P_MAX] *= 1.2;
    ehl_balance_outputs(&s->balance, &s->march, row, 0, 0.1);
    check_true("a pressure that no node has", w->outputs > 0.1);
}

int main(void)
{
    static scene s;
    stage *oil = stage_open("viscosity/roelands"), *rho = stage_open("density/dowson-higginson"),
          *flow = stage_open("rheology/ree-eyring");
    stage_set(oil, "eta0", 0.005);
    stage_set(oil, "alpha", 11e-9);
    stage_set(rho, "rho0", 917.8);
    stage_set(flow, "tau0", 5e6);
    ehl_laws laws = {.viscosity = stage_service(oil, FF_VISCOSITY_ID),
                     .density = stage_service(rho, FF_DENSITY_ID),
                     .rheology = stage_service(flow, FF_RHEOLOGY_3_ID)};
    make(&s, &laws);
    test_spoiled(&s);
    test_no_number(&s);
    test_no_pressure(&s);
    test_outputs(&s);
    double kept = lost(&s, 0);
    destroy(&s);
    make(&s, &laws);
    double gone = lost(&s, 2e-3);
    check_below("oil that comes and goes", kept, 0.01);
    check_true("a five-hundredth lost at each step", gone > 5 * kept && gone > 0.01);
    printf("off the oil that comes and goes: %.2g, with loss %.2g\n", kept, gone);
    destroy(&s);
    stage_close(oil);
    stage_close(rho);
    stage_close(flow);
    return check_done();
}
