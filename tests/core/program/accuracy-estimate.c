/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors estimated from answers whose errors are known. */
#include "../../../core/program/accuracy/estimate.h"
#include "../../../core/program/accuracy/lines.h"

#include <check.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 201 };
static const double safety = 1.25; /* Roache's, as the estimate has it */

/* Returns the order; no settings are told apart. */
static double estimate(const accuracy_ladder *l, double *error)
{
    double none;
    return accuracy_estimate(l, error, &none);
}

/* The exact answer is 1; its error at a level is c 2^(order level). */
static double answer_at(double c, double order, double level)
{
    return 1 + c * exp2(order * level);
}

/* With the order that it shows, the estimate is the error, times the factor of safety. */
static void test_orders(void)
{
    static const double orders[] = {0.5, 1, 1.5, 2};
    for (int i = 0; i < 4; i++) {
        double p = orders[i], c = 1e-3, error;
        double answer = answer_at(c, p, 0), half = answer_at(c, p, 1), quarter = answer_at(c, p, 2);
        accuracy_ladder l = {.count = 1, .answer = &answer, .half = &half, .quarter = &quarter};
        check_near("order", estimate(&l, &error), p, 1e-9);
        check_near("error", error, safety * c, 1e-9);
    }
}

/* The error of an answer whose levels show order p, over that of order 1, of one number and of two
   alike, where two levels differ by what order p makes of it. */
static void check_high_order(double p, double factor_of_one, double factor_of_two)
{
    double answer[2], half[2], quarter[2], error[2];
    for (int i = 0; i < 2; i++) {
        answer[i] = answer_at(1e-3, p, 0);
        half[i] = answer_at(1e-3, p, 1);
        quarter[i] = answer_at(1e-3, p, 2);
    }
    accuracy_ladder l = {.count = 1, .answer = answer, .half = half, .quarter = quarter};
    double near = fmax(half[0] - answer[0], (quarter[0] - half[0]) / fmin(exp2(p), 16));
    check_near("order", estimate(&l, error), p, 1e-9);
    check_near("error of one", error[0], safety * factor_of_one * near, 1e-9);
    l.count = 2;
    check_near("order", estimate(&l, error), p, 1e-9);
    check_near("error of two", error[1], safety * factor_of_two * near, 1e-9);
}

/* Above order 2 the rest falls as much more slowly, to order 1 of a number and 3/2 of a series;
   what lies above order 4 is none. */
static void test_high_orders(void)
{
    check_high_order(2.25, 1 / (exp2(1.75) - 1), 1 / (exp2(1.75) - 1));
    check_high_order(2.75, 1 / (exp2(1.25) - 1), 1 / (exp2(1.5) - 1));
    check_high_order(3, 1, 1 / (exp2(1.5) - 1));
    check_high_order(3.9, 1, 1 / (exp2(1.5) - 1));
    check_high_order(5, 1, 1);
}

/* No order, or two levels: three times what lies between them, as Roache has it. */
static void test_two_levels(void)
{
    double answer = 1, half = 1.01, error;
    accuracy_ladder l = {.count = 1, .answer = &answer, .half = &half};
    check_true("no order", isnan(estimate(&l, &error)));
    check_near("three times", error, 0.03, 0.01);
    l = (accuracy_ladder){.count = 1, .answer = &answer, .quarter = &half};
    check_true("no order", isnan(estimate(&l, &error)));
    check_near("of two levels", error, safety * 0.01, 1e-9);
    double twice = 0.99;
    l = (accuracy_ladder){.count = 1, .answer = &answer, .twice = &twice};
    check_true("no order", isnan(estimate(&l, &error)));
    check_true("that and the rest", error > safety * 0.01 * 1.5 && error < 0.05);
}

/* Where a coarser answer is missing, a finer one tells as much. */
static void test_a_finer_level(void)
{
    double c = 1e-2, twice = answer_at(c, 2, -1), answer = answer_at(c, 2, 0),
           half = answer_at(c, 2, 1), error;
    accuracy_ladder l = {.count = 1, .answer = &answer, .half = &half, .twice = &twice};
    check_near("order", estimate(&l, &error), 2, 1e-9);
    check_near("error", error, safety * c, 1e-9);
}

