/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stands under `study:` as axes and points; the Sobol sequence. */
#include "../../../core/program/study/kinds/kinds.h"
#include "../../../core/program/study/kinds/uncertainty/tolerances.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static ff_engine *engine;
static ff_run *run;
static ff_report *report;

static ff_run *parse(const char *text)
{
    ff_run *read;
    if (!engine)
        ff_engine_new(NULL, &engine);
    ff_run_parse(engine, "study.yaml", ".", text, &read);
    return read;
}

static study_definition *read_study(const char *text)
{
    run = parse(text);
    report = ff_run_report(run);
    return study_read(ff_node_get(ff_run_root(run), "study"), report);
}

static void forget(study_definition *study)
{
    study_free(study);
    ff_run_close(run);
}

static void expect_values(const char *what, const char *range, const char *const *values,
                          size_t count)
{
    char text[256];
    snprintf(text, sizeof text, "study: {sweep: {a.b: %s}}", range);
    study_definition *study = read_study(text);
    check_true(what, study && study->axis_count == 1 && study->count == count);
    for (size_t i = 0; study && i < count && i < study->count; i++)
        check_true(values[i], !strcmp(study_value(study, 0, i), values[i]));
    forget(study);
}

static void test_ranges(void)
{
    expect_values("linear", "{from: 400 Hz, to: 1 kHz, points: 4}",
                  (const char *const[]){"400 Hz", "600 Hz", "800 Hz", "1000 Hz"}, 4);
    expect_values("logarithmic", "{from: 128, to: 1024, points: 4, spacing: log}",
                  (const char *const[]){"128", "256", "512", "1024"}, 4);
    expect_values("tenths", "{from: 0, to: 0.3, points: 4, spacing: linear}",
                  (const char *const[]){"0", "0.1", "0.2", "0.3"}, 4);
    expect_values("downwards", "{from: 100 degC, to: 40 degC, points: 3}",
                  (const char *const[]){"100 degC", "70 degC", "40 degC"}, 3);
    expect_values("a list", "[1 mm, \"a, b\", {x: [1, 2], y: 'it''s'}]",
                  (const char *const[]){"1 mm", "\"a, b\"", "{x: [1, 2], y: \"it's\"}"}, 3);
}

static void test_product(void)
{
    study_definition *study = read_study("study:\n  sweep: {a: [1, 2], b: [x, y, z]}\n"
                                         "  zip: {c: [3, 4], d: [5, 6]}\n");
    check_true("cases", study && study->count == 12);
    check_true("zipped", !strcmp(study_assignment(study, 3, 11), "d=6"));
    check_true("crossed", !strcmp(study_assignment(study, 1, 4), "b=z"));
    forget(study);
}

/* Each case is in one chain, at one position; neighbours differ by one step of the followed axis.
 */
static void check_chains(const char *follow, bool falling)
{
    enum { CASES = 60 };
    char text[200];
    snprintf(text, sizeof text,
             "study: {sweep: {a: [1, 2, 3], f: {from: %d, to: %d, points: 5, follow: %s}, "
             "b: [x, y]}}",
             falling ? 5 : 1, falling ? 1 : 5, follow);
    study_definition *study = read_study(text);
    bool both = !strcmp(follow, "both"), seen[CASES] = {false};
    size_t chains = both ? 12 : 6;
    check_true(follow, study && study->count == 5 * chains && study_chains(study) == chains &&
                           study_chain_length(study) == 5);
    for (size_t c = 0; study && c < chains; c++)
        for (size_t i = 0; i < 5; i++) {
            size_t index = study_chain_case(study, c, i), first = study_chain_case(study, c, 0);
            size_t f = both ? 2 : 1; /* path number of the range, and of its neighbours */
            bool down =
                both ? !strcmp(study_value(study, 1, index), "down") : !strcmp(follow, "down");
            double value = strtod(study_value(study, f, index), NULL);
            check_true("once", !seen[index]);
            seen[index] = true;
            check_near("in order", value, down ? 5 - (double)i : 1 + (double)i, 0);
            for (size_t k = 0; k < study->varied_count; k++)
                check_true("alike but for that", k == f || !strcmp(study_value(study, k, index),
                                                                   study_value(study, k, first)));
        }
    forget(study);
}

