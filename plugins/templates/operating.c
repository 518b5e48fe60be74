/* @ID@: torque and speed at a temperature; write your duty into `evaluate`. */
#include <flankfilm/author.h>

#include <stdlib.h>

enum { TORQUE, SPEED, TEMPERATURE, PARAMS };

typedef struct {
    const ff_host *host;
    double value[PARAMS];
} stage;

static const ff_param params[] = {
    [TORQUE] = {.name = "torque",
                .unit = "N m",
                .type = FF_REAL,
                .flags = FF_REQUIRED,
                .doc = "torque on gear 1",
                .min = 0,
                .max = 1e9},
    [SPEED] = {.name = "speed",
               .unit = "rpm",
               .type = FF_REAL,
               .flags = FF_REQUIRED | FF_MIN_OPEN,
               .doc = "speed of gear 1",
               .min = 0,
               .max = 1e6},
    [TEMPERATURE] = {.name = "oil_temperature",
                     .unit = "degC",
                     .type = FF_REAL,
                     .preset = "40 degC",
                     .doc = "temperature of the oil",
                     .min = -100,
                     .max = 400},
};

static const ff_port inputs[] = {
    {.name = "gear.teeth", .unit = "1", .dims = "gear", .doc = "numbers of teeth"},
    {.name = "gear.base_radius", .unit = "m", .dims = "gear", .doc = "base circle radii"},
};

static const ff_port outputs[] = {
    {.name = "torque", .unit = "N m", .dims = "", .doc = "torque on gear 1"},
    {.name = "speed", .unit = "rad/s", .dims = "", .doc = "speed of gear 1"},
    {.name = "mesh_frequency", .unit = "Hz", .dims = "", .doc = "mesh cycles per second"},
    {.name = "line_force", .unit = "N", .dims = "", .doc = "force along the line of action"},
    {.name = "oil_temperature", .unit = "K", .dims = "", .doc = "temperature of the oil"},
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
    double teeth = in[0].shape[0] ? in[0].data[0] : 0, radius = in[1].shape[0] ? in[1].data[0] : 0;
    (void)wanted;
    if (!(teeth >= 1 && teeth < 1e6))
        return ff_failf(s->host, FF_INVALID, "gear.teeth", "%g is not a number of teeth", teeth);
    if (!(radius > 1e-6 && radius < 1e6))
        return ff_failf(s->host, FF_INVALID, "gear.base_radius", "%g m is not a radius", radius);
    const double value[] = {s->value[TORQUE], s->value[SPEED],
                            s->value[SPEED] * teeth / 6.283185307179586, s->value[TORQUE] / radius,
                            s->value[TEMPERATURE]};
    for (uint32_t i = 0; i < 5; i++)
        if (ff_put_scalar(s->host, i, value[i]) != FF_OK)
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
