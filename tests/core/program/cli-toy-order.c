/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A model without physics whose numerical error is known: that of its cells is of a given order,
   that of its tolerance in proportion to it. */
#include <flankfilm/author.h>
#include <flankfilm/estimates.h>

#include <math.h>
#include <stdlib.h>
#include <time.h>

typedef struct order {
    const ff_host *host;
    int64_t cells, steps, least, most, sure, shown, few;
    int32_t exact, steady, read;
    double tolerance, order, strength, gain, heat, guess, loosest, blunt, seen, scatter, drift,
        work;
} order;

static const ff_param params[] = {
    FF_COUNT("cells", order, cells, FF_TUNABLE, "64", NULL, 2, 1e6, 0, 0, "cells"),
    FF_COUNT_OR("auto", "steps", order, steps, FF_TUNABLE, "auto", NULL, 1, 1e6, 0, 0,
                "points of the wave; auto: 101"),
    FF_QUANTITY("tolerance", "%", order, tolerance, FF_TUNABLE, "0.01 %", NULL, 1e-6, 50, 0, 0,
                "relative error of everything"),
    FF_SWITCH("steady", order, steady, "false", "the wave has one point, at 0.75 s"),
    FF_SWITCH("exact", order, exact, "false", "the tolerance changes nothing"),
    FF_QUANTITY("order", "1", order, order, 0, "2", NULL, 0.1, 10, 0, 0, "of the cells"),
    FF_QUANTITY("strength", "1", order, strength, 0, "10", NULL, -1e6, 1e6, 0, 0,
                "error of the value with one cell"),
    FF_QUANTITY("gain", "1", order, gain, 0, "1", NULL, -1e6, 1e6, 0, 0,
                "what the value before is multiplied by"),
    FF_QUANTITY("heat", "1", order, heat, 0, "0", NULL, 0, 1, 0, 0, "a doubt of no setting"),
    FF_QUANTITY("loosest", "%", order, loosest, 0, "100 %", NULL, 0, 100, 0, 0,
                "with a larger tolerance it fails"),
    FF_QUANTITY(
        "blunt", "%", order, blunt, 0, "100 %", NULL, 1e-6, 100, 0, 0,
        "larger tolerances have an error of three times this, and points that hardly follow"),
    FF_QUANTITY("guess", "1", order, guess, 0, "0.5", NULL, 0, 1e6, 0, 0,
                "what it estimates to be its error with one cell"),
    FF_QUANTITY("seen", "1", order, seen, 0, "0", NULL, 0, 1, 0, 0,
                "what it estimates the wave to be off by from the middle on, over it, with a "
                "tolerance of 0.01 %"),
    FF_QUANTITY("scatter", "1", order, scatter, 0, "0", NULL, 0, 1, 0, 0,
                "what the model is off by there"),
    FF_QUANTITY("drift", "1", order, drift, 0, "0", NULL, 0, 1, 0, 0,
                "share by which twice the cells raise the wave, but where it is least"),
    FF_QUANTITY("work", "s", order, work, 0, "0 s", NULL, 0, 10, 0, 0, "how long to seem busy"),
    FF_COUNT("least", order, least, 0, "0", NULL, 0, 1e6, 0, 0, "with fewer cells it fails"),
    FF_COUNT("most", order, most, 0, "1000000", NULL, 1, 1e6, 0, 0, "with more cells it fails"),
    FF_COUNT("shown", order, shown, 0, "1000000", NULL, 1, 1e6, 0, 0,
             "from so many cells on the value is 5 % higher"),
    FF_COUNT("few", order, few, 0, "0", NULL, 0, 1e6, 0, 0, "with fewer cells it misses a peak"),
    FF_SWITCH("read", order, read, "false", "it fails if nobody reads its estimates"),
    FF_COUNT("sure", order, sure, 0, "0", NULL, 0, 1e6, 0, 0, "with fewer cells it has doubts"),
};

static const ff_port inputs[] = {
    {.name = "before.value",
     .unit = "m",
     .dims = "",
     .doc = "of a stage before",
     .flags = FF_OPTIONAL,
     .from = "toy"},
};

static const ff_port outputs[] = {
    {.name = "value", .unit = "m", .dims = "", .doc = "1 m, and what the stage before gives"},
    {.name = "time", .unit = "s", .dims = "t", .doc = "0 to 1 s"},
    {.name = "wave", .unit = "m", .dims = "t", .doc = "2 + sin(2 pi t), times the value"},
    {.name = "wave_error", .unit = "m", .dims = "t", .doc = "by `seen` and `scatter`"},
    {.name = "pairs", .unit = "m", .dims = "pair? t", .doc = "the value, of two pairs of points"},
    {.name = "peaks", .unit = "m", .dims = "peak", .doc = "the value, three times"},
};

