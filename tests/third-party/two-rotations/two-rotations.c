/* SPDX-License-Identifier: MIT */
/*
 * dynamics/two-rotations: both gears of a pair turn, each with its inertia, and the mesh between
 * them is a spring and a damper with backlash:
 *
 *   J1 theta1'' = T1 - r1 F,   J2 theta2'' = r2 F - T1 r2/r1,   x = r1 theta1 - r2 theta2 - e,
 *   F = max(0, k x + c x') where x > 0,   0 in the backlash,   min(0, k (x + b) + c x') behind it.
 *
 * The angles are those beside uniform rotation. Runge and Kutta's method of order 4 goes in equal
 * steps, over jumps of the stiffness too, until a mesh cycle is like the one before. A motion that
 * repeats after several cycles only, or never, is refused.
 */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

typedef struct stage {
    const ff_host *host;
    double damping, repeats;
    int64_t steps, cycles;
} stage;

static const ff_param params[] = {
    FF_QUANTITY("damping_ratio", "", stage, damping, FF_REQUIRED | FF_MIN_OPEN, NULL, NULL, 0, 1,
                0.01, 0.2, "c = 2 zeta sqrt(k m), k the mean stiffness, m the equivalent mass"),
    FF_COUNT("steps", stage, steps, FF_TUNABLE, "400", NULL, 32, 100000, 0, 0,
             "time steps of a mesh cycle"),
    FF_COUNT("cycles", stage, cycles, 0, "2000", NULL, 2, 1000000, 0, 0,
             "the most mesh cycles until the motion repeats"),
    FF_QUANTITY("repeats", "", stage, repeats, FF_TUNABLE | FF_MIN_OPEN, "1e-6", NULL, 0, 0.1, 0, 0,
                "change of the motion from cycle to cycle, over F/k, at which it is taken"),
};

enum { INERTIA, RADIUS, BACKLASH, TEETH, ROLL, LINE, MESH, PHASE_IN, STIFFNESS, ERROR, TOOTH_IN };

static const ff_port inputs[] = {
    [INERTIA] = {.name = "gear.inertia", .unit = "kg m2", .dims = "gear", .doc = "of both"},
    [RADIUS] = {.name = "gear.base_radius", .unit = "m", .dims = "gear", .doc = "of both"},
    [BACKLASH] = {.name = "gear.backlash", .unit = "m", .dims = "", .doc = "along the line"},
    [TEETH] = {.name = "gear.teeth", .unit = "1", .dims = "gear", .doc = "of both"},
    [ROLL] = {.name = "gear.roll_angle", .unit = "rad", .dims = "station", .doc = "from SAP on"},
    [LINE] = {.name = "operating.line_force", .unit = "N", .dims = "", .doc = "T1/r1"},
    [MESH] = {.name = "operating.mesh_frequency", .unit = "Hz", .dims = "", .doc = "of cycles"},
    [PHASE_IN] = {.name = "stiffness.phase", .unit = "1", .dims = "phase", .doc = "0 to 1"},
    [STIFFNESS] = {.name = "stiffness.stiffness", .unit = "N/m", .dims = "phase", .doc = "k"},
    [ERROR] = {.name = "stiffness.transmission_error",
               .unit = "m",
               .dims = "phase",
               .doc = "e, without load"},
    [TOOTH_IN] = {.name = "stiffness.tooth_force",
                  .unit = "N",
                  .dims = "gear.station",
                  .doc = "quasi-static force on one pair, for its share"},
};

enum { PHASE, DTE, VELOCITY, FORCE, SPEED_1, SPEED_2, TOOTH, RMS, MEAN, RANGE, PERIOD, NATURAL };

