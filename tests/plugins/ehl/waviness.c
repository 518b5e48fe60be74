/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Waviness on one flank in pure rolling, M = 100 and L = 11: compares the ratio of deformed to
   initial amplitude in the middle of the contact with the numerical table and the fit of Venner,
   Couhier, Lubrecht & Greenwood 1997. `table CELLS` and `refinement` print it all. */
#include "check.h"
#include "flank.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

enum { LENGTHS = 6, AMPLITUDES = 3 };

static const double lengths[LENGTHS] = {4, 2, 1, 0.5, 0.25, 0.125}; /* in Hertz half-widths */
static const double amplitudes[AMPLITUDES] = {0.1, 0.2, 0.5};       /* over the smooth central
                                                                       film */
static const double venner[LENGTHS][AMPLITUDES] = {
    {0.030, 0.030, 0.029}, {0.073, 0.073, 0.073}, {0.183, 0.182, 0.195},
    {0.394, 0.393, 0.378}, {0.660, 0.670, 0.679}, {0.839, 0.838, 0.859},
};

static double fit(double length)
{
    double n = length * pow(100, 0.75) / sqrt(11);
    return 1 / (1 + 0.17 * n + 0.03 * n * n);
}

static double half_width(const line *c)
{
    return sqrt(8 * c->load[0] * c->radius[0] / (pi * c->modulus));
}

static void open_contact(line *c, size_t cells)
{
    line_open(c, "ehl/finite-volume");
    line_moes(c, 100, 11);
    stage_set(c->film, "cells", (double)cells);
    stage_set(c->film, "inlet", 2.5);
    stage_set(c->film, "outlet", 1.5);
}

static double smooth_film(size_t cells)
{
    line c;
    open_contact(&c, cells);
    check_true("the smooth film is found", line_run(&c, "h_central") == FF_OK);
    double h = line_value(&c, "h_central", 0);
    line_close(&c);
    return h;
}

/* Returns the amplitude ratio A_d/A_i from the highest and lowest film at x = 0 while a wave
   passes, in steps of a cell, or in 32 steps per wave if these are shorter. */
static double left_over(double length, double amplitude, size_t cells)
{
    static flank f;
    line c;
    open_contact(&c, cells);
    double wave = length * half_width(&c), dx = 4 * half_width(&c) / (double)cells;
    double steps = fmax(32, ceil(wave / dx)), most = 0, least = HUGE_VAL;
    flank_sine(&f, amplitude, wave);
    flank_give(&f, c.film);
    line_last(&c, 2, wave / c.u1[0]);
    stage_set(c.film, "steps", steps);
    ff_status status = line_run(&c, "h_central");
    if (check_true(status == FF_OK ? "a wave passes" : stage_why(c.film), status == FF_OK))
        for (size_t k = 0; k <= (size_t)steps; k++) {
            most = fmax(most, line_value(&c, "h_central", k));
            least = fmin(least, line_value(&c, "h_central", k));
        }
    line_close(&c);
    return (most - least) / (2 * amplitude);
}

static void print_table(size_t cells)
{
    double film = smooth_film(cells);
    printf(
        "| wavelength/a | A_i/H_c | A_d/A_i | Venner et al., computed | difference | their fit | "
        "difference |\n|---|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < LENGTHS; i++)
        for (size_t k = 0; k < AMPLITUDES; k++) {
            double share = left_over(lengths[i], amplitudes[k] * film, cells);
            printf("| %g | %g | %.4f | %.3f | %+.1f %% | %.4f | %+.1f %% |\n", lengths[i],
                   amplitudes[k], share, venner[i][k], 100 * (share / venner[i][k] - 1),
                   fit(lengths[i]), 100 * (share / fit(lengths[i]) - 1));
            fflush(stdout);
        }
}

static void print_refinement(void)
{
    printf("| wavelength/a | 256 cells | 512 cells | 1024 cells | 2048 cells | Venner et al. |\n"
           "|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < LENGTHS; i++) {
        double share[4] = {0};
        for (size_t k = 0, cells = 256; k < (lengths[i] < 0.5 ? 4 : 3); k++, cells *= 2)
            share[k] = left_over(lengths[i], 0.1 * smooth_film(cells), cells);
        printf("| %g | %.4f | %.4f | %.4f ", lengths[i], share[0], share[1], share[2]);
        if (share[3] > 0)
            printf("| %.4f ", share[3]);
        else
            printf("| ");
        printf("| %.3f |\n", venner[i][0]);
        fflush(stdout);
    }
}

int main(int argc, char **argv)
{
    enum { CELLS = 512 };
    if (argc > 2 && strcmp(argv[1], "table") == 0) {
        print_table((size_t)strtoul(argv[2], NULL, 10));
        return 0;
    }
    if (argc > 1 && strcmp(argv[1], "refinement") == 0) {
        print_refinement();
        return 0;
    }
    double film = smooth_film(CELLS);
    for (size_t i = 2; i < 5; i++) { /* for the other waves, the grid is too coarse or too short */
        char name[96];
        snprintf(name, sizeof name, "share of the amplitude left, waves of %g a", lengths[i]);
        check_near(name, left_over(lengths[i], 0.1 * film, CELLS), venner[i][0], 0.05);
    }
    return check_done();
}
