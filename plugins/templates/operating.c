/* @ID@: torque and speed at one temperature. Write your operating point into `evaluate`. */
#include <flankfilm/author.h>

#include <stdlib.h>

typedef struct {
    const ff_host *host;
    double torque, speed, temperature;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("torque", "N m", stage, torque, FF_REQUIRED, NULL, NULL, 0, 1e9, 0, 0,
                "torque on gear 1"),
    FF_QUANTITY("speed", "rpm", stage, speed, FF_REQUIRED | FF_MIN_OPEN, NULL, NULL, 0, 1e6, 0, 0,
                "speed of gear 1"),
    FF_QUANTITY("oil_temperature", "degC", stage, temperature, 0, "40 degC", NULL, -100, 400, 0, 0,
                "temperature of the oil"),
};

static const ff_port inputs[] = {
    {.name = "gear.teeth", .unit = "1", .dims = "gear", .doc = "numbers of teeth"},
    {.name = "gear.base_radius", .unit = "m", .dims = "gear", .doc = "base circle radii"},
};

static const ff_port outputs[] = {
    {.name = "torque", .unit = "N m", .dims = "", .doc = "torque on gear 1"},
    {.name = "speed", .unit = "rad/s", .dims = "", .doc = "speed of gear 1"},
    {.name = "mesh_frequency",
     .unit = "Hz",
     .dims = "",
     .doc = "mesh frequency: mesh cycles per second"},
    {.name = "line_force", .unit = "N", .dims = "", .doc = "force along the line of action"},
    {.name = "oil_temperature", .unit = "K", .dims = "", .doc = "temperature of the oil"},
};

/* `wanted` has one bit per output; outputs that are not wanted may be left out. */
static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    double teeth = in[0].shape[0] ? in[0].data[0] : 0, radius = in[1].shape[0] ? in[1].data[0] : 0;
    (void)wanted;
    if (!(teeth >= 1 && teeth < 1e6))
        return ff_failf(s->host, FF_INVALID, "gear.teeth", "%g is not a valid number of teeth",
                        teeth);
    if (!(radius > 1e-6 && radius < 1e6))
        return ff_failf(s->host, FF_INVALID, "gear.base_radius", "%g m is not a valid radius",
                        radius);
    const double value[] = {s->torque, s->speed, s->speed * teeth / 6.283185307179586,
                            s->torque / radius, s->temperature};
    for (uint32_t i = 0; i < 5; i++)
        if (ff_put_scalar(s->host, i, value[i]) != FF_OK)
            return FF_NOMEM;
    return FF_OK;
}

FF_MODEL(model, stage, .id = "@ID@", .version = "0.1.0",
         .summary = "one line that says what the model is for", .reference = "", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