static const ff_port outputs[] = {
    [PHASE] = {.name = "phase", .unit = "1", .dims = "cycle", .doc = "0 to 1"},
    [DTE] = {.name = "dte", .unit = "m", .dims = "cycle", .doc = "r1 theta1 - r2 theta2"},
    [VELOCITY] = {.name = "dte_velocity", .unit = "m/s", .dims = "cycle", .doc = "its rate"},
    [FORCE] = {.name = "mesh_force", .unit = "N", .dims = "cycle", .doc = "F"},
    [SPEED_1] = {.name = "speed_change_1",
                 .unit = "rad/s",
                 .dims = "cycle",
                 .doc = "of gear 1 beside its mean"},
    [SPEED_2] = {.name = "speed_change_2", .unit = "rad/s", .dims = "cycle", .doc = "of gear 2"},
    [TOOTH] = {.name = "tooth_force", .unit = "N", .dims = "gear.station", .doc = "of one pair"},
    [RMS] = {.name = "dte_rms", .unit = "m", .dims = "", .doc = "of the alternating part of dte"},
    [MEAN] = {.name = "dte_mean", .unit = "m", .dims = "", .doc = "mean of dte"},
    [RANGE] = {.name = "dte_peak_to_peak", .unit = "m", .dims = "", .doc = "largest less least"},
    [PERIOD] = {.name = "period", .unit = "1", .dims = "", .doc = "mesh cycles: 1"},
    [NATURAL] = {.name = "natural_frequency", .unit = "Hz", .dims = "", .doc = "of the mean k"},
};

/* The pair, its stiffness and error at the ends and the middles of the steps, and the motion. */
typedef struct pair {
    double J[2], r[2], backlash, force, frequency, mean_k, mass, c, step;
    size_t halves; /* two to a step */
    double *k, *e, *de;
    double y[4], *cycle; /* theta1, theta1', theta2, theta2'; of all steps of the last cycle */
} pair;

/* Linear between the phases; at a jump, whose phase stands twice, what is after it. */
static double at_phase(const ff_array *phase, const ff_array *value, double at)
{
    const size_t count = phase->shape[0];
    size_t i = 1;
    while (i + 1 < count && phase->data[i] <= at)
        i++;
    double step = phase->data[i] - phase->data[i - 1],
           share = step > 0 ? fmin(1, fmax(0, (at - phase->data[i - 1]) / step)) : 1;
    return (1 - share) * value->data[i - 1] + share * value->data[i];
}

static double mesh_force(const pair *g, size_t half, const double *y, double *rate)
{
    const size_t i = half % g->halves;
    double x = g->r[0] * y[0] - g->r[1] * y[2] - g->e[i],
           v = g->r[0] * y[1] - g->r[1] * y[3] - g->de[i];
    *rate = v + g->de[i];
    if (x > 0)
        return fmax(0, g->k[i] * x + g->c * v);
    return x < -g->backlash ? fmin(0, g->k[i] * (x + g->backlash) + g->c * v) : 0;
}

static void slope(const pair *g, size_t half, const double *y, double *dy)
{
    double rate, F = mesh_force(g, half, y, &rate);
    dy[0] = y[1];
    dy[1] = g->r[0] * (g->force - F) / g->J[0];
    dy[2] = y[3];
    dy[3] = g->r[1] * (F - g->force) / g->J[1];
}

static void advance(pair *g, size_t half)
{
    static const double lead[] = {0, 0.5, 0.5, 1}, weight[] = {1, 2, 2, 1};
    double d[4] = {0}, sum[4] = {0}, at[4];
    for (int s = 0; s < 4; s++) {
        for (int i = 0; i < 4; i++)
            at[i] = g->y[i] + lead[s] * g->step * d[i];
        slope(g, half + (s == 0 ? 0 : s < 3 ? 1 : 2), at, d);
        for (int i = 0; i < 4; i++)
            sum[i] += weight[s] / 6 * d[i];
    }
    for (int i = 0; i < 4; i++)
        g->y[i] += g->step * sum[i];
}

/* One cycle; the largest change of dte against the cycle before. */
static double run_cycle(pair *g)
{
    const size_t steps = g->halves / 2;
    double worst = 0;
    for (size_t i = 0; i <= steps; i++) {
        double *was = g->cycle + 4 * i, dte = g->r[0] * g->y[0] - g->r[1] * g->y[2];
        worst = fmax(worst, fabs(dte - (g->r[0] * was[0] - g->r[1] * was[2])));
        memcpy(was, g->y, sizeof g->y);
        if (i < steps)
            advance(g, 2 * i);
    }
    return worst;
}

