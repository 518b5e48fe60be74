/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Statistics of uncertain inputs on problems whose answers are known. The bounds are those that a
 * right estimator crosses by chance with one in RISK of all seeds, shared evenly among the CHECKS:
 * intervals of 95 % hold in as many of the repeats as a binomial variate allows, the mean of the
 * repeats lies within z standard errors of the truth.
 */
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "../../../core/program/study/kinds/uncertainty/estimates/estimate.h"

/* of each problem: 5 intervals plainly, 2 and 5 of ladders, 2 of indices; 5 means; 2 errors */
enum { CHECKS = 3 * (14 + 5 + 2), RISK = 100 };
static const double risk = 1.0 / RISK / CHECKS;

enum { LEVELS = 3, PILOT = 60, PLAIN = 400, ROOM = 200000, SOBOL = 256 };

static int failures;

static void check(bool good, const char *what, double found, double least, double most)
{
    if (good)
        return;
    printf("%s: %g, expected %g to %g\n", what, found, least, most);
    failures++;
}

/* A problem of two independent standard normal inputs. */
typedef struct problem {
    const char *name;
    double (*answer)(double x, double y, int level);
    double mean, deviation, median, p90, probability, first, total; /* of x for the indices */
    double limit;
} problem;

/* Cheap levels are off by a factor, a shift and a wave that the inputs do not explain linearly. */
static double linear(double x, double y, int level)
{
    double value = 3 + 2 * x + y;
    return level == 0 ? value : level == 1 ? 0.9 * value + 0.1 * sin(3 * x * y) : value - 0.5 * y;
}

static double product(double x, double y, int level)
{
    double value = (2 + x) * (2 + y);
    return level == 0 ? value : level == 1 ? 1.1 * value + 0.2 * sin(3 * x * y) : 4 + 2 * x + 2 * y;
}

/* A jump, as where a motion leaves its branch; the cheapest level jumps elsewhere. */
static double fold(double x, double y, int level)
{
    double at = level == 2 ? 0.9 : 1;
    return y / 2 + x / 4 + (x > at ? 3 : 0) + (level ? 0.3 + 0.1 * sin(3 * x * y) : 0);
}

/* 95 % points of the fold: a mixture of the two sides, by its distribution function. */
static double fold_below(double t)
{
    enum { N = 4000 };
    double sum = 0, weight = 0;
    for (int i = 0; i < N; i++) {
        double x = gsl_cdf_ugaussian_Pinv((i + 0.5) / N);
        sum += gsl_cdf_ugaussian_P(2 * (t - x / 4 - (x > 1 ? 3 : 0)));
        weight++;
    }
    return sum / weight;
}

/* P((2 + x)(2 + y) <= t), by the inputs of x. */
static double product_below(double t)
{
    enum { N = 20000 };
    double sum = 0;
    for (int i = 0; i < N; i++) {
        double x = 2 + gsl_cdf_ugaussian_Pinv((i + 0.5) / N);
        sum += x > 0 ? gsl_cdf_ugaussian_P(t / x - 2) : gsl_cdf_ugaussian_Q(t / x - 2);
    }
    return sum / N;
}

static double solve(double (*below)(double), double share, double low, double high)
{
    for (int i = 0; i < 60; i++) {
        double middle = (low + high) / 2;
        if (below(middle) < share)
            low = middle;
        else
            high = middle;
    }
    return (low + high) / 2;
}

static void draw(gsl_rng *rng, const problem *p, size_t from, size_t to, double *const *values,
                 double *numbers)
{
    for (size_t i = from; i < to; i++) {
        double x = gsl_ran_gaussian(rng, 1), y = gsl_ran_gaussian(rng, 1);
        numbers[2 * i] = x;
        numbers[2 * i + 1] = y;
        for (int k = 0; k < LEVELS; k++)
            values[k][i] = p->answer(x, y, k);
    }
}

typedef struct tally {
    const char *what;
    double truth, sum, squares, fourths; /* sums over the repeats; powers of what it is off by */
    size_t repeats, held;
} tally;

/* The inputs explain all of the linear problem, whose intervals are as narrow as rounding. */
static void count(tally *t, estimate e)
{
    static const double rounding = 1e-13;
    t->repeats++;
    t->held += e.low - rounding <= t->truth && t->truth <= e.high + rounding;
    t->sum += e.value;
    t->squares += pow(e.value - t->truth, 2);
    t->fourths += pow(e.value - t->truth, 4);
}

