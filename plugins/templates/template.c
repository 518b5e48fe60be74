/* @ID@: a stage with one optional input and two outputs; write your model into `evaluate`. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct {
    const ff_host *host;
    double amplitude;
    size_t points;
} stage;

static const ff_param params[] = {
    {.name = "amplitude",
     .unit = "mm",
     .type = FF_REAL,
     .preset = "1 mm",
     .doc = "half the height of the wave",
     .max = 1000},
    {.name = "points",
     .unit = "",
     .type = FF_INT,
     .preset = "64",
     .flags = FF_TUNABLE,
     .doc = "points of a period",
     .min = 2,
     .max = 1e6},
};

static const ff_port inputs[] = {
    {.name = "operating.speed",
     .unit = "rad/s",
     .dims = "gear",
     .doc = "speeds; without them: 1 rad/s",
     .flags = FF_OPTIONAL,
     .from = "operating"},
};

static const ff_port outputs[] = {
    {.name = "time", .unit = "s", .dims = "t", .doc = "time"},
    {.name = "height", .unit = "m", .dims = "t", .doc = "height of the wave"},
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
        s->points = (size_t)value->integer;
    return FF_OK;
}

/* `wanted` has a bit for each output; those that are not wanted may be left out. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    stage *s = self;
    double speed = in[0].data && in[0].shape[0] ? in[0].data[0] : 1;
    (void)wanted;
    if (!(fabs(speed) > 1e-9 && fabs(speed) < 1e9))
        return ff_failf(s->host, FF_INVALID, "operating.speed", "%g rad/s is not a speed of a wave",
                        speed);
    double *time = ff_put_series(s->host, 0, s->points),
           *height = ff_put_series(s->host, 1, s->points);
    if (!time || !height)
        return FF_NOMEM;
    for (size_t i = 0; i < s->points; i++) {
        double phase = 6.283185307179586 * (double)i / (double)(s->points - 1);
        time[i] = phase / fabs(speed);
        height[i] = s->amplitude * sin(phase);
    }
    s->host->quality(s->host->ctx, "periodicity", fabs(height[s->points - 1] - height[0]), 1e-12,
                     FF_GOOD, NULL);
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
    .inputs = FF_TABLE(inputs),
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
