/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The audit in two rounds: the cases that are audited as they stand, with what their outputs are
 * plotted against; then, for each stage that has chosen its model, the case with this stage finer
 * and with the most exact model of its kind, all other choices held, and the case with each input a
 * little larger and smaller.
 */
#include "audit.h"

static const ff_param params[STUDY_SETTINGS] = {
    [STUDY_EVERY] = {.name = "every",
                     .unit = "",
                     .type = FF_INT,
                     .preset = "20",
                     .min = 1,
                     .max = 1000000,
                     .doc = "one case in so many is audited, and at least one"},
    [STUDY_SEED] = {.name = "seed",
                    .unit = "",
                    .type = FF_INT,
                    .preset = "1",
                    .min = 0,
                    .max = 1000000,
                    .doc = "draws which: one of each of as many equal parts of the study"},
    [STUDY_OUTPUTS] = {.name = "outputs",
                       .unit = "",
                       .type = FF_TREE,
                       .doc =
                           "list of the outputs that matter, [film.h_min_lowest]; else those that "
                           "the file names"},
    [STUDY_INPUTS] = {.name = "inputs",
                      .unit = "",
                      .type = FF_TREE,
                      .doc =
                          "map from parameters to their standard uncertainty: {duty.torque: 2 %, "
                          "gears.backlash: 10 um}"},
};

static const ff_port outputs[] = {
    {.name = "study", .unit = "", .dims = "", .service = FF_STUDY_ID, .doc = "promises and errors"},
};

size_t study_audit_count(const study_audit *a)
{
    size_t every = (size_t)a->every;
    return (a->cases + every - 1) / every;
}

static uint64_t hash(uint64_t start, uint64_t number)
{
    for (int i = 0; i < 64; i += 8) /* FNV-1a */
        start = (start ^ (number >> i & 0xff)) * UINT64_C(0x100000001b3);
    return start;
}

/* A case of each of equal parts. */
static size_t draw(const study_audit *a, size_t part)
{
    size_t parts = study_audit_count(a);
    size_t begin = part * a->cases / parts, end = (part + 1) * a->cases / parts;
    uint64_t number = hash(hash(UINT64_C(0xcbf29ce484222325), (uint64_t)a->seed), part);
    return begin + (size_t)((number ^ number >> 32) % (end - begin));
}

static void open_subjects(study_audit *a)
{
    const ff_study_desk *desk = a->desk;
    a->subject_count = study_audit_count(a);
    a->subjects = desk->memory(desk->ctx, (a->subject_count + 1) * sizeof *a->subjects);
    for (size_t i = 0; i < a->subject_count; i++) {
        audit_subject *s = &a->subjects[i];
        s->index = draw(a, i);
        const ff_study_look *look = desk->look(desk->ctx, s->index);
        if (*look->reason)
            s->trouble = look->reason;
        else
            study_find_items(a, s, look);
        if (!s->trouble)
            study_ask_base(a, i);
    }
}

/* Runs the probes from number `first` on, and reads what they gave. */
static ff_status run_probes(study_audit *a, size_t first)
{
    const ff_study_desk *desk = a->desk;
    if (first == a->probe_count)
        return FF_OK;
    ff_status status =
        desk->run(desk->ctx, a->probes[first].number, a->probes[a->probe_count - 1].number + 1);
    for (size_t i = first; status == FF_OK && i < a->probe_count; i++) {
        study_probe *p = &a->probes[i];
        p->answer = desk->answer(desk->ctx, p->number);
        p->record = p->answer->record ? json_loads(p->answer->record, 0, NULL) : NULL;
    }
    return status;
}

static ff_status run_both(study_audit *a)
{
    open_subjects(a);
    size_t count = a->probe_count;
    ff_status status = run_probes(a, 0);
    for (size_t i = 0; status == FF_OK && i < count; i++) {
        const json_t *choices = json_object_get(a->probes[i].record, "choices");
        if (study_is_good(a->probes[i].answer) && json_object_size(choices))
            study_ask_others(a, a->probes[i].subject, choices);
    }
    return status == FF_OK ? run_probes(a, count) : status;
}

static ff_status run(void *self, const ff_study_desk *desk)
{
    study_audit *a = self;
    a->desk = desk;
    ff_status status = run_both(a);
    if (status != FF_OK)
        return status;
    json_t *result = study_audit_result(a);
    const json_t *summary = json_object_get(result, "summary");
    study_hand_over(desk, "audit.json", result, study_put_json);
    study_hand_over(desk, "audit.csv", result, study_audit_table);
    study_hand_over(desk, "audit.svg", result, study_audit_draw);
    study_give_facts(desk, "audit", result, 17);
    study_audit_print(desk, result);
    if (study_number_of(summary, "failed") > 0) /* a broken promise is told, and is no failure */
        desk->conclude(desk->ctx, FF_BAD);
    json_decref(result);
    return FF_OK;
}

static ff_status create(const ff_host *host, void **self)
{
    study_audit *a = calloc(1, sizeof *a);
    if (!a)
        return ff_failf(host, FF_NOMEM, NULL, "out of memory");
    a->host = host;
    a->service = (ff_study_model){.size = sizeof a->service,
                                  .self = a,
                                  .verb = "is audited",
                                  .plan = study_audit_plan,
                                  .run = run,
                                  .check = study_audit_check};
    *self = a;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    study_audit *a = self;
    if (param == STUDY_EVERY)
        a->every = value->integer;
    else if (param == STUDY_SEED)
        a->seed = value->integer;
    else if (param < STUDY_SETTINGS)
        a->settings[param] = value->tree;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    return output ? NULL : &((study_audit *)self)->service;
}

static void destroy(void *self)
{
    study_audit *a = self;
    for (size_t i = 0; a && i < a->probe_count; i++) {
        json_decref(a->probes[i].record);
        free(a->probes[i].sets);
    }
    free(a ? a->probes : NULL);
    free(a);
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 1,
    .id = "study/audit",
    .version = "1.0.0",
    .summary = "Whether chosen models keep their promise: some cases once more, finer",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .service = service,
    .destroy = destroy,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
