/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cavitation with conservation of mass, in an isoviscous film in the rigid gap h0 (1 + a cos(4 pi
   x/L) + b x/L), which has two minima. The film ruptures downstream of the first, where h = h*, and
   forms again upstream of the second. Since p = 0 at both ends of each film, int (h - h*)/h^3 dx =
   0, with the same flow u h* everywhere (Jakobsson & Floberg 1957). h*, the point of reformation
   and both pressures follow by quadrature. */
#include "check.h"
#include "stage.h"

#include "../../../plugins/ehl/equations/cavitation.h"
#include "../../../plugins/ehl/equations/deflection.h"
#include "../../../plugins/ehl/equations/solver.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;
static const double h0 = 1e-6, wave = 0.4, tilt = 0.1, length = 4e-3, eta = 0.03, speed = 2,
                    rho = 900;

static double gap(double x)
{
    return h0 * (1 + wave * cos(4 * pi * x / length) + tilt * x / length);
}

/* Returns p at `to`, for p = 0 at `from`: 12 eta u int (h - h*)/h^3 dx by Simpson's rule. */
static double rise(double from, double to, double h_star)
{
    enum { PARTS = 2000 };
    double sum = 0, d = (to - from) / PARTS;
    for (int i = 0; i <= PARTS; i++) {
        double h = gap(from + d * i);
        sum += (i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2) * (h - h_star) / (h * h * h);
    }
    return 12 * eta * speed * sum * d / 3;
}

/* Returns the root x of f(x, y) in (low, high); f is positive at low. */
static double root(double (*f)(double x, double y), double y, double low, double high)
{
    for (int k = 0; k < 60; k++) {
        double x = (low + high) / 2;
        if (f(x, y) > 0)
            low = x;
        else
            high = x;
    }
    return low;
}

static double above(double x, double h_star)
{
    return gap(x) - h_star;
}

static double below(double x, double h_star)
{
    return h_star - gap(x);
}

/* Return the pressure at the end of the first film if it ruptures at x, and of the second film if
   it begins at x. */
static double first_film(double x, double unused)
{
    (void)unused;
    return rise(0, x, gap(x));
}

static double second_film(double x, double h_star)
{
    return rise(x, root(below, h_star, 0.75 * length, 0.95 * length), h_star);
}

typedef struct scene {
    ehl_grid grid;
    ehl_reynolds r;
    ehl_solver solver;
    ehl_film film;
    double *memory;
} scene;

static void open_scene(scene *s, const ehl_laws *laws, size_t cells)
{
    size_t n = cells + 1;
    ehl_oil oil;
    ehl_fluid_oil(laws, &oil);
    *s = (scene){.grid = {.nodes = n,
                          .dx = length / (double)cells,
                          .half_width = length,
                          .pressure = 12 * eta * speed * length / (h0 * h0)}};
    ehl_reynolds_create(&s->r, &s->grid, laws, &oil, 2);
    s->memory = calloc(5 * n, sizeof *s->memory);
    s->film = (ehl_film){.p = s->memory,
                         .v = s->memory + n,
                         .content = s->memory + 2 * n,
                         .full = (unsigned char *)(s->memory + 3 * n),
                         .asperity = (unsigned char *)(s->memory + 3 * n) + n};
    double *kernel = s->memory + 4 * n;
    ehl_kernel_fill(n, s->grid.dx, 1e20, length, kernel);
    s->r.conserving = 1;
    s->r.unit = rho * h0 / s->grid.pressure;
    for (size_t i = 0; i < n; i++) {
        s->r.half_square[i] = gap((double)i * s->grid.dx) - h0;
        s->film.full[i] = i > 0 && i < cells;
    }
    s->film.h00 = h0;
    s->solver =
        (ehl_solver){.grid = &s->grid, .reynolds = &s->r, .kernel = kernel, .tolerance = 1e-9};
    ehl_newton_krylov(&s->solver);
}

static void close_scene(scene *s)
{
    s->solver.destroy(&s->solver);
    ehl_reynolds_destroy(&s->r);
    free(s->memory);
}

