/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A linear oscillator in steady motion: s = F/k + A cos(2 pi phase - lag). */
#include "stub.h"

enum { POINTS = 129 };
enum { PHASE, DTE, VELOCITY, FORCE, RMS, MEAN, PEAK, NATURAL, PERIOD };
enum { MASS, FREQUENCY, LOAD, K_MEAN, ERROR, PHASES };

static const ff_port inputs[] = {
    {.name = "gear.equivalent_mass", .unit = "kg", .doc = "mass", .dims = ""},
    {.name = "operating.mesh_frequency", .unit = "Hz", .doc = "frequency", .dims = ""},
    {.name = "operating.line_force", .unit = "N", .doc = "load", .dims = ""},
    {.name = "stiffness.stiffness_mean", .unit = "N/m", .doc = "mean", .dims = ""},
    {.name = "stiffness.transmission_error", .unit = "m", .doc = "e", .dims = "phase"},
    {.name = "stiffness.phase", .unit = "1", .doc = "phase", .dims = "phase"},
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
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stub *s = self;
    double m = in[MASS].data[0], f = in[FREQUENCY].data[0], load = in[LOAD].data[0],
           k = in[K_MEAN].data[0], w = 2 * pi * f, d = 2 * 0.05 * sqrt(k * m) * w;
    double e = in[ERROR].shape[0] ? in[ERROR].data[0] : 0;
    double series[FORCE + 1][POINTS];
    (void)wanted;
    if (!(m > 1e-3 && m < 1e3 && f > 1 && f < 1e6 && load > 0 && load < 1e9 && k > 1 && k < 1e12 &&
          fabs(e) < 1))
        return ff_failf(s->host, FF_INVALID, "gear.equivalent_mass", "it cannot swing like that");
    double stiff = k - m * w * w, lag = atan2(d, stiff) - atan2(d, k);
    double A = e * hypot(k, d) / hypot(stiff, d), mean = load / k * off("deflection", 1.01);
    for (int i = 0; i < POINTS; i++) {
        double phase = (double)i / (POINTS - 1), angle = 2 * pi * phase - lag;
        series[PHASE][i] = phase;
        series[DTE][i] = mean + A * cos(angle) * (is("drift") ? 1 + 0.02 * phase : 1);
        series[VELOCITY][i] = -w * A * sin(angle - (is("lag") ? 0.1 : 0));
        series[FORCE][i] = load + m * w * w * A * (cos(angle) + (is("heavy") ? 0.05 : 0));
    }
    for (uint32_t k_series = 0; k_series <= FORCE; k_series++)
        put(s, k_series, POINTS, series[k_series]);
    ff_put_scalar(s->host, RMS, fabs(A) / sqrt(2));
    ff_put_scalar(s->host, MEAN, mean);
    ff_put_scalar(s->host, PEAK, 2 * fabs(A));
    ff_put_scalar(s->host, NATURAL, sqrt(k / m) / (2 * pi));
    return ff_put_scalar(s->host, PERIOD, 1);
}

STUB_MODEL