static int is_between(double value, double low, double high)
{
    return value > low && value < high;
}

/* NULL, or what of the inputs cannot be used. */
static const char *refused(const ff_array *in)
{
    static const uint32_t lists[] = {INERTIA, RADIUS, TEETH};
    for (size_t k = 0; k < sizeof lists / sizeof *lists; k++)
        for (size_t i = 0; i < 2; i++)
            if (in[lists[k]].shape[0] != 2 || !is_between(in[lists[k]].data[i], 1e-12, 1e9))
                return inputs[lists[k]].name;
    if (!is_between(in[BACKLASH].data[0], -1e-12, 1))
        return inputs[BACKLASH].name;
    if (!is_between(in[LINE].data[0], 0, 1e12) || !is_between(in[MESH].data[0], 1e-3, 1e7))
        return "operating.line_force";
    const size_t count = in[PHASE_IN].shape[0];
    for (size_t i = 0; i < count; i++) {
        if (!(in[PHASE_IN].data[i] >= (i ? in[PHASE_IN].data[i - 1] : 0)))
            return inputs[PHASE_IN].name;
        if (!is_between(in[STIFFNESS].data[i], 1, 1e15))
            return inputs[STIFFNESS].name;
        if (!is_between(in[ERROR].data[i], -0.1, 0.1))
            return inputs[ERROR].name;
    }
    return count < 2 || in[PHASE_IN].data[count - 1] > 1 ? inputs[PHASE_IN].name : NULL;
}

static ff_status set_up(const stage *s, const ff_array *in, pair *g)
{
    *g = (pair){.backlash = fmax(0, in[BACKLASH].data[0]),
                .force = in[LINE].data[0],
                .frequency = in[MESH].data[0],
                .halves = 2 * (size_t)s->steps};
    for (int i = 0; i < 2; i++) {
        g->J[i] = in[INERTIA].data[i];
        g->r[i] = in[RADIUS].data[i];
    }
    const size_t n = g->halves;
    g->k = calloc(3 * n + 4 * ((size_t)s->steps + 1), sizeof *g->k);
    if (!g->k)
        return FF_NOMEM;
    g->e = g->k + n;
    g->de = g->e + n;
    g->cycle = g->de + n;
    for (size_t i = 0; i < n; i++) {
        double phase = (double)i / (double)n;
        g->k[i] = at_phase(&in[PHASE_IN], &in[STIFFNESS], phase);
        g->e[i] = at_phase(&in[PHASE_IN], &in[ERROR], phase);
        g->mean_k += g->k[i] / (double)n;
    }
    for (size_t i = 0; i < n; i++)
        g->de[i] = (g->e[(i + 1) % n] - g->e[(i + n - 1) % n]) * g->frequency * (double)n / 2;
    g->mass = g->J[0] * g->J[1] / (g->J[0] * g->r[1] * g->r[1] + g->J[1] * g->r[0] * g->r[0]);
    g->c = 2 * s->damping * sqrt(g->mean_k * g->mass);
    g->step = 1 / (g->frequency * (double)s->steps);
    g->y[0] = (g->force / g->mean_k + g->e[0]) / g->r[0];
    if (sqrt(g->mean_k / g->mass) * g->step > 0.5)
        return ff_failf(s->host, FF_INVALID, "steps",
                        "a step takes %g of a natural period: at least %.0f steps are needed",
                        sqrt(g->mean_k / g->mass) * g->step / (2 * PI),
                        ceil(2 * sqrt(g->mean_k / g->mass) / g->frequency));
    return FF_OK;
}

static ff_status find_motion(const stage *s, pair *g)
{
    double change = INFINITY, size = g->force / g->mean_k;
    int64_t cycle = 0;
    for (; cycle < s->cycles && change > s->repeats * size; cycle++) {
        change = run_cycle(g);
        if (cycle % 64 == 63 && s->host->progress(s->host->ctx, (double)cycle / (double)s->cycles))
            return FF_STOPPED;
    }
    if (!(change <= s->repeats * size))
        return ff_failf(s->host, FF_NOCONV, NULL,
                        "the motion does not repeat itself after a mesh cycle: after %lld cycles "
                        "it still changes by %g of F/k",
                        (long long)cycle, change / size);
    s->host->quality(s->host->ctx, "cycle_change", change / size, s->repeats, FF_GOOD,
                     "change of dte from one mesh cycle to the next, over F/k");
    return FF_OK;
}

