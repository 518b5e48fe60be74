/* SPDX-License-Identifier: MIT */
/*
 * operating/motor: where an induction motor on gear 1 settles under the load of a fan or a pump.
 *
 * Motor: T = 2 T_b/(s/s_b + s_b/s) over its slip s = 1 - n/n_0 (Kloss 1916), on the branch from
 * synchronous speed down to breakdown at s_b. Load: T = T_r (n/n_r)^exponent. The difference
 * falls all along that branch, so that bisection finds the one point in which they agree.
 */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct stage {
    const ff_host *host;
    double synchronous, breakdown, slip, torque, speed, exponent;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("synchronous_speed", "rpm", stage, synchronous, FF_REQUIRED, NULL, NULL, 1, 1e5, 0,
                0, "60 times the frequency of the supply over the pairs of poles"),
    FF_QUANTITY("breakdown_torque", "N m", stage, breakdown, FF_REQUIRED | FF_MIN_OPEN, NULL, NULL,
                0, 1e9, 0, 0, "largest torque of the motor"),
    FF_QUANTITY("breakdown_slip", "", stage, slip, 0, "0.2", NULL, 0.01, 0.9, 0.05, 0.4,
                "slip at the largest torque"),
    FF_QUANTITY("load_torque", "N m", stage, torque, FF_REQUIRED, NULL, NULL, 0, 1e9, 0, 0,
                "what the load asks of gear 1 at load_speed"),
    FF_QUANTITY("load_speed", "rpm", stage, speed, FF_REQUIRED, NULL, NULL, 1, 1e5, 0, 0,
                "speed of gear 1 at which it asks that"),
    FF_QUANTITY("exponent", "", stage, exponent, 0, "2", NULL, 0, 4, 0, 0,
                "of the load over speed: 0 a hoist, 2 a fan or a centrifugal pump"),
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
    {.name = "slip", .unit = "1", .dims = "", .doc = "slip of the motor"},
};

static double motor_torque(const stage *s, double slip)
{
    return slip > 0 ? 2 * s->breakdown / (slip / s->slip + s->slip / slip) : 0;
}

static double load_torque(const stage *s, double slip)
{
    return s->torque * pow((1 - slip) * s->synchronous / s->speed, s->exponent);
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    double teeth = in[0].shape[0] ? in[0].data[0] : 0, radius = in[1].shape[0] ? in[1].data[0] : 0;
    (void)wanted;
    if (!(teeth >= 1 && teeth < 1e6))
        return ff_failf(s->host, FF_INVALID, "gear.teeth", "%g is not a number of teeth", teeth);
    if (!(radius > 1e-6 && radius < 1e6))
        return ff_failf(s->host, FF_INVALID, "gear.base_radius", "%g m is not a radius", radius);
    if (load_torque(s, s->slip) > s->breakdown)
        return ff_failf(s->host, FF_INVALID, "breakdown_torque",
                        "the motor stalls: at its breakdown slip the load asks for %g N m",
                        load_torque(s, s->slip));
    double none = 0, stall = s->slip;
    while (stall - none > 1e-15 + 1e-12 * s->slip) {
        double middle = (none + stall) / 2;
        if (motor_torque(s, middle) < load_torque(s, middle))
            none = middle;
        else
            stall = middle;
    }
    double speed = (1 - stall) * s->synchronous, torque = load_torque(s, stall);
    const double value[] = {torque, speed, speed * teeth / 6.283185307179586, torque / radius,
                            stall};
    for (uint32_t i = 0; i < sizeof value / sizeof *value; i++)
        if (ff_put_scalar(s->host, i, value[i]) != FF_OK)
            return FF_NOMEM;
    return FF_OK;
}

FF_MODEL(model, stage, .id = "operating/motor", .version = "1.0.0",
         .summary = "an induction motor on gear 1 under a load that rises with speed",
         .reference = "Kloss 1916, Archiv fuer Elektrotechnik 5, 59-87", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