/* An answer that overshoots from level to level has no order; the bar still holds it, also where
   what lies between the levels does not fall. */
static void test_oscillation(void)
{
    double answer = 1.001, half = 0.998, quarter = 1.004, error;
    accuracy_ladder l = {.count = 1, .answer = &answer, .half = &half, .quarter = &quarter};
    estimate(&l, &error);
    check_true("the error is held", error >= 0.001);
    check_true("and not lost", error < 0.01);
    quarter = 1.0005;
    estimate(&l, &error);
    check_near("as two levels have it", error, 0.009, 0.01);
}

/* Errors of two settings that cancel in the answers are both counted, and told apart. */
static void test_cancelling_settings(void)
{
    double c = 1e-3, answer = 1, half = 1, quarter = 1, error;
    double one = 1 - 12 * c, other = 1 + 12 * c, shares[2]; /* of 16 c - 4 c, from level 2 to 1 */
    const double *refined[] = {&one, &other};
    accuracy_ladder l = {.count = 1,
                         .answer = &answer,
                         .half = &half,
                         .quarter = &quarter,
                         .refined = refined,
                         .refined_count = 2};
    accuracy_estimate(&l, &error, shares);
    check_true("neither is lost", error >= c);
    check_near("halves", shares[0], 0.5, 1e-9);
    check_near("halves", shares[1], 0.5, 1e-9);
}

/* The error of a series passes through zero, and its differences do so elsewhere. */
static void test_series(void)
{
    double answer[POINTS], half[POINTS], quarter[POINTS], error[POINTS];
    int held = 0;
    for (int i = 0; i < POINTS; i++) {
        double x = 0.05 * i, wave = sin(x), late = sin(x + 0.05), later = sin(x + 0.1);
        answer[i] = 1e-3 * wave;
        half[i] = 4e-3 * late;
        quarter[i] = 16e-3 * later;
    }
    accuracy_ladder l = {.count = POINTS, .answer = answer, .half = half, .quarter = quarter};
    check_near("order", estimate(&l, error), 2, 0.03);
    for (int i = 0; i < POINTS; i++)
        held += fabs(answer[i]) <= error[i];
    printf("points held: %d of %d\n", held, POINTS);
    check_true("at every point", held == POINTS);
    check_below("and not far off", error[31], 2.5e-3);
}

/* A jump converges by one order, along ever fewer points; the rest of the series keeps its own. */
static void test_jump(void)
{
    double answer[POINTS], half[POINTS], quarter[POINTS], error[POINTS];
    for (int i = 0; i < POINTS; i++) {
        answer[i] = 1e-3 + (i == 100);
        half[i] = 4e-3 + (i >= 100 && i < 102);
        quarter[i] = 16e-3 + (i >= 100 && i < 104);
    }
    accuracy_ladder l = {.count = POINTS, .answer = answer, .half = half, .quarter = quarter};
    check_near("the order beside it", estimate(&l, error), 2, 1e-6);
    check_near("the error there", error[20], safety * 1e-3, 1e-9);
    check_true("at it", error[101] >= 1);
    check_near("what is typical", accuracy_typical(error, NULL, POINTS), safety * 1e-3, 1e-9);
}

/* A jump that each level has elsewhere, at both ends of a part where the error is known: that part
   keeps its own error, although the neighbours of all jumps are more than 5 % of the series. */
static void test_moving_jumps(void)
{
    double answer[POINTS], half[POINTS], quarter[POINTS], error[POINTS];
    for (int i = 0; i < POINTS; i++) {
        int at = i % 100;
        answer[i] = 1 + 1e-3 + (at < 20);
        half[i] = 1 + 4e-3 + (at < 22);
        quarter[i] = 1 + 16e-3 + (at < 24);
    }
    accuracy_ladder l = {.count = POINTS, .answer = answer, .half = half, .quarter = quarter};
    estimate(&l, error);
    check_near("in between", error[19], safety * 1e-3, 1e-9);
    check_near("where a coarser level jumps", error[23], safety * 1e-3, 1e-9);
    check_true("at the jump", error[20] >= 1);
    check_near("what is typical", accuracy_typical(error, NULL, POINTS), safety * 1e-3, 1e-9);
}

