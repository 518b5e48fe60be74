/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Allocates samples to levels, and estimates means and standard deviations from them. */
#include "estimate.h"

#include "../memory/memory.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics.h>
#include <math.h>
#include <stdlib.h>

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

/* m_i = N sqrt(d_i / w_i) sum sqrt(d_j w_j) gives the variance sum d_i / m_i = 1 / N at the least
   cost sum w_i m_i (Peherstorfer et al. 2016, theorem 3.4). Where level 0 needs more for its
   variance to be known, the others are allotted what variance that leaves. False: the counts do not
   rise. */
static bool count_samples(const double *d, const double *cost, size_t levels, double plain,
                          double *count)
{
    double left = 1 / plain, sum = 0;
    for (size_t i = 0; i < levels; i++)
        sum += sqrt(d[i] * cost[i]);
    count[0] = fmax(ESTIMATE_LEAST, ceil(plain * sqrt(d[0] / cost[0]) * sum));
    left -= d[0] / count[0];
    sum -= sqrt(d[0] * cost[0]);
    for (size_t i = 1; i < levels; i++) {
        count[i] = ceil(sqrt(d[i] / cost[i]) * sum / left);
        if (!(left > 0) || count[i] < count[i - 1] + ESTIMATE_LEAST || count[i] > 1e6)
            return false;
    }
    return true;
}

static double cost_of(const double *count, const double *cost, size_t levels)
{
    double sum = 0;
    for (size_t i = 0; i < levels; i++)
        sum += count[i] * cost[i];
    return sum;
}

/* The shares of the variance that samples of each level leave: for a mean by falling correlation,
   d_i = rho_i^2 - rho_(i+1)^2; for a probability near 1/2 with one cheap level, how often that lies
   on the other side, acos(rho) / pi of normal variates, over p (1 - p) = 1/4. */
static void share_variance(const double *rho2, size_t levels, estimate_aim aim, double *d)
{
    for (size_t i = 0; i < levels; i++)
        d[i] = fmax(rho2[i] - (i + 1 < levels ? rho2[i + 1] : 0), 0);
    if (aim == ESTIMATE_DISTRIBUTION && levels == 2) {
        d[0] = 4 * acos(sqrt(rho2[1])) / acos(-1);
        d[1] = 1;
    }
}

/* Tries the levels that the bits of `set` name. */
static void try_levels(estimate_plan *best, unsigned set, const double *cost, size_t levels,
                       double plain, estimate_aim aim)
{
    double rho2[ESTIMATE_MOST_LEVELS] = {1}, w[ESTIMATE_MOST_LEVELS] = {1};
    double count[ESTIMATE_MOST_LEVELS], d[ESTIMATE_MOST_LEVELS] = {0};
    size_t used[ESTIMATE_MOST_LEVELS] = {0}, n = 1;
    for (size_t k = 1; k < levels; k++) {
        double r2 = best->correlation[k] * best->correlation[k];
        size_t at = n;
        if (!(set >> k & 1))
            continue;
        for (; at > 1 && rho2[at - 1] < r2; at--) {
            rho2[at] = rho2[at - 1];
            w[at] = w[at - 1];
            used[at] = used[at - 1];
        }
        rho2[at] = r2;
        w[at] = cost[k];
        used[at] = k;
        n++;
    }
    share_variance(rho2, n, aim, d);
    if ((aim == ESTIMATE_DISTRIBUTION && n > 2) || !count_samples(d, w, n, plain, count) ||
        cost_of(count, w, n) >= best->cost)
        return;
    best->cost = cost_of(count, w, n);
    best->levels = n;
    for (size_t i = 0; i < n; i++) {
        best->level[i] = used[i];
        best->count[i] = (size_t)count[i];
    }
}

estimate_plan estimate_allocate(const double *const *pilot, size_t pilot_count, size_t levels,
                                const double *cost, size_t plain, estimate_aim aim)
{
    estimate_plan best = {.levels = 1, .count = {plain}, .correlation = {1}, .cost = (double)plain};
    for (size_t k = 1; k < levels; k++)
        best.correlation[k] = estimate_correlation(pilot[0], pilot[k], pilot_count);
    for (unsigned set = 2; set < 1u << levels; set += 2)
        try_levels(&best, set, cost, levels, (double)plain, aim);
    return best;
}

