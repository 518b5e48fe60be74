/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solutions with the banded matrices satisfy the linear system of the balances, with the effect of
   the pressures and of the deflection, and the load, if the kernel of the deflection is constant
   outside the band. */
#include "../../../plugins/ehl/equations/reynolds.h"
#include "../../../plugins/ehl/solvers/band.h"
#include "../../../plugins/ehl/solvers/line.h"
#include "check.h"

#include <math.h>
#include <stdlib.h>

enum { NODES = 48 };

static double share(void)
{
    return (double)rand() / RAND_MAX;
}

typedef struct scene {
    size_t before, last; /* before: number of nodes from the first node of a row's stencil to the
                            row; see reynolds.h */
    double kernel[NODES], by_p[EHL_STENCIL][NODES], by_h[EHL_STENCIL][NODES], residual[NODES];
    unsigned char full[NODES];
    ehl_reynolds r;
    ehl_film film;
} scene;

static void make(scene *s, size_t reach, size_t before, size_t last, int dry)
{
    s->before = before;
    s->last = last;
    for (size_t k = 0; k < NODES; k++)
        s->kernel[k] = 3 - log(0.5 + (double)(k <= reach ? k : reach + 1));
    s->r = (ehl_reynolds){.nodes = NODES, .last = last};
    s->film = (ehl_film){.full = s->full};
    for (size_t i = 0; i < NODES; i++) {
        s->full[i] = i > 0 && i < last && !(dry && i > 20 && i < 26);
        s->residual[i] = s->full[i] ? share() - 0.5 : 0;
        for (size_t k = 0; k < EHL_STENCIL; k++) {
            int diagonal = k == before, there = s->full[i] && i + k >= before;
            s->by_p[k][i] = there * (diagonal ? -4 - share() : share());
            s->by_h[k][i] = there * 0.1 * (share() - 0.7);
        }
    }
    for (size_t k = 0; k < EHL_STENCIL; k++) {
        s->r.by_p[k] = s->by_p[k];
        s->r.by_h[k] = s->by_h[k];
    }
}

/* Returns the largest residual of a balance after the changes dp, its deflection, and dh00. */
static double left(const scene *s, const double *dp, double dh00)
{
    double worst = 0, v[NODES];
    for (size_t i = 0; i < NODES; i++) {
        v[i] = dh00;
        for (size_t k = 0; k < NODES; k++)
            v[i] += s->kernel[i > k ? i - k : k - i] * dp[k];
    }
    for (size_t i = 1; i < s->last; i++) {
        double sum = s->residual[i];
        for (size_t k = i < s->before ? s->before - i : 0; k < EHL_STENCIL && s->full[i]; k++) {
            size_t at = i + k - s->before;
            sum -= s->by_p[k][i] * dp[at] + s->by_h[k][i] * v[at];
        }
        worst = fmax(worst, s->full[i] ? fabs(sum) : fabs(dp[i]));
    }
    return worst;
}

static void check_solution(const scene *s, int loaded, const double *dp, double dh00)
{
    double sum = 0;
    for (size_t i = 0; i < NODES; i++)
        sum += dp[i];
    check_below("balances", left(s, dp, dh00), 1e-12);
    if (loaded)
        check_near("load", sum, 0.7, 1e-12);
    else
        check_below("h00 stays", fabs(dh00), 0);
}

static void test_line(int loaded, int dry)
{
    enum { REACH = 8 };
    static scene s;
    double dp[NODES], dh00;
    make(&s, REACH, EHL_ASYMMETRIC_BEFORE, 44, dry);
    ehl_line_matrix *m = ehl_line_create(NODES, s.kernel);
    check_true("made", m != NULL);
    ehl_line_factor(m, &s.r, &s.film, loaded);
    ehl_line_solve(m, s.residual, loaded ? 0.7 : 0, dp, &dh00);
    check_solution(&s, loaded, dp, dh00);
    ehl_line_destroy(m);
}

/* Checks a matrix that is set up at once, and a matrix whose rows from 19 on are set up again. */
static void test_band(size_t last, int loaded, int dry)
{
    enum { FROM = 19 };
    static scene s, other;
    double dp[NODES] = {0}, dh00;
    make(&s, EHL_BAND_REACH - 1, 2, last, dry);
    ehl_band *b = ehl_band_create(NODES, s.kernel);
    check_true("made", b != NULL);
    ehl_band_factor(b, &s.r, &s.film, loaded, 1);
    ehl_band_solve(b, s.residual, loaded ? 0.7 : 0, dp, &dh00);
    check_solution(&s, loaded, dp, dh00);
    make(&other, EHL_BAND_REACH - 1, 2, last, 0);
    for (size_t i = FROM; i < NODES; i++)
        for (size_t k = 0; k < EHL_STENCIL; k++) {
            s.by_p[k][i] = other.by_p[k][i] * s.full[i];
            s.by_h[k][i] = other.by_h[k][i] * s.full[i];
        }
    ehl_band_factor(b, &s.r, &s.film, loaded, FROM);
    ehl_band_solve(b, s.residual, loaded ? 0.7 : 0, dp, &dh00);
    check_solution(&s, loaded, dp, dh00);
    ehl_band_destroy(b);
}

int main(void)
{
    srand(11);
    for (int loaded = 0; loaded < 2; loaded++)
        for (int dry = 0; dry < 2; dry++) {
            test_line(loaded, dry);
            for (size_t last = 41; last < 46; last++) /* numbers of rows that fill whole vector
                                                         registers, and numbers that do not */
                test_band(last, loaded, dry);
        }
    return check_done();
}
