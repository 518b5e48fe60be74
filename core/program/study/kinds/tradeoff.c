/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Error against cost: refines a reference until it hardly changes, then runs each candidate several
 * times, alone on a core; finds the Pareto front.
 */
#include "tradeoff.h"

#include <math.h>
#include <stdlib.h>

const ff_param study_tradeoff_keys[STUDY_TRADEOFF_KEYS] = {
    [TRADEOFF_OUTPUTS] = {.name = "outputs",
                          .unit = "",
                          .type = STUDY_TREE,
                          .flags = FF_REQUIRED,
                          .doc = "list of the outputs that matter: [film.h_min]"},
    [TRADEOFF_REFERENCE] =
        {.name = "reference",
         .unit = "",
         .type = STUDY_TREE,
         .flags = FF_REQUIRED,
         .doc = "map from paths to the values of the finest answer; refine: knobs to "
                "double, or a map to factors; refinements: how often at most, else 3"},
    [TRADEOFF_CANDIDATES] = {.name = "candidates",
                             .unit = "",
                             .type = STUDY_TREE,
                             .flags = FF_REQUIRED,
                             .doc = "list of maps from paths to values, as under sweep"},
    [TRADEOFF_REPEATS] = {.name = "repeats",
                          .unit = "",
                          .type = FF_INT,
                          .preset = "5",
                          .min = 1,
                          .max = 100,
                          .doc =
                              "runs of each candidate, 1 to 100; the median of their costs counts"},
    [TRADEOFF_ACCURACY] =
        {.name = "accuracy",
         .unit = "1",
         .type = FF_REAL,
         .flags = FF_MIN_OPEN,
         .preset = "0.5 %",
         .max = INFINITY,
         .low = 1e-9,
         .high = 1,
         .doc = "smallest error sought, above 0; the reference is to change by a tenth"},
    [TRADEOFF_COUNTS] = {.name = "counts",
                         .unit = "",
                         .type = STUDY_TREE,
                         .doc = "list of what counts work: [film.convolutions]"},
    [TRADEOFF_ALONG] = {.name = "along",
                        .unit = "",
                        .type = FF_TEXT,
                        .doc = "the series that others are compared along; else one is found"},
    [TRADEOFF_STAGES] = {.name = "stages",
                         .unit = "",
                         .type = STUDY_TREE,
                         .doc = "list of stages whose work counts although candidates share them"},
    [TRADEOFF_JUDGE] =
        {.name = "judge",
         .unit = "",
         .type = FF_CHOICE,
         .preset = "auto",
         .choices = "auto|largest|rms",
         .doc = "which error of a series makes fronts: the largest, or the rms along it; auto: "
                "the rms of what changes its sign, else the largest"},
};

/* Whether every output differs from the level before by at most a tenth of the smallest error
   sought. */
static bool level_has_settled(const study_tradeoff *t, size_t level)
{
    accuracy_difference d;
    for (size_t i = 0; i < t->context->output_count; i++)
        if (!study_tradeoff_compare(t, level - 1, level, i, &d) || d.judged > t->accuracy / 10)
            return false;
    return true;
}

/* Runs the levels of the reference and sets *levels to the number that ran. */
static bool run_reference(const study_tradeoff *t, size_t *levels)
{
    study_context *context = t->context;
    for (*levels = 0; *levels < t->levels;) {
        size_t level = (*levels)++;
        if (!study_run_submitted(context, level, level + 1))
            return false;
        const study_outcome *outcome = study_tradeoff_outcome(t, level);
        bool lost = *outcome->reason == '\0' && !outcome->outputs[0].values;
        if (*outcome->reason || lost)
            return ff_error(
                context->report, FF_FAULT_RUN, t->points[level].place->place,
                "a coarser reference, or fewer refinements, may do",
                "%s: the reference failed (%s): %s", context->name, t->points[level].label,
                lost ? "what it gave is lost; --rerun all computes it anew" : outcome->reason);
        if (level > 0 && level_has_settled(t, level))
            return true;
    }
    return true;
}

static void write_file(study_context *context, const char *name, const json_t *result,
                       void (*put)(const json_t *, FILE *))
{
    FILE *out = study_context_file(context, name);
    put(result, out);
    fclose(out);
}

static void put_json(const json_t *result, FILE *out)
{
    json_dumpf(result, out, JSON_INDENT(1) | JSON_REAL_PRECISION(6));
    fputc('\n', out);
}

/* Returns the members for `run --json`, rounded to twelve digits. */
static json_t *facts_of(const json_t *result)
{
    char *text = json_dumps(result, JSON_COMPACT | JSON_REAL_PRECISION(12));
    json_t *rounded = json_loads(text, 0, NULL);
    free(text);
    return json_pack("{s:o}", "tradeoff", rounded);
}

bool study_tradeoff_run(study_tradeoff *t)
{
    study_context *context = t->context;
    size_t levels;
    if (!run_reference(t, &levels) ||
        !study_run_submitted(context, t->levels, study_tradeoff_case(t, t->count, 0)))
        return false;
    json_t *result = study_tradeoff_result(t, levels);
    write_file(context, "tradeoff.csv", result, study_tradeoff_table);
    write_file(context, "tradeoff.json", result, put_json);
    write_file(context, "tradeoff.figure.json", result, study_tradeoff_figure);
    context->facts = facts_of(result);
    study_tradeoff_print(context, result);
    json_decref(result);
    return true;
}
