/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Mixed lubrication of one tooth pair with Rq 0.5 um on both flanks at 1500, 150, 15 and 1.5 rpm:
 * shares of the load and lengths, as means over the path of contact, for several surfaces, with
 * their mean and standard deviation.
 *
 *   meson test -C build --benchmark mixed --verbose
 *   build/tests/bench/bench-mixed [NAME=VALUE ...]
 *
 * Names: cells, steps, surfaces, shortest (um), least and most (rpm), ventilated (0 or 1), hardness
 * (GPa; 0: elastic flanks), cutoff (um of the surface; 0: none, -1: 16 cells).
 */
#include "check.h"
#include "tooth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { SHARES = 7, DEPTH = 6 };

static const char *const shares[SHARES] = {
    "asperity_load_share",  "contact_ratio", "trapped_share",    "lambda_ratio",
    "friction_coefficient", "yield_share",   "plastic_depth_max"};

typedef struct setup {
    double cells, steps, surfaces, shortest, least, most, ventilated, hardness, cutoff;
} setup;

/* `left_out`: root mean square height of the waves that are taken off, over all, %. */
static void run_name(const setup *u, double share, const char *surface, double left_out)
{
    char cut[48] = "", at[24] = "16 cells";
    if (u->cutoff > 0)
        snprintf(at, sizeof at, "%g um", u->cutoff);
    if (left_out > 0)
        snprintf(cut, sizeof cut, ", cut at %s: %.1f %% off", at, left_out);
    printf("%6g | %3g um%s | %5g | %6g | %3s ", 1500 * share, u->shortest, cut, u->cells, u->steps,
           surface);
}

static double mean(const stage *s, const char *output)
{
    size_t n;
    const double *y = stage_get(s, output, &n);
    double sum = 0;
    for (size_t k = 0; k < n; k++)
        sum += y[k];
    return sum / (double)n;
}

static stage *surface_open(const setup *u, int seed)
{
    stage *surface = stage_open("surface/synthetic");
    char text[48];
    stage_set_text(surface, "rq", "0.5 um");
    snprintf(text, sizeof text, "[%d, %d]", 2 * seed - 1, 2 * seed);
    stage_set_text(surface, "seed", text);
    snprintf(text, sizeof text, "%g um", u->shortest);
    stage_set_text(surface, "shortest", text);
    return surface;
}

static void tell(const setup *u, const stage *s, double share, int seed, const double *y,
                 double seconds)
{
    char surface[16];
    snprintf(surface, sizeof surface, "%d", seed);
    run_name(u, share, surface, 100 * stage_scalar(s, "rq_left_out") / (sqrt(2) * 0.5e-6));
    printf("| %.4f | %.4f | %.4f | %.3f | %.4f | %.4f | %.2f | %.2f | %.2f | %g | %.2f | %.1f\n",
           y[0], y[1], y[2], y[3], y[4], y[5], y[DEPTH], 1e9 * stage_scalar(s, "h_min_lowest"),
           1e-9 * stage_scalar(s, "p_max_highest"), stage_scalar(s, "steps_cut"),
           stage_quality(s, "asperity_resolution"), seconds);
    fflush(stdout);
}

/* Means over the path in `y`. */
static void run(const setup *u, const oil *o, double share, int seed, double *y)
{
    static path c;
    path_fill(&c, share);
    stage *surface = surface_open(u, seed);
    stage *s = film_open("ehl/finite-volume", &c, o, (size_t)u->cells, (size_t)u->steps);
    stage_set_text(s, "valleys", u->ventilated > 0 ? "ventilated" : "sealed");
    stage_set(s, "asperity_hardness", 1e9 * u->hardness);
    if (!(u->cutoff < 0))
        stage_set(s, "roughness_cutoff", 1e-6 * u->cutoff);
    stage_link(s, "surface", surface);
    clock_t begin = clock();
    ff_status status = stage_run_wanted(s, "asperity_load_share contact_ratio trapped_share "
                                           "lambda_ratio friction_coefficient yield_share "
                                           "plastic_depth_max load_error "
                                           "h_min_lowest p_max_highest steps_cut rq_left_out");
    double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC, off = 0;
    if (check_true(status == FF_OK ? "runs to the end" : stage_why(s), status == FF_OK)) {
        size_t n;
        const double *error = stage_get(s, "load_error", &n);
        for (size_t k = 0; k < SHARES; k++)
            y[k] = mean(s, shares[k]) * (k == DEPTH ? 1e9 : 1);
        for (size_t k = 0; k < n; k++)
            off = fmax(off, error[k]);
        check_below("load balance", off, 1e-8);
        tell(u, s, share, seed, y, seconds);
    }
    stage_close(s);
    stage_close(surface);
}

static void all_surfaces(const setup *u, const oil *o, double share)
{
    double sum[SHARES] = {0}, square[SHARES] = {0}, n = u->surfaces;
    for (int seed = 1; seed <= (int)n; seed++) {
        double y[SHARES] = {0};
        run(u, o, share, seed, y);
        for (int k = 0; k < SHARES; k++) {
            sum[k] += y[k];
            square[k] += y[k] * y[k];
        }
    }
    if (!(n > 1))
        return;
    run_name(u, share, "all", 0);
    for (int k = 0; k < SHARES; k++) {
        double average = sum[k] / n, spread = square[k] / n - average * average;
        printf("| %.4f +- %.4f ", average, sqrt(fmax(0, spread * n / (n - 1))));
    }
    printf("\n");
    fflush(stdout);
}

static int read_setup(setup *u, int count, char **word)
{
    const char *const names[] = {"cells", "steps",      "surfaces", "shortest", "least",
                                 "most",  "ventilated", "hardness", "cutoff"};
    double *const values[] = {&u->cells, &u->steps,      &u->surfaces, &u->shortest, &u->least,
                              &u->most,  &u->ventilated, &u->hardness, &u->cutoff};
    for (int i = 1; i < count; i++) {
        size_t length = strcspn(word[i], "="), k = 0;
        while (k < sizeof names / sizeof names[0] &&
               (strlen(names[k]) != length || strncmp(names[k], word[i], length) != 0))
            k++;
        if (k == sizeof names / sizeof names[0] || word[i][length] != '=') {
            fprintf(stderr, "%s is none of this benchmark's settings\n", word[i]);
            return 0;
        }
        *values[k] = strtod(word[i] + length + 1, NULL);
    }
    return 1;
}

int main(int argc, char **argv)
{
    setup u = {
        .cells = 512, .steps = 1000, .surfaces = 1, .shortest = 40, .most = 1500, .hardness = 7};
    if (!read_setup(&u, argc, argv))
        return 2;
    oil o;
    oil_open(&o);
    printf("   rpm | waves  | cells | steps  | surface | asperity share | contact ratio | "
           "trapped share | lambda | friction | yield share | plastic nm | least film nm | p_max "
           "GPa | steps cut | "
           "cells per inlet | CPU s\n");
    for (double share = 1; share > 0.0005; share /= 10)
        if (1500 * share > 0.999 * u.least && 1500 * share < 1.001 * u.most)
            all_surfaces(&u, &o, share);
    oil_close(&o);
    return check_done();
}
