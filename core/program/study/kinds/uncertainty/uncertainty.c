/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "uncertainty.h"

#include "../../../memory/memory.h"
#include "../../../run/run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const ff_param keys[STUDY_UNCERTAINTY_KEYS] = {
    [UNCERTAINTY_OUTPUTS] = {.name = "outputs",
                             .flags = FF_REQUIRED,
                             .doc = "list of scalars: [film.h_min_lowest]; the first one decides "
                                    "how many samples each level gets"},
    [UNCERTAINTY_INPUTS] = {.name = "inputs",
                            .doc =
                                "map from paths to {normal: [MEAN, SPREAD]}, {lognormal: [MEDIAN, "
                                "SPREAD]}, {uniform: [FROM, TO]} or {samples: FILE.csv or a "
                                "list}; with sets: [PATHS] one value for several. If missing: the "
                                "values of the pipeline that have a tolerance"},
    [UNCERTAINTY_CORRELATIONS] =
        {.name = "correlations",
         .doc = "list of [INPUT, INPUT, r]: correlations of the normal variates "
                "(Gaussian copula)"},
    [UNCERTAINTY_CONDITIONS] = {.name = "conditions",
                                .doc = "list of conditions whose probabilities are computed: "
                                       "[\"film.lambda_ratio_lowest < 1\"]"},
    [UNCERTAINTY_PERCENTILES] = {.name = "percentiles",
                                 .doc = "list of shares; if missing [5 %, 50 %, 95 %]"},
    [UNCERTAINTY_SAMPLES] = {.name = "samples",
                             .unit = "",
                             .type = FF_INT,
                             .preset = "100",
                             .min = 2,
                             .max = 1000000,
                             .doc = "number of samples of the file's model; with a ladder: the "
                                    "standard error of that many samples is reached"},
    [UNCERTAINTY_SEED] = {.name = "seed",
                          .unit = "",
                          .type = FF_INT,
                          .preset = "1",
                          .min = 0,
                          .max = 1000000,
                          .doc =
                              "seed of the random numbers; the same seed gives the same samples"},
    [UNCERTAINTY_LADDER] = {.name = "ladder",
                            .doc = "map from names to cheaper models, the cheapest last: {quick: "
                                   "{film.use: ehl/inlet-analysis, cost: 2 %}}"},
    [UNCERTAINTY_PILOT] = {.name = "pilot",
                           .unit = "",
                           .type = FF_INT,
                           .preset = "20",
                           .min = 5,
                           .max = 10000,
                           .doc = "number of first samples on every level of the ladder; they "
                                  "determine how many more are worth their cost"},
    [UNCERTAINTY_AIM] = {.name = "aim",
                         .unit = "",
                         .type = FF_CHOICE,
                         .preset = "mean",
                         .choices = "mean|distribution",
                         .doc = "results that a ladder must give as accurately as plain samples: "
                                "only the mean, or also percentiles and probabilities"},
    [UNCERTAINTY_SENSITIVITY] =
        {.name = "sensitivity",
         .unit = "",
         .type = FF_INT,
         .preset = "0",
         .min = 0,
         .max = 100000,
         .doc = "least number of samples of the cheapest level in use: a surface through them "
                "gives the share of each input in the variance"},
    [UNCERTAINTY_MODELS] = {.name = "models",
                            .doc = "map from names to other models or settings, tried at the "
                                   "medians: {thermal: {film.thermal: full}}"},
};

/* Returns the cost of a case of level 0. Stages shared by all samples, such as a mesh under one
 * torque, are computed once and do not count: the cases reuse them from the second one on. */
static double shared_seconds(const study_uncertainty *u)
{
    double least = INFINITY;
    for (size_t i = 1; i < u->pilot; i++)
        least =
            fmin(least, study_outcome_of(u->context, study_uncertainty_pilot_case(u, 0, i))->saved);
    return isfinite(least) ? least : 0;
}

/* Returns the median processor time of the cases of a level in the pilot. */
static double seconds_of(const study_uncertainty *u, size_t level)
{
    double shared = shared_seconds(u);
    double *all = memory_alloc(u->pilot * sizeof *all);
    size_t count = 0;
    for (size_t i = 0; i < u->pilot; i++) {
        const study_outcome *outcome =
            study_outcome_of(u->context, study_uncertainty_pilot_case(u, level, i));
        if (outcome->processor > 0)
            all[count++] = outcome->processor + fmax(0, outcome->saved - shared);
    }
    memory_sort(all, count, sizeof *all);
    double median = count ? all[count / 2] : (double)NAN;
    free(all);
    return median;
}

/* Sets the costs of the levels. Costs stated in the file give the same samples on every machine.
 * Measured costs are taken from the pilot's records, so that they stay the same when the study is
 * resumed, and rounded to 1, 2 or 5 times a power of ten. */
