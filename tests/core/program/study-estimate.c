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

/* of each problem: 5 intervals plainly, 2 and 5 of ladders, 6 of shares; 5 means; 2 errors; of
   inert inputs; a mean and 6 shares of few samples */
enum { CHECKS = 3 * (18 + 5 + 2) + 8, RISK = 100 };
static const double risk = 1.0 / RISK / CHECKS;

enum { LEVELS = 3, PILOT = 60, PLAIN = 400, ROOM = 200000, FEW = 16 };

static const estimate_input normal[] = {{.group = 0}, {.group = 1}};

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

/* A percentile is biased by the order of 1 / n, as that of every sample is. Intervals that also
   hold what a surface lacks are wide: they may hold more often. */
static void judge(const char *name, const char *how, const tally *t, bool unbiased, bool wide)
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
    check((double)t->held >= least && (exact || wide || (double)t->held <= most), what,
          (double)t->held, least, most);
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
                                    .input = normal,
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
        s.input = normal;
        s.numbers = numbers;
        draw(rng, p, drawn, s.count[s.levels - 1], values, numbers);
        count(&t[0], estimate_mean(&s));
        count(&t[1], estimate_deviation(&s));
        count(&t[2], estimate_percentile(&s, 0.5));
        count(&t[3], estimate_percentile(&s, 0.9));
        count(&t[4], estimate_probability(&s, p->limit));
    }
    for (size_t i = 0; i < (ladder && aim == ESTIMATE_MEAN ? 2 : 5); i++)
        judge(p->name, how, &t[i], i == 0 || i == 4, false);
    if (ladder)
        judge_error(p, how, &t[0], spent);
}

static void repeat_shares(const problem *p, int repeats, size_t samples, gsl_rng *rng,
                          double *const *values, double *numbers)
{
    tally first = {.what = "first index", .truth = p->first};
    tally total = {.what = "total index", .truth = p->total};
    char how[20];
    snprintf(how, sizeof how, "%zu", samples);
    for (int r = 0; r < repeats; r++) {
        estimate s[2], t[2];
        draw(rng, p, 0, samples, values, numbers);
        estimate_shares(values[0], numbers, samples, normal, 2, 2, s, t);
        if (isnan(s[0].value)) /* not told */
            continue;
        count(&first, s[0]);
        count(&total, t[0]);
    }
    judge(p->name, how, &first, false, true);
    judge(p->name, how, &total, false, true);
}

/* Smooth, but no polynomial. */
static double curved(double x, double y, int level)
{
    (void)level;
    return 3 * exp(x / 3) + y + x * y / 5;
}

/* The mean of so few samples that a surface would choose its terms by them, and of twice as many.
 */
static void repeat_few(int repeats, size_t samples, gsl_rng *rng, double *const *values,
                       double *numbers)
{
    double spread = 9 * exp(1 / 9.) * (exp(1 / 9.) - 1), whole = spread + 1 + 1 / 25.;
    const problem p = {.name = "curved",
                       .answer = curved,
                       .first = spread / whole,
                       .total = (spread + 1 / 25.) / whole};
    tally mean = {.what = "mean", .truth = 3 * exp(1 / 18.)};
    for (int r = 0; r < repeats; r++) {
        draw(rng, &p, 0, samples, values, numbers);
        const estimate_samples s = {
            .levels = 1, .count = {samples}, .values = {values[0]}, 2, normal, numbers};
        count(&mean, estimate_mean(&s));
    }
    judge(p.name, samples > FEW ? "few" : "fewest", &mean, false, false);
    for (size_t n = samples; n <= 16 * FEW; n *= 4)
        repeat_shares(&p, repeats, n, rng, values, numbers);
}

static void draw_numbers(gsl_rng *rng, double *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++)
        numbers[i] = gsl_ran_gaussian(rng, 1);
}

/* FEW samples of eight inputs, of which two matter: through a surface that there is the others get
   0, and where a wave is left over their intervals begin at 0 as often as 95 % say. */
static void test_inert(gsl_rng *rng, int repeats)
{
    enum { INPUTS = 8 };
    estimate_input inputs[INPUTS] = {{.group = 0}};
    double numbers[INPUTS * FEW], flat[FEW], wave[FEW];
    size_t from_zero = 0, inert = 0;
    for (size_t k = 0; k < INPUTS; k++)
        inputs[k].group = k;
    for (int r = 0; r < repeats; r++) {
        estimate first[INPUTS], total[INPUTS];
        draw_numbers(rng, numbers, INPUTS * FEW);
        for (size_t i = 0; i < FEW; i++) {
            const double *x = numbers + i * INPUTS;
            flat[i] = 1 + 3 * x[2] - 4 * x[5];
            wave[i] = flat[i] + sin(4 * x[2] + 2 * x[5]);
        }
        estimate_shares(flat, numbers, FEW, inputs, INPUTS, INPUTS, first, total);
        for (size_t k = 0; k < INPUTS; k++) {
            double truth = k == 2 ? 0.36 : k == 5 ? 0.64 : 0;
            check(fabs(first[k].value - truth) < 1e-9, "share of a plane", first[k].value, truth,
                  truth);
            check(fabs(total[k].high - truth) < 1e-9, "its bar", total[k].high, truth, truth);
        }
        estimate_shares(wave, numbers, FEW, inputs, INPUTS, INPUTS, first, total);
        for (size_t k = 0; k < INPUTS; k++)
            if (k != 2 && k != 5 && !isnan(first[k].value)) {
                from_zero += first[k].low <= 0;
                inert++;
            }
    }
    printf("inert inputs by %d samples: 0 is in %zu of %zu intervals\n", FEW, from_zero, inert);
    double least = held_bound(false, inert);
    check((double)from_zero >= least, "inert inputs whose interval holds 0", (double)from_zero,
          least, (double)inert);
}

