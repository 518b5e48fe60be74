/* SPDX-License-Identifier: GPL-3.0-or-later */
/* operating/steady: constant torque and speed. */
#include "references.h"

#include <flankfilm/author.h>
#include <flankfilm/needs.h>

#include <math.h>
#include <stdlib.h>

typedef struct steady {
    const ff_host *host;
    double torque, reference_torque, oil_temperature;
    double speed, mesh_frequency; /* rad/s, Hz; one of both is given */
} steady;

static const ff_param params[] = {
    FF_QUANTITY(
        "torque", "N m", steady, torque, FF_REQUIRED, NULL, NULL, -1e12, 1e12, -1e7, 1e7,
        "torque on gear 1, constant; of a power: that over the speed; below 0: gear 2 drives "
        "and the back flanks bear; 0: the gears float between their flanks"),
    FF_QUANTITY("reference_torque", "N m", steady, reference_torque, FF_MIN_OPEN, NULL, NULL, 0,
                1e12, 0, 0,
                "torque at which stiffness, sharing of the load and damping are taken; default: "
                "the torque without its sign"),
    FF_QUANTITY("speed", "rpm", steady, speed, FF_REQUIRED, NULL, "speed", 1e-3, 1e7, 0, 0,
                "speed of gear 1"),
    FF_QUANTITY("mesh_frequency", "Hz", steady, mesh_frequency, FF_REQUIRED, NULL, "speed", 1e-4,
                1e9, 0, 0, "tooth meshes per second, in place of the speed; needs a gear"),
    FF_QUANTITY("oil_temperature", "degC", steady, oil_temperature, 0, NULL, NULL, -150, 500, 0, 0,
                "temperature of the oil that enters the mesh; a stage that reads it asks for it"),
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

enum {
    OUT_TORQUE,
    OUT_SPEED,
    OUT_MESH_FREQUENCY,
    OUT_LINE_FORCE,
    OUT_OIL_TEMPERATURE,
    OUT_REFERENCE
};

static const ff_port outputs[] = {
    {.name = "torque", .unit = "N m", .doc = "torque on gear 1", .dims = ""},
    {.name = "speed", .unit = "rad/s", .doc = "speed of gear 1", .dims = ""},
    {.name = "mesh_frequency", .unit = "Hz", .doc = "tooth meshes per second", .dims = ""},
    {.name = "line_force",
     .unit = "N",
     .doc = "force along the line of action, torque over base radius, below 0 on the back flanks; "
            "needs a gear",
     .dims = ""},
    {.name = "oil_temperature", .unit = "K", .doc = "temperature of the oil", .dims = ""},
    {.name = "reference_force",
     .unit = "N",
     .doc = "force along the line of action at which stiffness, sharing and damping are taken, 0: "
            "the line force; needs a gear",
     .dims = ""},
};

static const char no_gear[] = "this output needs a gear: wire `gear` to a stage that offers one";
static const char no_temperature[] =
    "oil_temperature is missing: give the temperature of the oil that enters the mesh";

static ff_status ready(void *self)
{
    const steady *s = self;
    const ff_serving rows[] = {
        {1, "torque", "torque|line_force", NULL, NULL},
        {1, "reference_torque", "reference_force", NULL, NULL},
        {1, "speed", "speed|mesh_frequency", NULL, NULL},
        {1, "mesh_frequency", "speed|mesh_frequency", NULL, NULL},
        {1, "oil_temperature", "oil_temperature", NULL, NULL},
    };
    const ff_need needs[] = {
        {s->speed > 0, "gear.teeth", "mesh_frequency", no_gear},
        {!(s->speed > 0), "gear.teeth", "speed", no_gear},
        {1, "gear.base_radius", "line_force|reference_force", no_gear},
        {1, "oil_temperature", "oil_temperature", no_temperature},
    };
    ff_serve(s->host, rows, sizeof rows / sizeof rows[0]);
    ff_tell_needs(s->host, needs, sizeof needs / sizeof needs[0]);
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
                      [OUT_OIL_TEMPERATURE] = s->oil_temperature,
                      [OUT_REFERENCE] = 0};
    double gear = 1;
    ff_status status = FF_OK;
    if (s->torque < 0)
        s->host->quality(
            s->host->ctx, "flank", -1, 0, FF_GOOD,
            "the torque is below 0: gear 2 drives, and tooth forces, films, losses "
            "and ratings are of the back flanks; roll angles stay those of gear 1, "
            "and fall in time; relief as back_relief says, or as on the driving flank");
    int other = s->speed > 0 ? OUT_MESH_FREQUENCY : OUT_SPEED;
    if (wanted & FF_BIT(other)) {
        status = from_gear(s, &in[IN_TEETH], "gear.teeth", outputs[other].name, &gear);
        if (status != FF_OK)
            return status;
        /* f_m = z1 omega1 / (2 pi) */
        value[other] =
            s->speed > 0 ? s->speed * gear / (2 * M_PI) : s->mesh_frequency * 2 * M_PI / gear;
    }
    if (wanted & (FF_BIT(OUT_LINE_FORCE) | FF_BIT(OUT_REFERENCE))) {
        status = from_gear(s, &in[IN_BASE_RADIUS], "gear.base_radius", "line_force", &gear);
        if (status != FF_OK)
            return status;
        value[OUT_LINE_FORCE] = s->torque / gear;
        value[OUT_REFERENCE] = s->reference_torque > 0 ? s->reference_torque / gear : 0;
    }
    if (wanted & FF_BIT(OUT_OIL_TEMPERATURE) && isnan(s->oil_temperature))
        return s->host->fail(s->host->ctx, FF_UNSUPPORTED, "oil_temperature", no_temperature);
    for (uint32_t i = 0; i <= OUT_REFERENCE && status == FF_OK; i++)
        if (wanted & FF_BIT(i))
            status = ff_put_scalar(s->host, i, value[i]);
    return status;
}

FF_MODEL(operating_steady, steady, .id = "operating/steady", .version = "1.0.0",
         .summary = "constant torque and speed of gear 1",
         .reference = "Li and Kahraman 2011, Proc. IMechE Part J, Influence of dynamic behaviour "
                      "on elastohydrodynamic lubrication of spur gears",
         .bibtex = BIB_likahraman2011, .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
         .inputs = FF_TABLE(inputs), .outputs = FF_TABLE(outputs), .ready = ready,
         .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&operating_steady);
