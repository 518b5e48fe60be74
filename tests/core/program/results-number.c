/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as text that reads back, and in readable units. */
#include "../../../core/program/results/label.h"
#include "../../../core/program/study/kinds/answer/number.h"

#include <check.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void test_exact(void)
{
    static const double values[] = {0,       1,       -1,     0.1, 1.0 / 3, 1e23, 1.7e-7,
                                    DBL_MAX, DBL_MIN, 5e-324, 1e9, -2.1e9,  0.3,  0.1 + 0.2};
    char text[STUDY_NUMBER_SIZE];
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        study_number_exact(values[i], text);
        check_true(text, strtod(text, NULL) == values[i]);
    }
    study_number_exact(0.3, text);
    check_true("no more digits than it takes", strcmp(text, "0.3") == 0);
    study_number_exact((double)NAN, text);
    check_true("none", strcmp(text, "nan") == 0);
}

/* As many clauses as have room, at least one; brackets of a formula stay. */
static void test_label(void)
{
    static const struct {
        const char *doc, *label;
        size_t room;
    } rows[] = {
        {"highest pressure", "highest pressure", 0},
        {"load, never negative; needs a gear", "load, never negative", 20},
        {"load, never negative; needs a gear", "load", 19},
        {"film (parabola, through nodes)", "film", 80},
        {"u_r = (u1 + u2)/2", "u_r = (u1 + u2)/2", 0},
        {"a, b, c", "a, b", 5},
        {"phases in [0, 1) where k jumps", "phases in [0, 1) where k jumps", 0},
        {"amplitude at 1, 2, 3 ... times f, by FFT", "amplitude at 1, 2, 3 ... times f", 0},
        {"", "", 9},
    };
    char label[RESULTS_LABEL_SIZE];
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        results_label(rows[i].doc, rows[i].room, label);
        check_true(rows[i].doc, strcmp(label, rows[i].label) == 0);
    }
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
        {"N", 25448, 25.448, "kN"},
        {"N/m", 681100, 681.1, "N/mm"},
        {"N/m", 657.92e6, 657.92, "N/um"},
        {"W/m", 33850, 33.85, "W/mm"},
        {"1/Pa", 18.4e-9, 18.4, "1/GPa"},
        {"1", 0.5, 0.5, ""},
        {"K", 300, 300, "K"},
        {"kg m2", 3, 3, "kg m2"},
        {"m", 0, 0, "um"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        study_readable r = study_readable_unit(cases[i].si, cases[i].magnitude);
        check_true(cases[i].si, strcmp(r.unit, cases[i].unit) == 0 &&
                                    fabs(r.factor * cases[i].magnitude - cases[i].number) < 1e-9);
    }
}

int main(void)
{
    test_exact();
    test_label();
    test_readable();
    return check_done();
}
