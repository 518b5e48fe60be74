/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Models of one kind that assess themselves, each in the way that NAME says. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int is(const char *name)
{
    return !strcmp(NAME, name);
}

enum { CELLS, SCALE, KEY };

static const ff_param params[] = {
    {.name = "cells",
     .unit = "1",
     .doc = "its error is one over them",
     .type = FF_INT,
     .flags = FF_TUNABLE,
     .preset = "10",
     .min = 1,
     .max = 1000},
    {.name = "scale", .unit = "mm", .doc = "a length", .type = FF_REAL, .preset = "1 mm"},
    {.name = "key", .unit = "", .doc = "a text", .type = FF_TEXT, .flags = FF_REQUIRED},
};

static const ff_port inputs[] = {
    {.name = "source.level", .unit = "m", .doc = "a length", .dims = "", .from = "toy"},
    {.name = "more.level", .unit = "m", .doc = "another one", .dims = "", .from = "none"},
};

static const ff_port outputs[] = {
    {.name = "value", .unit = "1", .doc = "which model it is, and its cells", .dims = ""},
    {.name = "created", .unit = "1", .doc = "how often parameters were set", .dims = ""},
    {.name = "extra", .unit = "1", .doc = "what others lack", .dims = ""},
};

typedef struct picked {
    const ff_host *host;
    double cells, sets;
    int given;
    char proposed[32];
    ff_proposal proposal;
} picked;

static ff_status create(const ff_host *host, void **self)
{
    picked *p = calloc(1, sizeof *p);
    *self = p;
    if (p)
        p->host = host;
    return p ? FF_OK : FF_NOMEM;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    picked *p = self;
    if (param != CELLS)
        return FF_OK;
    p->cells = (double)value->integer;
    p->given = value->given;
    p->sets++;
    return FF_OK;
}

static ff_status ready(void *self)
{
    picked *p = self;
    return p->cells != 13 ? FF_OK
                          : ff_failf(p->host, FF_INVALID, "cells", "must not be 13 in %s", NAME);
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const picked *p = self;
    (void)wanted, (void)in;
    if (p->cells > 776 && p->cells < 778)
        p->host->quality(p->host->ctx, "balance", 1, 0, FF_BAD, "777 cells do not balance");
    ff_status status = ff_put_scalar(p->host, 0, is("coarse") ? 1 : p->cells);
    if (status == FF_OK)
        status = ff_put_scalar(p->host, 1, p->sets);
    return status == FF_OK && !is("coarse") ? ff_put_scalar(p->host, 2, 7) : status;
}

/* fine: as many cells as the accuracy takes, unless they are given. */
static void tune(picked *p, double accuracy, ff_assessment *a)
{
    double cells = p->given ? p->cells : fmin(ceil(1 / accuracy), 1000);
    snprintf(p->proposed, sizeof p->proposed, "%.0f", cells);
    p->proposal = (ff_proposal){is("liar") ? "scale" : "cells", p->proposed};
    a->proposals = &p->proposal;
    a->proposal_count = 1;
    a->error = 1 / cells;
    a->cost = cells;
}

static ff_status assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        ff_assessment *a)
{
    picked *p = self;
    (void)wanted;
    a->applies = FF_APPLIES;
    if (is("coarse")) {
        a->error = 0.05;
        a->cost = 2;
        a->reason = "coarse is coarse";
        return FF_OK;
    }
    tune(p, accuracy, a);
    a->reason = "one over the cells";
    if (is("vast"))
        a->error = INFINITY;
    if (in[0].data[0] > 0.09) {
        a->applies = FF_AMBIGUOUS;
        a->reason = "two answers beyond 90 mm";
    }
    if (in[0].data[0] < 0.001)
        return ff_failf(p->host, FF_INVALID, "source.level", "too short to judge");
    return FF_OK;
}

const ff_model *flankfilm_model_v1(void)
{
    static ff_model model = {
        .size = sizeof model,
        .abi_major = FF_ABI_MAJOR,
        .abi_minor = FF_ABI_MINOR,
        .id = "picked/" NAME,
        .version = "1.0.0",
        .summary = "one of several",
        .reference = "",
        .bibtex = "",
        .licence = "GPL-3.0-or-later",
        .params = params,
        .param_count = 2,
        .param_stride = sizeof params[0],
        .inputs = inputs,
        .input_count = 1,
        .input_stride = sizeof inputs[0],
        .outputs = outputs,
        .output_count = 3,
        .output_stride = sizeof outputs[0],
        .create = create,
        .set = set,
        .ready = ready,
        .evaluate = evaluate,
        .destroy = free,
        .assess = assess,
    };
    if (is("coarse")) {
        model.param_count = 1;
        model.output_count = 2;
    }
    if (is("needy"))
        model.param_count = 3;
    if (is("lonely"))
        model.input_count = 2;
    if (is("mute"))
        model.assess = NULL;
    return &model;
}
