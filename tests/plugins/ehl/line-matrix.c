/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The matrix of a line of nodes solves what it stands for, for a kernel that is even behind its
   reach: the balances by the pressures and by all that they deflect, and the load. */
#include "../../../plugins/ehl/band.h"

#include "../../../plugins/ehl/reynolds.h"
#include "check.h"

#include <math.h>
#include <stdlib.h>

enum { NODES = 48, LAST = 44, REACH = 8 };

static double share(void)
{
    return (double)rand() / RAND_MAX;
}

typedef struct scene {
    double kernel[NODES], by_p[EHL_STENCIL][NODES], by_h[EHL_STENCIL][NODES], residual[NODES];
    unsigned char full[NODES];
    ehl_reynolds r;
    ehl_film film;
} scene;

static void make(scene *s, int dry)
{
    for (size_t k = 0; k < NODES; k++)
        s->kernel[k] = k <= REACH ? 3 - log(0.5 + (double)k) : 3 - log(0.5 + REACH + 1);
    s->r = (ehl_reynolds){.nodes = NODES, .last = LAST};
    s->film = (ehl_film){.full = s->full};
    for (size_t i = 0; i < NODES; i++) {
        s->full[i] = i > 0 && i < LAST && !(dry && i > 20 && i < 26);
        s->residual[i] = s->full[i] ? share() - 0.5 : 0;
        for (size_t k = 0; k < EHL_STENCIL; k++) {
            int diagonal = k == EHL_ASYMMETRIC_BEFORE;
            s->by_p[k][i] = s->full[i] * (diagonal ? -4 - share() : share());
            s->by_h[k][i] = s->full[i] * 0.1 * (share() - 0.7);
        }
    }
    for (size_t k = 0; k < EHL_STENCIL; k++) {
        s->r.by_p[k] = s->by_p[k];
        s->r.by_h[k] = s->by_h[k];
    }
}

/* Largest balance that dp, what it deflects, and dh00 leave. */
static double left(const scene *s, const double *dp, double dh00)
{
    double worst = 0, v[NODES];
    for (size_t i = 0; i < NODES; i++) {
        v[i] = dh00;
        for (size_t k = 0; k < NODES; k++)
            v[i] += s->kernel[i > k ? i - k : k - i] * dp[k];
    }
    for (size_t i = 1; i < LAST; i++) {
        double sum = s->residual[i];
        for (size_t k = 0; k < EHL_STENCIL && s->full[i]; k++) {
            size_t at = i + k - EHL_ASYMMETRIC_BEFORE;
            sum -= s->by_p[k][i] * dp[at] + s->by_h[k][i] * v[at];
        }
        worst = fmax(worst, s->full[i] ? fabs(sum) : fabs(dp[i]));
    }
    return worst;
}

static void test_solution(int loaded, int dry)
{
    static scene s;
    double dp[NODES], dh00, sum = 0;
    make(&s, dry);
    ehl_line_matrix *m = ehl_line_create(NODES, s.kernel);
    check_true("made", m != NULL);
    ehl_line_factor(m, &s.r, &s.film, loaded);
    ehl_line_solve(m, s.residual, loaded ? 0.7 : 0, dp, &dh00);
    for (size_t i = 0; i < NODES; i++)
        sum += dp[i];
    check_below("balances", left(&s, dp, dh00), 1e-12);
    if (loaded)
        check_near("load", sum, 0.7, 1e-12);
    else
        check_below("h00 stays", fabs(dh00), 0);
    ehl_line_destroy(m);
}

int main(void)
{
    srand(11);
    for (int loaded = 0; loaded < 2; loaded++)
        for (int dry = 0; dry < 2; dry++)
            test_solution(loaded, dry);
    return check_done();
}