/* The number of repeats that intervals of 95 % hold in at least, or at most. */
static double held_bound(bool most, size_t repeats)
{
    unsigned k = 0;
    while (gsl_cdf_binomial_P(k, 0.95, (unsigned)repeats) < (most ? 1 - risk / 2 : risk / 2))
        k++;
    return k;
}

/* A percentile is biased by the order of 1 / n, as that of every sample is. */
static void judge(const char *name, const char *how, const tally *t, bool unbiased)
{
    char what[200];
    double z = gsl_cdf_ugaussian_Qinv(risk / 2), repeats = (double)t->repeats;
    double off = t->sum / repeats - t->truth;
    double error = sqrt(t->squares / repeats - off * off) / sqrt(repeats);
    double least = held_bound(false, t->repeats), most = held_bound(true, t->repeats);
    printf("%-8s %-8s %-12s held %5.1f %%, off by %5.2f standard errors, rms %.3g\n", name, how,
           t->what, 100. * (double)t->held / repeats, off / error, sqrt(t->squares / repeats));
    snprintf(what, sizeof what, "%s, %s: intervals of the %s that hold", name, how, t->what);
    bool exact = t->squares / repeats < 1e-24;
    check((double)t->held >= least && (exact || (double)t->held <= most), what, (double)t->held,
          least, most);
    snprintf(what, sizeof what, "%s, %s: mean of the %s in its standard errors", name, how,
             t->what);
    check(!unbiased || fabs(off) <= z * error, what, off / error, -z, z);
}

/*
 * The variance over that of the plain samples. A pilot of n samples underrates as often as it
 * overrates what a level leaves, but 1 / chi^2 of n - 2 degrees of freedom has the mean
 * 1 / (n - 4), and weights from n pairs add 1 / (n - 2). The fold has a strip of 2.5 % of the
 * samples in which the cheapest level has not jumped yet, by 3: it makes 9 * 0.025 of the variance.
 * A pilot without one of them, which is one in 0.975^-n, takes no further samples for it.
 */
static double expected_variance(const problem *p)
{
    double n = PILOT, ratio = (n - 2) / (n - 4) * (1 + 1 / (n - 2));
    double strip = gsl_cdf_ugaussian_Q(0.9) - gsl_cdf_ugaussian_Q(1), missed = pow(1 - strip, n);
    double left = 9 * strip / (p->deviation * p->deviation);
    return p->answer == fold ? ratio * (1 + missed * left * PLAIN / n) : ratio;
}

/* Whether the standard error of the mean of a ladder is that of the plain samples. */
static void judge_error(const problem *p, const char *how, const tally *t, double spent)
{
    double plain = p->deviation * p->deviation / PLAIN, repeats = (double)t->repeats;
    double square = t->squares / repeats;
    double error = sqrt((t->fourths / repeats - square * square) / repeats);
    double most = expected_variance(p) + gsl_cdf_ugaussian_Qinv(risk) * error / plain;
    printf("%-8s %-8s variance over that of %d plain samples %.3f at the cost of %.0f\n", p->name,
           how, PLAIN, square / plain, spent);
    check(square / plain < most, "the variance against that of plain samples", square / plain, 0,
          most);
}

static void repeat(const problem *p, int repeats, bool ladder, estimate_aim aim, gsl_rng *rng,
                   double *const *values, double *numbers)
{
    static const double cost[] = {1, 0.05, 0.005};
    const char *how = !ladder ? "plain" : aim == ESTIMATE_MEAN ? "mean" : "all";
    tally t[] = {{.what = "mean", .truth = p->mean},
                 {.what = "deviation", .truth = p->deviation},
                 {.what = "median", .truth = p->median},
                 {.what = "90 %", .truth = p->p90},
                 {.what = "probability", .truth = p->probability}};
    double spent = 0;
    for (int r = 0; r < repeats; r++) {
        estimate_samples s = {.levels = 1, .count = {PLAIN}, .values = {values[0]}};
        size_t drawn = ladder ? PILOT : 0;
        draw(rng, p, 0, drawn, values, numbers);
        if (ladder) {
            estimate_pilot pilot = {.levels = LEVELS,
                                    .count = PILOT,
                                    .values = {values[0], values[1], values[2]},
                                    .inputs = 2,
                                    .numbers = numbers};
            estimate_plan plan = estimate_allocate(&pilot, cost, PLAIN, aim);
            s = (estimate_samples){.levels = plan.levels};
            for (size_t k = 0; k < plan.levels; k++) {
                s.count[k] = plan.count[k];
                s.values[k] = values[plan.level[k]];
            }
            spent += plan.cost / repeats;
        }
        s.inputs = aim == ESTIMATE_MEAN ? 2 : 0;
        s.numbers = numbers;
        draw(rng, p, drawn, s.count[s.levels - 1], values, numbers);
        count(&t[0], estimate_mean(&s));
        count(&t[1], estimate_deviation(&s));
        count(&t[2], estimate_percentile(&s, 0.5));
        count(&t[3], estimate_percentile(&s, 0.9));
        count(&t[4], estimate_probability(&s, p->limit));
    }
    for (size_t i = 0; i < (ladder && aim == ESTIMATE_MEAN ? 2 : 5); i++)
        judge(p->name, how, &t[i], i == 0 || i == 4);
    if (ladder)
        judge_error(p, how, &t[0], spent);
}

