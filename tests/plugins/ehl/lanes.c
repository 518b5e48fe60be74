/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums and extremes of arrays that fill several vector registers, one in part, or none; the minimum
   of a film with NaN must be NaN. */
#include "check.h"

#include "../../../plugins/ehl/contact/simd-reductions.h"

#include <math.h>

enum { MOST = 3 * EHL_LANES };

/* Fills x with multiples of 0.5, whose sums have no rounding error in any order. */
static void fill(size_t n, size_t extreme, double *x)
{
    for (size_t i = 0; i < n; i++)
        x[i] = i == extreme ? -8 : 0.5 * (double)i - 1;
}

static void test_numbers(size_t n)
{
    double x[MOST], sum = 0, square = 0, most = -2;
    for (size_t extreme = 0; extreme < n; extreme++) {
        fill(n, extreme, x);
        sum = square = 0;
        most = -2;
        for (size_t i = 0; i < n; i++) {
            sum += x[i];
            square += x[i] * x[i];
            most = fmax(most, x[i]);
        }
        check_near("sum", ehl_sum(n, x), sum, 0);
        check_near("sum of squares", ehl_dot(n, x, x), square, 0);
        check_near("least", ehl_least(n, x), -8, 0);
        check_near("greatest", ehl_greatest(n, x, -2), most, 0);
        check_near("greatest size", ehl_greatest_size(n, x), 8, 0);
    }
}

static void test_no_numbers(size_t n)
{
    double x[MOST];
    for (size_t i = 0; i < n; i++)
        x[i] = NAN;
    check_true("no least", isnan(ehl_least(n, x)));
}

int main(void)
{
    for (size_t n = 1; n <= MOST; n++) {
        test_numbers(n);
        test_no_numbers(n);
    }
    return check_done();
}
