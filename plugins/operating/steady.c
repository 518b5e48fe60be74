/* SPDX-License-Identifier: GPL-3.0-or-later */
/* operating/steady: constant torque and speed. */
#include "references.h"

#include <flankfilm/author.h>
#include <flankfilm/needs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The sum of amplitude cos(order phi + phase) over the terms; phi is the angle of gear 1. */
typedef struct fluctuation {
    ff_reals amplitude, order, phase;
} fluctuation;

typedef struct steady {
    const ff_host *host;
    double torque, reference_torque, oil_temperature;
    double speed, mesh_frequency; /* rad/s, Hz; exactly one is given */
    fluctuation of_torque, of_speed;
} steady;

#define FLUCTUATION_ROWS(name, unit, member, most, doc)                                            \
    FF_LIST(name ".amplitude", unit, steady, member.amplitude, FF_MIN_OPEN, NULL, NULL, 0, most,   \
            0, 0, 0, 32, doc),                                                                     \
        FF_LIST(name ".order", "1", steady, member.order, FF_WHOLE, NULL, NULL, 1, 1000, 0, 0, 0,  \
                0,                                                                                 \
                "orders, one whole number per amplitude: periods of the fluctuation per turn "     \
                "of gear 1"),                                                                      \
        FF_LIST(name ".phase", "deg", steady, member.phase, 0, NULL, NULL, -360, 360, 0, 0, 0, 0,  \
                "phases of the terms amplitude cos(order angle + phase); the angle of gear 1 is "  \
                "0 when a pair is at SAP; default: 0")

static const ff_param params[] = {
    FF_QUANTITY("torque", "N m", steady, torque, FF_REQUIRED, NULL, NULL, -1e12, 1e12, -1e7, 1e7,
                "constant torque on gear 1: power over angular speed; negative: gear 2 drives and "
                "the back flanks carry the load; 0: the gears float within the backlash"),
    FF_QUANTITY(
        "reference_torque", "N m", steady, reference_torque, FF_MIN_OPEN, NULL, NULL, 0, 1e12, 0, 0,
        "torque for which stiffness, load sharing and damping are evaluated; default: the "
        "absolute value of the torque, or the largest value of its fluctuation if that is larger"),
    FF_QUANTITY("speed", "rpm", steady, speed, FF_REQUIRED, NULL, "speed", 1e-3, 1e7, 0, 0,
                "speed of gear 1"),
    FF_QUANTITY("mesh_frequency", "Hz", steady, mesh_frequency, FF_REQUIRED, NULL, "speed", 1e-4,
                1e9, 0, 0,
                "mesh frequency: tooth engagements per second, instead of speed; needs a gear"),
    FLUCTUATION_ROWS("torque_fluctuation", "N m", of_torque, 1e12,
                     "amplitudes of the torque fluctuation on gear 1, one per order"),
    FLUCTUATION_ROWS(
        "speed_fluctuation", "rpm", of_speed, 1e7,
        "amplitudes of the prescribed speed fluctuation of gear 1, one per order, independent of "
        "the tooth forces; the torque is then the load of gear 2, referred to gear 1"),
    FF_QUANTITY("oil_temperature", "degC", steady, oil_temperature, 0, NULL, NULL, -150, 500, 0, 0,
                "temperature of the oil that enters the mesh; required if a stage uses it"),
};

enum { IN_TEETH, IN_BASE_RADIUS, IN_INERTIA };

enum { MOST_SWINGS = 64 };

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
    {.name = "gear.inertia",
     .unit = "kg m2",
     .doc = "moments of inertia, needed for a speed fluctuation",
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
    OUT_REFERENCE,
    OUT_ORDER,
    OUT_COSINE,
    OUT_SINE,
    OUT_PERIOD,
    OUT_DRIVEN_MASS,
    OUT_LARGEST,
    OUT_COUNT
};

