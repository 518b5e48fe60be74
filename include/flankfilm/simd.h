/* SPDX-License-Identifier: MIT */
/*
 * Exponential and logarithm for loops over points. They have no branches and no tables, so that the
 * compiler can vectorise a loop that calls them; it cannot vectorise calls to libm. An example, a
 * viscosity law:
 *
 *   FF_SIMD
 *   static void barus(size_t n, const double *restrict p, double alpha, double *restrict eta)
 *   {
 *       for (size_t i = 0; i < n; i++)
 *           eta[i] = ff_exp(alpha * p[i]);
 *   }
 *
 * Both are accurate to 1 ulp for every argument. Overflow, subnormal numbers, infinities and NaN
 * are as in libm, but errno is not set. They require round-to-nearest and no -ffast-math. In
 * FF_SIMD functions the result is bitwise equal on every processor and for every vector width. In
 * other functions this needs a compiler that does not contract products and sums
 * (-ffp-contract=off, which -std=c11 implies in gcc).
 */
#ifndef FLANKFILM_SIMD_H
#define FLANKFILM_SIMD_H

#include <stddef.h>
#include <stdint.h>
#include <string.h>

/*
 * FF_SIMD before a function vectorises its loops, in gcc also at -O2. With gcc, x86-64 and glibc
 * there is also an AVX2 version, which the loader selects if the processor supports it; both
 * versions give bitwise equal results. Elsewhere there is only one version. Reasons: other systems
 * have no indirect functions (ELF ifunc); clang before 18 gives them names that other object files
 * do not link to; and gcc's thread sanitizer would call its runtime in the selecting function,
 * before the loader has linked it. For best results, pass the arrays of such a loop as `restrict`
 * parameters, and write choices as `?:` between values that are computed in any case.
 *
 * FF_SIMD_LOOP before a loop asserts that no iteration needs what another one writes. It serves
 * loops over more arrays than there are parameters.
 */
#if defined(__GNUC__) && !defined(__clang__)
#if defined(__x86_64__) && defined(__GLIBC__) && !defined(__SANITIZE_THREAD__)
#define FF_SIMD_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define FF_SIMD_CLONES
#endif
#define FF_SIMD                                                                                    \
    FF_SIMD_CLONES                                                                                 \
    __attribute__((optimize("tree-vectorize", "vect-cost-model=dynamic", "no-math-errno",          \
                            "no-trapping-math", "fp-contract=off")))
#define FF_SIMD_LOOP _Pragma("GCC ivdep")
#else
#define FF_SIMD
#define FF_SIMD_LOOP
#endif

#if defined(__GNUC__)
#define FF_SIMD_INLINE static inline __attribute__((always_inline))
#else
#define FF_SIMD_INLINE static inline
#endif

FF_SIMD_INLINE uint64_t ff_simd_bits(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

FF_SIMD_INLINE double ff_simd_from_bits(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/*
 * e^x = 2^k e^r, where k is the integer nearest to x/ln 2 and |r| < 0.3467. A polynomial of degree
 * 11 approximates e^r with an error of 0.12 of 2^-53. ln 2 is the sum of two numbers, of which k
 * times the first is exact.
 */
FF_SIMD_INLINE double ff_exp(double x)
{
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif
    /* 1.5 * 2^52: adding it rounds a number to an integer, which is in the lowest bits of the
       sum */
    const double whole = 6755399441055744.0;
    const double ln2 = 0.69314718055989033, ln2_rest = 5.4979230187083712e-14;
    /* beyond these limits the result is infinite or 0; NaN stays NaN */
    double y = x > 710.0 ? 710.0 : x;
    y = y < -746.0 ? -746.0 : y;
    double k = (y * 1.4426950408889634 + whole) - whole;
    double high = y - k * ln2, low = k * ln2_rest, r = high - low;
    double p = 2.510038549551032e-08;
    p = p * r + 2.7620088445409746e-07;
    p = p * r + 2.7557268459997064e-06;
    p = p * r + 2.4801521295954376e-05;
    p = p * r + 0.00019841269863053618;
    p = p * r + 0.0013888888917213717;
    p = p * r + 0.008333333333330062;
    p = p * r + 0.04166666666662413;
    p = p * r + 0.16666666666666669;
    p = p * r + 0.5000000000000001;
    /* 1 + high as a rounded sum and its exact rounding error */
    double one = 1.0 + high, rest = high - (one - 1.0);
    double near_one = one + (rest + (p * r * r - low));
    /* 2^k as two factors, neither of which overflows */
    double half = k * 0.5 + whole, other = (k - (half - whole)) + whole;
    const uint64_t bias = (uint64_t)1023 << 52;
    double power = ff_simd_from_bits((ff_simd_bits(half) << 52) + bias);
    double power_other = ff_simd_from_bits((ff_simd_bits(other) << 52) + bias);
    return near_one * power * power_other;
}

/*
 * ln x = k ln 2 + ln(1 + f), where x = 2^k (1 + f) and 1 + f lies between sqrt(1/2) and sqrt(2).
 * With s = f/(2 + f), ln(1 + f) = 2 s + s R = f - f^2/2 + s (f^2/2 + R). R is approximated by a
 * polynomial of degree 7 in s^2 with an error of 2^-56.
 */
FF_SIMD_INLINE double ff_log(double x)
{
#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif
    const double ln2 = 0.69314718055989033, ln2_rest = 5.4979230187083712e-14;
    const uint64_t one = (uint64_t)0x3ff << 52, root_of_half = 0x3fe6a09e667f3bcd;
    const uint64_t fraction = ((uint64_t)1 << 52) - 1;
    const double infinity = ff_simd_from_bits((uint64_t)0x7ff << 52);
    /* subnormal numbers are scaled by 2^54 */
    const int subnormal = x < 2.2250738585072014e-308;
    double y = subnormal ? x * 18014398509481984.0 : x, bias = subnormal ? 1077.0 : 1023.0;
    uint64_t bits = ff_simd_bits(y) + (one - root_of_half);
    /* converts the exponent to a double: an integer in the lowest bits of 2^52 */
    double k = ff_simd_from_bits((bits >> 52) + ((uint64_t)0x433 << 52)) - 4503599627370496.0;
    double f = ff_simd_from_bits((bits & fraction) + root_of_half) - 1.0;
    k -= bias;
    double s = f / (2.0 + f), z = s * s, half_square = 0.5 * f * f;
    double p = 0.1461644970704499;
    p = p * z + 0.1533172159877604;
    p = p * z + 0.1818288912531527;
    p = p * z + 0.22222211134794345;
    p = p * z + 0.28571428625975487;
    p = p * z + 0.39999999999899505;
    p = p * z + 0.666666666666667;
    /* k ln 2 + f as a rounded sum and its exact rounding error */
    double high = k * ln2, sum = high + f, rest = f - (sum - high);
    double ln = sum + (rest + ((s * (half_square + p * z) + k * ln2_rest) - half_square));
    ln = x < infinity ? ln : x;
    ln = x == 0.0 ? -infinity : ln;
    return x < 0.0 ? infinity - infinity : ln;
}

#endif
