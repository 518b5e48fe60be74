/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "squeeze-law.h"

#include <math.h>

/* Ends of the table in ln w. Beyond these ends, the power laws give beta with a relative error of
   1e-8. */
static const double lowest = -12, highest = 14;

/* Compute the integrals of cos^4 and of sin^2 cos^2 from -pi/2 to delta - pi/2, which equal those
   of sin^4 and of sin^2 cos^2 from 0 to delta. Near 0 the closed forms suffer from cancellation, so
   series are used there. */
static double fourth_power(double d)
{
    double x = d * d;
    if (d < 0.2)
        return d * x * x *
               (1. / 5 + x * (-2. / 21 + x * (1. / 45 + x * (-34. / 10395 + x * 62. / 184275))));
    return 3 * d / 8 - sin(2 * d) / 4 + sin(4 * d) / 32;
}

static double mixed_power(double d)
{
    double x = d * d;
    if (d < 0.2)
        return d * x *
               (1. / 3 + x * (-4. / 15 + x * (32. / 315 + x * (-64. / 2835 + x * 512. / 155925))));
    return d / 8 - sin(4 * d) / 32;
}

/* Returns the integral of cos^2 over the same range, using sin^2 = sin^4 + sin^2 cos^2. */
static double second_power(double d)
{
    return fourth_power(d) + mixed_power(d);
}

/* Evaluates the curve in closed form. Reynolds' equation, integrated once, is with X = x/sqrt(2 R
   h) and H = 1 + X^2: h^2/(12 eta u sqrt(2 R h)) dp/dX = (H - beta X - c)/H^3. The constant c = 1 +
   X_e^2 - beta X_e makes dp/dX = 0 at the end X_e of the film. With X = tan(gamma) all integrals
   are elementary. The condition p(X_e) = 0 is linear in beta. w is 24 times the integral of the
   pressure, integrated by parts. */
void dynamics_squeeze_point(double delta, double *beta, double *w)
{
    double s = sin(delta), c = cos(delta), end = -c / s;
    double j4 = fourth_power(delta), j2 = second_power(delta), quarter = s * s * s * s / 4;
    double past = (j4 - j2 - end * quarter) / (end * j4 + quarter); /* beta - X_e */
    *beta = end + past;
    double constant = 1 - end * past;
    *w = 24 * (s * s / 2 + *beta * mixed_power(delta) - constant * quarter);
}

/* Finds delta for a given ln w by Newton's method, starting from a neighbouring value. */
static double find_delta(double target, double delta)
{
    for (int i = 0; i < 60; i++) {
        double beta, w, above, step = 1e-6 * fmin(delta, M_PI - delta);
        dynamics_squeeze_point(delta, &beta, &w);
        dynamics_squeeze_point(delta + step, &beta, &above);
        double next = delta + (target - log(w)) * step * w / (above - w);
        next = fmin(fmax(next, 0.5 * delta), delta + 0.5 * (M_PI - delta));
        if (fabs(next - delta) < 1e-14 * delta)
            return next;
        delta = next;
    }
    return delta;
}

static double slope_at(double delta)
{
    double step = 1e-4 * fmin(delta, M_PI - delta), beta[2], w[2];
    dynamics_squeeze_point(delta - step, &beta[0], &w[0]);
    dynamics_squeeze_point(delta + step, &beta[1], &w[1]);
    return (asinh(beta[1]) - asinh(beta[0])) / log(w[1] / w[0]);
}

void dynamics_squeeze_table_build(dynamics_squeeze_table *t)
{
    double delta = 1e-3, width = (highest - lowest) / (DYNAMICS_SQUEEZE_NODES - 1), beta, w;
    for (int i = 0; i < DYNAMICS_SQUEEZE_NODES; i++) {
        delta = find_delta(lowest + i * width, delta);
        dynamics_squeeze_point(delta, &beta, &w);
        t->value[i] = asinh(beta);
        t->slope[i] = slope_at(delta);
    }
    t->least = 0; /* least = 0 makes dynamics_squeeze_beta use the curve itself */
    t->beta_least = dynamics_squeeze_beta(t, exp(lowest), &t->slope_least);
    t->least = exp(lowest);
}

/* Evaluates the cubic in ln w between the nodes. Beyond them the curve is a power law, which is a
   straight line here. */
static double curve(const dynamics_squeeze_table *t, double x, double *slope)
{
    const double width = (highest - lowest) / (DYNAMICS_SQUEEZE_NODES - 1);
    double at = (x - lowest) / width;
    int i = (int)fmin(fmax(at, 0), DYNAMICS_SQUEEZE_NODES - 2);
    if (at < 0 || at > DYNAMICS_SQUEEZE_NODES - 1) {
        i += at > 0;
        *slope = t->slope[i];
        return t->value[i] + *slope * (x - lowest - i * width);
    }
    double a = t->value[i], z = t->value[i + 1], p = at - i;
    double sa = t->slope[i] * width, sz = t->slope[i + 1] * width;
    double c2 = 3 * (z - a) - 2 * sa - sz, c3 = sa + sz - 2 * (z - a);
    *slope = (sa + p * (2 * c2 + 3 * p * c3)) / width;
    return a + p * (sa + p * (c2 + p * c3));
}

double dynamics_squeeze_beta(const dynamics_squeeze_table *t, double w, double *slope)
{
    if (w < t->least) {
        *slope = t->slope_least;
        return t->beta_least + t->slope_least * (w - t->least);
    }
    double s = curve(t, log(w), slope);
    double up = exp(s), down = 1 / up;
    *slope *= 0.5 * (up + down) / w;
    return 0.5 * (up - down);
}

double dynamics_squeeze_wedge(void)
{
    double low = 1, high = 3, beta, w = 0;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        dynamics_squeeze_point(middle, &beta, &w);
        *(beta < 0 ? &low : &high) = middle;
    }
    return w;
}
