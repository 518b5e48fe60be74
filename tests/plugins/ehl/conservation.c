/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks that plates at rest, plates that carry their oil along, and a rigid parabola at rest have
   no residual in the mass balances, over unequal time steps with restarts. If plates approach, the
   oil that leaves must be the oil that the gap loses. Also checks the balances after only the
   states of nodes have changed. */
#include "check.h"
#include "stage.h"

#include "../../../plugins/ehl/equations/march.h"

#include <math.h>
#include <stdio.h>

enum { CELLS = 64, STEPS = 24, RESTART = 7 };

/* A film without pressure in a given gap, and its masses at the last two times. */
typedef struct scene {
    ehl_grid grid;
    ehl_oil oil;
    ehl_reynolds reynolds;
    ehl_solver solver;
    ehl_march march;
    ehl_film film;
    double zeros[2 * (CELLS + 1)], past[CELLS + 1], mass[2][CELLS + 1];
    unsigned char full[CELLS + 1];
} scene;

static void make(scene *s, const ehl_laws *laws, int wedge)
{
    const double length = 1e-3;
    *s = (scene){.grid = {.nodes = CELLS + 1,
                          .dx = length / CELLS,
                          .first = -length / 2,
                          .inlet = length / 2,
                          .outlet = length / 2,
                          .half_width = length / 4}};
    ehl_fluid_oil(laws, &s->oil);
    check_true("room", ehl_reynolds_create(&s->reynolds, &s->grid, laws, &s->oil, wedge) == FF_OK);
    s->solver = (ehl_solver){.grid = &s->grid, .reynolds = &s->reynolds};
    s->film = (ehl_film){.p = s->zeros, .v = s->zeros + CELLS + 1, .full = s->full};
    for (size_t i = 0; i <= CELLS; i++)
        s->full[i] = 1;
    s->march = (ehl_march){.solver = &s->solver, .scheme = EHL_BDF2};
    for (int k = 0; k < 2; k++)
        s->march.state[k].mass = s->mass[k];
}

/* Stores the mass of the film that was evaluated last. */
static void keep(scene *s, double time)
{
    s->march.state[1].time = s->march.state[0].time;
    s->march.state[0].time = time;
    for (size_t i = 0; i <= CELLS; i++) {
        s->mass[1][i] = s->mass[0][i];
        s->mass[0][i] = s->reynolds.mass[i];
    }
}

/* Runs through time with steps that differ by up to a factor of three, and some restarts. Finds the
   largest residual of a node, without the oil that a closing gap squeezes out, and the largest sum
   of all residuals and of the flow through both ends, over the mass in a cell per step. */
static void pass(scene *s, double radius, double speed, double closing, double *node, double *all)
{
    const ehl_reynolds *r = &s->reynolds;
    const double dx = s->grid.dx, lost = dx * r->oil.density * closing;
    ehl_step step = {.entrainment = speed, .radius = radius, .past = s->past};
    double time = 0;
    *node = *all = 0;
    s->film.h00 = 1e-6;
    ehl_reynolds_evaluate(&s->reynolds, &step, &s->film);
    keep(s, time);
    for (int k = 0; k < STEPS; k++) {
        double c[3], sum = 0;
        time += 1e-6 * (1 + 2 * fabs(sin(3. * k)));
        s->march.smooth = k % RESTART == 0 ? 1 : 2;
        ehl_march_factors(&s->march, time, c);
        for (size_t i = 0; i <= CELLS; i++)
            s->past[i] = c[1] * s->mass[0][i] + c[2] * s->mass[1][i];
        step.rate = c[0];
        s->film.h00 = 1e-6 - closing * time;
        ehl_reynolds_evaluate(&s->reynolds, &step, &s->film);
        double scale = r->mass[CELLS / 2] * dx * step.rate;
        for (size_t i = 1; i < CELLS; i++) {
            sum += r->residual[i] + dx * (step.rate * r->mass[i] + s->past[i]);
            *node = fmax(*node, fabs(r->residual[i] - lost) / scale);
        }
        *all = fmax(*all, fabs(sum - (r->flux[CELLS - 1] - r->flux[0])) / scale);
        keep(s, time);
    }
}

/* After a change of only the states of nodes, ehl_reynolds_turned must find the same residuals as
   ehl_reynolds_evaluate, which evaluates all laws again. */
static void test_turned(const ehl_laws *laws)
{
    static scene s;
    double content[CELLS + 1], residual[CELLS + 1], before = 0, off = 0;
    make(&s, laws, 1);
    ehl_reynolds *r = &s.reynolds;
    ehl_step step = {.entrainment = 3, .radius = 0.01, .rate = 1e6, .past = s.past};
    r->conserving = 1;
    s.film.content = content;
    s.film.h00 = 1e-6;
    for (size_t i = 0; i <= CELLS; i++) {
        content[i] = 870 * 1e-6 * (0.5 + 0.3 * sin((double)i));
        s.zeros[i] = i > CELLS / 2 ? 0 : 1e8 * sin(3. * (double)i / CELLS);
        s.full[i] = i < CELLS / 2;
    }
    ehl_reynolds_evaluate(r, &step, &s.film);
    for (size_t i = 0; i <= CELLS; i++)
        residual[i] = r->residual[i];
    for (size_t i = CELLS / 2 - 3; i < CELLS; i += 5)
        s.full[i] = !s.full[i];
    ehl_reynolds_turned(r, &step, &s.film);
    for (size_t i = 1; i < CELLS; i++) {
        before = fmax(before, fabs(r->residual[i] - residual[i]));
        residual[i] = r->residual[i];
    }
    ehl_reynolds_evaluate(r, &step, &s.film);
    for (size_t i = 1; i < CELLS; i++)
        off = fmax(off, fabs(r->residual[i] - residual[i]));
    check_true("nodes that turn change the balance", before > 0);
    check_below("and as all laws asked anew say", off / before, 1e-12);
    ehl_reynolds_destroy(r);
}

int main(void)
{
    static const struct {
        const char *what;
        double radius, speed, closing;
    } at[] = {{"plates at rest", 1e15, 0, 0},
              {"plates that take their oil along", 1e15, 3, 0},
              {"a rigid parabola at rest", 0.01, 0, 0},
              {"plates that close", 1e15, 3, 5e-3}};
    static scene s;
    stage *oil = stage_open("viscosity/isoviscous"), *rho = stage_open("density/dowson-higginson");
    stage_set(oil, "eta0", 0.01);
    stage_set(rho, "rho0", 870);
    const ehl_laws laws = {.viscosity = stage_service(oil, FF_VISCOSITY_ID),
                           .density = stage_service(rho, FF_DENSITY_ID)};
    for (int wedge = 1; wedge <= 2; wedge++)
        for (size_t k = 0; k < sizeof at / sizeof at[0]; k++) {
            char what[96];
            double node, all;
            make(&s, &laws, wedge);
            pass(&s, at[k].radius, at[k].speed, at[k].closing, &node, &all);
            snprintf(what, sizeof what, "%s, wedge of order %d: each node", at[k].what, wedge);
            check_below(what, node, 1e-12);
            check_below("and all of them with both ends", all, 1e-12);
            ehl_reynolds_destroy(&s.reynolds);
        }
    test_turned(&laws);
    stage_close(oil);
    stage_close(rho);
    return check_done();
}
