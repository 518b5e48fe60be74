/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares solutions for the heated channel with closed forms, and the table with the solutions. */
#include "../../../plugins/ehl/estimates/channel.h"

#include "../../../plugins/ehl/estimates/inlet-heat.h"
#include "check.h"

#include <math.h>

/* For small F and S, R = 1 - (3/7) F - S/12, with an error that decreases as the squares of F and
   S. */
static void test_limits(void)
{
    for (double small = 1e-3; small > 1e-5; small /= 10) {
        ehl_channel flow = {.b = 0}, both = {.b = 0};
        double of_flow = ehl_channel_solve(&flow, small, 0);
        double of_both = ehl_channel_solve(&both, small, small);
        check_near("of the pressure flow", of_flow, 1 - 3 * small / 7, 2 * small * small);
        check_near("of both", of_both, 1 - 3 * small / 7 - small / 12, 2 * small * small);
    }
}

/* Nahme's problem (Nahme 1940): with x = sqrt(S/8), the stress over that of the cold film is
   asinh(x)/(x sqrt(1 + x^2)), and in the middle exp(beta dT) = 1 + x^2. The differences are of
   fourth order in the number N of cells across: the error in the middle is (e^theta)^2/(16 N^4),
   theta = beta dT, about 1e-7 at S = 300. */
static void test_nahme(void)
{
    const double S[] = {0.01, 0.1, 1, 10, 100, 300};
    ehl_channel c = {.b = 0};
    for (int k = 0; k < 6; k++) {
        double x = sqrt(S[k] / 8), stress = asinh(x) / (x * sqrt(1 + x * x));
        check_true("solved", isfinite(ehl_channel_solve(&c, 1e-6, S[k])));
        check_near("stress", c.a / sqrt(S[k]), stress, 2e-6 * stress);
        check_near("middle", exp(c.theta[EHL_CHANNEL_CELLS / 2]), 1 + x * x, 1e-5 * (1 + x * x));
    }
}

/* Values published to three digits: solutions for the channel, not the fit of Wilson & Sheu. */
static void test_sliding_alone(void)
{
    check_near("S = 0.1", ehl_heat_ratio(0, 0.1), 0.992, 6e-4);
    check_near("S = 1", ehl_heat_ratio(0, 1), 0.924, 6e-4);
    check_near("S = 3", ehl_heat_ratio(0, 3), 0.809, 6e-4);
    check_near("S = 10", ehl_heat_ratio(0, 10), 0.583, 6e-4);
}

/* Cubic interpolation in the table, with steps of 0.1: the largest error is 1e-4, near F = 500 and
   S = 6000; with steps of 0.2, it would be 1.5e-3 there. */
static void test_table(void)
{
    ehl_channel first = {.b = 0};
    double worst = 0;
    for (double x = 0.05; x < 9; x += 0.6) {
        ehl_channel_solve(&first, expm1(x), 0);
        ehl_channel c = first;
        for (double y = 0.05; y < 9; y += 0.2) {
            double R = ehl_channel_solve(&c, expm1(x), expm1(y));
            worst = fmax(worst, fabs(ehl_heat_ratio(expm1(x), expm1(y)) / R - 1));
        }
    }
    check_below("off the solutions", worst, 2e-4);
    check_near("cold", ehl_heat_ratio(0, 0), 1, 1e-6);
    check_true("a number beyond it", ehl_heat_ratio(1e300, 1e300) > 0);
    check_true("that of its edge", ehl_heat_ratio(1e5, 0) >= ehl_heat_ratio(1e9, 0));
}

int main(void)
{
    test_limits();
    test_nahme();
    test_sliding_alone();
    test_table();
    return check_done();
}
