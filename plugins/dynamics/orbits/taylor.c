/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "taylor.h"

#include <flankfilm/simd.h>

#include <math.h>

const double dynamics_taylor_longest_step = 1.5;

/* For each order n, the square of the step size x above which the term x^n/n! exceeds 2e-17. */
static const double reach[] = {2e-17,    6.325e-9, 4.932e-6, 1.480e-4, 1.191e-3, 4.932e-3, 1.391e-2,
                               3.078e-2, 5.785e-2, 9.685e-2, 0.1489,   0.2147,   0.2944,   0.3879,
                               0.4949,   0.6150,   0.7476,   0.8921,   1.048,    1.214};
enum { REACHES = sizeof reach / sizeof reach[0] };

double dynamics_taylor_step_size(const dynamics_piece_equation *q, double h)
{
    double k = fmax(q->k[0], dynamics_piece_value(q->k, q->degree, h));
    if (q->degree > 1)
        k = fmax(k, dynamics_piece_value(q->k, q->degree, 0.5 * h));
    return h * (sqrt(fmax(k, 0)) + q->damper);
}

static int likely_order(double size)
{
    int n = 0;
    while (n < REACHES && size > reach[n])
        n++;
    return n + 1 < 4 ? 4 : n + 1;
}

/* Returns whether the last two coefficients of the first `columns` columns are below round-off. The
   motion is compared with `unit`, the response to the start rate with h. */
static int has_converged(const dynamics_taylor_series *s, int n, int columns, double unit)
{
    static const double round_off = 5e-17;
    double last = fabs(s->c[n][0]) + fabs(s->c[n - 1][0]);
    if (last > round_off * unit)
        return 0;
    if (columns == 1)
        return 1;
    return fabs(s->c[n][1]) + fabs(s->c[n - 1][1]) <= round_off &&
           fabs(s->c[n][2]) + fabs(s->c[n - 1][2]) <= round_off * s->h;
}

static const double share[] = {0,       1.,      1. / 2,  1. / 3,  1. / 4,  1. / 5,  1. / 6,
                               1. / 7,  1. / 8,  1. / 9,  1. / 10, 1. / 11, 1. / 12, 1. / 13,
                               1. / 14, 1. / 15, 1. / 16, 1. / 17, 1. / 18, 1. / 19, 1. / 20,
                               1. / 21, 1. / 22, 1. / 23, 1. / 24, 1. / 25, 1. / 26, 1. / 27,
                               1. / 28, 1. / 29, 1. / 30};

/* Adds factor x to sum. It is one vector expression, because gcc would unroll a loop here before
   vectorising it. */
FF_SIMD_INLINE void add_product(double factor, const double *restrict x, int columns,
                                double *restrict sum)
{
#pragma GCC unroll 1
    for (int j = 0; j < columns; j++)
        sum[j] += factor * x[j];
}

/* Computes the coefficients of t/h by the recurrence of the equation in taylor.h, for linear k and
   e: n (n - 1) c_n = -damper h (n - 1) c_(n-1) - k_0 h^2 c_(n-2) - k_1 h^3 c_(n-3). The derivative
   with respect to T at a fixed phase obeys the same equation with (2 z'' + damper z')/T added. */
FF_SIMD_INLINE void recur_straight(const dynamics_piece_equation *q, double T, int columns,
                                   dynamics_taylor_series *s)
{
    double h = s->h, a = q->damper * h, b = q->k[0] * h * h, d = q->k[1] * h * h * h;
    double unit = fabs(s->c[0][0]) + fabs(s->c[1][0]) + q->load * h * h;
    double(*c)[DYNAMICS_COLUMNS] = s->c;
    int likely = likely_order(dynamics_taylor_step_size(q, h));
    for (int j = 0; j < columns; j++)
        c[2][j] = -0.5 * (a * c[1][j] + b * c[0][j]);
    c[2][0] += 0.5 * q->load * h * h;
    if (columns == DYNAMICS_COLUMNS)
        c[2][3] += (2 * c[2][0] + 0.5 * a * c[1][0]) / T;
    for (int n = 3; n <= DYNAMICS_ORDER_MAX; n++) {
        double fa = -a * share[n], f = -share[n] * share[n - 1];
        for (int j = 0; j < columns; j++)
            c[n][j] = fa * c[n - 1][j] + f * (b * c[n - 2][j] + d * c[n - 3][j]);
        if (columns == DYNAMICS_COLUMNS)
            c[n][3] += (2 * c[n][0] - fa * c[n - 1][0]) / T;
        s->order = n;
        s->converged = n >= likely && has_converged(s, n, columns, unit);
        if (s->converged)
            break;
    }
}

