/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "channel.h"

#include <math.h>
#include <string.h>

enum { N = EHL_CHANNEL_CELLS };

/* Changes of theta for each right-hand side: the residual, and the derivatives with respect to a
   and b. */
typedef struct columns {
    double by[3][N + 1];
} columns;

/* The source g = (a + b y)^2 exp(theta) at node i, which equals its derivative with respect to
   theta, and its derivatives with respect to a and b. */
typedef struct source {
    double g, by_a, by_b;
} source;

static source source_at(const ehl_channel *c, int i)
{
    double y = (double)i / N - 0.5, s = c->a + c->b * y, hot = exp(c->theta[i]);
    return (source){s * s * hot, 2 * s * hot, 2 * s * y * hot};
}

/* Solves the linear equations of the inner nodes by elimination: theta(i-1) - 2 theta(i) +
   theta(i+1) + (g(i-1) + 10 g(i) + g(i+1))/(12 N^2) = 0. */
static void sweep(const ehl_channel *c, columns *d)
{
    const double w = 1. / (12. * N * N);
    double upper[N + 1] = {0};
    source s0 = source_at(c, 0), s1 = source_at(c, 1);
    memset(d, 0, sizeof *d);
    for (int i = 1; i < N; i++) {
        source s2 = source_at(c, i + 1);
        double lower = i > 1 ? 1 + w * s0.g : 0, main = -2 + 10 * w * s1.g, next = 1 + w * s2.g;
        double right[3] = {
            c->theta[i - 1] - 2 * c->theta[i] + c->theta[i + 1] + w * (s0.g + 10 * s1.g + s2.g),
            w * (s0.by_a + 10 * s1.by_a + s2.by_a), w * (s0.by_b + 10 * s1.by_b + s2.by_b)};
        double pivot = 1 / (main - lower * upper[i - 1]);
        upper[i] = next * pivot;
        for (int k = 0; k < 3; k++)
            d->by[k][i] = (-right[k] - lower * d->by[k][i - 1]) * pivot;
        s0 = s1;
        s1 = s2;
    }
    for (int k = 0; k < 3; k++)
        for (int i = N - 2; i > 0; i--)
            d->by[k][i] -= upper[i] * d->by[k][i + 1];
}

/* The integrals of flow and speed, and their derivatives along each column. The derivatives with
   respect to a and b include the explicit dependence on a and b. */
typedef struct integrals {
    double flow, flow_by[3], speed, speed_by[3];
} integrals;

static integrals integrate(const ehl_channel *c, const columns *d)
{
    integrals sum = {0};
    for (int i = 0; i <= N; i++) {
        double weight = (i == 0 || i == N ? 1. : i % 2 ? 4. : 2.) / (3. * N);
        double y = (double)i / N - 0.5, hot = weight * exp(c->theta[i]);
        double rate = (c->a + c->b * y) * hot;
        const double own[3] = {0, hot, y * hot};
        sum.flow += y * rate;
        sum.speed += rate;
        for (int k = 0; k < 3; k++) {
            double change = rate * d->by[k][i] + own[k];
            sum.flow_by[k] += y * change;
            sum.speed_by[k] += change;
        }
    }
    return sum;
}

double ehl_channel_solve(ehl_channel *c, double F, double S)
{
    enum { LIMIT = 40 };
    const double within = 1e-8; /* bound on the last Newton step; at F = 1e-6 the step cannot be
                                   smaller than about 1e-9, because of round-off */
    const double flow = sqrt(F), speed = sqrt(S);
    if (!(c->b > 0)) {
        c->b = 12 * flow;
        c->a = speed;
    }
    for (int turn = 0; turn < LIMIT; turn++) {
        columns d;
        sweep(c, &d);
        integrals now = integrate(c, &d);
        double aa = now.flow_by[1], ab = now.flow_by[2], ra = flow - now.flow - now.flow_by[0];
        double ba = now.speed_by[1], bb = now.speed_by[2], rb = speed - now.speed - now.speed_by[0];
        double det = aa * bb - ab * ba, da = (ra * bb - ab * rb) / det,
               db = (aa * rb - ra * ba) / det;
        double most = fmax(fabs(da) / (1 + c->a), fabs(db) / c->b);
        for (int i = 1; i < N; i++) {
            double change = d.by[0][i] + da * d.by[1][i] + db * d.by[2][i];
            c->theta[i] += change;
            most = fmax(most, fabs(change));
        }
        c->a += da;
        c->b += db;
        if (!isfinite(most))
            return NAN;
        if (most < within)
            return c->b / (12 * flow);
    }
    return NAN;
}
