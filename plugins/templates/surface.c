/* @ID@: one wave on flank 1, flank 2 smooth; write your flanks into `evaluate`. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct {
    const ff_host *host;
    double amplitude, wavelength;
    size_t points;
} stage;

static const ff_param params[] = {
    {.name = "amplitude",
     .unit = "um",
     .type = FF_REAL,
     .preset = "0.5 um",
     .doc = "half the height from valley to crest",
     .min = 0,
     .max = 1e4},
    {.name = "wavelength",
     .unit = "um",
     .type = FF_REAL,
     .preset = "200 um",
     .doc = "length of a wave",
     .min = 0.01,
     .max = 1e7},
    {.name = "points",
     .unit = "",
     .type = FF_INT,
     .preset = "64",
     .flags = FF_TUNABLE,
     .doc = "points of a wave",
     .min = 4,
     .max = 1e6},
};

enum { POSITION, HEIGHT_1, HEIGHT_2, RQ_1, RQ_2, PERIOD, ORIGIN };

static const ff_port outputs[] = {
    [POSITION] = {.name = "position",
                  .unit = "m",
                  .dims = "arc",
                  .doc = "arc coordinate along x, in equal steps from 0"},
    [HEIGHT_1] = {.name = "height_1",
                  .unit = "m",
                  .dims = "arc",
                  .doc = "flank 1, positive out of the metal"},
    [HEIGHT_2] = {.name = "height_2",
                  .unit = "m",
                  .dims = "arc",
                  .doc = "flank 2, positive out of the metal"},
    [RQ_1] = {.name = "rq_1",
              .unit = "m",
              .dims = "",
              .doc = "root mean square roughness of flank 1"},
    [RQ_2] = {.name = "rq_2",
              .unit = "m",
              .dims = "",
              .doc = "root mean square roughness of flank 2"},
    [PERIOD] = {.name = "period",
                .unit = "m",
                .dims = "",
                .doc = "length after which the record repeats; 0: flat outside of it"},
    [ORIGIN] = {.name = "origin",
                .unit = "m",
                .dims = "",
                .doc = "arc coordinate that lies at x = 0 at the first time"},
};

static ff_status create(const ff_host *host, void **self)
{
    stage *s = calloc(1, sizeof *s);
    if (!s)
        return ff_failf(host, FF_NOMEM, NULL, "out of memory");
    s->host = host;
    *self = s;
    return FF_OK;
}

/* The value is in SI units. */
static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    stage *s = self;
    if (param == 0)
        s->amplitude = value->real;
    if (param == 1)
        s->wavelength = value->real;
    if (param == 2)
        s->points = (size_t)value->integer;
    return FF_OK;
}

/* `wanted` has a bit for each output; those that are not wanted may be left out. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    double *position = ff_put_series(s->host, POSITION, s->points);
    double *height_1 = ff_put_series(s->host, HEIGHT_1, s->points);
    double *height_2 = ff_put_series(s->host, HEIGHT_2, s->points);
    const double scalar[] = {s->amplitude / sqrt(2), 0, s->wavelength, 0};
    (void)wanted, (void)in;
    if (!position || !height_1 || !height_2)
        return FF_NOMEM;
    for (size_t i = 0; i < s->points; i++) {
        /* the last point is one step before the wave repeats */
        double share = (double)i / (double)s->points;
        position[i] = share * s->wavelength;
        height_1[i] = s->amplitude * cos(6.283185307179586 * share);
        height_2[i] = 0;
    }
    for (uint32_t i = RQ_1; i <= ORIGIN; i++)
        if (ff_put_scalar(s->host, i, scalar[i - RQ_1]) != FF_OK)
            return FF_NOMEM;
    return FF_OK;
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .id = "@ID@",
    .version = "0.1.0",
    .summary = "one line on what it is good for",
    .reference = "",
    .bibtex = "",
    .licence = "MIT",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .evaluate = evaluate,
    .destroy = free,
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
