/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A row of each type with a place, and one without; the outputs are what the members hold. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdbool.h>
#include <string.h>

typedef struct placed {
    const ff_host *host;
    double real, speed, rate;
    int64_t integer;
    int32_t on, choice;
    const char *text, *file;
    ff_reals list;
    bool is_ready;
    double check; /* of texts and lists, when ready */
    double sets;  /* calls of set, all of which found the members filled in; below 0: one did not */
} placed;

static const ff_param params[] = {
    {.name = "plain", .unit = "1", .doc = "for set", .type = FF_REAL, .preset = "3"},
    FF_QUANTITY_OR("auto", "real", "mm", placed, real, 0, NULL, NULL, 0, 100, 1, 50, "a length"),
    FF_COUNT_OR("few|many", "integer", placed, integer, 0, NULL, NULL, 0, 100, 0, 0, "a number"),
    FF_SWITCH("on", placed, on, NULL, "a switch"),
    FF_ONE_OF("even|odd", "choice", placed, choice, 0, NULL, "a choice"),
    FF_PHRASE("text", placed, text, 0, NULL, NULL, "a text"),
    FF_PATH("file", placed, file, 0, NULL, "a file"),
    FF_LIST("list", "kg", placed, list, 0, NULL, NULL, 0, 0, 0, 0, 0, 0, "a list"),
    FF_QUANTITY("speed", "rpm", placed, speed, 0, "10 rpm", "turning", 0, 0, 0, 0, "in a group"),
    FF_QUANTITY("rate", "Hz", placed, rate, 0, NULL, "turning", 0, 0, 0, 0, "the same"),
};

static const ff_port outputs[] = {
    {.name = "real", .unit = "m", .doc = "-1: not given", .dims = ""},
    {.name = "integer", .unit = "1", .doc = "as it is", .dims = ""},
    {.name = "on", .unit = "1", .doc = "as it is", .dims = ""},
    {.name = "choice", .unit = "1", .doc = "as it is", .dims = ""},
    {.name = "text", .unit = "1", .doc = "length; -1: not given", .dims = ""},
    {.name = "file", .unit = "1", .doc = "length; -1: not given", .dims = ""},
    {.name = "list", .unit = "1", .doc = "count", .dims = ""},
    {.name = "sum", .unit = "kg", .doc = "of the list", .dims = ""},
    {.name = "speed", .unit = "rad/s", .doc = "-1: not given", .dims = ""},
    {.name = "rate", .unit = "Hz", .doc = "-1: not given", .dims = ""},
    {.name = "sets", .unit = "1", .doc = "calls of set", .dims = ""},
    {.name = "given", .unit = "1", .doc = "parameters that the user wrote", .dims = ""},
};

/* Before they are filled in the members are 0, which no row reads as: `on` is -1, 0 or 1. */
static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    placed *p = self;
    p->sets += param == 0 && value->real == 3 && !isnan(p->sets) ? 1 : -1000;
    if (p->real == 0 && p->integer == 0)
        p->sets = -1000;
    return FF_OK;
}

static double length(const char *text)
{
    return text ? (double)strlen(text) : -1;
}

static double number(double value)
{
    return isnan(value) ? -1 : value;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const placed *p = self;
    double sum = 0, given = 0;
    (void)wanted, (void)in;
    for (size_t i = 0; i < p->list.count; i++)
        sum += p->list.data[i];
    for (uint32_t i = 0; i < sizeof params / sizeof *params; i++)
        given += p->host->given(p->host->ctx, i);
    const double values[] = {number(p->real),
                             (double)p->integer,
                             p->on,
                             p->choice,
                             length(p->text),
                             length(p->file),
                             (double)p->list.count,
                             sum,
                             number(p->speed),
                             number(p->rate),
                             p->sets,
                             given};
    ff_status status = FF_OK;
    for (uint32_t i = 0; i < sizeof values / sizeof *values && status == FF_OK; i++)
        status = ff_put_scalar(p->host, i, values[i]);
    return status;
}

static double check_sum(const placed *p)
{
    double sum = 0;
    for (const char *at = p->text; at && *at; at++)
        sum = 31 * sum + *at;
    for (size_t i = 0; i < p->list.count; i++)
        sum += p->list.data[i];
    return sum;
}

static ff_status ready(void *self)
{
    placed *p = self;
    p->check = check_sum(p);
    p->is_ready = true;
    return FF_OK;
}

/* Texts and lists are what they were until here. */
static void destroy(void *self)
{
    const placed *p = self;
    double off = p && p->is_ready ? check_sum(p) - p->check : 0;
    if (off < 0 || off > 0)
        abort();
    free(self);
}

FF_MODEL(placed_model, placed, .id = "toy/placed", .version = "1.0.0",
         .summary = "What stands behind each row with a place", .reference = "", .bibtex = "",
         .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .outputs = FF_TABLE(outputs),
         .set = set, .ready = ready, .evaluate = evaluate, .destroy = destroy);
FF_EXPORT_MODELS(&placed_model);
