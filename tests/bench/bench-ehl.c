/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The film of one tooth pair over its path of contact: operating point I of Li & Kahraman 2011,
 * quasi-static load with ramps of 0.2 deg, Doolittle-Tait and Ree-Eyring oil. Prints process CPU
 * seconds, so that other jobs on the machine do not count, and work per time step; for steps that
 * the model chooses also the largest error of h_min(t), against 16000 equal steps.
 *
 *   meson test -C build --benchmark ehl --verbose
 */
#include "host.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

enum { POINTS = 801 };

typedef struct path {
    double time[POINTS], radius[POINTS], u1[POINTS], u2[POINTS], load[POINTS];
} path;

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

static void fill(path *c)
{
    const double base = 70.476947e-3, sum = 51.3030e-3, speed = 1500 * 6 * degree;
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

typedef struct oil {
    stage *viscosity, *density, *rheology;
} oil;

static stage *film(const char *model, const path *c, const oil *o, size_t cells, size_t steps)
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

/* CPU seconds per time step. */
static double run(const char *model, const path *c, const oil *o, size_t cells, size_t steps)
{
    stage *s = film(model, c, o, cells, steps);
    clock_t begin = clock();
    ff_status status = stage_run_wanted(
        s, "h_min h_central p_max h_min_lowest newton_steps convolutions steps_cut");
    double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC, n = (double)steps;
    if (status == FF_OK)
        printf("%-18s %5zu x %4zu: %.3f s, %.3f ms/step, Newton %.2f and convolutions %.2f per "
               "step, %g cut, lowest h_min %.4f um\n",
               model, cells, steps, seconds, 1e3 * seconds / n, stage_scalar(s, "newton_steps") / n,
               stage_scalar(s, "convolutions") / n, stage_scalar(s, "steps_cut"),
               1e6 * stage_scalar(s, "h_min_lowest"));
    else
        printf("%-18s %5zu x %4zu: %s\n", model, cells, steps, stage_why(s));
    check_true("runs to the end", status == FF_OK);
    stage_close(s);
    return seconds / n;
}

/* The estimates, that take too little time for the clock: the best of many runs, with the loading
   of the model left out. */
static void estimate(const char *model, const path *c, const oil *o, double full)
{
    enum { RUNS = 50 };
    double best = HUGE_VAL;
    for (int k = 0; k < RUNS; k++) {
        stage *s = film(model, c, o, 512, 1000);
        struct timespec begin, end;
        ff_status status = stage_ready(s);
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
        status =
            status == FF_OK ? stage_run_wanted(s, "h_min h_central p_max h_min_lowest") : status;
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
        best = fmin(best, (double)(end.tv_sec - begin.tv_sec) +
                              1e-9 * (double)(end.tv_nsec - begin.tv_nsec));
        if (k + 1 == RUNS && check_true("runs to the end", status == FF_OK))
            printf("%-18s        1000: %.3f ms, ehl/finite-volume with 512 cells takes %.0f times "
                   "as long; lowest h_min %.4f um\n",
                   model, 1e3 * best, full / best, 1e6 * stage_scalar(s, "h_min_lowest"));
        stage_close(s);
    }
}

/* Linear between the results of `s`. */
static double h_min_at(const stage *s, double time)
{
    size_t low = 0, high;
    const double *t = stage_get(s, "time", &high), *h = stage_get(s, "h_min", NULL);
    high--;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        if (t[middle] <= time)
            low = middle;
        else
            high = middle;
    }
    return h[low] + (h[high] - h[low]) * (time - t[low]) / (t[high] - t[low]);
}

/* Largest difference of h_min at the times of either run, relative. */
static double largest_error(const stage *s, const stage *exact)
{
    double worst = 0;
    for (int side = 0; side < 2; side++) {
        size_t n;
        const double *t = stage_get(side ? exact : s, "time", &n);
        for (size_t k = 0; k < n; k++)
            worst = fmax(worst, fabs(h_min_at(s, t[k]) / h_min_at(exact, t[k]) - 1));
    }
    return worst;
}

