/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Anderson acceleration of a linear relaxation: it must end after one step more than there are
   unknowns. */
#include "../../../plugins/ehl/solvers/anderson.h"

#include "check.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST = 20 };

/* g = b - A y, a relaxation that diverges by itself where A has eigenvalues beyond 2. */
static void residual(size_t n, double a[MOST][MOST], const double *b, const double *y, double *g)
{
    for (size_t i = 0; i < n; i++) {
        g[i] = b[i];
        for (size_t k = 0; k < n; k++)
            g[i] -= a[i][k] * y[k];
    }
}

static double size_of(const double *g, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += g[i] * g[i];
    return sqrt(sum);
}

/* Without rounding errors, Anderson acceleration reaches the residual of GMRES (Walker & Ni 2011,
   theorem 2.2), which vanishes after n steps. Changes that are linearly dependent on others to
   within 1e-6 are left out. */
static void test_linear(size_t n)
{
    static double a[MOST][MOST], b[MOST], y[MOST], g[MOST], change[MOST];
    ehl_anderson m;
    check_true("made", ehl_anderson_create(&m, n));
    for (int round = 0; round < 2; round++) { /* the second solution must not depend on the first */
        for (size_t i = 0; i < n; i++) {
            for (size_t k = 0; k < n; k++)
                a[i][k] = 0.5 * ((double)rand() / RAND_MAX - 0.5) + 3 * (i == k);
            b[i] = (double)rand() / RAND_MAX;
            y[i] = 0;
        }
        ehl_anderson_begin(&m);
        residual(n, a, b, y, g);
        double first = size_of(g, n);
        for (size_t step = 0; step <= n; step++) {
            ehl_anderson_step(&m, y, g, change);
            for (size_t i = 0; i < n; i++)
                y[i] += change[i];
            residual(n, a, b, y, g);
        }
        printf("%zu unknowns\n", n);
        check_below("residual after n + 1 steps", size_of(g, n) / first, 1e-6);
    }
    ehl_anderson_destroy(&m);
}

int main(void)
{
    srand(5);
    test_linear(1);
    test_linear(2);
    test_linear(7);
    test_linear(MOST);
    return check_done();
}
