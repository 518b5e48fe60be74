/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The film of one tooth pair over its path of contact. Prints process CPU
 * seconds, so that other jobs on the machine do not count, and work per time step; for steps that
 * the model chooses also the largest error of h_min(t), against 16000 equal steps.
 *
 *   meson test -C build --benchmark ehl --verbose
 *
 * With a number of cells and one of steps it runs ehl/finite-volume once, for a profiler, and with
 * a speed in rpm behind them the same with rough flanks.
 */
#include "check.h"
#include "tooth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* CPU seconds per time step. */
static double run(const char *model, const path *c, const oil *o, size_t cells, size_t steps)
{
    stage *s = film_open(model, c, o, cells, steps);
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
        stage *s = film_open(model, c, o, 512, 1000);
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
    stage *exact = film_open("ehl/finite-volume", c, o, 512, 16000);
    stage *s = film_open("ehl/finite-volume", c, o, 512, 1000);
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
static void run_rough(const oil *o, size_t cells, size_t steps, double speed)
{
    static path c;
    path_fill(&c, speed);
    stage *surface = stage_open("surface/synthetic");
    stage_set_text(surface, "rq", "0.5 um");
    stage *s = film_open("ehl/finite-volume", &c, o, cells, steps);
    stage_link(s, "surface", surface);
    clock_t begin = clock();
    ff_status status = stage_run_wanted(
        s,
        "h_min load_error asperity_load_share trapped_share newton_steps convolutions steps_cut");
    double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC, share = 0, trapped = 0, load = 0;
    if (!check_true("rough flanks run to the end", status == FF_OK))
        return;
    for (size_t k = 0; k <= steps; k++) {
        share += stage_get(s, "asperity_load_share", NULL)[k] / ((double)steps + 1);
        trapped += stage_get(s, "trapped_share", NULL)[k] / ((double)steps + 1);
        load = fmax(load, stage_get(s, "load_error", NULL)[k]);
    }
    double n = (double)steps;
    printf("rough, %5g rpm %8zu x %zu: %.2f ms/step, Newton %.1f and convolutions %.1f per step, "
           "%g cut, asperities carry %.4f, trapped oil %.4f\n",
           1500 * speed, cells, steps, 1e3 * seconds / n, stage_scalar(s, "newton_steps") / n,
           stage_scalar(s, "convolutions") / n, stage_scalar(s, "steps_cut"), share, trapped);
    check_below("load balance", load, 1e-8);
    stage_close(s);
    stage_close(surface);
}

int main(int argc, char **argv)
{
    static path c;
    oil o;
    path_fill(&c, 1);
    oil_open(&o);
    if (argc > 2) {
        size_t cells = strtoul(argv[1], NULL, 10), steps = strtoul(argv[2], NULL, 10);
        if (argc > 3)
            run_rough(&o, cells, steps, strtod(argv[3], NULL) / 1500);
        else
            run("ehl/finite-volume", &c, &o, cells, steps);
        oil_close(&o);
        return check_done();
    }
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
    for (double speed = 1; speed > 0.005; speed /= 10)
        run_rough(&o, 512, 1000, speed);
    /* last, because idle threads of the BLAS still count as CPU time for a while */
    double sweeps = run("ehl/control-volume", &c, &o, 512, 1000);
    printf("ehl/control-volume takes %.1f times as long per step\n", sweeps / fast);
    double dense = run("ehl/dense-newton", &c, &o, 512, 10);
    printf("ehl/dense-newton takes %.0f times as long per step\n", dense / fast);
    oil_close(&o);
    return check_done();
}
