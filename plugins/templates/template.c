/* @ID@: a stage with one optional input and two outputs. Write your model into `evaluate`. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct {
    const ff_host *host;
    double amplitude;
    int64_t points;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("amplitude", "mm", stage, amplitude, 0, "1 mm", NULL, 0, 1000, 0, 0,
                "half the height of the wave"),
    FF_COUNT("points", stage, points, FF_TUNABLE, "64", NULL, 2, 1e6, 0, 0,
             "number of points per period"),
};

static const ff_port inputs[] = {
    {.name = "operating.speed",
     .unit = "rad/s",
     .dims = "gear",
     .doc = "angular speed; not wired: 1 rad/s",
     .flags = FF_OPTIONAL,
     .from = "operating"},
};

static const ff_port outputs[] = {
    {.name = "time", .unit = "s", .dims = "t", .doc = "time"},
    {.name = "height", .unit = "m", .dims = "t", .doc = "height of the wave"},
};

/* `wanted` has one bit per output; outputs that are not wanted may be left out. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    stage *s = self;
    size_t points = (size_t)s->points;
    double speed = in[0].data && in[0].shape[0] ? in[0].data[0] : 1;
    (void)wanted;
    if (!(fabs(speed) > 1e-9 && fabs(speed) < 1e9))
        return ff_failf(s->host, FF_INVALID, "operating.speed",
                        "%g rad/s is not a valid angular "
                        "speed",
                        speed);
    double *time = ff_put_series(s->host, 0, points), *height = ff_put_series(s->host, 1, points);
    if (!time || !height)
        return FF_NOMEM;
    for (size_t i = 0; i < points; i++) {
        double phase = 6.283185307179586 * (double)i / (double)(points - 1);
        time[i] = phase / fabs(speed);
        height[i] = s->amplitude * sin(phase);
    }
    s->host->quality(s->host->ctx, "periodicity", fabs(height[points - 1] - height[0]), 1e-12,
                     FF_GOOD, NULL);
    return FF_OK;
}

FF_MODEL(model, stage, .id = "@ID@", .version = "0.1.0",
         .summary = "one line that says what the model is for", .reference = "", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
