/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Models of a kind that choose themselves, with errors that are known. The truth is
 * level * width^2, in a chain with the memory's share of the level before it. fine: off by 1/cells,
 * and says so, with as many cells as an accuracy takes. coarse: off by 5 %, says 6 %. liar: off by
 * 10 %, says 1 %. plain: off by 1/cells of its 10, says 20 %, and has nothing to propose.
 * shy: coarse, and says nothing of series.
 */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEVEL, WIDTH, CELLS, MOST, MODE, SPARE, MEMORY };

typedef struct gauge {
    const ff_host *host;
    double level, width, cells, most, memory, from, to;
    int given;
    char text[32];
    ff_proposal proposal;
} gauge;

static int is(const char *name)
{
    return !strcmp(NAME, name);
}

static const ff_param params[] = {
    {.name = "level", .unit = "mm", .doc = "a length", .type = FF_REAL, .preset = "1 mm"},
    {.name = "width", .unit = "1", .doc = "counts by its square", .type = FF_REAL, .preset = "1"},
    {.name = "cells",
     .unit = "",
     .doc = "the error is one over them",
     .type = FF_INT,
     .flags = FF_TUNABLE,
     .preset = "10",
     .min = 1,
     .max = 100000},
    {.name = "most", .unit = "", .doc = "more cells fail", .type = FF_INT, .preset = "100000"},
    {.name = "mode", .unit = "", .doc = "a word", .type = FF_TEXT, .preset = "none"},
    {.name = "spare", .unit = "m", .doc = "nothing depends on it", .type = FF_REAL},
    {.name = "memory", .unit = "1", .doc = "of the case before", .type = FF_REAL, .preset = "0"},
};

static const ff_port outputs[] = {
    {.name = "answer", .unit = "m", .doc = "the truth, nearly", .dims = ""},
    {.name = "answers", .unit = "m", .doc = "the same, rising", .dims = "t"},
    {.name = "t", .unit = "s", .doc = "as many points as cells", .dims = "t"},
};

static ff_status create(const ff_host *host, void **self)
{
    gauge *g = calloc(1, sizeof *g);
    *self = g;
    if (g)
        g->host = host;
    return g ? FF_OK : FF_NOMEM;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    gauge *g = self;
    if (param == LEVEL)
        g->level = value->real;
    else if (param == WIDTH)
        g->width = value->real;
    else if (param == MEMORY)
        g->memory = value->real;
    else if (param == MOST)
        g->most = (double)value->integer;
    else if (param == CELLS) {
        g->cells = (double)value->integer;
        g->given = value->given;
    }
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    gauge *g = self;
    double off = is("coarse") || is("shy") ? 0.05 : is("liar") ? 0.1 : 1 / g->cells;
    g->to = g->level + g->memory * g->from;
    g->from = 0;
    double value = g->to * g->width * g->width * (1 + off);
    size_t count = (size_t)g->cells + 1;
    (void)in;
    if (g->cells > g->most)
        return ff_failf(g->host, FF_NOCONV, "cells", "%g cells are too many", g->cells);
    if (ff_put_scalar(g->host, 0, value) != FF_OK)
        return FF_NOMEM;
    for (uint32_t k = 1; k < 3; k++) {
        double *series = wanted & FF_BIT(k) ? ff_put_series(g->host, k, count) : NULL;
        for (size_t i = 0; series && i < count; i++)
            series[i] = k == 1 ? value * (1 + (double)i / g->cells) : (double)i / g->cells;
    }
    return FF_OK;
}

static ff_status carry(void *self, const ff_state_bytes *from, ff_state_bytes *to)
{
    gauge *g = self;
    if (from && from->count == sizeof g->from)
        memcpy(&g->from, from->bytes, sizeof g->from);
    if (to) {
        to->bytes = &g->to;
        to->count = sizeof g->to;
    }
    return FF_OK;
}

static void destroy(void *self)
{
    free(self);
}

static ff_status assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        ff_assessment *a)
{
    gauge *g = self;
    (void)in;
    a->applies = is("shy") && wanted & FF_BIT(1) ? FF_APPLIES_NOT : FF_APPLIES;
    a->reason = "by its words";
    a->error = is("coarse") || is("shy") ? 0.06 : is("liar") ? 0.01 : 0.2;
    a->cost = is("liar") ? 0.1 : 0.5;
    if (is("fine")) {
        double cells = g->given ? g->cells : fmin(ceil(1 / accuracy), 10000);
        snprintf(g->text, sizeof g->text, "%.0f", cells);
        g->proposal = (ff_proposal){"cells", g->text};
        a->proposals = &g->proposal;
        a->proposal_count = 1;
        a->error = 1 / cells;
        a->cost = cells;
    }
    return FF_OK;
}

const ff_model *flankfilm_model_v1(void)
{
    static const ff_model model = {
        .size = sizeof model,
        .abi_major = FF_ABI_MAJOR,
        .abi_minor = FF_ABI_MINOR,
        .id = "gauge/" NAME,
        .version = "1.0.0",
        .summary = "known errors without physics",
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
        .assess = assess,
    };
    return &model;
}
