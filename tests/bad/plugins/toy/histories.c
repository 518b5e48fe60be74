/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Histories of two stages: toy/histories gives one, toy/along another at its instants, toy/apart
   takes two of different lengths, toy/together two of one length. */
#include <flankfilm/author.h>
#include <flankfilm/history.h>

#include <stdlib.h>

typedef struct histories {
    const ff_host *host;
    int64_t count, more;
    double from;
} histories;

static const ff_param params[] = {
    FF_COUNT("count", histories, count, 0, "3", NULL, 1, 100, 0, 0, "instants"),
    FF_QUANTITY("from", "s", histories, from, 0, "0 s", NULL, 0, 0, 0, 0, "first instant"),
};
static const ff_param along_params[] = {
    FF_COUNT("more", histories, more, 0, "0", NULL, 0, 100, 0, 0, "instants that it must not have"),
};

enum { T, Y };

static const ff_port outputs[] = {
    {.name = "t", .unit = "s", .doc = "instants", .dims = "t"},
    {.name = "series", .unit = "m", .doc = "their squares", .dims = "t"},
};
static const ff_port along_outputs[] = {
    {.name = "t", .unit = "s", .doc = "instants", .dims = "one.t"},
    {.name = "series", .unit = "m", .doc = "the same", .dims = "one.t"},
};
static const ff_port sampled[] = {
    {.name = "series", .unit = "m", .doc = "two at the instants of one", .dims = "one.t"},
};

enum { ONE_T, ONE, TWO_T, TWO };

#define PAIR(dims_of_two)                                                                          \
    {                                                                                              \
        {.name = "one.t", .unit = "s", .doc = "instants", .dims = "t", .from = "toy"},             \
            {.name = "one.series", .unit = "m", .doc = "a series", .dims = "t", .from = "toy"},    \
            {.name = "two.t",                                                                      \
             .unit = "s",                                                                          \
             .doc = "instants",                                                                    \
             .dims = dims_of_two,                                                                  \
             .flags = FF_OPTIONAL,                                                                 \
             .from = "toy"},                                                                       \
        {                                                                                          \
            .name = "two.series", .unit = "m", .doc = "a series", .dims = dims_of_two,             \
            .flags = FF_OPTIONAL, .from = "toy"                                                    \
        }                                                                                          \
    }
static const ff_port apart_inputs[] = PAIR("t"), together_inputs[] = PAIR("one.t");

static ff_status put(const histories *h, size_t count, const double *t)
{
    double *instants = ff_put_series(h->host, T, count), *y = ff_put_series(h->host, Y, count);
    for (size_t i = 0; instants && y && i < count; i++) {
        instants[i] = t ? t[i] : h->from + (double)i;
        y[i] = instants[i] * instants[i];
    }
    return instants && y ? FF_OK : FF_NOMEM;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const histories *h = self;
    (void)wanted, (void)in;
    return put(h, (size_t)h->count, NULL);
}

static ff_status evaluate_along(void *self, uint64_t wanted, const ff_array *in)
{
    const histories *h = self;
    const double t[101] = {0};
    const size_t count = in[ONE_T].shape[0];
    (void)wanted;
    return put(h, count + (size_t)h->more, h->more ? t : in[ONE_T].data);
}

static ff_status sample(void *self, uint64_t wanted, const ff_array *in)
{
    const histories *h = self;
    const size_t count = in[ONE_T].shape[0];
    double *y = ff_put_series(h->host, 0, count);
    (void)wanted;
    if (!y || !in[TWO].data)
        return FF_NOMEM;
    if (ff_history_at(in[TWO].shape[0], in[TWO_T].data, in[TWO].data, count, in[ONE_T].data, y) < 0)
        return ff_failf(h->host, FF_INVALID, "two.t", "instants must not decrease");
    return FF_OK;
}

#define TEXTS                                                                                      \
    .version = "1.0.0", .summary = "Histories", .reference = "", .bibtex = "",                     \
    .licence = "GPL-3.0-or-later", .destroy = free

FF_MODEL(history, histories, TEXTS, .id = "toy/histories", .params = FF_TABLE(params),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate);
FF_MODEL(along, histories, TEXTS, .id = "toy/along", .params = FF_TABLE(along_params),
         .inputs = apart_inputs, .input_count = TWO_T, .input_stride = sizeof(ff_port),
         .outputs = FF_TABLE(along_outputs), .evaluate = evaluate_along);
FF_MODEL(apart, histories, TEXTS, .id = "toy/apart", .inputs = FF_TABLE(apart_inputs),
         .outputs = FF_TABLE(sampled), .evaluate = sample);
FF_MODEL(together, histories, TEXTS, .id = "toy/together", .inputs = FF_TABLE(together_inputs),
         .outputs = FF_TABLE(sampled), .evaluate = sample);
FF_EXPORT_MODELS(&history, &along, &apart, &together);
