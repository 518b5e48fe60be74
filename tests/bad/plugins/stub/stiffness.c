/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mesh of 2.4e8 N/m for each pair in contact, one or two that share alike. */
#define STUB_MORE .evaluate = evaluate
#include "stub.h"

enum { PHASES = 65, STATIONS = 99 };
enum { PHASE, K, MEAN, LOADED, ERROR, FORCE, SHARE, BREAKS };
enum { ROLL, TEETH, LOAD };

static const ff_port inputs[] = {
    {.name = "gear.roll_angle", .unit = "rad", .doc = "roll angle", .dims = "station"},
    {.name = "gear.teeth", .unit = "1", .doc = "teeth", .dims = "gear"},
    {.name = "operating.line_force", .unit = "N", .doc = "load", .dims = ""},
    {.name = "gear.face_width", .unit = "m", .doc = "b", .dims = ""},
};

static const ff_port outputs[] = {
    {.name = "phase", .unit = "1", .doc = "phase", .dims = "phase"},
    {.name = "stiffness", .unit = "N/m", .doc = "k", .dims = "phase"},
    {.name = "stiffness_mean", .unit = "N/m", .doc = "mean", .dims = ""},
    {.name = "loaded_transmission_error", .unit = "m", .doc = "e_l", .dims = "phase"},
    {.name = "transmission_error", .unit = "m", .doc = "e", .dims = "phase"},
    {.name = "tooth_force", .unit = "N", .doc = "W_s", .dims = "station"},
    {.name = "load_share", .unit = "1", .doc = "share", .dims = "station"},
    {.name = "breakpoints", .unit = "1", .doc = "breakpoints", .dims = "breakpoint"},
};

/* One of n pairs that are in contact with it carries 1/n. */
static double pairs(const double *roll, size_t count, size_t i, double cycle)
{
    double n = 1;
    for (double a = roll[i] - cycle; a >= roll[0]; a -= cycle)
        n++;
    for (double a = roll[i] + cycle; a <= roll[count - 1]; a += cycle)
        n++;
    return n;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stub *s = self;
    size_t count = in[ROLL].shape[0];
    const double *roll = in[ROLL].data;
    double load = in[LOAD].data[0], phase[PHASES], k[PHASES], loaded[PHASES], error[PHASES] = {0};
    double teeth = in[TEETH].shape[0] ? in[TEETH].data[0] : 0;
    (void)wanted;
    if (count < 2 || !(teeth >= 5 && teeth < 1000) || !(load > 0 && load < 1e9) ||
        !(fabs(roll[0]) < 10 && fabs(roll[count - 1]) < 10))
        return ff_failf(s->host, FF_INVALID, "gear.roll_angle", "no gear rolls like that");
    for (int i = 0; i < PHASES; i++) {
        phase[i] = (double)i / (PHASES - 1);
        double doubled = (roll[count - 1] - roll[0]) * teeth / (2 * pi) - 1,
               at = fmod(phase[i] + (is("late") ? 0.5 : 0), 1),
               two = at < doubled || at > 1 - 1e-9 ? 1 : 0;
        k[i] = 2.4e8 *
               (is("inverted") ? 2 - two
                : is("even")   ? 1.5
                               : 1 + two) *
               off("tenfold", 10) * off("half", 0.5);
        if (is("negative") && i == 30)
            k[i] = -k[i];
        if (is("aperiodic"))
            k[i] *= 1 + phase[i] / 100;
        loaded[i] = load / k[i] * off("deflection", 1.01);
    }
    double *force = ff_put_series(s->host, FORCE, count),
           *share = ff_put_series(s->host, SHARE, count);
    for (size_t i = 0; force && share && i < count; i++) {
        share[i] = off("unbalanced", 1.02) / pairs(roll, count, i, 2 * pi / teeth);
        force[i] = share[i] * load;
    }
    put(s, PHASE, PHASES, phase);
    put(s, K, PHASES, k);
    put(s, LOADED, PHASES, loaded);
    put(s, ERROR, PHASES, error);
    put(s, BREAKS, 0, phase);
    double mean = 0;
    for (int i = 1; i < PHASES; i++)
        mean += (k[i] + k[i - 1]) / 2 / (PHASES - 1);
    return ff_put_scalar(s->host, MEAN, mean);
}

STUB_MODEL
