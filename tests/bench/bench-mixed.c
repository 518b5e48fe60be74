/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Mixed lubrication of one tooth pair with Rq 0.5 um on both flanks at 1500, 150, 15 and 1.5 rpm:
 * shares of the load and lengths, as means over the path of contact, for several surfaces, with
 * their mean and standard deviation.
 *
 *   meson test -C build --benchmark mixed --verbose
 *   build/tests/bench/bench-mixed [CELLS [SURFACES [LEAST_RPM [MOST_RPM]]]]
 */
#include "tooth.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { STEPS = 1000, SHARES = 5 };

static const char *const shares[SHARES] = {"asperity_load_share", "contact_ratio", "trapped_share",
                                           "lambda_ratio", "friction_coefficient"};

static double mean(const stage *s, const char *output)
{
    size_t n;
    const double *y = stage_get(s, output, &n);
    double sum = 0;
    for (size_t k = 0; k < n; k++)
        sum += y[k];
    return sum / (double)n;
}

/* Means over the path in `y`; the CPU seconds. */
static double run(const oil *o, double share, size_t cells, int seed, double *y)
{
    static path c;
    path_fill(&c, share);
    stage *surface = stage_open("surface/synthetic");
    stage_set_text(surface, "rq", "0.5 um");
    char seeds[32];
    snprintf(seeds, sizeof seeds, "[%d, %d]", 2 * seed - 1, 2 * seed);
    stage_set_text(surface, "seed", seeds);
    stage *s = film_open("ehl/finite-volume", &c, o, cells, STEPS);
    stage_link(s, "surface", surface);
    clock_t begin = clock();
    ff_status status = stage_run_wanted(s, "asperity_load_share contact_ratio trapped_share "
                                           "lambda_ratio friction_coefficient load_error "
                                           "h_min_lowest p_max_highest steps_cut");
    double seconds = (double)(clock() - begin) / CLOCKS_PER_SEC, off = 0;
    if (check_true(status == FF_OK ? "runs to the end" : stage_why(s), status == FF_OK)) {
        for (size_t k = 0; k < SHARES; k++)
            y[k] = mean(s, shares[k]);
        for (size_t k = 0; k <= STEPS; k++)
            off = fmax(off, stage_get(s, "load_error", NULL)[k]);
        check_below("load balance", off, 1e-8);
        printf("%6g | %5zu | %4d | %.4f | %.4f | %.4f | %.3f | %.4f | %.2f | %.2f | %g | %.1f\n",
               1500 * share, cells, seed, y[0], y[1], y[2], y[3], y[4],
               1e9 * stage_scalar(s, "h_min_lowest"), 1e-9 * stage_scalar(s, "p_max_highest"),
               stage_scalar(s, "steps_cut"), seconds);
        fflush(stdout);
    }
    stage_close(s);
    stage_close(surface);
    return seconds;
}

static void all_surfaces(const oil *o, double share, size_t cells, int surfaces)
{
    double sum[SHARES] = {0}, square[SHARES] = {0};
    for (int seed = 1; seed <= surfaces; seed++) {
        double y[SHARES] = {0};
        run(o, share, cells, seed, y);
        for (int k = 0; k < SHARES; k++) {
            sum[k] += y[k];
            square[k] += y[k] * y[k];
        }
    }
    double n = surfaces;
    printf("%6g | %5zu | all ", 1500 * share, cells);
    for (int k = 0; k < SHARES; k++) {
        double average = sum[k] / n, spread = square[k] / n - average * average;
        printf("| %.4f +- %.4f ", average, n > 1 ? sqrt(fmax(0, spread * n / (n - 1))) : 0);
    }
    printf("\n");
    fflush(stdout);
}

int main(int argc, char **argv)
{
    size_t cells = argc > 1 ? (size_t)strtoul(argv[1], NULL, 10) : 512;
    int surfaces = argc > 2 ? (int)strtol(argv[2], NULL, 10) : 1;
    double least = argc > 3 ? strtod(argv[3], NULL) : 0,
           most = argc > 4 ? strtod(argv[4], NULL) : 1e9;
    oil o;
    oil_open(&o);
    printf("   rpm | cells | seed | asperity share | contact ratio | trapped share | lambda | "
           "friction | least film nm | p_max GPa | steps cut | CPU s\n");
    for (double share = 1; share > 0.0005; share /= 10)
        if (1500 * share > 0.999 * least && 1500 * share < 1.001 * most)
            all_surfaces(&o, share, cells, surfaces);
    oil_close(&o);
    return check_done();
}
