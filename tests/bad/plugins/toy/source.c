/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A healthy model without physics: every type of parameter, scalars, a series, a field. */
#include <flankfilm/author.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COUNT, LEVEL, SHARE, MODE, ON, NOTE, WEIGHTS, TABLE, STEPS, SPEED, RATE, FROM, TO, ANSWER };

static const ff_param params[] = {
    {.name = "count",
     .unit = "1",
     .doc = "length of the series",
     .type = FF_INT,
     .preset = "3",
     .max = 1e6},
    {.name = "level",
     .unit = "mm",
     .doc = "value of all outputs",
     .type = FF_REAL,
     .flags = FF_REQUIRED | FF_MIN_OPEN,
     .max = 100,
     .low = 0.5,
     .high = 50},
    {.name = "share", .unit = "1", .doc = "a share", .type = FF_REAL, .preset = "0.5", .max = 1},
    {.name = "mode",
     .unit = "",
     .doc = "a choice",
     .type = FF_CHOICE,
     .preset = "even",
     .choices = "even|odd"},
    {.name = "on", .unit = "", .doc = "a switch", .type = FF_BOOL, .preset = "true"},
    {.name = "note", .unit = "", .doc = "a text", .type = FF_TEXT},
    {.name = "weights",
     .unit = "kg",
     .doc = "a list",
     .type = FF_REALS,
     .flags = FF_INCREASING,
     .preset = "[1 kg, 2 kg]",
     .max = 10,
     .min_count = 1,
     .max_count = 3},
    {.name = "table", .unit = "", .doc = "a file", .type = FF_FILE},
    {.name = "steps",
     .unit = "1",
     .doc = "a number or a word",
     .type = FF_INT,
     .preset = "auto",
     .choices = "auto|few",
     .min = 1,
     .max = 1000},
    {.name = "speed",
     .unit = "rpm",
     .doc = "one of two",
     .type = FF_REAL,
     .preset = "10 rpm",
     .group = "speed"},
    {.name = "rate", .unit = "Hz", .doc = "the other of two", .type = FF_REAL, .group = "speed"},
    {.name = "range.from", .unit = "degC", .doc = "begin of a range", .type = FF_REAL},
    {.name = "range.to", .unit = "degC", .doc = "end of a range", .type = FF_REAL},
    {.name = "answer", .unit = "", .doc = "status of ready or evaluate", .type = FF_TEXT},
};

enum {
    OUT_LEVEL,
    OUT_SERIES,
    OUT_FIELD,
    OUT_WANTED,
    OUT_EVALUATIONS,
    OUT_SPEED,
    OUT_RARE,
    OUT_NEVER
};

static const ff_port outputs[] = {
    {.name = "level", .unit = "m", .doc = "the level", .dims = ""},
    {.name = "series", .unit = "m", .doc = "the level again and again", .dims = "t"},
    {.name = "field", .unit = "m", .doc = "the same in a plane", .dims = "t x"},
    {.name = "wanted", .unit = "1", .doc = "the bits that were asked for", .dims = ""},
    {.name = "evaluations", .unit = "1", .doc = "calls of evaluate", .dims = ""},
    {.name = "speed", .unit = "rad/s", .doc = "the speed, or 0", .dims = ""},
    {.name = "rare", .unit = "Pa", .doc = "a series in groups", .dims = "group? k"},
    {.name = "never", .unit = "1", .doc = "refused when it is wanted", .dims = ""},
};

typedef struct source {
    const ff_host *host;
    double level, speed;
    size_t count;
    int evaluations;
    char answer[32];
} source;

static ff_status create(const ff_host *host, void **self)
{
    source *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    *self = s;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    source *s = self;
    if (param == COUNT)
        s->count = (size_t)value->integer;
    else if (param == LEVEL)
        s->level = value->real;
    else if (param == SPEED)
        s->speed = value->real;
    else if (param == ANSWER)
        snprintf(s->answer, sizeof s->answer, "%s", value->text);
    return FF_OK;
}

static ff_status ready(void *self)
{
    const source *s = self;
    if (!strcmp(s->answer, "ready"))
        return ff_failf(s->host, FF_INVALID, "count", "a count of %zu is not to be had", s->count);
    return FF_OK;
}

/* The status that the user asked for; "" stands for FF_OK. */
static ff_status answer(const source *s)
{
    static const struct {
        const char *word;
        ff_status status;
    } statuses[] = {{"domain", FF_DOMAIN},   {"noconv", FF_NOCONV}, {"stopped", FF_STOPPED},
                    {"invalid", FF_INVALID}, {"nomem", FF_NOMEM},   {"unsupported", FF_UNSUPPORTED},
                    {"bug", FF_BUG},         {"unknown", 77}};
    for (size_t i = 0; i < sizeof statuses / sizeof statuses[0]; i++)
        if (!strcmp(s->answer, statuses[i].word))
            return ff_failf(s->host, statuses[i].status, "level", "the answer is %s", s->answer);
    if (!strcmp(s->answer, "bad"))
        s->host->quality(s->host->ctx, "balance", 0.5, 1e-8, FF_BAD, "nothing balances");
    if (!strcmp(s->answer, "progress") && s->host->progress(s->host->ctx, 0.5))
        return FF_STOPPED;
    return FF_OK;
}

static ff_status fill(const source *s, uint32_t output, uint32_t rank, const size_t *shape)
{
    double *data = s->host->output(s->host->ctx, output, rank, shape);
    if (!data)
        return FF_NOMEM;
    size_t count = 1;
    for (uint32_t i = 0; i < rank; i++)
        count *= shape[i];
    for (size_t i = 0; i < count; i++)
        data[i] = s->level;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    source *s = self;
    const size_t shape[] = {s->count, 4};
    (void)in;
    s->evaluations++;
    if (wanted & FF_BIT(OUT_NEVER))
        return ff_failf(s->host, FF_UNSUPPORTED, "never", "not to be had");
    ff_put_scalar(s->host, OUT_WANTED, (double)wanted);
    ff_put_scalar(s->host, OUT_EVALUATIONS, s->evaluations);
    ff_put_scalar(s->host, OUT_SPEED, s->speed);
    fill(s, OUT_LEVEL, 0, NULL);
    fill(s, OUT_SERIES, 1, shape);
    s->host->quality(s->host->ctx, "residual", 1e-12, 1e-8, FF_GOOD, NULL);
    s->host->log(s->host->ctx, FF_LOG_INFO, "working");
    if ((wanted & FF_BIT(OUT_FIELD)) && fill(s, OUT_FIELD, 2, shape) != FF_OK)
        return FF_NOMEM;
    if (wanted & FF_BIT(OUT_RARE))
        fill(s, OUT_RARE, 1, shape);
    return answer(s);
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = "toy/source",
    .version = "1.0.0",
    .summary = "A source of equal numbers",
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
    .ready = ready,
    .evaluate = evaluate,
    .destroy = free,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