static ff_status ready(void *self)
{
    const order *o = self;
    const ff_serving rows[] = {{o->exact, "tolerance", "", NULL, "it is exact"}};
    ff_serve(o->host, rows, 1);
    return FF_OK;
}

/* Waits, and tells how far it is. */
static void seem_busy(const order *o)
{
    enum { PARTS = 20 };
    const struct timespec part = {0, (long)(1e9 * o->work / PARTS)};
    for (int i = 0; o->work > 0 && i < PARTS; i++) {
        nanosleep(&part, NULL);
        o->host->progress(o->host->ctx, (double)i / PARTS);
    }
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    order *o = self;
    double value = 1 + o->strength * pow((double)o->cells, -o->order);
    const double seen = o->seen * o->tolerance / 1e-4;
    size_t points = o->steady ? 1 : o->steps > 0 ? (size_t)o->steps : 101;
    if (o->cells < o->least)
        return ff_failf(o->host, FF_NOCONV, NULL, "%d cells are too few", (int)o->cells);
    if (o->cells > o->most)
        return ff_failf(o->host, FF_NOCONV, NULL, "%d cells are too many", (int)o->cells);
    if (o->read && !ff_estimates_are_read(o->host))
        return ff_failf(o->host, FF_NOCONV, NULL, "nobody reads the estimates");
    if (o->tolerance > o->loosest)
        return ff_failf(o->host, FF_NOCONV, NULL, "%g is too loose", o->tolerance);
    if (o->tolerance > o->blunt)
        points -= (size_t)log2(o->tolerance / o->blunt);
    seem_busy(o);
    value += o->exact ? 0 : o->tolerance > o->blunt ? 3 * o->blunt : o->tolerance;
    if (o->cells >= o->shown)
        value += 0.05;
    if (in[0].data)
        value += o->gain * in[0].data[0];
    if (wanted & 1)
        ff_put_scalar(o->host, 0, value);
    if (wanted & 14) {
        double *time = ff_put_series(o->host, 1, points), *wave = ff_put_series(o->host, 2, points),
               *off = ff_put_series(o->host, 3, points);
        if (!time || !wave || !off)
            return FF_NOMEM;
        for (size_t i = 0; i < points; i++) {
            time[i] = points > 1 ? (double)i / (double)(points - 1) : 0.75;
            wave[i] = value * (2 + sin(6.283185307179586 * time[i]));
            if (time[i] != 0.75)
                wave[i] *= 1 + o->drift * (log2((double)o->cells) - 6);
            off[i] = time[i] >= 0.5 ? (seen + o->scatter) * wave[i] : 0;
        }
    }
    if (wanted & FF_BIT(4)) {
        const size_t shape[] = {2, 2};
        double *pairs = o->host->output(o->host->ctx, 4, 2, shape);
        for (size_t i = 0; pairs && i < 4; i++)
            pairs[i] = value;
    }
    if (wanted & FF_BIT(5)) {
        const size_t count = o->cells < o->few ? 2 : 3;
        double *peaks = ff_put_series(o->host, 5, count);
        for (size_t i = 0; peaks && i < count; i++)
            peaks[i] = value;
    }
    const double guess = o->guess / (double)o->cells;
    o->host->quality(o->host->ctx, "value_guess_error", guess, 0.001, FF_DOUBTFUL, "a guess");
    o->host->quality(o->host->ctx, "balance", (double)o->sure / (double)o->cells, 1,
                     o->cells < o->sure ? FF_DOUBTFUL : FF_GOOD, "no estimate of an error");
    if (o->seen > 0)
        o->host->quality(o->host->ctx, "wave_seen_error", seen + o->scatter, 0.1, FF_DOUBTFUL,
                         "a guess");
    if (o->heat > 0)
        o->host->quality(o->host->ctx, "heat", o->heat, 0, FF_DOUBTFUL, "whatever the cells are");
    return FF_OK;
}

FF_MODEL(model, order, .id = "toy/order", .version = "1.0.0",
         .summary = "a value with a known error", .reference = "", .bibtex = "", .licence = "MIT",
         .params = FF_TABLE(params), .inputs = FF_TABLE(inputs), .outputs = FF_TABLE(outputs),
         .ready = ready, .evaluate = evaluate, .destroy = free, .cost = 1);
FF_MODEL(silent, order, .id = "toy/silent", .version = "1.0.0",
         .summary = "the same, without a word about what it costs", .reference = "", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .ready = ready, .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model, &silent);
