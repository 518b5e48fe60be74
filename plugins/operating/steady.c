/* SPDX-License-Identifier: GPL-3.0-or-later */
/* operating/steady: constant torque and speed. */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { P_TORQUE, P_SPEED, P_MESH_FREQUENCY, P_OIL_TEMPERATURE };

static const ff_param params[] = {
    {.name = "torque",
     .unit = "N m",
     .doc = "torque on gear 1, constant",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .min = 1e-9,
     .max = 1e12},
    {.name = "speed",
     .unit = "rpm",
     .doc = "speed of gear 1",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .group = "speed",
     .min = 1e-3,
     .max = 1e7},
    {.name = "mesh_frequency",
     .unit = "Hz",
     .doc = "tooth meshes per second, in place of the speed; needs a gear",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .group = "speed",
     .min = 1e-4,
     .max = 1e9},
    {.name = "oil_temperature",
     .unit = "degC",
     .doc = "temperature of the oil that enters the mesh, handed to stages that ask for it",
     .type = FF_REAL,
     .preset = "40 degC",
     .min = -150,
     .max = 500},
};

enum { IN_TEETH, IN_BASE_RADIUS };

static const ff_port inputs[] = {
    {.name = "gear.teeth",
     .unit = "1",
     .doc = "numbers of teeth",
     .dims = "gear",
     .flags = FF_OPTIONAL,
     .from = "gear"},
    {.name = "gear.base_radius",
     .unit = "m",
     .doc = "base circle radii",
     .dims = "gear",
     .flags = FF_OPTIONAL,
     .from = "gear"},
};

enum { OUT_TORQUE, OUT_SPEED, OUT_MESH_FREQUENCY, OUT_LINE_FORCE, OUT_OIL_TEMPERATURE };

static const ff_port outputs[] = {
    {.name = "torque", .unit = "N m", .doc = "torque on gear 1", .dims = ""},
    {.name = "speed", .unit = "rad/s", .doc = "speed of gear 1", .dims = ""},
    {.name = "mesh_frequency", .unit = "Hz", .doc = "tooth meshes per second", .dims = ""},
    {.name = "line_force",
     .unit = "N",
     .doc = "force along the line of action, torque over base radius; needs a gear",
     .dims = ""},
    {.name = "oil_temperature", .unit = "K", .doc = "temperature of the oil", .dims = ""},
};

typedef struct steady {
    const ff_host *host;
    double torque, oil_temperature;
    double speed, mesh_frequency; /* rad/s, Hz; 0: not given */
} steady;

static ff_status create(const ff_host *host, void **self)
{
    steady *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    *self = s;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    steady *s = self;
    switch (param) {
    case P_TORQUE:
        s->torque = value->real;
        break;
    case P_SPEED:
        s->speed = value->real;
        break;
    case P_MESH_FREQUENCY:
        s->mesh_frequency = value->real;
        break;
    default:
        s->oil_temperature = value->real;
    }
    return FF_OK;
}

static ff_status ready(void *self)
{
    const steady *s = self;
    if ((s->speed > 0) == (s->mesh_frequency > 0))
        return ff_failf(s->host, FF_INVALID, s->speed > 0 ? "mesh_frequency" : "speed",
                        "give one of speed and mesh_frequency, above 0");
    return FF_OK;
}

/* Reads the value of gear 1, above 0; a missing gear is refused with the output that needs it. */
static ff_status from_gear(const steady *s, const ff_array *in, const char *input,
                           const char *output, double *value)
{
    if (!in->data || in->rank != 1 || in->shape[0] < 1)
        return ff_failf(s->host, FF_INVALID, input,
                        "%s needs a gear: wire `gear` to a stage that offers %s", output,
                        input + 5);
    *value = in->data[0];
    if (!(*value > 0 && isfinite(*value)))
        return ff_failf(s->host, FF_INVALID, input, "%s of gear 1 is %g; it must be above 0",
                        input + 5, *value);
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const steady *s = self;
    double value[] = {[OUT_TORQUE] = s->torque,
                      [OUT_SPEED] = s->speed,
                      [OUT_MESH_FREQUENCY] = s->mesh_frequency,
                      [OUT_LINE_FORCE] = 0,
                      [OUT_OIL_TEMPERATURE] = s->oil_temperature};
    double gear = 1;
    ff_status status = FF_OK;
    int other = s->speed > 0 ? OUT_MESH_FREQUENCY : OUT_SPEED;
    if (wanted & FF_BIT(other)) {
        status = from_gear(s, &in[IN_TEETH], "gear.teeth", outputs[other].name, &gear);
        if (status != FF_OK)
            return status;
        /* f_m = z1 omega1 / (2 pi) */
        value[other] =
            s->speed > 0 ? s->speed * gear / (2 * M_PI) : s->mesh_frequency * 2 * M_PI / gear;
    }
    if (wanted & FF_BIT(OUT_LINE_FORCE)) {
        status = from_gear(s, &in[IN_BASE_RADIUS], "gear.base_radius", "line_force", &gear);
        if (status != FF_OK)
            return status;
        value[OUT_LINE_FORCE] = s->torque / gear;
    }
    for (uint32_t i = 0; i <= OUT_OIL_TEMPERATURE && status == FF_OK; i++)
        if (wanted & FF_BIT(i))
            status = ff_put_scalar(s->host, i, value[i]);
    return status;
}

static void destroy(void *self)
{
    free(self);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "operating/steady",
    .version = "1.0.0",
    .summary = "constant torque and speed of gear 1",
    .reference = "Li and Kahraman 2011, Proc. IMechE Part J, Influence of dynamic behaviour on "
                 "elastohydrodynamic lubrication of spur gears",
    .bibtex =
        "@article{likahraman2011, author = {Li, S. and Kahraman, A.}, title = {Influence of "
        "dynamic "
        "behaviour on elastohydrodynamic lubrication of spur gears}, journal = {Proceedings of the "
        "Institution of Mechanical Engineers, Part J}, pages = {740--753}, year = {2011}}",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .inputs = FF_TABLE(inputs),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .ready = ready,
    .evaluate = evaluate,
    .destroy = destroy,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