static void test_chains(void)
{
    static const char *const ways[] = {"up", "down", "both"};
    for (size_t i = 0; i < 6; i++)
        check_chains(ways[i / 2], i % 2);
}

static void test_sample(void)
{
    study_definition *study =
        read_study("study:\n  sample: {sobol: 8, seed: 3}\n"
                   "  sweep: {a: {from: 0, to: 1}, l: [p, q], b: {from: 10 mm, to: 20 mm}}\n");
    check_true("a sample is crossed with lists", study && study->count == 16);
    for (size_t i = 0; i < 16; i++) {
        const char *b = study_value(study, 2, i);
        double at = strtod(study_value(study, 0, i), NULL), width = strtod(b, NULL);
        check_true("inside", at >= 0 && at < 1 && width >= 10 && width < 20 && strstr(b, " mm"));
    }
    check_true("drawn", !strcmp(study_value(study, 0, 2), study_value(study, 0, 3)) &&
                            strcmp(study_value(study, 0, 2), study_value(study, 0, 4)) != 0);
    forget(study);
}

/* Of the first 2^k points each of 2^k equal intervals holds one, in every dimension. */
static void test_strata(uint64_t seed)
{
    enum { POINTS = 1024 };
    for (uint32_t d = 0; d < STUDY_SOBOL_DIMENSIONS; d++) {
        bool seen[POINTS] = {false}, all = true;
        for (uint32_t i = 0; i < POINTS; i++)
            seen[(int)(study_sobol(i, d, seed) * POINTS)] = true;
        for (uint32_t i = 0; i < POINTS; i++)
            all = all && seen[i];
        check_true("strata", all);
    }
}

/* Mean of prod (1 + (x_d - 1/2)/(d + 1)), exactly 1; Monte Carlo would be off by about 1e-2. */
static void test_integral(void)
{
    enum { POINTS = 4096 };
    double sum = 0;
    for (uint32_t i = 0; i < POINTS; i++) {
        double product = 1;
        for (uint32_t d = 0; d < 8; d++)
            product *= 1 + (study_sobol(i, d, 7) - 0.5) / (d + 1);
        sum += product / POINTS;
    }
    check_near("integral", sum, 1, 1e-3);
}

/* No two dimensions are alike: each pair's first 1024 points fill 16 x 16 boxes evenly enough. */
static void test_pairs(void)
{
    for (uint32_t a = 0; a < STUDY_SOBOL_DIMENSIONS; a++)
        for (uint32_t b = 0; b < a; b++) {
            double correlation = 0;
            for (uint32_t i = 0; i < 1024; i++)
                correlation +=
                    12 * (study_sobol(i, a, 0) - 0.5) * (study_sobol(i, b, 0) - 0.5) / 1024;
            check_true("pairs", fabs(correlation) < 0.1);
        }
}

/* Values of lists have one, and those of the model that is used. */
static void test_tolerances(void)
{
    static const char *const paths[] = {"g.d", "g.l.0", "g.s", "g.with.a/b.p"};
    memory_arena arena = {0};
    size_t count;
    ff_run *file = parse(
        "pipeline:\n  g: {use: a/b, d: 3 mm +- 1 mm, l: [5 um to 7 um, 2 um], s: 1 to 2, t: 2 mm,\n"
        "      with: {a/b: {p: 1 +- 0.5}, a/c: {p: 1 +- 0.5}}}\n");
    const study_toleranced *list = study_find_toleranced(ff_run_root(file), &arena, &count);
    check_true("four values", count == 4);
    for (size_t i = 0; i < count && i < 4; i++)
        check_true(paths[i], !strcmp(list[i].path, paths[i]));
    check_true("their ends", list[1].tolerance.low == 5 && list[1].tolerance.high == 7);
    memory_arena_free(&arena);
    ff_run_close(file);
}

int main(void)
{
    test_tolerances();
    test_ranges();
    test_product();
    test_chains();
    test_sample();
    test_strata(0);
    test_strata(5);
    test_integral();
    test_pairs();
    return check_done();
}
