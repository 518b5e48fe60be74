/* @ID@: one wave on flank 1; flank 2 is smooth. Write your flanks into `evaluate`. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct {
    const ff_host *host;
    double amplitude, wavelength;
    int64_t points;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("amplitude", "um", stage, amplitude, 0, "0.5 um", NULL, 0, 1e4, 0, 0,
                "half the height from valley to crest"),
    FF_QUANTITY("wavelength", "um", stage, wavelength, 0, "200 um", NULL, 0.01, 1e7, 0, 0,
                "length of a wave"),
    FF_COUNT("points", stage, points, FF_TUNABLE, "64", NULL, 4, 1e6, 0, 0,
             "number of points per wave"),
};

enum { POSITION, HEIGHT_1, HEIGHT_2, RQ_1, RQ_2, PERIOD, ORIGIN };

static const ff_port outputs[] = {
    [POSITION] = {.name = "position",
                  .unit = "m",
                  .dims = "arc",
                  .doc = "arc coordinate of the points along x, in equal steps from 0"},
    [HEIGHT_1] = {.name = "height_1",
                  .unit = "m",
                  .dims = "arc",
                  .doc = "heights of flank 1, positive out of the metal"},
    [HEIGHT_2] = {.name = "height_2",
                  .unit = "m",
                  .dims = "arc",
                  .doc = "heights of flank 2, positive out of the metal"},
    [RQ_1] = {.name = "rq_1",
              .unit = "m",
              .dims = "",
              .doc = "root mean square roughness of flank 1"},
    [RQ_2] = {.name = "rq_2",
              .unit = "m",
              .dims = "",
              .doc = "root mean square roughness of flank 2"},
    [PERIOD] =
        {.name = "period",
         .unit = "m",
         .dims = "",
         .doc = "length after which the record repeats; 0: the flanks are flat outside the record"},
    [ORIGIN] = {.name = "origin",
                .unit = "m",
                .dims = "",
                .doc = "arc coordinate that lies at x = 0 at the first time"},
};

/* `wanted` has one bit per output; outputs that are not wanted may be left out. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    size_t points = (size_t)s->points;
    double *position = ff_put_series(s->host, POSITION, points);
    double *height_1 = ff_put_series(s->host, HEIGHT_1, points);
    double *height_2 = ff_put_series(s->host, HEIGHT_2, points);
    const double scalar[] = {s->amplitude / sqrt(2), 0, s->wavelength, 0};
    (void)wanted, (void)in;
    if (!position || !height_1 || !height_2)
        return FF_NOMEM;
    for (size_t i = 0; i < points; i++) {
        /* the last point is one step before the wave repeats */
        double share = (double)i / (double)points;
        position[i] = share * s->wavelength;
        height_1[i] = s->amplitude * cos(6.283185307179586 * share);
        height_2[i] = 0;
    }
    for (uint32_t i = RQ_1; i <= ORIGIN; i++)
        if (ff_put_scalar(s->host, i, scalar[i - RQ_1]) != FF_OK)
            return FF_NOMEM;
    return FF_OK;
}

FF_MODEL(model, stage, .id = "@ID@", .version = "0.1.0",
         .summary = "one line that says what the model is for", .reference = "", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .outputs = FF_TABLE(outputs),
         .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
