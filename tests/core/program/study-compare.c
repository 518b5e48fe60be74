/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers of a trade-off: differences between answers, the front, its knee. */
#include "../../../core/program/accuracy/compare.h"

#include "../../../core/program/study/kinds/tradeoff/front.h"

#include <check.h>
#include <math.h>

static void test_scalars(void)
{
    double a = 1.02, b = -1, zero = 0;
    accuracy_series answer = {0, 1, NULL, &a, 0, false}, reference = {0, 1, NULL, &b, 0, false};
    accuracy_difference d;
    check_true("of the other sign", accuracy_compare(&answer, &reference, &d));
    check_near("twice", d.largest, 2.02, 1e-15);
    b = 1;
    check_true("compared", accuracy_compare(&answer, &reference, &d));
    check_near("two per cent", d.largest, 0.02, 1e-14);
    reference.value = &zero;
    check_true("0 has no shares", accuracy_compare(&answer, &reference, &d) && d.absolute);
    check_near("the number itself", d.typical, 1.02, 1e-15);
    answer.value = &zero;
    check_true("but 0", accuracy_compare(&answer, &reference, &d) && d.largest == 0);
}

/* On another grid a straight line is the same line; beyond its ends it stays where it is. */
static void test_grids(void)
{
    double at[] = {0, 1}, line[] = {10, 20}, fine[] = {-1, 0, 0.25, 0.5, 1},
           same[] = {10, 10, 12.5, 15, 20};
    accuracy_series answer = {1, 2, at, line, 0, false}, reference = {1, 5, fine, same, 0, false};
    accuracy_difference d;
    check_true("compared", accuracy_compare(&answer, &reference, &d));
    check_near("no difference", d.largest, 0, 1e-15);
    same[3] = 12;
    check_true("compared", accuracy_compare(&answer, &reference, &d));
    check_near("relative to the value there", d.largest, 0.25, 1e-14);
    check_near("at a point that stands for a fifth of the length", d.typical, 0.25, 1e-14);
}

/* The error of a series leaves out the worst twentieth of its length. */
static void test_typical(void)
{
    double at[101], flat[101], off[101];
    for (size_t i = 0; i < 101; i++) {
        at[i] = (double)i;
        flat[i] = 1;
        off[i] = i < 4 ? 2 : 1.01;
    }
    accuracy_series answer = {1, 101, at, off, 0, false}, reference = {1, 101, at, flat, 0, false};
    accuracy_difference d;
    check_true("compared", accuracy_compare(&answer, &reference, &d));
    check_near("the worst", d.largest, 1, 1e-14);
    check_near("typical", d.typical, 0.01, 1e-14);
    off[4] = off[5] = 2;
    check_true("compared", accuracy_compare(&answer, &reference, &d));
    check_near("of more than a twentieth", d.typical, 1, 1e-14);
}

/* Errors in the unit of the values, and shares of the rise over another value than 0. */
static void test_scales(void)
{
    double hot[] = {400, 410}, off[] = {402, 410}, at[] = {0, 1};
    accuracy_series answer = {1, 2, at, off, 360, false}, reference = {1, 2, at, hot, 360, true};
    accuracy_difference d;
    check_true("compared", accuracy_compare(&answer, &reference, &d));
    check_near("in kelvin", d.largest, 2, 1e-14);
    reference.absolute = false;
    check_true("compared", accuracy_compare(&answer, &reference, &d));
    check_near("of the rise", d.largest, 2.0 / 40, 1e-14);
}

/* Relative to a tenth of the largest where the reference is smaller than that. */
static void test_zero_crossing(void)
{
    double at[] = {0, 1, 2}, wave[] = {1, 0, -1}, off[] = {1, 0.01, -1};
    accuracy_series answer = {1, 3, at, off, 0, false}, reference = {1, 3, at, wave, 0, false};
    accuracy_difference d;
    check_true("compared", accuracy_compare(&answer, &reference, &d));
    check_near("a tenth", d.largest, 0.1, 1e-14);
}

/* Two values at one place: each side is held against its own. */
static void test_jump(void)
{
    double at[] = {0, 1, 1, 2}, step[] = {5, 5, 8, 8}, mid[] = {0, 0.5, 1, 1, 1.5, 2},
           fine[] = {5, 5, 5, 8, 8, 8};
    accuracy_series answer = {1, 4, at, step, 0, false}, reference = {1, 6, mid, fine, 0, false};
    accuracy_difference d;
    check_true("compared", accuracy_compare(&answer, &reference, &d));
    check_near("no difference", d.largest, 0, 1e-15);
    check_near("left", accuracy_interpolate(&answer, 1, false), 5, 0);
    check_near("right", accuracy_interpolate(&answer, 1, true), 8, 0);
    check_near("end, right", accuracy_interpolate(&answer, 2, true), 8, 0);
}

static void test_mismatch(void)
{
    double values[] = {1, 2, 3}, bad[] = {1, NAN, 3};
    accuracy_series three = {1, 3, NULL, values, 0, false}, two = {1, 2, NULL, values, 0, false},
                    scalar = {0, 1, NULL, values, 0, false};
    accuracy_series broken = {1, 3, NULL, bad, 0, false};
    accuracy_difference d;
    check_true("by index", accuracy_compare(&three, &three, &d) && d.largest == 0);
    check_true("other lengths", !accuracy_compare(&two, &three, &d));
    check_true("other ranks", !accuracy_compare(&scalar, &three, &d));
    check_true("no number", !accuracy_compare(&broken, &three, &d));
}

static void test_front(void)
{
    /* dear, cheap, beaten by the cheap one, failed, a step that buys 1 %, the bend */
    const double cost[] = {100, 1, 2, NAN, 110, 3}, error[] = {1e-3, 1, 1.5, 1e-9, 0.99e-3, 1e-2};
    size_t front[6];
    check_true("three", study_front(cost, error, 6, front) == 3);
    check_true("in order", front[0] == 1 && front[1] == 5 && front[2] == 0);
    check_true("knee", study_front_knee(cost, error, front, 3) == 1);
    check_true("no knee between two", study_front_knee(cost, error, front, 2) == 2);
    check_near("on the front", study_front_excess(cost, error, 6, 5), 1, 0);
    check_near("beaten", study_front_excess(cost, error, 6, 2), 2, 0);
    const double line[] = {1, 0.1, 0.01}, even[] = {1, 10, 100};
    check_true("all", study_front(even, line, 3, front) == 3);
    check_true("a straight front has no knee", study_front_knee(even, line, front, 3) == 3);
}

int main(void)
{
    test_scalars();
    test_grids();
    test_typical();
    test_scales();
    test_zero_crossing();
    test_jump();
    test_mismatch();
    test_front();
    return check_done();
}