static void test_steady(const ehl_laws *laws, size_t cells)
{
    scene s;
    open_scene(&s, laws, cells);
    ehl_step step = {.entrainment = speed, .radius = 1};
    check_true("converges", s.solver.solve(&s.solver, &step, &s.film, 100) == FF_OK);
    double x1 = root(first_film, 0, 0.25 * length, 0.5 * length), h_star = gap(x1);
    double x2 = root(second_film, h_star, 0.5 * length, 0.7 * length);
    double summit_1 = rise(0, root(above, h_star, 0, 0.25 * length), h_star);
    double summit_2 = rise(x2, root(above, h_star, x2, 0.75 * length), h_star);
    double top[2] = {0, 0}, least = 1, most = 0;
    size_t first = 0, again = 0;
    for (size_t i = 1; i < cells; i++) {
        int half = i > cells / 2;
        top[half] = fmax(top[half], s.film.p[i]);
        first = s.film.full[i] && !half ? i : first;
        again = s.film.full[i] && half && again == 0 ? i : again;
        if (s.film.full[i] || s.film.full[i + 1]) /* the last cell of a void fills gradually */
            continue;
        least = fmin(least, s.film.content[i] / (rho * s.r.h[i]));
        most = fmax(most, fabs(s.film.content[i] / (rho * h_star) - 1));
    }
    /* both films end within a cell of the exact points, where p is proportional to the square of
       the distance */
    double error = 4 / (double)cells;
    check_near("first pressure", top[0], summit_1, error);
    check_near("second pressure", top[1], summit_2, error);
    check_below("place of rupture", fabs((double)first * s.grid.dx - x1) / s.grid.dx, 2);
    check_below("place of reformation", fabs((double)again * s.grid.dx - x2) / s.grid.dx, 2);
    check_below("flow through the void", most, error);
    check_true("the void is no more than full", least > 0.5 && least < 1);
    close_scene(&s);
}

/* A node whose pressure was cut off must be cavitated for one time step, in which its oil is
   computed, before it may become full. In a steady film, it may become full at once. */
static void test_wait(const ehl_laws *laws, int steps)
{
    scene s;
    ehl_cavitation w;
    double change[65];
    enum { CUT = 20, OVER = 40 };
    open_scene(&s, laws, 64);
    ehl_reynolds_gap(&s.r, 1, &s.film);
    check_true("memory", ehl_cavitation_create(&w, 65) == FF_OK);
    ehl_cavitation_begin(&w, 65);
    s.film.p[CUT] = -1e5;
    check_near("pressure that is cut off", ehl_cavitation_shrink_film(&w, &s.r, &s.film, change),
               1e5, 0);
    check_near("its cell is full of oil", s.film.content[CUT], rho * s.r.h[CUT], 1e-15);
    s.film.full[OVER] = 0;
    s.film.content[CUT] *= 1.01;
    s.film.content[OVER] = 1.01 * rho * s.r.h[OVER];
    check_true("more than a gap holds fills it", ehl_cavitation_fill(&w, &s.r, &s.film, steps));
    check_true("the node that was cavitated before", s.film.full[OVER]);
    check_true("the node that was cut off", s.film.full[CUT] == !steps);
    ehl_cavitation_fill(&w, &s.r, &s.film, steps);
    check_true("a step later", s.film.full[CUT]);
    ehl_cavitation_destroy(&w);
    close_scene(&s);
}

int main(void)
{
    stage *oil = stage_open("viscosity/isoviscous"),
          *density = stage_open("density/incompressible");
    stage_set(oil, "eta0", eta);
    stage_set(density, "rho0", rho);
    ehl_laws laws = {.viscosity = stage_service(oil, FF_VISCOSITY_ID),
                     .density = stage_service(density, FF_DENSITY_ID)};
    test_steady(&laws, 400);
    test_steady(&laws, 1600);
    test_wait(&laws, 0);
    test_wait(&laws, 1);
    stage_close(oil);
    stage_close(density);
    return check_done();
}
