/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A linear oscillator under e = E cos(2 pi phase), with its tooth forces; where the flanks would
   part it is no model of the pair, and says so. */
#define STUB_MORE .evaluate = evaluate, .params = FF_TABLE(params), .set = stub_set
#include "stub.h"

enum { POINTS = 257 };
enum { PHASE, DTE, VELOCITY, FORCE, RMS, MEAN, PEAK, NATURAL, PERIOD, TOOTH };
enum { MASS, FREQUENCY, LOAD, K_MEAN, ERROR, PHASES, ROLL, TEETH, SHARE };

static const ff_param params[] = {{.name = "damping_ratio",
                                   .unit = "1",
                                   .doc = "c/(2 sqrt(k m))",
                                   .type = FF_REAL,
                                   .preset = "0.05",
                                   .max = 1,
                                   .low = 1e-4,
                                   .high = 0.2}};

static const ff_port inputs[] = {
    {.name = "gear.equivalent_mass", .unit = "kg", .doc = "mass", .dims = ""},
    {.name = "operating.mesh_frequency", .unit = "Hz", .doc = "frequency", .dims = ""},
    {.name = "operating.line_force", .unit = "N", .doc = "load", .dims = ""},
    {.name = "stiffness.stiffness_mean", .unit = "N/m", .doc = "mean", .dims = ""},
    {.name = "stiffness.transmission_error", .unit = "m", .doc = "e", .dims = "phase"},
    {.name = "stiffness.phase", .unit = "1", .doc = "phase", .dims = "phase"},
    {.name = "gear.roll_angle", .unit = "rad", .doc = "roll angle", .dims = "station"},
    {.name = "gear.teeth", .unit = "1", .doc = "teeth", .dims = "gear"},
    {.name = "stiffness.load_share", .unit = "1", .doc = "share", .dims = "station"},
};

static const ff_port outputs[] = {
    {.name = "phase", .unit = "1", .doc = "phase", .dims = "cycle"},
    {.name = "dte", .unit = "m", .doc = "s", .dims = "cycle"},
    {.name = "dte_velocity", .unit = "m/s", .doc = "s'", .dims = "cycle"},
    {.name = "mesh_force", .unit = "N", .doc = "force", .dims = "cycle"},
    {.name = "dte_rms", .unit = "m", .doc = "rms", .dims = ""},
    {.name = "dte_mean", .unit = "m", .doc = "mean", .dims = ""},
    {.name = "dte_peak_to_peak", .unit = "m", .doc = "range", .dims = ""},
    {.name = "natural_frequency", .unit = "Hz", .doc = "f_n", .dims = ""},
    {.name = "period", .unit = "1", .doc = "period", .dims = ""},
    {.name = "tooth_force", .unit = "N", .doc = "W", .dims = "station"},
};

/* load + m w^2 A cos(2 pi phase - lag) */
typedef struct motion {
    double mean, amplitude, lag, load, inertia; /* inertia: m w^2 */
} motion;

static double force_at(const motion *m, double phase)
{
    return m->load + m->inertia * m->amplitude * cos(2 * pi * phase - m->lag);
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stub *s = self;
    double mass = in[MASS].data[0] * off("mass-twice", 2), f = in[FREQUENCY].data[0],
           load = in[LOAD].data[0], k = in[K_MEAN].data[0], w = 2 * pi * f,
           d = 2 * s->value[0] * off("damping-twice", 2) * sqrt(k * mass) * w;
    double e = in[ERROR].shape[0] ? in[ERROR].data[0] : 0, series[FORCE + 1][POINTS];
    size_t stations = in[ROLL].shape[0];
    (void)wanted;
    if (!(mass > 1e-3 && mass < 1e3 && f > 1 && f < 1e6 && load > 0 && load < 1e9 && k > 1 &&
          k < 1e12 && fabs(e) < 1 && in[TEETH].shape[0] == 2 && in[TEETH].data[0] > 4 &&
          in[TEETH].data[0] < 1e4 && stations > 0 && in[SHARE].shape[0] == stations))
        return ff_failf(s->host, FF_INVALID, "gear.equivalent_mass", "it cannot swing like that");
    double stiff = k - mass * w * w, turn = is("late") ? 0.25 : 0;
    motion m = {.mean = load / k * off("deflection", 1.01),
                .amplitude = e * hypot(k, d) / hypot(stiff, d),
                .lag = atan2(d, stiff) - atan2(d, k) + 2 * pi * turn,
                .load = load,
                .inertia = mass * w * w};
    if (m.inertia * fabs(m.amplitude) > load && !is("no-backlash"))
        return ff_failf(s->host, FF_UNSUPPORTED, NULL, "the flanks would part");
    const double excess = is("heavy") ? 0.05 * m.inertia * m.amplitude : 0;
    for (int i = 0; i < POINTS; i++) {
        double phase = (double)i / (POINTS - 1), angle = 2 * pi * phase - m.lag;
        series[PHASE][i] = phase;
        series[DTE][i] = m.mean + m.amplitude * cos(angle) * (is("drift") ? 1 + 0.02 * phase : 1);
        series[VELOCITY][i] = -w * m.amplitude * sin(angle - (is("lag") ? 0.1 : 0));
        series[FORCE][i] = force_at(&m, phase) + excess;
    }
    for (uint32_t row = 0; row <= FORCE; row++)
        put(s, row, POINTS, series[row]);
    double *tooth = ff_put_series(s->host, TOOTH, stations);
    for (size_t i = 0; tooth && i < stations; i++) {
        double cycles = (in[ROLL].data[i] - in[ROLL].data[0]) * in[TEETH].data[0] / (2 * pi);
        tooth[i] = in[SHARE].data[i] * (force_at(&m, cycles) + excess) * off("forces", 1.1);
    }
    ff_put_scalar(s->host, RMS,
                  fabs(m.amplitude) * off("rms", 0.5) / sqrt(2) * off("rms", sqrt(2)));
    ff_put_scalar(s->host, MEAN, is("mean") ? 0 : m.mean);
    ff_put_scalar(s->host, PEAK, off("peak", 0.5) * 2 * fabs(m.amplitude));
    ff_put_scalar(s->host, NATURAL, sqrt(k / mass) / (2 * pi));
    return ff_put_scalar(s->host, PERIOD, 1);
}

STUB_MODEL