static void repeat_sobol(const problem *p, int repeats, gsl_rng *rng)
{
    tally first = {.what = "first index", .truth = p->first};
    tally total = {.what = "total index", .truth = p->total};
    for (int r = 0; r < repeats; r++) {
        double a[SOBOL], b[SOBOL], c[2 * SOBOL];
        estimate s[2], t[2];
        for (size_t i = 0; i < SOBOL; i++) {
            double x = gsl_ran_gaussian(rng, 1), y = gsl_ran_gaussian(rng, 1);
            double u = gsl_ran_gaussian(rng, 1), v = gsl_ran_gaussian(rng, 1);
            a[i] = p->answer(x, y, 0);
            b[i] = p->answer(u, v, 0);
            c[i] = p->answer(u, y, 0);
            c[SOBOL + i] = p->answer(x, v, 0);
        }
        estimate_sobol(a, b, c, SOBOL, 2, (uint64_t)r, s, t);
        count(&first, s[0]);
        count(&total, t[0]);
    }
    judge(p->name, "sobol", &first, false);
    judge(p->name, "sobol", &total, false);
}

/* 25 inputs that add up, by 16 rows: what chance makes of them is no share, and an inert one of the
   two that matter of a few rows has none. */
static void test_shares(void)
{
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    enum { ROWS = 16, INPUTS = 25 };
    double a[ROWS], b[ROWS], c[INPUTS * ROWS], x[ROWS][INPUTS], y[ROWS][INPUTS];
    estimate first[INPUTS], total[INPUTS];
    double sum = 0, raw = 0;
    for (size_t i = 0; i < ROWS; i++) {
        a[i] = b[i] = 0;
        for (size_t g = 0; g < INPUTS; g++) {
            a[i] += x[i][g] = gsl_ran_gaussian(rng, 1);
            b[i] += y[i][g] = gsl_ran_gaussian(rng, 1);
        }
        for (size_t g = 0; g < INPUTS; g++)
            c[g * ROWS + i] = a[i] - x[i][g] + y[i][g];
    }
    gsl_rng_free(rng);
    size_t rows = estimate_sobol(a, b, c, ROWS, INPUTS, 1, first, total);
    check(rows == ROWS, "rows that count", (double)rows, ROWS, ROWS);
    for (size_t g = 0; g < INPUTS; g++)
        raw += fabs(first[g].value - total[g].value) / INPUTS;
    check(raw > 0.02, "chance moves first indices", raw, 0.02, 1);
    estimate_tell_shares(first, total, INPUTS, rows);
    for (size_t g = 0; g < INPUTS; g++) {
        sum += isfinite(first[g].value) ? first[g].value : 0;
        check(!(first[g].value > total[g].value), "first index within its total", first[g].value, 0,
              total[g].value);
        check(total[g].value >= 0 && total[g].high <= 1, "total index", total[g].value, 0, 1);
    }
    check(sum <= 1.5, "sum of what is told", sum, 0, 1.5);
    for (size_t i = 0; i < ROWS; i++) {
        a[i] = x[i][0];
        b[i] = y[i][0];
        c[i] = y[i][0];
        c[ROWS + i] = x[i][0];
    }
    rows = estimate_sobol(a, b, c, ROWS, 2, 1, first, total);
    estimate_tell_shares(first, total, 2, rows);
    check(first[0].value > 0.49, "the one that matters is told", first[0].value, 0.49, 1);
    check(first[1].value == 0 && total[1].value == 0, "an inert one has 0", first[1].value, 0, 0);
}

/* 16 rows tell no share below 1.96 / sqrt(16) = 0.49, one above its total is clipped to it, and
   shares whose sum is above 1 by more than 0.49 are not told. */
