/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outputs with natural bounds, whose numbers are parameters; memory for an output that nobody asked
   for is taken and left alone. */
#include <flankfilm/author.h>

typedef struct bounded {
    const ff_host *host;
    double share, temperature, rise;
    ff_reals film;
    int32_t strange;
} bounded;

static const ff_param params[] = {
    FF_QUANTITY("share", "1", bounded, share, 0, "0.5", NULL, 0, 0, 0, 0, "given as it is"),
    FF_QUANTITY("temperature", "K", bounded, temperature, 0, "300 K", NULL, 0, 0, 0, 0, "a point"),
    FF_QUANTITY("rise", "K", bounded, rise, 0, "1 K", NULL, 0, 0, 0, 0, "a difference"),
    FF_LIST("film", "m", bounded, film, 0, "[1 m, 2 m]", NULL, 0, 0, 0, 0, 1, 9, "a series"),
    FF_SWITCH("strange", bounded, strange, "false", "adds a line that is outside of the range"),
};

enum { SHARE, TEMPERATURE, RISE, FILM, IDLE };

static const ff_port outputs[] = {
    {.name = "share", .unit = "1", .doc = "from 0 to 1", .dims = "", .max = 1},
    {.name = "temperature",
     .unit = "K",
     .doc = "never below 0",
     .dims = "",
     .shown = "degC",
     .quantity = "temperature of the toy",
     .apart = 5},
    {.name = "rise", .unit = "K", .doc = "of any sign", .dims = "", .flags = FF_DIFFERENCE},
    {.name = "film", .unit = "m", .doc = "not negative", .dims = "t", .max = INFINITY},
    {.name = "idle", .unit = "1", .doc = "given when asked for", .dims = ""},
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const bounded *b = self;
    (void)in;
    if (b->strange)
        b->host->quality(b->host->ctx, "strangeness", 2, 1, FF_RANGE, "stranger than it was meant");
    double *idle = b->host->output(b->host->ctx, IDLE, 0, NULL);
    double *film = ff_put_series(b->host, FILM, b->film.count);
    if (!idle || !film)
        return FF_NOMEM;
    if (wanted & FF_BIT(IDLE))
        *idle = 7;
    for (size_t i = 0; i < b->film.count; i++)
        film[i] = b->film.data[i];
    ff_status status = ff_put_scalar(b->host, SHARE, b->share);
    if (status == FF_OK)
        status = ff_put_scalar(b->host, TEMPERATURE, b->temperature);
    return status == FF_OK ? ff_put_scalar(b->host, RISE, b->rise) : status;
}

FF_MODEL(bounded_model, bounded, .id = "toy/bounded", .version = "1.0.0",
         .summary = "Gives numbers that have natural bounds", .reference = "", .bibtex = "",
         .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .outputs = FF_TABLE(outputs),
         .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&bounded_model);