static void find_costs(study_uncertainty *u)
{
    for (size_t k = 0; k < u->level_count; k++)
        u->seconds[k] = seconds_of(u, k);
    for (size_t k = 0; k < u->level_count; k++) {
        double share = u->seconds[k] / u->seconds[0], power = pow(10, floor(log10(share)));
        double digit = share / power < 1.5   ? 1
                       : share / power < 3.5 ? 2
                       : share / power < 7.5 ? 5
                                             : 10;
        u->cost[k] = isfinite(u->levels[k].cost) ? u->levels[k].cost
                     : isfinite(share)           ? digit * power
                                                 : 1;
    }
}

/* Chooses the numbers of samples from the first output. */
static void plan_samples(study_uncertainty *u)
{
    double *values = memory_alloc(u->level_count * u->pilot * sizeof *values);
    double *numbers = variates_draw(&u->inputs, u->seed, u->pilot);
    estimate_pilot pilot = {.levels = u->level_count,
                            .count = u->pilot,
                            .inputs = u->inputs.count,
                            .input = u->shapes,
                            .numbers = numbers};
    for (size_t k = 0; k < u->level_count; k++) {
        pilot.values[k] = values + k * u->pilot;
        for (size_t i = 0; i < u->pilot; i++)
            values[k * u->pilot + i] =
                study_uncertainty_value(u, study_uncertainty_pilot_case(u, k, i), 0);
    }
    find_costs(u);
    u->plan = estimate_allocate(&pilot, u->cost, u->samples, u->aim);
    free(values);
    free(numbers);
}

static void add_for_shares(study_uncertainty *u)
{
    size_t last = u->plan.levels - 1, *count = &u->plan.count[last];
    if (*count >= u->sensitivity)
        return;
    u->plan.cost += (double)(u->sensitivity - *count) * u->cost[u->plan.level[last]];
    *count = u->sensitivity;
}

static void submit_main(study_uncertainty *u)
{
    size_t last = u->plan.count[u->plan.levels - 1];
    double *numbers = variates_draw(&u->inputs, u->seed, last);
    u->numbers =
        memory_arena_alloc(&u->context->arena, (last * u->inputs.count + 1) * sizeof *numbers);
    memcpy(u->numbers, numbers, last * u->inputs.count * sizeof *numbers);
    free(numbers);
    for (size_t slot = 0; slot < u->plan.levels; slot++) {
        const uncertainty_patch *level = &u->levels[u->plan.level[slot]];
        for (size_t i = u->pilot; i < u->plan.count[slot]; i++)
            study_uncertainty_submit(
                u, study_context_format(u->context, "sample %zu, %s", i + 1, level->name),
                u->numbers + i * u->inputs.count, level, false);
    }
}

/* A level of the ladder that is impossible for any inputs is found with the first sample that the
 * file's own model accepts. */
static bool open_levels(const study_uncertainty *u)
{
    for (size_t i = 0; i < u->pilot; i++) {
        if (!study_submitted_opens(u->context, study_uncertainty_pilot_case(u, 0, i), false))
            continue;
        for (size_t k = 1; k < u->level_count; k++)
            if (!study_submitted_opens(u->context, study_uncertainty_pilot_case(u, k, i), true))
                return false;
        return true;
    }
    return true;
}

static bool run_cases(void *study)
{
    study_uncertainty *u = study;
    study_context *context = u->context;
    u->plan = (estimate_plan){
        .levels = 1, .count = {u->samples}, .correlation = {1}, .cost = (double)u->samples};
    u->cost[0] = 1;
    u->seconds[0] = (double)NAN;
    if (!open_levels(u) || !study_run_submitted(context, 0, u->first_main))
        return false;
    if (u->level_count > 1)
        plan_samples(u);
    add_for_shares(u);
    submit_main(u);
    return study_run_submitted(context, u->first_main, context->list.count);
}

/* Checks that limits have the units of their outputs. */
static void check(const void *study, const ff_pipeline *pipeline, ff_report *report)
{
    const study_uncertainty *u = study;
    for (size_t i = 0; i < u->condition_count; i++) {
        const uncertainty_condition *c = &u->conditions[i];
        const ff_stage *stage;
        const ff_result *of = run_output(pipeline, u->context->outputs[c->output]->text, &stage);
        const char *unit = of ? of->row->unit : NULL;
        ff_unit parsed;
        char why[300];
        double value;
        if (unit && (!ff_unit_parse(unit, &parsed, why, sizeof why) ||
                     !ff_quantity_parse(c->limit, &parsed, unit, &value, why, sizeof why)))
            ff_error(report, FF_FAULT_INPUT, c->place->place, NULL, "%s: %.100s: %s",
                     u->context->name, c->text, why);
    }
}

const study_kind study_uncertainty_kind = {
    .name = "uncertainty",
    .verb = "samples uncertain inputs",
    .summary = "Spread of the outputs due to uncertain inputs, compared with the errors of grids "
               "and models",
    .file = "uncertainty",
    .keys = keys,
    .key_count = STUDY_UNCERTAINTY_KEYS,
    .read = study_uncertainty_read,
    .cases = run_cases,
    .reduce = study_uncertainty_reduce,
    .check = check,
};