static bool is_whole(const estimate_samples *s, size_t first, size_t i)
{
    for (size_t k = first; k < s->levels; k++)
        if (!isfinite(s->values[k][i]))
            return false;
    return true;
}

static size_t begin_of(const estimate_samples *s, size_t block)
{
    return block ? s->count[block - 1] : 0;
}

/* The weights of the control variates, from the pilot: cov(g_0, g_k) / var(g_k). */
static void find_weights(const estimate_samples *s, double (*g)(double, double), double about,
                         double *weight)
{
    weight[0] = 1;
    for (size_t k = 1; k < s->levels; k++) {
        estimate_moments m = estimate_pairs(s->pilot[0], s->pilot[k], s->pilot_count, g, about);
        weight[k] = m.bb > 0 ? m.ab / m.bb : 0;
    }
}

/*
 * Estimates the mean of g. It is a sum over samples, each of which contributes what it has of
 *   mean_0(m_0) + sum_k weight_k (mean_k(m_k) - mean_k(m_(k-1))).
 * Samples of a block, which are on the same levels, contribute alike and independently, so that
 * the variance of the sum is found from the spread within the blocks, with the degrees of freedom
 * of Welch and Satterthwaite.
 */
static estimate mean_of(const estimate_samples *s, double (*g)(double, double), double about)
{
    double weight[ESTIMATE_MOST_LEVELS], m[ESTIMATE_MOST_LEVELS] = {0};
    double sum = 0, variance = 0, fourth = 0;
    find_weights(s, g, about, weight);
    for (size_t block = 0; block < s->levels; block++)
        for (size_t i = begin_of(s, block); i < s->count[block]; i++)
            for (size_t k = block; is_whole(s, block, i) && k < s->levels; k++)
                m[k]++;
    for (size_t block = 0; block < s->levels; block++) {
        double mean = 0, squares = 0, n = 0;
        for (size_t i = begin_of(s, block); i < s->count[block]; i++) {
            double part = 0;
            if (!is_whole(s, block, i))
                continue;
            for (size_t k = block; k < s->levels; k++) {
                double share = 1 / m[k] - (k > block ? 1 / m[k - 1] : 0);
                part += weight[k] * share * g(s->values[k][i], about);
            }
            double step = part - mean;
            n++;
            mean += step / n;
            squares += step * (part - mean);
        }
        if (n == 0)
            continue;
        double own = n * squares / (n - 1); /* of n contributions */
        sum += n * mean;
        variance += own;
        fourth += own * own / (n - 1);
    }
    double t = fourth > 0 ? gsl_cdf_tdist_Pinv(0.975, fmax(variance * variance / fourth, 1)) : 0;
    double error = m[0] > 1 ? sqrt(variance) : (double)NAN;
    double value = m[0] > 0 ? sum : (double)NAN;
    return (estimate){value, value - t * error, value + t * error, error};
}

static double itself(double value, double about)
{
    (void)about;
    return value;
}

static double square(double value, double about)
{
    return (value - about) * (value - about);
}

estimate estimate_mean(const estimate_samples *s)
{
    return mean_of(s, itself, 0);
}

/* var = E (y - c)^2 - (mean - c)^2 for any c; c is near the mean, so that the second term is as
   small as its correction by the variance of the mean. The interval is that of the logarithm. */
estimate estimate_deviation(const estimate_samples *s)
{
    estimate mean = estimate_mean(s), squares = mean_of(s, square, mean.value);
    double variance = squares.value + mean.error * mean.error;
    if (!(variance > 0))
        return (estimate){variance >= 0 ? 0 : (double)NAN, 0, INFINITY, (double)NAN};
    double half = (squares.high - squares.low) / 2 / variance / 2; /* of ln(sd) */
    double deviation = sqrt(variance);
    return (estimate){deviation, deviation * exp(-half), deviation * exp(half), (double)NAN};
}
