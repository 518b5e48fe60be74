/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Goes three quarters of its way so far and one step more: a result that depends on the chain of
   cases before it. */
#include <flankfilm/author.h>

#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { STEP, WORK, TRAP, FOOT, BULK };

typedef struct walk {
    const ff_host *host;
    double step, work, trap, from, to;
    int given;
    size_t bulk;
} walk;

static const ff_param params[] = {
    {.name = "step", .unit = "m", .doc = "length of the step", .type = FF_REAL, .preset = "1 m"},
    {.name = "work", .unit = "s", .doc = "how long to seem busy", .type = FF_REAL, .preset = "0 s"},
    {.name = "trap",
     .unit = "m",
     .doc = "step that ends the process",
     .type = FF_REAL,
     .preset = "0 m"},
    {.name = "foot", .unit = "", .doc = "a number that nothing depends on", .type = FF_INT},
    {.name = "bulk",
     .unit = "",
     .doc = "bytes that the state is said to have",
     .type = FF_INT,
     .preset = "8"},
};

static const ff_port outputs[] = {
    {.name = "place", .unit = "m", .doc = "where the walk has got to", .dims = ""},
};

static ff_status create(const ff_host *host, void **self)
{
    walk *w = calloc(1, sizeof *w);
    if (!w)
        return FF_NOMEM;
    w->host = host;
    *self = w;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    walk *w = self;
    if (param == STEP)
        w->step = value->real;
    else if (param == WORK)
        w->work = value->real;
    else if (param == TRAP)
        w->trap = value->real;
    else if (param == BULK)
        w->bulk = (size_t)value->integer;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    walk *w = self;
    struct timespec nap = {(time_t)w->work, (long)(1e9 * (w->work - (double)(time_t)w->work))};
    (void)wanted, (void)in;
    nanosleep(&nap, NULL);
    if (w->step == w->trap)
        abort();
    w->to = (w->given ? 0.75 * w->from : 0) + w->step;
    w->given = 0;
    return ff_put_scalar(w->host, 0, w->to);
}

static ff_status carry(void *self, const ff_state_bytes *from, ff_state_bytes *to)
{
    walk *w = self;
    w->given = from && from->count == sizeof w->from;
    if (w->given)
        memcpy(&w->from, from->bytes, sizeof w->from);
    if (to)
        *to = (ff_state_bytes){sizeof *to, &w->to, w->bulk};
    return FF_OK;
}

static void destroy(void *self)
{
    free(self);
}

const ff_model *flankfilm_model_v1(void)
{
    static const ff_model model = {
        .size = sizeof model,
        .abi_major = FF_ABI_MAJOR,
        .abi_minor = FF_ABI_MINOR,
        .id = "toy/walk",
        .version = "1.0.0",
        .summary = "a walk without physics",
        .reference = "",
        .bibtex = "",
        .licence = "GPL-3.0-or-later",
        .params = params,
        .param_count = sizeof params / sizeof params[0],
        .param_stride = sizeof params[0],
        .outputs = outputs,
        .output_count = sizeof outputs / sizeof outputs[0],
        .output_stride = sizeof outputs[0],
        .create = create,
        .set = set,
        .evaluate = evaluate,
        .destroy = destroy,
        .carry = carry,
    };
    return &model;
}
