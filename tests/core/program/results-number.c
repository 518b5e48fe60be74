/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fast writing of numbers against printf. */
#include "../../../core/program/results/number.h"

#include <check.h>
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int same(double value, int digits)
{
    char ours[RESULTS_NUMBER_SIZE], theirs[64];
    size_t length = results_number_print(value, digits, ours);
    snprintf(theirs, sizeof theirs, "%.*g", digits, value);
    int equal = strcmp(ours, theirs) == 0 && length == strlen(ours);
    if (!equal)
        printf("%s, printf %s\n", ours, theirs);
    return equal;
}

static void test_edges(void)
{
    static const double values[] = {1,
                                    -1,
                                    10,
                                    9.9999999999e9,
                                    9.99999999949e-5,
                                    1e-4,
                                    1e-5,
                                    0.5,
                                    123456789,
                                    1e9,
                                    1e10,
                                    1e11,
                                    1e22,
                                    1e23,
                                    1e-22,
                                    DBL_MAX,
                                    DBL_MIN,
                                    5e-324,
                                    -DBL_MAX,
                                    0.1,
                                    1.0 / 3,
                                    2.0 / 3,
                                    1e100,
                                    1e-100,
                                    4294967296.0,
                                    999999999999.0,
                                    0.00099999999996,
                                    1.7e-7,
                                    2.1e9};
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++)
        for (int digits = 1; digits <= RESULTS_NUMBER_DIGITS; digits++)
            check_true("as printf does", same(values[i], digits));
    char text[RESULTS_NUMBER_SIZE];
    check_true("zero", results_number_print(0, 10, text) == 1 && strcmp(text, "0") == 0);
    check_true("no negative zero", results_number_print(-0.0, 10, text) == 1);
}

/* splitmix64 */
static uint64_t next(uint64_t *state)
{
    uint64_t z = *state += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/* Reading back loses at most half of the last digit, and the rounding of scale and reader. */
static void test_error(void)
{
    uint64_t state = 1;
    double worst = 0;
    for (int i = 0; i < 200000; i++) {
        double unit = (double)(next(&state) >> 11) * 0x1p-53;
        double value = ldexp(0.5 + unit / 2, (int)(next(&state) % 160) - 80);
        char text[RESULTS_NUMBER_SIZE];
        results_number_print(value, 12, text);
        double last = pow(10, floor(log10(value)) - 11); /* one in the last digit */
        worst = fmax(worst, fabs(strtod(text, NULL) - value) / last);
    }
    check_below("units of the last digit", worst, 0.5 + 1e-3);
}

static void test_readable(void)
{
    static const struct {
        const char *si;
        double magnitude, number;
        const char *unit;
    } cases[] = {
        {"m", 3e-7, 0.3, "um"},
        {"m", 0.02, 20, "mm"},
        {"m", 2, 2, "m"},
        {"Pa", 1.2e9, 1.2, "GPa"},
        {"Pa", 5e6, 5, "MPa"},
        {"rad", 3.14159265358979, 180, "deg"},
        {"rad/s", 3.14159265358979, 30, "rpm"},
        {"N", 2500, 2500, "N"},
        {"1", 0.5, 0.5, ""},
        {"K", 300, 300, "K"},
        {"kg m2", 3, 3, "kg m2"},
        {"m", 0, 0, "um"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        results_readable r = results_readable_unit(cases[i].si, cases[i].magnitude);
        check_true(cases[i].si, strcmp(r.unit, cases[i].unit) == 0 &&
                                    fabs(r.factor * cases[i].magnitude - cases[i].number) < 1e-9);
    }
}

int main(void)
{
    test_edges();
    test_error();
    test_readable();
    return check_done();
}