static void test_withheld(void)
{
    enum { GROUPS = 4, ROWS = 16 };
    static const struct {
        double first[GROUPS], total[GROUPS], told[GROUPS]; /* NaN: not told */
    } cases[] = {
        {{0.9, 0.48, 0.7, -0.3}, {0.6, 0.9, 0.45, 0}, {0.6, (double)NAN, (double)NAN, 0}},
        {{0.8, 0.65, 0, 0}, {0.9, 0.9, 0, 0}, {0.8, 0.65, 0, 0}},
        {{0.8, 0.75, 0, 0}, {0.9, 0.9, 0, 0}, {(double)NAN, (double)NAN, 0, 0}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        estimate first[GROUPS], total[GROUPS];
        for (size_t g = 0; g < GROUPS; g++) {
            double f = cases[i].first[g], t = cases[i].total[g];
            first[g] = (estimate){.value = f, .low = f - 0.1, .high = f + 0.1};
            total[g] = (estimate){.value = t, .low = t, .high = t};
        }
        estimate_tell_shares(first, total, GROUPS, ROWS);
        for (size_t g = 0; g < GROUPS; g++) {
            double value = first[g].value, told = cases[i].told[g];
            check(isnan(told) ? isnan(value) : value == told, "what is told of a share", value,
                  told, told);
        }
    }
}

/* Where all but one of the further samples failed, that one counts. */
static void test_one_left(void)
{
    double values[16];
    for (int i = 0; i < 16; i++)
        values[i] = i < 9 ? i : (double)NAN;
    const estimate_samples s = {.levels = 2, .count = {8, 16}, .values = {values, values}};
    double mean = estimate_mean(&s).value;
    check(fabs(mean - 4) < 1e-12, "one sample left of a level", mean, 4, 4);
}

/* Two samples are as far from their mean as each other, which tells nothing of the spread. */
static void test_two(void)
{
    const double values[] = {1, 2.1};
    const estimate_samples s = {.levels = 1, .count = {2}, .values = {values}};
    estimate e = estimate_deviation(&s);
    check(!(e.low > 0) && isinf(e.high), "deviation of two samples", e.low, 0, 0);
}

/* The argument is the number of repeats: 200. */
int main(int argc, char **argv)
{
    int repeats = argc > 1 ? atoi(argv[1]) : 200;
    test_shares();
    test_withheld();
    test_one_left();
    test_two();
    problem problems[] = {
        {.name = "linear", .answer = linear, .limit = 1, .first = 0.8, .total = 0.8},
        {.name = "product", .answer = product, .limit = 2, .first = 4 / 9., .total = 5 / 9.},
        {.name = "fold", .answer = fold, .limit = 1},
    };
    double *values[LEVELS], *numbers = malloc(2 * ROOM * sizeof *numbers);
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    for (int k = 0; k < LEVELS; k++)
        values[k] = malloc(ROOM * sizeof **values);
    problem *p = problems;
    p->mean = p->median = 3;
    p->deviation = sqrt(5);
    p->p90 = 3 + p->deviation * gsl_cdf_ugaussian_Pinv(0.9);
    p->probability = gsl_cdf_ugaussian_P((p->limit - 3) / p->deviation);
    p++;
    p->mean = 4;
    p->deviation = 3; /* var = 4 + 4 + 1 */
    p->median = solve(product_below, 0.5, 0, 10);
    p->p90 = solve(product_below, 0.9, 0, 30);
    p->probability = product_below(p->limit);
    p++;
    double q = gsl_cdf_ugaussian_Q(1), density = gsl_ran_ugaussian_pdf(1);
    p->mean = 3 * q;
    /* x / 4 and the jump: cov(x, x > 1) = density(1) */
    p->deviation = sqrt(0.25 + 1 / 16. + 9 * q * (1 - q) + 2 * 3 / 4. * density);
    p->median = solve(fold_below, 0.5, -2, 5);
    p->p90 = solve(fold_below, 0.9, -2, 8);
    p->probability = fold_below(p->limit);
    p->first = 1 - 0.25 / (p->deviation * p->deviation);
    p->total = p->first;
    for (size_t i = 0; i < sizeof problems / sizeof *problems; i++) {
        repeat(&problems[i], repeats, false, ESTIMATE_MEAN, rng, values, numbers);
        repeat(&problems[i], repeats, true, ESTIMATE_MEAN, rng, values, numbers);
        repeat(&problems[i], repeats, true, ESTIMATE_DISTRIBUTION, rng, values, numbers);
        repeat_sobol(&problems[i], repeats, rng);
    }
    for (int k = 0; k < LEVELS; k++)
        free(values[k]);
    free(numbers);
    gsl_rng_free(rng);
    return failures > 0;
}
