/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "check.h"

#include <math.h>
#include <stdio.h>

static int checks, failures;

static int count_check(int holds)
{
    checks++;
    failures += !holds;
    return holds;
}

int check_near(const char *what, double value, double expected, double relative)
{
    double scale = fabs(expected) > 0 ? fabs(expected) : 1;
    double error = fabs(value - expected) / scale;
    int holds = error <= relative;
    printf("%s %s: %.10g, expected %.10g, off by %.2e of %.1e\n", holds ? "ok  " : "FAIL", what,
           value, expected, error, relative);
    return count_check(holds);
}

int check_below(const char *what, double value, double limit)
{
    int holds = value <= limit;
    printf("%s %s: %.4g <= %.4g\n", holds ? "ok  " : "FAIL", what, value, limit);
    return count_check(holds);
}

int check_true(const char *what, int condition)
{
    printf("%s %s\n", condition ? "ok  " : "FAIL", what);
    return count_check(condition != 0);
}

int check_done(void)
{
    printf("%d checks, %d failed\n", checks, failures);
    return checks == 0 || failures > 0;
}
