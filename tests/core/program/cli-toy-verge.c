/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A model whose verges are known: it warns above a speed of 2 m/s, swings above 2.5, is out of its
   range below 0.2, fails above 3, and above a load of 5 N it is ten times worse than it says. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { LOAD, SPEED, CELLS };

typedef struct verge {
    const ff_host *host;
    double load, speed, cells;
} verge;

static const ff_param params[] = {
    {.name = "load",
     .unit = "N",
     .doc = "above 5 N the error is not what is said",
     .type = FF_REAL,
     .preset = "1 N",
     .min = 0.01,
     .max = 100},
    {.name = "speed", .unit = "m/s", .doc = "has verges", .type = FF_REAL, .preset = "1 m/s"},
    {.name = "cells", .unit = "", .doc = "of no grid", .type = FF_INT, .preset = "10"},
};

static const ff_port outputs[] = {
    {.name = "answer", .unit = "m", .doc = "1 m, nearly", .dims = ""},
    {.name = "swing",
     .unit = "1",
     .doc = "1: it swings",
     .dims = "",
     .label = "state of <the> verge"},
    {.name = "answers", .unit = "m", .doc = "the same thrice", .dims = "t"},
    {.name = "known_error", .unit = "1", .doc = "infinite with one cell", .dims = ""},
};

static ff_status create(const ff_host *host, void **self)
{
    verge *v = calloc(1, sizeof *v);
    if (!v)
        return FF_NOMEM;
    v->host = host;
    *self = v;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    verge *v = self;
    if (param == LOAD)
        v->load = value->real;
    else if (param == SPEED)
        v->speed = value->real;
    else
        v->cells = (double)value->integer;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    verge *v = self;
    const ff_host *host = v->host;
    double estimate = 1 / (v->cells * v->cells);
    (void)in;
    if (v->speed > 3)
        return ff_failf(host, FF_NOCONV, "speed", "step 7 of 9: %g m/s is above 3", v->speed);
    host->quality(host->ctx, "residual", v->speed, 2, v->speed > 2 ? FF_DOUBTFUL : FF_GOOD,
                  "it grows with speed");
    const int known = v->cells > 1;
    host->quality(host->ctx, "answer_error", known ? estimate : (double)NAN, 0.1,
                  known ? FF_GOOD : FF_DOUBTFUL, NULL);
    if (!known)
        host->quality(host->ctx, "swing_error", NAN, 0.1, FF_DOUBTFUL, NULL);
    host->quality(host->ctx, "law", v->speed, 0.2, v->speed < 0.2 ? FF_DOUBTFUL : FF_GOOD, NULL);
    if (v->load > 50)
        host->quality(host->ctx, "reach", v->load, 50, FF_RANGE, "it was made for less");
    if (ff_put_scalar(host, 0, 1 + (v->load > 5 ? 10 : 1) * estimate) != FF_OK ||
        ff_put_scalar(host, 1, v->load > 0.5 && v->speed < 0.5) != FF_OK ||
        ff_put_scalar(host, 3, known ? estimate : (double)INFINITY) != FF_OK)
        return FF_NOMEM;
    double *answers = wanted & FF_BIT(2) ? ff_put_series(host, 2, 3) : NULL;
    for (int i = 0; answers && i < 3; i++)
        answers[i] = 1;
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
        .id = "toy/verge",
        .version = "1.0.0",
        .summary = "known verges without physics",
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
    };
    return &model;
}