/* Steps chosen by the model, and as many equal ones. */
static void run_own_steps(const path *c, const oil *o, const char *cavitation)
{
    stage *exact = film("ehl/finite-volume", c, o, 512, 16000);
    stage *s = film("ehl/finite-volume", c, o, 512, 1000);
    stage_set_text(exact, "cavitation", cavitation);
    stage_set_text(s, "cavitation", cavitation);
    stage_set_text(s, "steps", "auto");
    check_true("reference", stage_run_wanted(exact, "time h_min") == FF_OK);
    clock_t begin = clock();
    check_true("own steps", stage_run_wanted(s, "time h_min convolutions") == FF_OK);
    double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC, error = largest_error(s, exact);
    size_t n;
    stage_get(s, "time", &n);
    printf("own steps, 512 cells, %s: %zu steps, %.3f s, convolutions %.2f per step, h_min(t) "
           "within %.2f %%\n",
           cavitation, n - 1, seconds, stage_scalar(s, "convolutions") / (double)(n - 1),
           100 * error);
    check_below("h_min(t) within 0.5 %", error, 5e-3);
    stage_close(exact);
    stage_close(s);
}

/* Both flanks with Rq 0.5 um, at a share of the speed. */
static void run_rough(const path *nominal, const oil *o, stage *surface, double speed)
{
    enum { STEPS = 1000 };
    static path c;
    c = *nominal;
    for (size_t i = 0; i < POINTS; i++) {
        c.time[i] /= speed;
        c.u1[i] *= speed;
        c.u2[i] *= speed;
    }
    stage *s = film("ehl/finite-volume", &c, o, 512, STEPS);
    stage_link(s, "surface", surface);
    clock_t begin = clock();
    ff_status status = stage_run_wanted(
        s,
        "h_min load_error asperity_load_share trapped_share newton_steps convolutions steps_cut");
    double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC, share = 0, trapped = 0, load = 0;
    if (!check_true("rough flanks run to the end", status == FF_OK))
        return;
    for (size_t k = 0; k <= STEPS; k++) {
        share += stage_get(s, "asperity_load_share", NULL)[k] / (STEPS + 1);
        trapped += stage_get(s, "trapped_share", NULL)[k] / (STEPS + 1);
        load = fmax(load, stage_get(s, "load_error", NULL)[k]);
    }
    printf(
        "rough, %5g rpm      512 x %d: %.2f ms/step, Newton %.1f and convolutions %.1f per step, "
        "%g cut, asperities carry %.4f, trapped oil %.4f\n",
        1500 * speed, STEPS, 1e3 * seconds / STEPS, stage_scalar(s, "newton_steps") / STEPS,
        stage_scalar(s, "convolutions") / STEPS, stage_scalar(s, "steps_cut"), share, trapped);
    check_below("load balance", load, 1e-8);
    stage_close(s);
}

int main(void)
{
    static path c;
    oil o = {stage_open("viscosity/doolittle-tait"), stage_open("density/dowson-higginson"),
             stage_open("rheology/ree-eyring")};
    fill(&c);
    stage_set(o.viscosity, "eta0", 5.006e-3);
    stage_set(o.viscosity, "B", 3.7303);
    stage_set(o.viscosity, "V_occ", 0.6132);
    stage_set(o.viscosity, "K0", 1.05e9);
    stage_set(o.viscosity, "K0_prime", 10.076);
    stage_set(o.density, "rho0", 917.8);
    stage_set(o.rheology, "tau0", 5e6);
    double fast = run("ehl/finite-volume", &c, &o, 512, 1000);
    run_own_steps(&c, &o, "clip");
    run_own_steps(&c, &o, "mass-conserving");
    estimate("ehl/film-formula", &c, &o, 1000 * fast);
    estimate("ehl/inlet-analysis", &c, &o, 1000 * fast);
    for (size_t cells = 1024; cells <= 4096; cells *= 2) {
        double each = run("ehl/finite-volume", &c, &o, cells, 1000);
        double n = (double)cells / 512, grown = n * (9 + log2(n)) / 9;
        printf("%.1f times as long as 512 cells; N log N is %.1f\n", each / fast, grown);
    }
    stage *surface = stage_open("surface/synthetic");
    stage_set_text(surface, "rq", "0.5 um");
    for (double speed = 1; speed > 0.005; speed /= 10)
        run_rough(&c, &o, surface, speed);
    stage_close(surface);
    /* last, because idle threads of the BLAS still count as CPU time for a while */
    double sweeps = run("ehl/control-volume", &c, &o, 512, 1000);
    printf("ehl/control-volume takes %.1f times as long per step\n", sweeps / fast);
    double dense = run("ehl/dense-newton", &c, &o, 512, 10);
    printf("ehl/dense-newton takes %.0f times as long per step\n", dense / fast);
    stage_close(o.viscosity);
    stage_close(o.density);
    stage_close(o.rheology);
    return check_done();
}
