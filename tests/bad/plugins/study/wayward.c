/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study of one path that is faulty in the way that FAULT names. */
#include <flankfilm/author.h>
#include <flankfilm/study.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct study {
    ff_study_model service;
    const ff_written *outputs, *axes;
    const ff_study_plan *plan;
    const ff_study_block *block;
} study;

static int faulty(const char *fault)
{
    return !strcmp(FAULT, fault);
}

static size_t ask(const ff_study_desk *desk, const char *assignment, const char *name)
{
    const ff_study_point point = {assignment, name};
    const ff_study_case one = {.size = sizeof one, .points = &point, .label = name};
    return desk->ask(desk->ctx, &one);
}

/* It goes with a sweep. */
static int sweeps(void)
{
    return faulty("astray") || faulty("crash-check") || faulty("rerun");
}

static ff_status check(void *self, const ff_study_desk *desk, size_t cases)
{
    (void)self, (void)desk;
    if (faulty("crash-check"))
        abort();
    return cases > 0 ? FF_OK : FF_BUG;
}

static ff_status run_more(const ff_study_desk *desk)
{
    const ff_study_case one = {.size = sizeof one, .label = "", .of = 77};
    size_t number = faulty("rerun") ? 0 : desk->ask(desk->ctx, &one);
    return desk->run(desk->ctx, number, number + 1);
}

static ff_status plan(void *self, const ff_study_desk *desk, ff_study_plan *made)
{
    study *s = self;
    if (faulty("crash-plan"))
        abort();
    s->plan = made;
    made->flags = sweeps() ? FF_STUDY_SWEEPS : 0;
    if (sweeps())
        return FF_OK;
    s->block = s->axes ? desk->expand(desk->ctx, s->axes) : NULL;
    if (!s->block)
        return faulty("silent") ? FF_INVALID
                                : desk->refuse(desk->ctx, FF_INVALID, s->axes, NULL,
                                               "\"axes\" is a map from one path to its values");
    made->paths = s->block->paths;
    made->path_count = 1;
    made->outputs = s->outputs->items;
    made->output_count = s->outputs->count;
    for (size_t i = 0; i < s->block->case_count && !faulty("nothing"); i++)
        ask(desk, s->block->points[i].assignment, s->block->points[i].name);
    return faulty("early") ? desk->run(desk->ctx, 0, 1) : FF_OK;
}

/* The same case again and again, until it is told to stop. */
static ff_status run_for_ever(const ff_study_desk *desk)
{
    ff_status status = FF_OK;
    while (status == FF_OK) {
        size_t number = ask(desk, "", "");
        status = desk->run(desk->ctx, number, number + 1);
    }
    return status;
}

static ff_status run(void *self, const ff_study_desk *desk)
{
    const study *s = self;
    if (faulty("crash"))
        abort();
    if (sweeps())
        return run_more(desk);
    size_t count = s->block->case_count, extra = 0;
    if (faulty("endless"))
        return run_for_ever(desk);
    if (faulty("beyond"))
        return desk->run(desk->ctx, 0, count + 5);
    for (size_t i = 0; i < 1000001 && faulty("greedy"); i++)
        ask(desk, "", "");
    if (faulty("impossible"))
        extra = ask(desk, "nowhere.nothing=1", "1") + 1;
    if (faulty("nan"))
        extra = ask(desk, "root.n=nan", "nan") + 1;
    ff_status status = desk->run(desk->ctx, 0, extra ? extra : count);
    if (status != FF_OK)
        return faulty("deaf") ? FF_OK : status;
    if (faulty("folder"))
        desk->file(desk->ctx, "../escaped.txt", "here");
    if (faulty("journal"))
        desk->file(desk->ctx, "table.csv", "here");
    desk->facts(desk->ctx, faulty("facts") ? "{\"best\": nan}" : "{\"best\": 1}");
    desk->say(desk->ctx, 0, "it was done");
    return faulty("status") ? 77 : FF_OK;
}

static ff_status create(const ff_host *host, void **self)
{
    study *s = calloc(1, sizeof *s);
    if (!s)
        return ff_failf(host, FF_NOMEM, NULL, "out of memory");
    s->service = (ff_study_model){.size = sizeof s->service,
                                  .self = s,
                                  .verb = "tries",
                                  .plan = plan,
                                  .run = faulty("no-run") ? NULL : run,
                                  .check = sweeps() ? check : NULL};
    *self = s;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    *(param ? &((study *)self)->axes : &((study *)self)->outputs) = value->tree;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    return output ? NULL : &((study *)self)->service;
}

static const ff_param params[] = {
    {.name = "outputs", .unit = "", .type = FF_TREE, .flags = FF_REQUIRED, .doc = "what to see"},
    {.name = "axes", .unit = "", .type = FF_TREE, .flags = FF_REQUIRED, .doc = "what to vary"},
};
static const ff_port outputs[] = {
    {.name = "study", .unit = "", .dims = "", .service = FF_STUDY_ID, .doc = "a study"},
};

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 1,
    .id = "study/" FAULT,
    .version = "1.0.0",
    .summary = "A study with a fault",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .service = service,
    .destroy = free,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