static const ff_port outputs[] = {
    {.name = "torque", .unit = "N m", .doc = "torque on gear 1", .dims = ""},
    {.name = "speed", .unit = "rad/s", .doc = "speed of gear 1", .dims = ""},
    {.name = "mesh_frequency",
     .unit = "Hz",
     .doc = "mesh frequency: tooth engagements per second",
     .dims = ""},
    {.name = "line_force",
     .unit = "N",
     .doc = "force along the line of action: torque over base radius, negative on the back flanks; "
            "needs a gear",
     .dims = ""},
    {.name = "oil_temperature", .unit = "K", .doc = "temperature of the oil", .dims = ""},
    {.name = "reference_force",
     .unit = "N",
     .doc = "force along the line of action for which stiffness, load sharing and damping are "
            "evaluated; 0: the line force; needs a gear",
     .dims = ""},
    {.name = "fluctuation_order",
     .unit = "1",
     .doc = "orders of the line force fluctuation: periods per turn of gear 1",
     .dims = "fluctuation"},
    {.name = "fluctuation_cosine",
     .unit = "N",
     .doc = "amplitude of cos(order angle) in the line force, for each order; angle of gear 1",
     .dims = "fluctuation"},
    {.name = "fluctuation_sine",
     .unit = "N",
     .doc = "amplitude of sin(order angle) in the line force, for each order",
     .dims = "fluctuation"},
    {.name = "fluctuation_period",
     .unit = "1",
     .doc = "number of mesh cycles after which line force and mesh repeat together",
     .dims = ""},
    {.name = "driven_mass",
     .unit = "kg",
     .doc = "equivalent mass if the speed of gear 1 is prescribed: that of gear 2, I2/rb2^2; 0: "
            "both gears are free",
     .dims = ""},
    {.name = "largest_force",
     .unit = "N",
     .doc = "largest absolute line force during the torque fluctuation; 0: no fluctuation",
     .dims = ""},
};

static const char no_gear[] = "this output needs a gear: wire `gear` to a stage that offers one";
static const char no_temperature[] =
    "oil_temperature is missing: give the temperature of the oil that enters the mesh";

static const char no_inertia[] =
    "speed_fluctuation needs a gear that offers inertia, since it accelerates gear 2";

#define FLUCTUATES                                                                                 \
    "largest_force|fluctuation_order|fluctuation_cosine|fluctuation_sine|fluctuation_period"

static ff_status check_fluctuation(const steady *s, const char *name, const fluctuation *f)
{
    const size_t n = f->amplitude.count;
    if (n == f->order.count && (f->phase.count == 0 || f->phase.count == n))
        return FF_OK;
    return ff_failf(s->host, FF_INVALID, name,
                    "%zu amplitudes, %zu orders and %zu phases: give one order for each amplitude, "
                    "and one phase for each or none",
                    n, f->order.count, f->phase.count);
}

static ff_status ready(void *self)
{
    const steady *s = self;
    const ff_serving rows[] = {
        {1, "torque", "torque|line_force", NULL, NULL},
        {1, "torque_fluctuation.amplitude", FLUCTUATES, NULL, NULL},
        {1, "torque_fluctuation.order", FLUCTUATES, NULL, NULL},
        {1, "torque_fluctuation.phase", FLUCTUATES, NULL, NULL},
        {1, "speed_fluctuation.amplitude", FLUCTUATES "|driven_mass", NULL, NULL},
        {1, "speed_fluctuation.order", FLUCTUATES "|driven_mass", NULL, NULL},
        {1, "speed_fluctuation.phase", FLUCTUATES, NULL, NULL},
        {1, "reference_torque", "reference_force", NULL, NULL},
        {1, "speed", "speed|mesh_frequency", NULL, NULL},
        {1, "mesh_frequency", "speed|mesh_frequency", NULL, NULL},
        {1, "oil_temperature", "oil_temperature", NULL, NULL},
    };
    const ff_need needs[] = {
        {s->speed > 0, "gear.teeth", "mesh_frequency", no_gear},
        {!(s->speed > 0), "gear.teeth", "speed", no_gear},
        {1, "gear.base_radius", "line_force|reference_force|largest_force", no_gear},
        {s->of_torque.order.count + s->of_speed.order.count > 0, "gear.base_radius", FLUCTUATES,
         no_gear},
        {s->of_torque.order.count + s->of_speed.order.count > 0, "gear.teeth", FLUCTUATES, no_gear},
        {s->of_speed.order.count > 0, "gear.inertia", FLUCTUATES "|driven_mass", no_inertia},
        {1, "oil_temperature", "oil_temperature", no_temperature},
    };
    ff_serve(s->host, rows, sizeof rows / sizeof rows[0]);
    ff_tell_needs(s->host, needs, sizeof needs / sizeof needs[0]);
    ff_status status = check_fluctuation(s, "torque_fluctuation.order", &s->of_torque);
    if (status == FF_OK)
        status = check_fluctuation(s, "speed_fluctuation.order", &s->of_speed);
    if (status != FF_OK)
        return status;
    if ((s->speed > 0) == (s->mesh_frequency > 0))
        return ff_failf(s->host, FF_INVALID, s->speed > 0 ? "mesh_frequency" : "speed",
                        "give one of speed and mesh_frequency, above 0");
    return FF_OK;
}

