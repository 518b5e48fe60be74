/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Smooth pieces instead of the straight lines of a table: they must reproduce the sampled curve,
   and leave kinks, jumps, and short or rough tables unchanged. */
#include "check.h"

#include "../../../plugins/dynamics/excitation/excitation.h"

#include <math.h>
#include <stdio.h>

enum { LINES = 200 };

typedef struct table {
    size_t count;
    double phase[LINES + 4], k[LINES + 4], e[LINES + 4];
} table;

static void sample(table *t, double (*k)(double), double (*e)(double))
{
    t->count = LINES + 1;
    for (size_t i = 0; i <= LINES; i++) {
        t->phase[i] = (double)i / LINES;
        t->k[i] = k(t->phase[i]);
        t->e[i] = e ? e(t->phase[i]) : 0;
    }
}

static dynamics_excitation build(const table *t)
{
    dynamics_excitation x = {.length = 1, .stiffness = 1};
    dynamics_mesh_curves curves = {t->count, t->phase, t->k, t->e};
    check_true("builds", dynamics_excitation_build(&x, &curves));
    return x;
}

static double wave(double phase)
{
    return 1 + 0.2 * cos(2 * M_PI * phase) + 0.05 * sin(6 * M_PI * phase);
}

static double wave_slope(double phase)
{
    return 2 * M_PI * (0.15 * cos(6 * M_PI * phase) - 0.2 * sin(2 * M_PI * phase));
}

static double error(double phase)
{
    return 0.3 * sin(2 * M_PI * phase);
}

static double roof(double phase)
{
    return phase < 0.375 ? 1 + sin(phase) : 1 + sin(0.375) - 0.5 * (phase - 0.375);
}

/* Finds the largest difference of the pieces, and of their slopes, from the curve between its
   nodes. */
static void distances(const dynamics_excitation *x, double (*k)(double), double (*slope)(double),
                      double distance[2])
{
    distance[0] = distance[1] = 0;
    for (int i = 0; i < 1777; i++) {
        double phase = (i + 0.5) / 1777;
        const dynamics_piece *p = dynamics_excitation_piece(x, phase, 0);
        double since = phase - p->start;
        distance[0] =
            fmax(distance[0], fabs(dynamics_piece_value(p->k, p->degree, since) - k(phase)));
        distance[1] =
            fmax(distance[1], fabs(dynamics_piece_slope(p->k, p->degree, since) - slope(phase)));
    }
}

/* Straight lines have the error k'' h^2/8, 7e-5 here, the smooth pieces a thousandth of it. */
static void test_curve(void)
{
    static table t;
    double distance[2];
    sample(&t, wave, error);
    dynamics_excitation x = build(&t);
    distances(&x, wave, wave_slope, distance);
    printf("%zu pieces\n", x.count);
    check_true("few", x.count <= 12 && x.represented.lines == LINES);
    check_below("the curve between its nodes", distance[0], 2e-7);
    check_below("its slope", distance[1], 5e-5);
    check_below("what is said of the nodes", x.represented.at_nodes, 1e-7);
    double sag = (0.2 * 4 + 0.05 * 36) * M_PI * M_PI / (8.0 * LINES * LINES);
    check_true("what is said of the lines",
               x.represented.between > 0.3 * sag && x.represented.between < 1.1 * sag);
    const dynamics_piece *p = dynamics_excitation_piece(&x, 0.4, 0);
    check_near("e, too", dynamics_piece_value(p->e, p->degree, 0.4 - p->start), error(0.4), 1e-6);
    for (size_t i = 0; i < x.count; i++)
        check_true("no jump", !x.pieces[i].jump);
    dynamics_excitation_free(&x);
}

static void test_corner(void)
{
    static table t;
    sample(&t, roof, NULL);
    dynamics_excitation x = build(&t);
    const dynamics_piece *a = dynamics_excitation_piece(&x, 0.375, 1),
                         *z = dynamics_excitation_piece(&x, 0.375, 0);
    check_near("ends in the corner", a->start + a->length, 0.375, 1e-12);
    check_near("slope before", dynamics_piece_slope(a->k, a->degree, a->length), cos(0.375), 1e-6);
    check_near("slope behind", z->k[1], -0.5, 1e-9);
    dynamics_excitation_free(&x);
}

/* Two nodes at 0.25, where k decreases by 0.3. */
static void test_jump(void)
{
    static table t, u;
    sample(&t, wave, NULL);
    u = t;
    u.count = t.count + 1;
    for (size_t i = 51; i < u.count; i++) {
        u.phase[i] = t.phase[i - 1];
        u.k[i] = t.k[i - 1] - 0.3;
    }
    dynamics_excitation x = build(&u);
    const dynamics_piece *z = dynamics_excitation_piece(&x, 0.25, 0);
    check_near("starts behind the jump", z->start, 0.25, 0);
    check_true("is marked", z->jump);
    check_near("value behind", z->k[0], wave(0.25) - 0.3, 1e-12);
    dynamics_excitation_free(&x);
}

/* A table with an error of 1e-5 at every node, and a table of 10 lines. */
static void test_lines_that_stay(void)
{
    static table t;
    sample(&t, wave, NULL);
    for (size_t i = 1; i < LINES; i++)
        t.k[i] += i % 2 ? 1e-5 : -1e-5;
    dynamics_excitation x = build(&t);
    check_true("rough", x.count == LINES && x.pieces[77].degree == 1);
    dynamics_excitation_free(&x);
    for (size_t i = 0; i <= 10; i++)
        t.phase[i] = (double)i / 10, t.k[i] = wave(t.phase[i]);
    t.count = 11;
    x = build(&t);
    check_true("short", x.count == 10 && x.pieces[7].degree == 1);
    check_near("straight", dynamics_piece_value(x.pieces[7].k, 1, 0.05),
               0.5 * (wave(0.7) + wave(0.8)), 1e-14);
    dynamics_excitation_free(&x);
}

int main(void)
{
    test_curve();
    test_corner();
    test_jump();
    test_lines_that_stay();
    return check_done();
}