/* Does the same for polynomials k and e and with a drag. For the derivative with respect to T, (2
   (z'' + e'') + damper z')/T is added. */
FF_SIMD_INLINE void recur_curved(const dynamics_piece_equation *q, double T, int columns,
                                 dynamics_taylor_series *s)
{
    double h = s->h, a = q->damper * h, power = 1, k[DYNAMICS_DEGREE + 1], e[DYNAMICS_DEGREE + 1];
    double drag[DYNAMICS_DEGREE + 1];
    double unit = fabs(s->c[0][0]) + fabs(s->c[1][0]) + q->load * h * h;
    double(*c)[DYNAMICS_COLUMNS] = s->c;
    int likely = likely_order(dynamics_taylor_step_size(q, h));
    for (int i = 0; i <= q->degree; i++, power *= h) {
        k[i] = q->k[i] * power * h * h;
        e[i] = q->e[i] * power;
        drag[i] = q->drag[i] * power * h * h;
    }
    int degree = q->degree; /* in a short step the high powers of k are below round-off */
    while (degree > 0 && fabs(k[degree]) < 1e-18)
        degree--;
    for (int n = 2; n <= DYNAMICS_ORDER_MAX; n++) {
        double fa = -a * share[n], f = -share[n] * share[n - 1], sum[DYNAMICS_COLUMNS] = {0};
        int last = degree < n - 2 ? degree : n - 2;
        if (last == DYNAMICS_DEGREE) /* the usual case gets a loop of constant length */
            for (int i = 0; i <= DYNAMICS_DEGREE; i++)
                add_product(k[i], c[n - 2 - i], columns, sum);
        for (int i = 0; last < DYNAMICS_DEGREE && i <= last; i++)
            add_product(k[i], c[n - 2 - i], columns, sum);
        for (int j = 0; j < columns; j++)
            sum[j] *= f;
        add_product(fa, c[n - 1], columns, sum);
        for (int j = 0; j < columns; j++)
            c[n][j] = sum[j];
        if (n == 2)
            c[n][0] += 0.5 * q->load * h * h;
        if (q->drags && n - 2 <= q->degree)
            c[n][0] += f * drag[n - 2];
        double bend = n <= q->degree ? e[n] : 0;
        if (columns == DYNAMICS_COLUMNS)
            c[n][3] += (2 * c[n][0] - fa * c[n - 1][0]) / T; /* c_n does not yet contain -e_n */
        c[n][0] -= bend;
        s->order = n;
        s->converged = n >= likely && n > q->degree + 2 && has_converged(s, n, columns, unit);
        if (s->converged)
            break;
    }
}

FF_SIMD_INLINE void recur(const dynamics_piece_equation *q, double T, int columns,
                          dynamics_taylor_series *s)
{
    if (q->degree > 1 || q->drags)
        recur_curved(q, T, columns, s);
    else
        recur_straight(q, T, columns, s);
}

void dynamics_taylor_expand_motion(const dynamics_piece_equation *q, double h, const double z[2],
                                   dynamics_taylor_series *s)
{
    s->h = h;
    s->c[0][0] = z[0];
    s->c[1][0] = z[1] * h;
    recur(q, 1, 1, s);
}

FF_SIMD
void dynamics_taylor_expand(const dynamics_piece_equation *q, double T, double h, const double z[2],
                            const double z_T[2], dynamics_taylor_series *s)
{
    s->h = h;
    s->c[0][DYNAMICS_Z] = z[0];
    s->c[1][DYNAMICS_Z] = z[1] * h;
    s->c[0][DYNAMICS_PHI_1] = 1;
    s->c[1][DYNAMICS_PHI_1] = 0;
    s->c[0][DYNAMICS_PHI_2] = 0;
    s->c[1][DYNAMICS_PHI_2] = h;
    s->c[0][DYNAMICS_Z_T] = z_T[0];
    /* the rate is with respect to time, and time is T phase */
    s->c[1][DYNAMICS_Z_T] = (z_T[1] + z[1] / T) * h;
    recur(q, T, DYNAMICS_COLUMNS, s);
}

