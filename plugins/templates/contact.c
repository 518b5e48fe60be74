/* @ID@: a steady line contact; write your history of one contact into `evaluate`. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { RADIUS, SPEED, SLIDE, WIDTH_LOAD, MODULUS, PARAMS };

typedef struct {
    const ff_host *host;
    double value[PARAMS];
} stage;

static const ff_param params[] = {
    [RADIUS] = {.name = "radius",
                .unit = "mm",
                .type = FF_REAL,
                .flags = FF_REQUIRED,
                .doc = "equivalent radius R, 1/R = 1/R1 + 1/R2",
                .min = 1e-3,
                .max = 1e6},
    [SPEED] = {.name = "entrainment_speed",
               .unit = "m/s",
               .type = FF_REAL,
               .flags = FF_REQUIRED,
               .doc = "u_r = (u1 + u2)/2",
               .min = 0,
               .max = 1e4},
    [SLIDE] = {.name = "slide_roll_ratio",
               .unit = "",
               .type = FF_REAL,
               .preset = "0",
               .doc = "(u1 - u2)/u_r",
               .min = -2,
               .max = 2},
    [WIDTH_LOAD] = {.name = "load_per_width",
                    .unit = "N/mm",
                    .type = FF_REAL,
                    .flags = FF_REQUIRED,
                    .doc = "load per width of the contact",
                    .min = 0,
                    .max = 1e6},
    [MODULUS] = {.name = "reduced_modulus",
                 .unit = "GPa",
                 .type = FF_REAL,
                 .preset = "226.4 GPa",
                 .doc = "E' of 2/E' = sum (1 - nu^2)/E",
                 .min = 1e-3,
                 .max = 1e5},
};

enum { TIME, EQUIVALENT, SPEED_1, SPEED_2, LOAD, WIDTH, PRESSURE, REDUCED };

static const ff_port outputs[] = {
    [TIME] = {.name = "time", .unit = "s", .dims = "t", .doc = "time; one: a steady contact"},
    [EQUIVALENT] = {.name = "equivalent_radius", .unit = "m", .dims = "t", .doc = "R"},
    [SPEED_1] = {.name = "speed_1", .unit = "m/s", .dims = "t", .doc = "surface speed u1"},
    [SPEED_2] = {.name = "speed_2", .unit = "m/s", .dims = "t", .doc = "surface speed u2"},
    [LOAD] = {.name = "load_per_width", .unit = "N/m", .dims = "t", .doc = "load per width"},
    [WIDTH] = {.name = "hertz_half_width", .unit = "m", .dims = "t", .doc = "dry half width"},
    [PRESSURE] = {.name = "hertz_pressure",
                  .unit = "Pa",
                  .dims = "t",
                  .doc = "dry maximum pressure"},
    [REDUCED] = {.name = "reduced_modulus", .unit = "Pa", .dims = "", .doc = "E'"},
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
    ((stage *)self)->value[param] = value->real;
    return FF_OK;
}

/* `wanted` has a bit for each output; those that are not wanted may be left out. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const double *v = s->value, pi = 3.141592653589793;
    const double width = sqrt(8 * v[WIDTH_LOAD] * v[RADIUS] / (pi * v[MODULUS]));
    const double value[] = {0,
                            v[RADIUS],
                            v[SPEED] * (1 + v[SLIDE] / 2),
                            v[SPEED] * (1 - v[SLIDE] / 2),
                            v[WIDTH_LOAD],
                            width,
                            width > 0 ? 2 * v[WIDTH_LOAD] / (pi * width) : 0};
    (void)wanted, (void)in;
    for (uint32_t i = TIME; i <= PRESSURE; i++) {
        double *series = ff_put_series(s->host, i, 1);
        if (!series)
            return FF_NOMEM;
        series[0] = value[i];
    }
    return ff_put_scalar(s->host, REDUCED, v[MODULUS]);
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