/* What is typical is so relative to the scale of each number, as the error is. */
static void test_scales(void)
{
    double answer[POINTS], half[POINTS], quarter[POINTS], scale[POINTS], error[POINTS];
    for (int i = 0; i < POINTS; i++) {
        scale[i] = i % 10 ? 1 : 100;
        answer[i] = scale[i] * (1 + 1e-3);
        half[i] = scale[i] * (1 + 4e-3);
        quarter[i] = scale[i] * (1 + 16e-3);
    }
    accuracy_ladder l = {.count = POINTS,
                         .at = NULL,
                         .scale = scale,
                         .answer = answer,
                         .half = half,
                         .quarter = quarter};
    check_near("order", estimate(&l, error), 2, 1e-9);
    for (int i = 0; i < POINTS; i++)
        check_near("error", error[i], safety * 1e-3 * scale[i], 1e-9);
}

/* 95 % of the length, however the points lie; of few points all. */
static void test_typical(void)
{
    double values[40], at[40];
    for (int i = 0; i < 40; i++) {
        values[i] = i < 20 ? 1 : 40 - i; /* 20 to 1 in a stretch that is 1 % of the length */
        at[i] = i < 20 ? i : 19 + 0.01 * (i - 19);
    }
    check_near("by length", accuracy_typical(values, at, 40), 1, 1e-12);
    check_near("by number", accuracy_typical(values, NULL, 40), 18, 1e-12);
    check_near("of few", accuracy_typical(values + 20, NULL, 5), 20, 1e-12);
    check_near("of one", accuracy_typical(values + 39, NULL, 1), 1, 1e-12);
}

/* What no setting changes has no error. */
static void test_no_difference(void)
{
    double answer = 1, error, share = 1;
    const double *refined[] = {&answer};
    accuracy_ladder l = {.count = 1,
                         .answer = &answer,
                         .half = &answer,
                         .quarter = &answer,
                         .refined = refined,
                         .refined_count = 1};
    check_true("no order", isnan(accuracy_estimate(&l, &error, &share)));
    check_true("no error", error == 0 && share == 0);
}

static void check_words(const accuracy_record *record, double reached, double apart,
                        const char *words)
{
    const accuracy_error error = {.reached = reached, .twin_difference = apart};
    char *text = accuracy_print_check(record, &error);
    if (strcmp(text, words) != 0)
        printf("found: %s\n", text);
    check_true(words, !strcmp(text, words));
    free(text);
}

/* What a finer twin says, if there is one and it can be compared. */
static void test_words_of_a_check(void)
{
    const accuracy_record run = {.checked = true}, same = {.checked = true, .from_finer = true},
                          none = {.checked = true, .check_failure = "too many cells"};
    check_words(&run, 0.02, 0.01, "1 % from a twin a level finer");
    check_words(&run, 0.02, 0.03, "3 % from a twin a level finer: more than the stated error");
    check_words(&run, 0.02, NAN, "it cannot be compared with a finer run");
    check_words(&run, NAN, 0.01, "1 % from a twin a level finer; the error itself is not known");
    check_words(&same, 0.02, 0.01, "1 % from a twin a level finer, which also gave the error");
    check_words(&none, 0.02, NAN, "the finer run failed: too many cells");
}

int main(void)
{
    test_orders();
    test_high_orders();
    test_two_levels();
    test_a_finer_level();
    test_oscillation();
    test_cancelling_settings();
    test_series();
    test_jump();
    test_moving_jumps();
    test_scales();
    test_typical();
    test_no_difference();
    test_words_of_a_check();
    return check_done();
}