/* Reads a value of gear 1, which must be positive. Without a gear, the output that needs the value
   is refused. */
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

/* The fluctuation of the line force: the sum of cosine cos(order phi) + sine sin(order phi). */
typedef struct swings {
    size_t count;
    double order[MOST_SWINGS], cosine[MOST_SWINGS], sine[MOST_SWINGS];
    double period; /* mesh cycles */
} swings;

/* Adds the terms of a fluctuation, `newton` per unit of amplitude. `quarter`: phase lead of the
   force over the fluctuation, rad. */
static void add_swings(const fluctuation *f, double newton, double quarter, swings *to)
{
    for (size_t i = 0; i < f->amplitude.count; i++, to->count++) {
        const double phase = (f->phase.count ? f->phase.data[i] : 0) + quarter;
        to->order[to->count] = f->order.data[i];
        to->cosine[to->count] = newton * f->amplitude.data[i] * cos(phase);
        to->sine[to->count] = -newton * f->amplitude.data[i] * sin(phase);
    }
}

/* Returns the number of mesh cycles after which the fluctuation and the teeth repeat together. It
   is the least common multiple of the numbers for the single orders, which divide the number of
   teeth; thus it divides the number of teeth, too. */
static double period_of(const swings *w, double teeth)
{
    uint64_t common = (uint64_t)teeth;
    for (size_t i = 0; i < w->count; i++)
        for (uint64_t n = (uint64_t)w->order[i], rest; n; n = rest) {
            rest = common % n;
            common = n;
        }
    return w->count ? teeth / (double)common : 1;
}

/* Returns the largest absolute line force, sampled with steps of an eighth of a radian of the
   highest order. */
static double largest_force(const swings *w, double mean)
{
    double most = fabs(mean), highest = 0;
    for (size_t i = 0; i < w->count; i++)
        highest = fmax(highest, w->order[i]);
    const size_t steps = (size_t)ceil(16 * M_PI * highest);
    for (size_t k = 0; k < steps; k++) {
        double force = mean, angle = 2 * M_PI * (double)k / (double)steps;
        for (size_t i = 0; i < w->count; i++)
            force +=
                w->cosine[i] * cos(w->order[i] * angle) + w->sine[i] * sin(w->order[i] * angle);
        most = fmax(most, fabs(force));
    }
    return most;
}

/* A torque on gear 1 acts at its base radius. A prescribed speed of gear 1 accelerates gear 2: m_2
   s'' + c (s' - e') + G = F + m_2 r_b1 theta_1'', m_2 = I_2/r_b2^2, with theta_1'' = - sum of A n w
   sin(n w t + phase). */
static ff_status find_swings(const steady *s, const ff_array *in, swings *w, double *mass)
{
    double base = 1, teeth = 1;
    *w = (swings){.period = 1};
    *mass = 0;
    if (s->of_torque.amplitude.count + s->of_speed.amplitude.count == 0)
        return FF_OK;
    ff_status status =
        from_gear(s, &in[IN_BASE_RADIUS], "gear.base_radius", "fluctuation_cosine", &base);
    if (status == FF_OK)
        status = from_gear(s, &in[IN_TEETH], "gear.teeth", "fluctuation_period", &teeth);
    if (status != FF_OK)
        return status;
    add_swings(&s->of_torque, 1 / base, 0, w);
    if (s->of_speed.amplitude.count > 0) {
        const ff_array *inertia = &in[IN_INERTIA], *radii = &in[IN_BASE_RADIUS];
        if (!inertia->data || inertia->rank != 1 || inertia->shape[0] != 2 ||
            radii->shape[0] != 2 || !(inertia->data[1] > 0))
            return ff_failf(s->host, FF_INVALID, "gear.inertia", no_inertia);
        *mass = inertia->data[1] / (radii->data[1] * radii->data[1]);
        const double omega = s->speed > 0 ? s->speed : s->mesh_frequency * 2 * M_PI / teeth;
        double most = 0;
        for (size_t i = 0; i < s->of_speed.amplitude.count; i++)
            most += s->of_speed.amplitude.data[i];
        if (!(most < omega))
            return ff_failf(s->host, FF_INVALID, "speed_fluctuation.amplitude",
                            "the amplitudes sum to %.6g rpm, but the speed is %.6g rpm: gear 1 "
                            "must not turn backwards",
                            most * 30 / M_PI, omega * 30 / M_PI);
        const size_t first = w->count;
        add_swings(&s->of_speed, *mass * base * omega, M_PI / 2, w);
        for (size_t i = first; i < w->count; i++) {
            w->cosine[i] *= w->order[i];
            w->sine[i] *= w->order[i];
        }
    }
    w->period = period_of(w, teeth);
    return FF_OK;
}