void dynamics_taylor_at(const dynamics_taylor_series *s, int column, double x, double at[2])
{
    double value = 0, slope = 0;
    for (int n = s->order; n >= 0; n--) {
        slope = slope * x + value;
        value = value * x + s->c[n][column];
    }
    at[0] = value;
    at[1] = slope / s->h;
}

void dynamics_taylor_columns_at(const dynamics_taylor_series *s, double x,
                                double value[DYNAMICS_COLUMNS], double rate[DYNAMICS_COLUMNS])
{
    double v[DYNAMICS_COLUMNS] = {0}, r[DYNAMICS_COLUMNS] = {0};
    for (int n = s->order; n >= 0; n--)
        for (int j = 0; j < DYNAMICS_COLUMNS; j++) {
            r[j] = r[j] * x + v[j];
            v[j] = v[j] * x + s->c[n][j];
        }
    for (int j = 0; j < DYNAMICS_COLUMNS; j++) {
        value[j] = v[j];
        rate[j] = r[j] / s->h;
    }
}

typedef struct polynomial {
    const double *p;
    int order;
    double bend; /* bound on the absolute second derivative in [0, 1] */
    double tiny; /* round-off error of the values */
} polynomial;

static double value_at(const polynomial *q, double x, double *slope)
{
    double value = 0;
    *slope = 0;
    for (int n = q->order; n >= 0; n--) {
        *slope = *slope * x + value;
        value = value * x + q->p[n];
    }
    return value;
}

/* Finds the root on an interval in which the polynomial decreases, by Newton's method, with
   bisection where Newton's method leaves the bracket. A step of d leaves an error of at most d^2
   bend/(2 slope). */
static double falling_root(const polynomial *q, double low, double high)
{
    double x = 0.5 * (low + high), slope;
    for (int i = 0; i < 100; i++) {
        double value = value_at(q, x, &slope);
        if (value >= 0)
            low = x;
        else
            high = x;
        double step = -value / slope, next = x + step;
        if (step * step * q->bend <= 2e-16 * fabs(slope))
            return fmin(fmax(next, low), high);
        if (!(next > low && next < high))
            next = 0.5 * (low + high);
        if (high - low <= 2e-16)
            return next;
        x = next;
    }
    return x;
}

/* Finds the first change of sign in [a, z] if the value at a is not negative. Returns -1 if there
   is none. */
static double first_change(const polynomial *q, double a, double z)
{
    static const double shortest =
        1e-9; /* tolerance of the minimum; its value is then accurate to the square of this */
    double middle = 0.5 * (a + z), d = 0.5 * (z - a), slope, end_slope;
    double value = value_at(q, middle, &slope), turn = q->bend * d;
    if (value + q->tiny > (fabs(slope) + 0.5 * turn) * d || d < shortest || slope > turn)
        return -1;
    if (-slope > turn)
        return value_at(q, z, &end_slope) < 0 ? falling_root(q, a, z) : -1;
    double first = first_change(q, a, middle);
    return first >= 0 ? first : first_change(q, middle, z);
}

double dynamics_taylor_first_exit(const double *p, int order, double tiny)
{
    double sum = 0;
    for (int n = 1; n <= order; n++)
        sum += fabs(p[n]);
    if (p[0] > sum && p[0] > tiny)
        return -1;
    polynomial q = {p, order, 0, tiny};
    if (p[0] < -tiny)
        return 0;
    /* if the motion starts at the bound, p(0) = 0; p is then divided by x, since p(x) and p(x)/x
       have the same sign */
    for (int i = 0; q.order > 0 && (i == 0 ? fabs(q.p[0]) <= tiny : q.p[0] == 0) && i < 3; i++) {
        q.p++;
        q.order--;
    }
    if (q.p[0] < 0)
        return 0;
    for (int n = 2; n <= q.order; n++)
        q.bend += n * (n - 1) * fabs(q.p[n]);
    return first_change(&q, 0, 1);
}
