/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Error against cost: a reference that is refined until it stands, then candidates, each several
 * times alone on a core; the Pareto front of both, and whether the errors that models claim hold.
 */
#include "tradeoff.h"

static const ff_param params[STUDY_SETTINGS] = {
    [STUDY_OUTPUTS] = {.name = "outputs",
                       .unit = "",
                       .type = FF_TREE,
                       .flags = FF_REQUIRED,
                       .doc = "list of the outputs that matter: [film.h_min]"},
    [STUDY_REFERENCE] = {.name = "reference",
                         .unit = "",
                         .type = FF_TREE,
                         .flags = FF_REQUIRED,
                         .doc =
                             "map from paths to the values of the finest answer; refine: knobs to "
                             "double, or a map to factors; refinements: how often at most, else 3"},
    [STUDY_CANDIDATES] = {.name = "candidates",
                          .unit = "",
                          .type = FF_TREE,
                          .flags = FF_REQUIRED,
                          .doc = "list of maps from paths to values, as under sweep"},
    [STUDY_REPEATS] = {.name = "repeats",
                       .unit = "",
                       .type = FF_INT,
                       .preset = "5",
                       .low = 1,
                       .high = 100,
                       .doc = "runs of each candidate, 1 to 100; the median of their costs counts"},
    [STUDY_ACCURACY] =
        {.name = "accuracy",
         .unit = "1",
         .type = FF_REAL,
         .preset = "0.5 %",
         .low = 1e-9,
         .high = 1,
         .doc = "smallest error sought, above 0; the reference is to change by a tenth"},
    [STUDY_ESTIMATES] = {.name = "estimates",
                         .unit = "",
                         .type = FF_TREE,
                         .doc =
                             "map from outputs to the names that say their errors, or none; else "
                             "those called OUTPUT_error and OUTPUT_..._error"},
    [STUDY_COUNTS] = {.name = "counts",
                      .unit = "",
                      .type = FF_TREE,
                      .doc = "list of what counts work: [film.convolutions]"},
    [STUDY_ALONG] = {.name = "along",
                     .unit = "",
                     .type = FF_TEXT,
                     .doc = "the series that others are compared along; else one is found"},
    [STUDY_STAGES] = {.name = "stages",
                      .unit = "",
                      .type = FF_TREE,
                      .doc = "list of stages whose work counts although candidates share them"},
    [STUDY_JUDGE] = {.name = "judge",
                     .unit = "",
                     .type = FF_CHOICE,
                     .preset = "largest",
                     .choices = "largest|rms",
                     .doc =
                         "which error of a series makes fronts: the largest, or the rms along it"},
};

static const ff_port outputs[] = {
    {.name = "study", .unit = "", .dims = "", .service = FF_STUDY_ID, .doc = "error against cost"},
};

/* Every output differs from the level before by a tenth of the smallest error at most. */
static bool stands(const study_tradeoff *t, size_t level)
{
    study_difference d;
    for (size_t i = 0; i < t->plan->output_count; i++)
        if (!study_tradeoff_compare(t, level - 1, level, i, &d) || d.judged > t->accuracy / 10)
            return false;
    return true;
}

/* *levels: those that ran. */
static ff_status run_reference(const study_tradeoff *t, size_t *levels)
{
    for (*levels = 0; *levels < t->levels;) {
        size_t level = (*levels)++;
        ff_status status = t->desk->run(t->desk->ctx, level, level + 1);
        if (status != FF_OK)
            return status;
        const ff_study_answer *answer = study_tradeoff_answer(t, level);
        bool lost = *answer->reason == '\0' && !answer->outputs[0]->values;
        if (*answer->reason || lost)
            return t->desk->refuse(
                t->desk->ctx, FF_NOCONV, t->points[level].place,
                "a coarser reference, or fewer refinements, may do",
                study_keep(t->desk, "the reference failed (%s): %s", t->points[level].label,
                           lost ? "what it gave is lost; --rerun all computes it anew"
                                : answer->reason));
        if (level > 0 && stands(t, level))
            return FF_OK;
    }
    return FF_OK;
}

static ff_status run(void *self, const ff_study_desk *desk)
{
    study_tradeoff *t = self;
    size_t levels;
    t->desk = desk;
    ff_status status = run_reference(t, &levels);
    if (status == FF_OK)
        status = desk->run(desk->ctx, t->levels, study_tradeoff_case(t, t->count, 0));
    if (status != FF_OK)
        return status;
    json_t *result = study_tradeoff_result(t, levels);
    study_hand_over(desk, "tradeoff.csv", result, study_tradeoff_table);
    study_hand_over(desk, "tradeoff.json", result, study_put_json);
    study_hand_over(desk, "tradeoff.svg", result, study_tradeoff_draw);
    study_give_facts(desk, "tradeoff", result, 12);
    study_tradeoff_print(desk, result);
    json_decref(result);
    return FF_OK;
}

static ff_status create(const ff_host *host, void **self)
{
    study_tradeoff *t = calloc(1, sizeof *t);
    if (!t)
        return ff_failf(host, FF_NOMEM, NULL, "out of memory");
    t->host = host;
    t->service = (ff_study_model){.size = sizeof t->service,
                                  .self = t,
                                  .verb = "measures a trade-off",
                                  .plan = study_tradeoff_plan,
                                  .run = run};
    *self = t;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    study_tradeoff *t = self;
    if (param < STUDY_SETTINGS)
        t->settings[param] = value->tree;
    if (param == STUDY_REPEATS)
        t->repeats = value->integer;
    if (param == STUDY_ACCURACY)
        t->accuracy = value->real;
    if (param == STUDY_JUDGE)
        t->rms = value->integer == 1;
    if (param == STUDY_ALONG) {
        free((void *)(uintptr_t)t->along);
        t->along = strdup(value->text);
    }
    return param == STUDY_ALONG && !t->along ? ff_failf(t->host, FF_NOMEM, NULL, "out of memory")
                                             : FF_OK;
}

static ff_status ready(void *self)
{
    const study_tradeoff *t = self;
    if (t->repeats < 1 || t->repeats > 100)
        return ff_failf(t->host, FF_INVALID, "repeats",
                        "\"repeats\" wants a whole number from 1 to 100");
    if (!(t->accuracy > 0))
        return ff_failf(t->host, FF_INVALID, "accuracy",
                        "\"accuracy\" is the smallest error that is sought, such as 0.5 %%");
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    return output ? NULL : &((study_tradeoff *)self)->service;
}

static void destroy(void *self)
{
    study_tradeoff *t = self;
    if (t)
        free((void *)(uintptr_t)t->along);
    free(t);
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 1,
    .id = "study/tradeoff",
    .version = "1.0.0",
    .summary = "Error against cost of models and resolutions, with the Pareto front",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .ready = ready,
    .service = service,
    .destroy = destroy,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
