/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cheap models in the place of toy/order, whose value is 1: guess is off by what it is told, and by
   1 more without the wave of the stage before, which toy/order does not ask for; brief has no wave
   of its own. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct guess {
    const ff_host *host;
    double off, gain;
    int32_t sure;
} guess;

static const ff_param params[] = {
    FF_QUANTITY("off", "%", guess, off, 0, "1 %", NULL, 0, 100, 0, 0, "by what the value is off"),
    FF_QUANTITY("gain", "1", guess, gain, 0, "1", NULL, -1e6, 1e6, 0, 0,
                "what the value before is multiplied by"),
    FF_SWITCH("sure", guess, sure, "true", "it has no doubts"),
};

static const ff_port inputs[] = {
    {.name = "before.value",
     .unit = "m",
     .dims = "",
     .doc = "of a stage before",
     .flags = FF_OPTIONAL,
     .from = "toy"},
    {.name = "before.wave",
     .unit = "m",
     .dims = "t",
     .doc = "of the same",
     .flags = FF_OPTIONAL,
     .from = "toy"},
};

static const ff_port outputs[] = {
    {.name = "value", .unit = "m", .dims = "", .doc = "1 m, and what the stage before gives"},
    {.name = "time", .unit = "s", .dims = "t", .doc = "0 to 1 s"},
    {.name = "wave", .unit = "m", .dims = "t", .doc = "2 + sin(2 pi t), times the value"},
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    enum { POINTS = 101 };
    const guess *g = self;
    double value = 1 + g->off + (in[0].data ? g->gain * in[0].data[0] : 0);
    value += in[0].data && !in[1].data ? 1 : 0;
    if (wanted & 1)
        ff_put_scalar(g->host, 0, value);
    if (wanted & 6) {
        double *time = ff_put_series(g->host, 1, POINTS), *wave = ff_put_series(g->host, 2, POINTS);
        if (!time || !wave)
            return FF_NOMEM;
        for (size_t i = 0; i < POINTS; i++) {
            time[i] = (double)i / (POINTS - 1);
            wave[i] = value * (2 + sin(6.283185307179586 * time[i]));
        }
    }
    g->host->quality(g->host->ctx, "trust", 0, 1, g->sure ? FF_GOOD : FF_DOUBTFUL, NULL);
    return FF_OK;
}

FF_MODEL(model, guess, .id = "toy/guess", .version = "1.0.0", .summary = "a guess", .reference = "",
         .bibtex = "", .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate, .destroy = free, .cost = 0.1);
FF_MODEL(brief, guess, .id = "toy/brief", .version = "1.0.0", .summary = "a guess without a wave",
         .reference = "", .bibtex = "", .licence = "MIT", .params = FF_TABLE(params),
         .inputs = FF_TABLE(inputs), .outputs = outputs, .output_count = 1,
         .output_stride = sizeof outputs[0], .evaluate = evaluate, .destroy = free, .cost = 0.01);
FF_EXPORT_MODELS(&model, &brief);