/* dte over the cycle, and the numbers that stand for it. */
static ff_status put_motion(const stage *s, const pair *g)
{
    const size_t steps = g->halves / 2, count = steps + 1;
    double *out[TOOTH], mean[3] = {0}, square = 0, low = INFINITY, high = -INFINITY;
    for (uint32_t k = PHASE; k < TOOTH; k++)
        if (!(out[k] = ff_put_series(s->host, k, count)))
            return FF_NOMEM;
    for (size_t i = 0; i < count; i++) {
        const double *y = g->cycle + 4 * i;
        out[PHASE][i] = (double)i / (double)steps;
        out[DTE][i] = g->r[0] * y[0] - g->r[1] * y[2];
        out[FORCE][i] = mesh_force(g, 2 * i, y, &out[VELOCITY][i]);
        out[SPEED_1][i] = y[1];
        out[SPEED_2][i] = y[3];
        low = fmin(low, out[DTE][i]);
        high = fmax(high, out[DTE][i]);
        double weight = (i == 0 || i == steps ? 0.5 : 1) / (double)steps;
        mean[0] += weight * out[DTE][i];
        mean[1] += weight * y[1];
        mean[2] += weight * y[3];
    }
    for (size_t i = 0; i < count; i++) {
        out[SPEED_1][i] -= mean[1];
        out[SPEED_2][i] -= mean[2];
        double weight = (i == 0 || i == steps ? 0.5 : 1) / (double)steps;
        square += weight * (out[DTE][i] - mean[0]) * (out[DTE][i] - mean[0]);
    }
    const double value[] = {sqrt(square), mean[0], high - low, 1,
                            sqrt(g->mean_k / g->mass) / (2 * PI)};
    for (uint32_t k = RMS; k <= NATURAL; k++)
        if (ff_put_scalar(s->host, k, value[k - RMS]) != FF_OK)
            return FF_NOMEM;
    return FF_OK;
}

/* A pair of teeth bears of the mesh force the share that it has of the quasi-static one. */
static ff_status put_teeth(const stage *s, const pair *g, const ff_array *in)
{
    const size_t count = in[ROLL].shape[0], steps = g->halves / 2;
    double *tooth = ff_put_series(s->host, TOOTH, count), rate, pitch = 2 * PI / in[TEETH].data[0];
    if (!tooth)
        return FF_NOMEM;
    for (size_t i = 0; i < count; i++) {
        double turned = (in[ROLL].data[i] - in[ROLL].data[0]) / pitch;
        if (!is_between(turned, -1e-9, 100) || !is_between(in[TOOTH_IN].data[i], -1e12, 1e12))
            return ff_failf(s->host, FF_INVALID, "gear.roll_angle", "no tooth rolls like that");
        double at = (turned - floor(turned)) * (double)steps, share = at - floor(at);
        size_t left = (size_t)at % steps;
        tooth[i] = in[TOOTH_IN].data[i] / g->force *
                   ((1 - share) * mesh_force(g, 2 * left, g->cycle + 4 * left, &rate) +
                    share * mesh_force(g, 2 * left + 2, g->cycle + 4 * left + 4, &rate));
    }
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    const char *item = refused(in);
    pair g;
    (void)wanted;
    if (item)
        return ff_failf(s->host, FF_INVALID, item, "no pair of gears has that");
    ff_status status = set_up(s, in, &g);
    if (status == FF_OK)
        status = find_motion(s, &g);
    if (status == FF_OK)
        status = put_motion(s, &g);
    if (status == FF_OK)
        status = put_teeth(s, &g, in);
    free(g.k);
    return status;
}

FF_MODEL(model, stage, .id = "dynamics/two-rotations", .version = "1.0.0",
         .summary = "both gears turn, with backlash, until a mesh cycle repeats",
         .reference = "Kahraman & Singh 1990, J. Sound Vib. 142, 49-75", .bibtex = "",
         .licence = "MIT", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
