/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Means, squares and products of pairs of values, and their correlation. */
#include "estimate.h"

#include <math.h>

estimate_moments estimate_pairs(const double *a, const double *b, size_t count,
                                double (*g)(double, double), double about)
{
    estimate_moments m = {0};
    for (size_t i = 0; i < count; i++) {
        double x = g ? g(a[i], about) : a[i], y = g ? g(b[i], about) : b[i];
        if (!isfinite(x) || !isfinite(y))
            continue;
        double dx = x - m.mean_a, dy = y - m.mean_b;
        m.count++;
        m.mean_a += dx / m.count;
        m.mean_b += dy / m.count;
        m.aa += dx * (x - m.mean_a);
        m.bb += dy * (y - m.mean_b);
        m.ab += dx * (y - m.mean_b);
    }
    return m;
}

double estimate_correlation(const double *a, const double *b, size_t count)
{
    estimate_moments m = estimate_pairs(a, b, count, NULL, 0);
    if (m.count < 3 || !(m.aa > 0 && m.bb > 0))
        return 0;
    /* the residual variance of n samples has n - 2 degrees of freedom, the variance n - 1 */
    double rest = (1 - m.ab * m.ab / (m.aa * m.bb)) * (m.count - 1) / (m.count - 2);
    return rest < 1 ? copysign(sqrt(1 - fmax(rest, 0)), m.ab) : 0;
}
