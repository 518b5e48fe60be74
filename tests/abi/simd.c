/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * ff_exp and ff_log of simd.h against those of libm in long double, at points of every size, and
 * against themselves as built for other processors and for one point at a time.
 */
#include "check.h"

#include <flankfilm/simd.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef void points(size_t n, const double *restrict x, double *restrict y);
points plain_exp, plain_log, haswell_exp, haswell_log, wide_exp, wide_log;

enum { COUNT = 400000 };

static uint64_t state = 88172645463325252u;

/* xorshift */
static uint64_t random_bits(void)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return state;
}

/* From 0 up to 1. */
static double random_share(void)
{
    return (double)(random_bits() >> 11) * 0x1p-53;
}

/* Distance of y from the exact value, in units of its last place. */
static double distance(double y, long double exact)
{
    const long double beyond = 0x1p1024L;
    if (isnan(y) || isnan(exact))
        return isnan(y) && isnan(exact) ? 0 : HUGE_VAL;
    if (exact == 0 || isinf(exact))
        return (long double)y == exact ? 0 : HUGE_VAL;
    int exponent;
    frexpl(exact, &exponent);
    exponent = exponent < DBL_MIN_EXP ? DBL_MIN_EXP : exponent;
    exponent = exponent > DBL_MAX_EXP ? DBL_MAX_EXP : exponent;
    long double shown = isinf(y) ? copysignl(beyond, (long double)y) : (long double)y;
    exact = fabsl(exact) > beyond ? copysignl(beyond, exact) : exact;
    return (double)ldexpl(fabsl(shown - exact), DBL_MANT_DIG - exponent);
}

static double worst_distance(size_t n, const double *x, const double *y,
                             long double exact(long double))
{
    double worst = 0, where = 0;
    for (size_t i = 0; i < n; i++) {
        double here = distance(y[i], exact((long double)x[i]));
        where = here > worst ? x[i] : where;
        worst = here > worst ? here : worst;
    }
    printf("     %.3f ulp at %a\n", worst, where);
    return worst;
}

/* The eight numbers around x. */
static size_t put_around(double x, double *to)
{
    double low = x;
    for (int k = 0; k < 4; k++)
        low = nextafter(low, -HUGE_VAL);
    for (size_t k = 0; k < 8; k++) {
        to[k] = low;
        low = nextafter(low, HUGE_VAL);
    }
    return 8;
}

/* Limits of the result and of the reduction, small and special numbers; then numbers over all that
   matters, and of any bits. */
static void fill_for_exp(double *x)
{
    const double corners[] = {0,
                              DBL_MIN,
                              0x1p-54,
                              1,
                              709.782712893384,
                              710,
                              1024.5,
                              DBL_MAX,
                              -0x1p-54,
                              -DBL_MIN,
                              -708.39641853226,
                              -744.4400719213812,
                              -745.13321910194122,
                              -746,
                              -1e4,
                              -DBL_MAX};
    size_t n = 0;
    for (size_t k = 0; k < sizeof corners / sizeof corners[0]; k++)
        n += put_around(corners[k], x + n);
    for (int k = -2151; k <= 2047; k += 2)
        n += put_around(k * 0.34657359027997264, x + n);
    x[n++] = HUGE_VAL;
    x[n++] = -HUGE_VAL;
    x[n++] = NAN;
    for (; n < COUNT / 2; n++)
        x[n] = -746 + 1456.5 * random_share();
    for (; n < 3 * COUNT / 4; n++)
        x[n] = 2 * random_share() - 1;
    for (; n < COUNT; n++)
        x[n] = ff_simd_from_bits(random_bits());
}

static void fill_for_log(double *x)
{
    const double corners[] = {
        0, DBL_MIN, DBL_TRUE_MIN, 0.5, 0.70710678118654757, 1, 1.4142135623730951, 2, DBL_MAX, -1};
    size_t n = 0;
    for (size_t k = 0; k < sizeof corners / sizeof corners[0]; k++)
        n += put_around(corners[k], x + n);
    for (int k = -1074; k < 1024; k++) {
        n += put_around(ldexp(1, k), x + n);
        n += put_around(ldexp(0.70710678118654757, k), x + n);
    }
    x[n++] = HUGE_VAL;
    x[n++] = -HUGE_VAL;
    x[n++] = -0.0;
    x[n++] = NAN;
    for (; n < COUNT / 2; n++)
        x[n] = 0.5 + 2 * random_share();
    for (; n < 3 * COUNT / 4; n++)
        x[n] = 1 + ldexp(random_share() - 0.5, -(int)(random_bits() % 52));
    for (; n < COUNT; n++)
        x[n] = ff_simd_from_bits(random_bits() >> 1);
}

static int same_bits(size_t n, const double *a, const double *b)
{
    for (size_t i = 0; i < n; i++)
        if (ff_simd_bits(a[i]) != ff_simd_bits(b[i]) && !(isnan(a[i]) && isnan(b[i]))) {
            printf("     %a and %a\n", a[i], b[i]);
            return 0;
        }
    return 1;
}

/* The same at each width, in the remainder of a loop, and for a point alone. */
static void check_builds(const double *x, const double *y, points *haswell, points *wide,
                         double one(double))
{
    static double z[COUNT];
    for (size_t i = 0; i < COUNT; i++)
        z[i] = one(x[i]);
    check_true("a point alone", same_bits(COUNT, y, z));
#ifdef SIMD_X86
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
        haswell(COUNT - 3, x + 3, z + 3);
        check_true("built for AVX2 and FMA", same_bits(COUNT - 3, y + 3, z + 3));
    }
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw")) {
        wide(COUNT - 5, x + 5, z + 5);
        check_true("built for AVX-512", same_bits(COUNT - 5, y + 5, z + 5));
    }
#else
    (void)haswell;
    (void)wide;
#endif
}

static double one_exp(double x)
{
    return ff_exp(x);
}

static double one_log(double x)
{
    return ff_log(x);
}

int main(void)
{
    static double x[COUNT], y[COUNT];
    fill_for_exp(x);
    plain_exp(COUNT, x, y);
    check_below("exp within 1 ulp", worst_distance(COUNT, x, y, expl), 1);
    check_builds(x, y, haswell_exp, wide_exp, one_exp);
    fill_for_log(x);
    plain_log(COUNT, x, y);
    check_below("log within 1 ulp", worst_distance(COUNT, x, y, logl), 1);
    check_builds(x, y, haswell_log, wide_log, one_log);
    return check_done();
}
