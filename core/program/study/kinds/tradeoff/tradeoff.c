/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures error against cost: refines a reference until it hardly changes, runs each candidate
 * several times, alone on a core, and finds the Pareto front. */
#include "tradeoff.h"

#include <math.h>

static const ff_param keys[STUDY_TRADEOFF_KEYS] = {
    [TRADEOFF_OUTPUTS] = {.name = "outputs",
                          .flags = FF_REQUIRED,
                          .doc = "list of the outputs that matter: [film.h_min]"},
    [TRADEOFF_REFERENCE] =
        {.name = "reference",
         .flags = FF_REQUIRED,
         .doc = "map from paths to the values of the finest answer; refine: knobs to "
                "double, or a map to factors; refinements: how often at most, else 3"},
    [TRADEOFF_CANDIDATES] = {.name = "candidates",
                             .flags = FF_REQUIRED,
                             .doc = "list of maps from paths to lists of values, as under sweep"},
    [TRADEOFF_REPEATS] = {.name = "repeats",
                          .unit = "",
                          .type = FF_INT,
                          .preset = "5",
                          .min = 1,
                          .max = 100,
                          .doc =
                              "runs of each candidate, 1 to 100; the median of their costs counts"},
    [TRADEOFF_ACCURACY] = {.name = "accuracy",
                           .unit = "1",
                           .type = FF_REAL,
                           .flags = FF_MIN_OPEN,
                           .preset = "0.5 %",
                           .max = INFINITY,
                           .low = 1e-9,
                           .high = 1,
                           .doc = "smallest error of interest, above 0; the reference must change "
                                  "by less than a tenth of it"},
    [TRADEOFF_COUNTS] = {.name = "counts",
                         .doc = "list of results that count work: [film.convolutions]"},
    [TRADEOFF_ALONG] =
        {.name = "along",
         .unit = "",
         .type = FF_TEXT,
         .doc = "the series along which others are compared; found automatically if not given"},
    [TRADEOFF_STAGES] = {.name = "stages",
                         .doc =
                             "list of stages whose work counts although all candidates share it"},
};

/* True if every output has settled. Otherwise records whether the change of any other output still
 * falls. */
static bool level_has_settled(study_tradeoff *t, size_t level)
{
    bool settled = true, falls = level < 2;
    for (size_t i = 0; i < t->context->output_count; i++) {
        accuracy_difference before, now;
        if (study_tradeoff_has_settled(t, level, i))
            continue;
        settled = false;
        falls = falls || (study_tradeoff_compare(t, level - 2, level - 1, i, &before) &&
                          study_tradeoff_compare(t, level - 1, level, i, &now) &&
                          (now.absolute != before.absolute || now.typical < before.typical));
    }
    t->stalled = !settled && !falls;
    return settled;
}

/* Runs the levels of the reference until one has settled, or until refinement no longer reduces the
 * change. */
static bool run_reference(study_tradeoff *t)
{
    study_context *context = t->context;
    for (t->ran = 0; t->ran < t->levels;) {
        size_t level = t->ran++;
        if (!study_run_submitted(context, level, level + 1))
            return false;
        const study_outcome *outcome = study_tradeoff_outcome(t, level);
        bool lost = *outcome->reason == '\0' && !outcome->outputs[0].values;
        if (*outcome->reason || lost)
            return ff_error(
                context->report, FF_FAULT_RUN, t->points[level].place->place,
                "try a coarser reference, or fewer refinements",
                "%s: the reference failed (%s): %s", context->name, t->points[level].label,
                lost ? "its results are lost; --rerun all computes them again" : outcome->reason);
        if (level > 0 && (level_has_settled(t, level) || t->stalled))
            return true;
    }
    return true;
}

static bool run_cases(void *study)
{
    study_tradeoff *t = study;
    return run_reference(t) &&
           study_run_submitted(t->context, t->levels, study_tradeoff_case(t, t->count, 0));
}

static void reduce(void *study, study_answer *answer)
{
    const study_tradeoff *t = study;
    answer->value = study_tradeoff_result(t, t->ran);
    study_tradeoff_print(answer);
}

const study_kind study_tradeoff_kind = {
    .name = "tradeoff",
    .verb = "measures a trade-off",
    .summary = "Error against cost of models and resolutions, with the Pareto front",
    .file = "tradeoff",
    .keys = keys,
    .key_count = STUDY_TRADEOFF_KEYS,
    .read = study_tradeoff_read,
    .cases = run_cases,
    .reduce = reduce,
};
