/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks the residual that remains after a solution of the coarse system, with sums over the blocks
   computed here. */
#include "check.h"

#include "../../../plugins/ehl/equations/deflection.h"
#include "../../../plugins/ehl/solvers/coarse.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NODES = 257, LAST = 213, STRIDE = 16, BLOCKS = (LAST - 1) / STRIDE };

static double random_part(void)
{
    return (double)rand() / RAND_MAX - 0.5;
}

typedef struct scene {
    ehl_reynolds r;
    ehl_film film;
    double kernel[NODES], by_p[EHL_STENCIL][NODES], by_h[EHL_STENCIL][NODES], residual[NODES];
    double dp[NODES], dh[NODES], dh00;
    unsigned char full[NODES];
} scene;

/* Sets up transport and diffusion that vary from node to node; nodes downstream of LAST and some
   upstream are dry. */
static void make(scene *s)
{
    memset(s, 0, sizeof *s);
    s->r = (ehl_reynolds){.nodes = NODES, .last = LAST, .dx = 1e-5};
    s->film.full = s->full;
    ehl_kernel_fill(NODES, 1e-5, 2.2e11, 1e-3, s->kernel);
    for (size_t k = 0; k < EHL_STENCIL; k++) {
        s->r.by_p[k] = s->by_p[k];
        s->r.by_h[k] = s->by_h[k];
    }
    double stiff = s->kernel[0] - s->kernel[NODES - 1];
    for (size_t i = 1; i < LAST; i++) {
        double upwind[EHL_STENCIL] = {-0.5, 2, -1.5, 0}, flow[EHL_STENCIL] = {0, 1, -2, 1};
        s->full[i] = i < 100 || i > 102;
        for (size_t k = i > 1 ? 0 : 1; k < EHL_STENCIL; k++) {
            s->by_h[k][i] = s->full[i] * (upwind[k] + 0.05 * random_part());
            s->by_p[k][i] = s->full[i] * stiff * (0.1 + 3.0 / (double)i) * flow[k];
        }
        s->residual[i] = s->full[i] * random_part();
    }
}

static size_t block_of(size_t i)
{
    size_t corner = (i + STRIDE / 2) / STRIDE;
    return (corner < 1 ? 1 : corner > BLOCKS ? BLOCKS : corner) - 1;
}

/* Returns the largest sum over a block of the residual minus the balances of dp and dh, over the
   largest sum of the residual. */
static double left(const scene *s)
{
    double sum[BLOCKS] = {0}, whole[BLOCKS] = {0}, worst = 0, most = 0;
    for (size_t i = 1; i < LAST; i++) {
        sum[block_of(i)] += s->residual[i];
        whole[block_of(i)] += s->residual[i];
        for (size_t k = i > 1 ? 0 : 1; k < EHL_STENCIL; k++)
            sum[block_of(i)] -= s->by_p[k][i] * s->dp[i + k - 2] + s->by_h[k][i] * s->dh[i + k - 2];
    }
    for (size_t b = 0; b < BLOCKS; b++) {
        worst = fmax(worst, fabs(sum[b]));
        most = fmax(most, fabs(whole[b]));
    }
    return worst / most;
}

/* Returns the largest difference of dh from the deflection of dp and dh00, over the largest change;
   dh is linear between the corners. */
static double bend_error(const scene *s)
{
    static double v[NODES], p[NODES];
    double worst = 0, most = 0;
    memcpy(p, s->dp, LAST * sizeof *p);
    for (size_t i = 100; i <= 102; i++) /* the linear dh ignores dry nodes */
        p[i] = p[99] + (p[103] - p[99]) * (double)(i - 99) / 4;
    for (size_t i = LAST; i < (BLOCKS + 1) * STRIDE; i++) /* and the end of the film */
        p[i] = p[BLOCKS * STRIDE] * (double)((BLOCKS + 1) * STRIDE - i) / STRIDE;
    ehl_kernel_direct(NODES, s->kernel, p, v);
    for (size_t i = 0; i < LAST; i += STRIDE) {
        worst = fmax(worst, fabs(v[i] + s->dh00 - s->dh[i]));
        most = fmax(most, fabs(s->dh[i]));
    }
    return worst / most;
}

static void test_balances(int loaded)
{
    static scene s;
    make(&s);
    ehl_coarse *c = ehl_coarse_create(NODES, STRIDE, s.kernel);
    ehl_coarse_factor(c, &s.r, &s.film, loaded);
    double missing = loaded ? 3e15 : 0, sum = 0;
    check_true("has a solution",
               ehl_coarse_solve(c, LAST, s.residual, missing, &s.film, s.dp, s.dh, &s.dh00));
    for (size_t i = 1; i < LAST; i++)
        sum += s.dp[i];
    check_below("nothing is left on the blocks", left(&s), 1e-9);
    check_below("deflection at the corners", bend_error(&s), 1e-9);
    if (loaded)
        check_near("load", sum, missing, 1e-9);
    else
        check_near("h00 stays without a load", s.dh00, 0, 0);
    check_near("dry nodes keep no pressure", s.dp[101], 0, 0);
    ehl_coarse_destroy(c);
}

/* Checks a block in which all nodes are dry. */
static void test_singular(void)
{
    static scene s;
    make(&s);
    for (size_t i = 80; i < 130; i++)
        for (size_t k = 0; k < EHL_STENCIL; k++)
            s.by_p[k][i] = s.by_h[k][i] = s.full[i] = 0;
    ehl_coarse *c = ehl_coarse_create(NODES, STRIDE, s.kernel);
    ehl_coarse_factor(c, &s.r, &s.film, 1);
    check_true("a singular system has none",
               !ehl_coarse_solve(c, LAST, s.residual, 0, &s.film, s.dp, s.dh, &s.dh00));
    ehl_coarse_destroy(c);
}

int main(void)
{
    srand(5);
    test_balances(1);
    test_balances(0);
    test_singular();
    return check_done();
}
