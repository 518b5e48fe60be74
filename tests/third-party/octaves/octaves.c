/* SPDX-License-Identifier: MIT */
/*
 * surface/octaves: a self-affine flank 1 as a sum of waves whose lengths halve (the function of
 * Weierstrass and Mandelbrot: Majumdar & Bhushan 1990), against a smooth flank 2.
 *
 * Wave k, k = 0, 1, ..., has the wave number 2^k and the amplitude c 2^(-k H), H the exponent of
 * Hurst; its phase is k times the golden angle, so that no two crests agree. All waves fit into the
 * record: Rq^2 = sum a_k^2/2, which gives c.
 */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct stage {
    const ff_host *host;
    double rq, length, hurst;
    int64_t octaves, points;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("rq", "um", stage, rq, FF_REQUIRED, NULL, NULL, 0, 100, 0.01, 5,
                "root mean square roughness of flank 1"),
    FF_QUANTITY("length", "um", stage, length, 0, "800 um", NULL, 1, 1e6, 0, 0,
                "longest wave, after which the record repeats"),
    FF_COUNT("octaves", stage, octaves, 0, "5", NULL, 1, 16, 0, 0,
             "waves: the shortest has length/2^(octaves - 1)"),
    FF_QUANTITY("hurst", "", stage, hurst, 0, "0.8", NULL, 0, 1, 0, 0,
                "exponent of Hurst: 1 a flank whose short waves are as steep as its long ones"),
    FF_COUNT("points", stage, points, FF_TUNABLE, "16", NULL, 4, 1024, 0, 0,
             "points of the shortest wave"),
};

enum { POSITION, HEIGHT_1, HEIGHT_2, RQ_1, RQ_2, PERIOD, ORIGIN };

static const ff_port outputs[] = {
    [POSITION] = {.name = "position",
                  .unit = "m",
                  .dims = "arc",
                  .doc = "along x, equal steps from 0"},
    [HEIGHT_1] = {.name = "height_1", .unit = "m", .dims = "arc", .doc = "out of the metal"},
    [HEIGHT_2] = {.name = "height_2", .unit = "m", .dims = "arc", .doc = "out of the metal"},
    [RQ_1] = {.name = "rq_1", .unit = "m", .dims = "", .doc = "root mean square of height_1"},
    [RQ_2] = {.name = "rq_2", .unit = "m", .dims = "", .doc = "root mean square of height_2"},
    [PERIOD] = {.name = "period", .unit = "m", .dims = "", .doc = "after which all repeats"},
    [ORIGIN] = {.name = "origin",
                .unit = "m",
                .dims = "",
                .doc = "what lies at x = 0 at the first time"},
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const size_t points = (size_t)s->points << (s->octaves - 1);
    const double turn = 2 * 3.14159265358979323846, golden = turn * 0.3819660112501051;
    double *position = ff_put_series(s->host, POSITION, points),
           *height_1 = ff_put_series(s->host, HEIGHT_1, points),
           *height_2 = ff_put_series(s->host, HEIGHT_2, points), square = 0;
    const double scalar[] = {s->rq, 0, s->length, 0};
    (void)wanted, (void)in;
    if (!position || !height_1 || !height_2)
        return FF_NOMEM;
    for (int k = 0; k < s->octaves; k++)
        square += pow(2, -2 * k * s->hurst) / 2;
    for (size_t i = 0; i < points; i++) {
        double share = (double)i / (double)points; /* the last point is a step before the period */
        position[i] = share * s->length;
        height_1[i] = height_2[i] = 0;
        for (int k = 0; k < s->octaves; k++)
            height_1[i] += s->rq / sqrt(square) * pow(2, -k * s->hurst) *
                           cos(turn * share * (double)(1 << k) + k * golden);
    }
    for (uint32_t i = RQ_1; i <= ORIGIN; i++)
        if (ff_put_scalar(s->host, i, scalar[i - RQ_1]) != FF_OK)
            return FF_NOMEM;
    return FF_OK;
}

FF_MODEL(model, stage, .id = "surface/octaves", .version = "1.0.0",
         .summary = "a self-affine flank whose waves halve in length",
         .reference = "Majumdar & Bhushan 1990, J. Tribol. 112, 205-216", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .outputs = FF_TABLE(outputs),
         .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