/* Ishigami & Homma 1990: sin x + 7 sin^2 y + 0.1 z^4 sin x, each between -pi and pi. */
static void test_ishigami(gsl_rng *rng)
{
    enum { SAMPLES = 1000 };
    static const double first[] = {0.3139, 0.4424, 0}, total[] = {0.5576, 0.4424, 0.2437};
    const estimate_input even[] = {
        {0, ESTIMATE_EVEN, 0, NULL}, {1, ESTIMATE_EVEN, 0, NULL}, {2, ESTIMATE_EVEN, 0, NULL}};
    double *numbers = malloc(3 * SAMPLES * sizeof *numbers), values[SAMPLES];
    const double pi = acos(-1);
    estimate s[3], t[3];
    draw_numbers(rng, numbers, 3 * SAMPLES);
    for (size_t i = 0; i < SAMPLES; i++) {
        double x[3];
        for (size_t k = 0; k < 3; k++)
            x[k] = pi * (2 * gsl_cdf_ugaussian_P(numbers[3 * i + k]) - 1);
        values[i] = sin(x[0]) + 7 * pow(sin(x[1]), 2) + 0.1 * pow(x[2], 4) * sin(x[0]);
    }
    estimate_shares(values, numbers, SAMPLES, even, 3, 3, s, t);
    for (size_t k = 0; k < 3; k++) {
        printf("Ishigami, input %zu: %.4f (%.4f to %.4f), with others %.4f (%.4f to %.4f)\n", k + 1,
               s[k].value, s[k].low, s[k].high, t[k].value, t[k].low, t[k].high);
        check(fabs(s[k].value - first[k]) < 0.01, "Ishigami alone", s[k].value, first[k], first[k]);
        check(fabs(t[k].value - total[k]) < 0.01, "Ishigami", t[k].value, total[k], total[k]);
        check(s[k].low <= first[k] && first[k] <= s[k].high, "Ishigami's bar alone", first[k],
              s[k].low, s[k].high);
        check(t[k].low <= total[k] && total[k] <= t[k].high, "Ishigami's bar", total[k], t[k].low,
              t[k].high);
    }
    free(numbers);
}

/* Two of three starts from below, beside an input between two ends: any answer by the word has a
   surface, as has a parabola. One word more that no sample has leaves it to the others. */
static void test_shapes(gsl_rng *rng)
{
    enum { SAMPLES = 40 };
    static const size_t step[] = {0, 1, 0, 2};
    const estimate_input inputs[] = {{0, ESTIMATE_STEPS, 4, step}, {1, ESTIMATE_EVEN, 0, NULL}};
    static const double by_word[] = {0, 3, 10}; /* mean 3.25, variance 109 / 4 - 3.25^2 */
    double numbers[2 * SAMPLES], values[SAMPLES], part[SAMPLES];
    estimate s[2], t[2];
    draw_numbers(rng, numbers, 2 * SAMPLES);
    for (size_t i = 0; i < SAMPLES; i++) {
        double y = 2 * gsl_cdf_ugaussian_P(numbers[2 * i + 1]) - 1;
        size_t at = (size_t)(4 * gsl_cdf_ugaussian_P(numbers[2 * i]));
        values[i] = by_word[step[at]] + 9 * y * y; /* mean 3, variance 81 (1 / 5 - 1 / 9) */
    }
    double word = 109 / 4. - 3.25 * 3.25, parabola = 81 * (1 / 5. - 1 / 9.);
    estimate_shares(values, numbers, SAMPLES, inputs, 2, 2, s, t);
    check(fabs(s[0].value - word / (word + parabola)) < 1e-9, "share of words", s[0].value, 0, 1);
    check(fabs(t[1].high - parabola / (word + parabola)) < 1e-9, "share of ends", t[1].high, 0, 1);
    estimate_explained(values, numbers, SAMPLES, inputs, 2, part);
    for (size_t i = 0; i < SAMPLES; i++)
        check(fabs(values[i] - part[i] - 6.25) < 1e-9, "value without what is explained",
              values[i] - part[i], 6.25, 6.25);
    estimate_shares(values, numbers, 5, inputs, 2, 2, s, t);
    check(isnan(s[0].value) && isnan(t[0].value), "share by 5 samples", s[0].value, 0, 0);
}

/* Samples that no surface is fitted to have what it says of them. */
static void test_many(gsl_rng *rng)
{
    enum { SAMPLES = 3000 };
    double *numbers = malloc(2 * SAMPLES * sizeof *numbers), values[SAMPLES];
    draw_numbers(rng, numbers, 2 * SAMPLES);
    for (size_t i = 0; i < SAMPLES; i++)
        values[i] = i % 7 ? 2 + numbers[2 * i] * numbers[2 * i + 1] : (double)NAN;
    const estimate_samples s = {
        .levels = 1, .count = {SAMPLES}, .values = {values}, 2, normal, numbers};
    estimate e = estimate_mean(&s);
    check(fabs(e.value - 2) < 1e-12 && e.high - e.low < 1e-9, "mean of a saddle", e.value, 2, 2);
    free(numbers);
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
    test_inert(rng, repeats);
    test_ishigami(rng);
    test_shapes(rng);
    test_many(rng);
    repeat_few(repeats, 2 * FEW, rng, values, numbers);
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
        for (size_t samples = FEW; samples <= 16 * FEW; samples *= 4)
            repeat_shares(&problems[i], repeats, samples, rng, values, numbers);
    }
    repeat_few(repeats, FEW, rng, values, numbers);
    for (int k = 0; k < LEVELS; k++)
        free(values[k]);
    free(numbers);
    gsl_rng_free(rng);
    return failures > 0;
}
