/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A linear stage with feedback: level = base + gain before + factor back + share more. */
#include <flankfilm/author.h>

#include "../toy/toy.h"

#include <math.h>
#include <string.h>
#include <time.h>

typedef struct loop {
    const ff_host *host;
    double base, gain, factor, share, most, work;
    int64_t points, rows;
    int32_t warns;
    double evaluations;
    char carried[32];
} loop;

#define NUMBER(name, preset, doc)                                                                  \
    FF_QUANTITY(#name, "1", loop, name, 0, preset, NULL, 0, 0, 0, 0, doc)
static const ff_param params[] = {
    FF_QUANTITY("base", "m", loop, base, FF_REQUIRED, NULL, NULL, 0, 0, 0, 0, "without inputs"),
    NUMBER(gain, "1", "of what is before"),
    NUMBER(factor, "0", "of what comes back"),
    NUMBER(share, "0", "of what else comes back"),
    FF_QUANTITY("most", "m", loop, most, 0, "1e300 m", NULL, 0, 0, 0, 0, "above it, no solution"),
    FF_QUANTITY("work", "s", loop, work, 0, "0 s", NULL, 0, 0.1, 0, 0, "wasted in evaluate"),
    FF_COUNT("points", loop, points, 0, "3", NULL, 0, 100, 0, 0, "one less with feedback"),
    FF_COUNT("rows", loop, rows, 0, "0", NULL, 0, 100, 0, 0, "of the series; 0: it is one"),
    FF_SWITCH("warns", loop, warns, "false", "says that it is out of range"),
};

static const char nobody[] = "nothing";
static const ff_port inputs[] = {
    {.name = "before.level",
     .unit = "m",
     .doc = "a level",
     .dims = "",
     .flags = FF_OPTIONAL,
     .from = nobody},
    {.name = "before.series",
     .unit = "m",
     .doc = "a series",
     .dims = "t",
     .flags = FF_OPTIONAL,
     .from = nobody},
    {.name = "flag.sign",
     .unit = "1",
     .doc = "a sign",
     .dims = "",
     .flags = FF_OPTIONAL,
     .from = nobody},
    {.name = "law",
     .unit = "",
     .doc = "a law",
     .dims = NULL,
     .service = TOY_LAW_ID,
     .flags = FF_OPTIONAL,
     .from = nobody},
    {.name = "back.level",
     .unit = "m",
     .doc = "a level",
     .dims = "",
     .flags = FF_OPTIONAL | FF_FEEDBACK,
     .from = "loop"},
    {.name = "back.series",
     .unit = "m",
     .doc = "a series",
     .dims = "before.t",
     .flags = FF_OPTIONAL | FF_FEEDBACK,
     .from = "loop"},
    {.name = "more.level",
     .unit = "m",
     .doc = "another level",
     .dims = "",
     .flags = FF_OPTIONAL | FF_FEEDBACK,
     .from = "loop"},
};
enum { BEFORE, BEFORE_SERIES, FLAG, LAW, BACK, BACK_SERIES, MORE };

static const ff_port outputs[] = {
    {.name = "level", .unit = "m", .doc = "a level", .dims = ""},
    {.name = "series", .unit = "m", .doc = "the level over its points", .dims = "row? t"},
    {.name = "sign", .unit = "1", .doc = "of the level", .dims = ""},
    {.name = "evaluations", .unit = "1", .doc = "so far", .dims = ""},
    {.name = "connected", .unit = "1", .doc = "inputs that are there", .dims = ""},
    {.name = "law", .unit = "", .doc = "itself as a law", .dims = NULL, .service = TOY_LAW_ID},
    {.name = "returned",
     .unit = "m",
     .doc = "the level that comes back; refused without",
     .dims = ""},
};

static ff_status wire(void *self, uint32_t input, const void *service)
{
    (void)self, (void)input, (void)service;
    return FF_OK;
}

static ff_status ready(void *self)
{
    const loop *l = self;
    return l->points > 0 ? FF_OK : ff_failf(l->host, FF_DOMAIN, NULL, "no points");
}

static double at(const ff_array *in, double factor)
{
    return in->data ? factor * in->data[0] : 0;
}

static void waste(double seconds)
{
    clock_t end = clock() + (clock_t)(seconds * CLOCKS_PER_SEC);
    while (clock() < end)
        ;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    loop *l = self;
    const ff_host *host = l->host;
    double connected = 0;
    char text[32];
    if (wanted & FF_BIT(6) && !in[BACK].data)
        return ff_failf(host, FF_UNSUPPORTED, "returned", "nothing comes back");
    waste(l->work);
    for (int i = 0; i < 7; i++)
        connected += in[i].data != NULL;
    double level =
        l->base + at(&in[BEFORE], l->gain) + at(&in[BACK], l->factor) + at(&in[MORE], l->share);
    if (level > l->most)
        return ff_failf(host, FF_NOCONV, NULL, "the level is %g", level);
    if (host->progress(host->ctx, 0.5))
        return FF_STOPPED;
    l->evaluations++;
    snprintf(text, sizeof text, "evaluation %g", l->evaluations);
    host->log(host->ctx, FF_LOG_INFO, text);
    host->quality(host->ctx, "level", level, l->most, FF_GOOD, NULL);
    double values[] = {level, 0, (level > 0) - (level < 0), l->evaluations, connected};
    ff_status status = l->warns ? ff_failf(host, FF_DOMAIN, NULL, "level %g", level) : FF_OK;
    for (uint32_t i = 0; i < sizeof values / sizeof *values; i++)
        if (i != 1 && wanted & FF_BIT(i) && ff_put_scalar(host, i, values[i]) != FF_OK)
            return FF_NOMEM;
    size_t count = (size_t)l->points - (l->points > 3 && in[BACK].data);
    size_t rows = l->rows ? (size_t)l->rows : 1, shape[] = {rows, count};
    double *series = wanted & FF_BIT(1)
                         ? host->output(host->ctx, 1, l->rows ? 2 : 1, l->rows ? shape : &shape[1])
                         : NULL;
    for (size_t i = 0; series && i < rows * count; i++)
        series[i] = level * (double)(i % count + 1) / (double)count;
    if (wanted & FF_BIT(6) && ff_put_scalar(host, 6, in[BACK].data[0]) != FF_OK)
        return FF_NOMEM;
    return status;
}

static const void *service(void *self, uint32_t output)
{
    static const toy_law law = {.size = sizeof law};
    (void)self, (void)output;
    return &law;
}

/* The state tells how often stages before it were evaluated. */
static ff_status carry(void *self, const ff_state_bytes *from, ff_state_bytes *to)
{
    loop *l = self;
    if (from)
        l->evaluations = 100 * (double)from->count;
    else
        to->bytes = l->carried, to->count = 1;
    return FF_OK;
}

FF_MODEL(loop_model, loop, .id = "loop/linear", .version = "1.0.0",
         .summary = "Adds up what is before and what comes back", .reference = "", .bibtex = "",
         .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .wire = wire, .ready = ready, .evaluate = evaluate,
         .destroy = free, .service = service, .carry = carry);
FF_EXPORT_MODELS(&loop_model);