static ff_status put_swings(const steady *s, uint64_t wanted, const swings *w)
{
    const double *series[] = {w->order, w->cosine, w->sine};
    char text[200];
    for (uint32_t k = 0; k < 3; k++) {
        if (!(wanted & FF_BIT(OUT_ORDER + k)))
            continue;
        double *to = ff_put_series(s->host, OUT_ORDER + k, w->count);
        if (!to && w->count > 0)
            return FF_NOMEM;
        for (size_t i = 0; i < w->count; i++)
            to[i] = series[k][i];
    }
    snprintf(text, sizeof text,
             "torque or speed fluctuates: line force and mesh repeat together after %g mesh "
             "cycles, the shortest possible period of a motion",
             w->period);
    if (w->count > 0)
        s->host->quality(s->host->ctx, "fluctuation_period", w->period, 0, FF_GOOD, text);
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
                      [OUT_LARGEST] = 0};
    static const uint64_t of_swings = FF_BIT(OUT_ORDER) | FF_BIT(OUT_COSINE) | FF_BIT(OUT_SINE) |
                                      FF_BIT(OUT_PERIOD) | FF_BIT(OUT_DRIVEN_MASS) |
                                      FF_BIT(OUT_REFERENCE) | FF_BIT(OUT_LARGEST);
    double gear = 1;
    swings w = {.count = 0};
    ff_status status = wanted & of_swings ? find_swings(s, in, &w, &value[OUT_DRIVEN_MASS]) : FF_OK;
    if (status == FF_OK)
        status = put_swings(s, wanted, &w);
    if (status != FF_OK)
        return status;
    value[OUT_PERIOD] = w.period;
    if (s->torque < 0)
        s->host->quality(
            s->host->ctx, "flank", -1, 0, FF_GOOD,
            "the torque is below 0: gear 2 drives, so tooth forces, films, losses and ratings "
            "refer to the back flanks; roll angles refer to gear 1 and decrease with time; the "
            "relief is back_relief if given, otherwise that of the driving flank");
    int other = s->speed > 0 ? OUT_MESH_FREQUENCY : OUT_SPEED;
    if (wanted & FF_BIT(other)) {
        status = from_gear(s, &in[IN_TEETH], "gear.teeth", outputs[other].name, &gear);
        if (status != FF_OK)
            return status;
        /* f_m = z1 omega1 / (2 pi) */
        value[other] =
            s->speed > 0 ? s->speed * gear / (2 * M_PI) : s->mesh_frequency * 2 * M_PI / gear;
    }
    if (wanted & (FF_BIT(OUT_LINE_FORCE) | FF_BIT(OUT_REFERENCE) | FF_BIT(OUT_LARGEST))) {
        status = from_gear(s, &in[IN_BASE_RADIUS], "gear.base_radius", "line_force", &gear);
        if (status != FF_OK)
            return status;
        value[OUT_LINE_FORCE] = s->torque / gear;
        value[OUT_LARGEST] = w.count ? largest_force(&w, s->torque / gear) : 0;
        double swing = largest_force(&w, 0);
        value[OUT_REFERENCE] = s->reference_torque > 0               ? s->reference_torque / gear
                               : swing > fabs(value[OUT_LINE_FORCE]) ? swing
                                                                     : 0;
    }
    if (wanted & FF_BIT(OUT_OIL_TEMPERATURE) && isnan(s->oil_temperature))
        return s->host->fail(s->host->ctx, FF_UNSUPPORTED, "oil_temperature", no_temperature);
    for (uint32_t i = 0; i < OUT_COUNT && status == FF_OK; i++)
        if (wanted & FF_BIT(i) && !(i >= OUT_ORDER && i <= OUT_SINE))
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
