/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "linear-pair.h"

#include <math.h>

/* Longest part of a stretch between samples, rad, and the most parts: the extremes are those of the
   samples. */
static const double part = 0.3;
enum { MOST_PARTS = 1000 };

typedef struct state {
    double s, rate;
} state;

/* The state after t, where s_0 = a + b t: the free vibration, exp(-zeta t) (x cos w t + ... sin w
   t) with w = sqrt(1 - zeta^2), about the particular solution a + b t - 2 zeta b (Meirovitch 2001,
   Fundamentals of Vibrations, ch. 2). */
static state advance(state from, double a, double b, double zeta, double t)
{
    double z = fmin(zeta, 0.999), damped = sqrt(1 - z * z);
    double x = from.s - (a - 2 * z * b), v = from.rate - b;
    double decay = exp(-z * t), c = cos(damped * t), s = sin(damped * t);
    double sine = (v + z * x) / damped;
    return (state){
        .s = a + b * t - 2 * z * b + decay * (x * c + sine * s),
        .rate = b + decay * (v * c - (z * v + x) / damped * s),
    };
}

typedef struct sums {
    double time, s, square, zero, zero_square, apart_square;
    double high, low, zero_high, zero_low;
    dynamics_linear_pair_response *motion;
} sums;

static void add_to_sums(sums *u, double s, double zero, double weight)
{
    double apart = s - zero;
    u->time += weight;
    u->s += weight * s;
    u->square += weight * s * s;
    u->zero += weight * zero;
    u->zero_square += weight * zero * zero;
    u->apart_square += weight * apart * apart;
    u->high = fmax(u->high, s);
    u->low = fmin(u->low, s);
    u->zero_high = fmax(u->zero_high, zero);
    u->zero_low = fmin(u->zero_low, zero);
    u->motion->highest = fmax(u->motion->highest, apart);
    u->motion->lowest = fmin(u->motion->lowest, apart);
}

/* The state after one mesh cycle; u may be NULL. `mean` of s_0 is taken off so that no digits
 * cancel. */
static state follow_cycle(const dynamics_linear_pair *l, state y, double mean, sums *u)
{
    double cycle = 2 * acos(-1) / l->frequency;
    for (size_t i = 1; i < l->count; i++) {
        double t = (l->phase[i] - l->phase[i - 1]) * cycle, a = l->deflection[i - 1] - mean;
        if (!(t > 0))
            continue;
        double b = (l->deflection[i] - l->deflection[i - 1]) / t;
        double parts = u ? fmin(ceil(t / part), MOST_PARTS) : 1;
        state begin = y;
        for (double k = 1; u && k <= parts; k++) {
            double middle = t * (k - 0.5) / parts;
            add_to_sums(u, advance(begin, a, b, l->zeta, middle).s, a + b * middle, t / parts);
            add_to_sums(u, advance(begin, a, b, l->zeta, t * k / parts).s, a + b * t * k / parts,
                        0);
        }
        y = advance(begin, a, b, l->zeta, t);
    }
    return y;
}

/* The start to which one mesh cycle leads back: its end is an affine map of the start, known by
   three tries. */
static state find_periodic_start(const dynamics_linear_pair *l, double mean, double size)
{
    state o = follow_cycle(l, (state){0, 0}, mean, NULL);
    state x = follow_cycle(l, (state){size, 0}, mean, NULL);
    state v = follow_cycle(l, (state){0, size}, mean, NULL);
    double m11 = 1 - (x.s - o.s) / size, m12 = -(v.s - o.s) / size;
    double m21 = -(x.rate - o.rate) / size, m22 = 1 - (v.rate - o.rate) / size;
    double det = m11 * m22 - m12 * m21;
    if (!(fabs(det) > 1e-12)) /* undamped, at resonance */
        det = 1e-12;
    return (state){(m22 * o.s - m12 * o.rate) / det, (m11 * o.rate - m21 * o.s) / det};
}

dynamics_linear_pair_response dynamics_linear_pair_motion(const dynamics_linear_pair *l)
{
    dynamics_linear_pair_response m = {.highest = -HUGE_VAL, .lowest = HUGE_VAL};
    double mean = 0, high = -HUGE_VAL, low = HUGE_VAL;
    for (size_t i = 0; i < l->count; i++) {
        if (i > 0)
            mean += (l->phase[i] - l->phase[i - 1]) * (l->deflection[i] + l->deflection[i - 1]) / 2;
        high = fmax(high, l->deflection[i]);
        low = fmin(low, l->deflection[i]);
    }
    if (!(high > low))
        return (dynamics_linear_pair_response){0};
    sums u = {.motion = &m,
              .high = -HUGE_VAL,
              .low = HUGE_VAL,
              .zero_high = -HUGE_VAL,
              .zero_low = HUGE_VAL};
    follow_cycle(l, find_periodic_start(l, mean, high - low), mean, &u);
    m.rms = sqrt(u.apart_square / u.time);
    m.rms_static = sqrt(fmax(u.zero_square / u.time - pow(u.zero / u.time, 2), 0));
    m.rms_total = sqrt(fmax(u.square / u.time - pow(u.s / u.time, 2), 0));
    m.swing_static = u.zero_high - u.zero_low;
    m.swing_total = u.high - u.low;
    return m;
}
