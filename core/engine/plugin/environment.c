/* SPDX-License-Identifier: MIT */
#include "environment.h"

#include "../value/memory.h"

#include <float.h>
#include <locale.h>
#include <string.h>

/* Finds the arithmetic modes by computing, without reading control registers of the processor. */
static fe_arithmetic arithmetic(void)
{
    volatile double smallest = DBL_MIN, subnormal = DBL_TRUE_MIN;
    volatile long double one = 1;
    volatile double half = smallest / 2, twice = subnormal * 0x1p60;
    volatile long double next = one + LDBL_EPSILON;
    return (fe_arithmetic){
        .rounding = fegetround(),
        .traps = fegetexcept(),
        .flushes = half == 0,
        .ignores = twice == 0,
        .extended = next > 1,
    };
}

void fe_environment_keep(ff_environment *environment)
{
    fegetenv(&environment->floating);
    environment->arithmetic = arithmetic();
    fesetenv(&environment->floating);
    const char *locale = setlocale(LC_ALL, NULL);
    size_t length = locale ? strlen(locale) : sizeof environment->locale;
    environment->locale[0] = 0;
    if (length < sizeof environment->locale)
        memcpy(environment->locale, locale, length + 1);
}

ff_environment *ff_environment_keep(void)
{
    ff_environment *environment = fe_alloc(sizeof *environment);
    fe_environment_keep(environment);
    return environment;
}

const char *ff_environment_restore(const ff_environment *environment)
{
    const fe_arithmetic was = environment->arithmetic, is = arithmetic();
    const char *changed = NULL;
    if (environment->locale[0] && strcmp(environment->locale, setlocale(LC_ALL, NULL)) != 0) {
        setlocale(LC_ALL, environment->locale);
        changed = "changed the locale";
    }
    if (is.extended != was.extended)
        changed = "changed the precision of long double arithmetic";
    if (is.traps != was.traps)
        changed = "switched on floating-point traps";
    if (is.rounding != was.rounding)
        changed = "changed the rounding mode";
    if (is.flushes != was.flushes || is.ignores != was.ignores)
        changed = "switched the processor to flush small numbers to zero "
                  "(-ffast-math in its link arguments does that)";
    fesetenv(&environment->floating);
    return changed;
}
