/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * dynamics/quasi-static: the motion far below resonance, s - e = b + F/k (Li & Kahraman 2011, eq. 2
 * without inertia and damping). s is the loaded transmission error; as in all models, zero is the
 * middle of the backlash.
 */
#include "../excitation/inputs.h"
#include "references.h"

#include <flankfilm/author.h>
#include <flankfilm/needs.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct model {
    const ff_host *host;
    dynamics_inertia inertia;
    double zeta;
} model;

static const ff_param params[] = {
    DYNAMICS_INERTIA_ROWS(model),
    FF_QUANTITY("damping_ratio", "1", model, zeta, 0, "0.01", NULL, 0, 10, 1e-4, 0.2,
                "damping over critical damping; used only to estimate the difference from the "
                "dynamic motion if the program chooses the model"),
};

enum {
    I_BACKLASH,
    I_MASS,
    I_LINE_FORCE,
    I_PHASE,
    I_ERROR,
    I_STIFFNESS_MEAN,
    I_TOOTH_FORCE,
    I_MESH_FREQUENCY,
    I_REFERENCE,
    I_FLUCTUATION
};

static const ff_port inputs[] = {
    {.name = "gear.backlash",
     .unit = "m",
     .doc = "backlash along the line of action, 2 b",
     .dims = "",
     .flags = FF_OPTIONAL},
    {.name = "gear.equivalent_mass",
     .unit = "kg",
     .doc = "equivalent mass at the mesh spring",
     .dims = "",
     .flags = FF_OPTIONAL},
    {.name = "operating.line_force",
     .unit = "N",
     .doc = "static force along the line of action",
     .dims = ""},
    {.name = "stiffness.phase",
     .unit = "1",
     .doc = "phase of the mesh cycle, 0 to 1; a repeated value marks a jump",
     .dims = "phase"},
    {.name = "stiffness.loaded_transmission_error",
     .unit = "m",
     .doc = "static transmission error under load",
     .dims = "phase"},
    {.name = "stiffness.stiffness_mean", .unit = "N/m", .doc = "mean mesh stiffness", .dims = ""},
    {.name = "stiffness.tooth_force",
     .unit = "N",
     .doc = "quasi-static tooth force W_s",
     .dims = "engagement? station"},
    {.name = "operating.mesh_frequency",
     .unit = "Hz",
     .doc = "mesh frequency, used only to estimate the difference from the dynamic motion",
     .dims = "",
     .flags = FF_OPTIONAL},
    {.name = "operating.reference_force",
     .unit = "N",
     .doc = "line force at which the loaded transmission error was computed; not given or 0: the "
            "line force",
     .dims = "",
     .flags = FF_OPTIONAL},
    {.name = "operating.fluctuation_order",
     .unit = "1",
     .doc = "orders of the fluctuation of the line force; this model refuses them",
     .dims = "fluctuation",
     .flags = FF_OPTIONAL},
};

enum {
    O_PHASE,
    O_DTE,
    O_MESH_FORCE,
    O_DTE_RMS,
    O_DTE_MEAN,
    O_DTE_PEAK_TO_PEAK,
    O_TOOTH_FORCE,
    O_GAP,
    O_DYNAMIC_FACTOR_TOOTH,
    O_DYNAMIC_FACTOR_MESH,
    O_CONTACT_LOSS,
    O_BACK_CONTACT,
    O_NATURAL_FREQUENCY,
    O_PERIOD
};

static const ff_port outputs[] = {
    {.name = "phase",
     .unit = "1",
     .label = "mesh cycle",
     .doc = "mesh cycles since the entering pair was at SAP; a repeated value marks a jump",
     .dims = "cycle"},
    {.name = "dte",
     .label = "transmission error",
     .unit = "m",
     .doc = "transmission error s under load; zero is the middle of the backlash, so that the "
            "values include half the backlash",
     .dims = "cycle"},
    {.name = "mesh_force",
     .unit = "N",
     .doc = "mesh force; equal to the static force",
     .dims = "cycle"},
    {.name = "dte_rms",
     .label = "rms of the transmission error",
     .unit = "m",
     .doc = "root mean square of the alternating part of the transmission error s",
     .dims = "",
     .max = INFINITY},
    {.name = "dte_mean", .unit = "m", .doc = "mean of the transmission error s", .dims = ""},
    {.name = "dte_peak_to_peak",
     .unit = "m",
     .doc = "largest minus smallest transmission error s",
     .dims = "",
     .max = INFINITY},
    {.name = "tooth_force",
     .unit = "N",
     .doc = "tooth force; equal to the quasi-static tooth force",
     .dims = "engagement? stiffness.station"},
    {.name = "gap",
     .unit = "m",
     .doc = "separation of the driving flanks; always 0",
     .dims = "engagement? stiffness.station"},
    {.name = "dynamic_factor_tooth",
     .unit = "1",
     .doc = "always 1, since there are no dynamics",
     .dims = ""},
    {.name = "dynamic_factor_mesh",
     .unit = "1",
     .doc = "always 1, since there are no dynamics",
     .dims = ""},
    {.name = "contact_loss",
     .unit = "1",
     .doc = "share of the time without contact; always 0",
     .dims = "",
     .max = 1},
    {.name = "back_contact",
     .unit = "1",
     .doc = "share of the time with contact on the back flanks; always 0",
     .dims = "",
     .max = 1},
    {.name = "natural_frequency",
     .unit = "Hz",
     .doc = "natural frequency of small vibrations at the mean of the wired stiffness; needs a "
            "mass",
     .dims = "",
     .max = INFINITY},
    {.name = "period",
     .unit = "1",
     .doc = "period of the motion in mesh cycles: that of the tooth forces",
     .dims = ""},
};

static ff_status check(const ff_host *host, const ff_array *in)
{
    for (int i = 0; i < (int)(sizeof inputs / sizeof inputs[0]); i++) {
        size_t count = in[i].data ? 1 : 0;
        for (uint32_t k = 0; in[i].data && k < in[i].rank; k++)
            count *= in[i].shape[k];
        for (size_t k = 0; k < count; k++)
            if (!(fabs(in[i].data[k]) <= 1e100))
                return ff_failf(host, FF_INVALID, inputs[i].name,
                                "value %zu is not a usable number", k + 1);
    }
    size_t count = in[I_PHASE].rank == 1 ? in[I_PHASE].shape[0] : 0;
    const double *phase = in[I_PHASE].data;
    if (count < 2 || fabs(phase[0]) > 1e-9 || fabs(phase[count - 1] - 1) > 1e-9)
        return ff_failf(host, FF_INVALID, inputs[I_PHASE].name, "must run from 0 to 1");
    for (size_t i = 1; i < count; i++)
        if (phase[i] < phase[i - 1])
            return ff_failf(host, FF_INVALID, inputs[I_PHASE].name,
                            "must not decrease, but %g follows %g", phase[i], phase[i - 1]);
    if (in[I_ERROR].rank != 1 || in[I_ERROR].shape[0] != count)
        return ff_failf(host, FF_INVALID, inputs[I_ERROR].name, "must be a series of %zu values",
                        count);
    if (in[I_TOOTH_FORCE].rank < 1 || in[I_TOOTH_FORCE].rank > 2)
        return ff_failf(host, FF_INVALID, inputs[I_TOOTH_FORCE].name,
                        "must be a series, or one for each engagement");
    if (!(in[I_STIFFNESS_MEAN].data[0] > 0))
        return ff_failf(host, FF_INVALID, inputs[I_STIFFNESS_MEAN].name, "must be above 0");
    return FF_OK;
}

typedef struct statistics {
    double mean, rms, low, high;
} statistics;

/* Returns the statistics, exact for straight lines between the phases. */
static statistics statistics_of(size_t count, const double *phase, const double *s)
{
    statistics st = {.low = s[0], .high = s[0]};
    double square = 0;
    for (size_t i = 1; i < count; i++) {
        st.mean += (phase[i] - phase[i - 1]) * (s[i] + s[i - 1]) / 2;
        st.low = fmin(st.low, s[i]);
        st.high = fmax(st.high, s[i]);
    }
    for (size_t i = 1; i < count; i++) {
        double a = s[i - 1] - st.mean, z = s[i] - st.mean;
        square += (phase[i] - phase[i - 1]) * (a * a + a * z + z * z) / 3;
    }
    st.rms = sqrt(square);
    return st;
}

/* `apart` is the separation of the flanks on the driving side. */
static ff_status put_series(const ff_host *host, const ff_array *in, const double *s, int back,
                            double apart)
{
    const ff_array *force = &in[I_TOOTH_FORCE];
    size_t count = in[I_PHASE].shape[0], stations = 1;
    double *phase = ff_put_series(host, O_PHASE, count), *dte = ff_put_series(host, O_DTE, count);
    double *excitation = ff_put_series(host, O_MESH_FORCE, count);
    double *tooth = host->output(host->ctx, O_TOOTH_FORCE, force->rank, force->shape);
    double *gap = host->output(host->ctx, O_GAP, force->rank, force->shape);
    for (uint32_t k = 0; k < force->rank; k++)
        stations *= force->shape[k];
    if (!phase || !dte || !excitation || !tooth || !gap)
        return FF_NOMEM;
    for (size_t i = 0; i < count; i++) {
        phase[i] = in[I_PHASE].data[i];
        dte[i] = s[i];
        excitation[i] = back ? -in[I_LINE_FORCE].data[0] : in[I_LINE_FORCE].data[0];
    }
    for (size_t i = 0; i < stations; i++) {
        tooth[i] = force->data[i];
        gap[i] = apart;
    }
    dynamics_put_stations(tooth, force->shape[force->rank - 1], stations, back);
    return FF_OK;
}

static ff_status put_scalars(const ff_host *host, const statistics *st, double period, int floats)
{
    const struct {
        uint32_t output;
        double value;
    } scalars[] = {
        {O_DTE_RMS, st->rms},
        {O_DTE_MEAN, st->mean},
        {O_DTE_PEAK_TO_PEAK, st->high - st->low},
        {O_DYNAMIC_FACTOR_TOOTH, !floats},
        {O_DYNAMIC_FACTOR_MESH, !floats},
        {O_CONTACT_LOSS, floats},
        {O_BACK_CONTACT, 0},
        {O_PERIOD, period},
    };
    ff_status status = FF_OK;
    for (size_t i = 0; i < sizeof scalars / sizeof scalars[0] && status == FF_OK; i++)
        status = ff_put_scalar(host, scalars[i].output, scalars[i].value);
    return status;
}

static const char no_inertia[] = "needs an inertia: give equivalent_mass or natural_frequency, "
                                 "or wire a gear that gives equivalent_mass";

/* Writes the natural frequency. A missing mass is an error only if this output is requested. */
static ff_status put_natural_frequency(const model *m, uint64_t wanted, const ff_array *in)
{
    double frequency;
    ff_status status = dynamics_natural_frequency(m->host, &m->inertia, &in[I_MASS],
                                                  in[I_STIFFNESS_MEAN].data[0], &frequency);
    if (status != FF_OK)
        return status;
    if (frequency > 0)
        return ff_put_scalar(m->host, O_NATURAL_FREQUENCY, frequency);
    if (wanted & FF_BIT(O_NATURAL_FREQUENCY))
        return m->host->fail(m->host->ctx, FF_UNSUPPORTED, "natural_frequency", no_inertia);
    return FF_OK;
}

static ff_status evaluate_driving(void *self, uint64_t wanted, const ff_array *in, int back)
{
    const model *m = self;
    ff_status status =
        dynamics_refuse_fluctuation(m->host, &in[I_FLUCTUATION], "the loaded transmission error");
    if (status == FF_OK)
        status = check(m->host, in);
    if (status != FF_OK)
        return status;
    size_t count = in[I_PHASE].shape[0];
    double half_gap = in[I_BACKLASH].data ? in[I_BACKLASH].data[0] / 2 : 0;
    const double force = in[I_LINE_FORCE].data[0];
    const int floats = force == 0;
    if (!floats && in[I_REFERENCE].data && in[I_REFERENCE].data[0] > 0 &&
        fabs(in[I_REFERENCE].data[0] - force) > 1e-9 * force)
        return ff_failf(m->host, FF_UNSUPPORTED, "operating.reference_force",
                        "the loaded transmission error was computed at %g N, but the line force is "
                        "%g N: leave reference_torque out of the operating stage",
                        in[I_REFERENCE].data[0], force);
    if (floats)
        dynamics_floating_line(m->host);
    double *s = calloc(count, sizeof *s);
    if (!s)
        return FF_NOMEM;
    for (size_t i = 0; i < count; i++)
        s[i] = floats ? 0 : (back ? -1 : 1) * (in[I_ERROR].data[i] + half_gap);
    statistics st = statistics_of(count, in[I_PHASE].data, s);
    status = put_series(m->host, in, s, back, floats ? half_gap : 0);
    if (status == FF_OK)
        status = put_scalars(m->host, &st,
                             in[I_TOOTH_FORCE].rank > 1 ? (double)in[I_TOOTH_FORCE].shape[0] : 1,
                             floats);
    if (status == FF_OK)
        status = put_natural_frequency(m, wanted, in);
    free(s);
    return status;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    return dynamics_evaluate(((const model *)self)->host, inputs, sizeof inputs / sizeof inputs[0],
                             I_TOOTH_FORCE, in, evaluate_driving, self, wanted);
}

/* An inertia affects only the natural frequency. */
static ff_status ready(void *self)
{
    const model *m = self;
    static const ff_serving rows[] = {
        {1, "equivalent_mass", "natural_frequency", NULL, NULL},
        {1, "natural_frequency", "natural_frequency", NULL, NULL},
        {1, "gear.equivalent_mass", "natural_frequency", NULL, NULL},
    };
    static const ff_need needs[] = {{1, "equivalent_mass|natural_frequency|gear.equivalent_mass",
                                     "natural_frequency", no_inertia}};
    ff_serve(m->host, rows, sizeof rows / sizeof rows[0]);
    ff_tell_needs(m->host, needs, 1);
    dynamics_tell_servings(m->host, &m->inertia, NAN);
    return FF_OK;
}

FF_MODEL(dynamics_quasi_static, model, .id = "dynamics/quasi-static", .version = "1.0.0",
         .summary = "no dynamics: the gears are at rest in every mesh position",
         .reference =
             "Li & Kahraman 2011, Influence of dynamic behaviour on elastohydrodynamic "
             "lubrication of spur gears, Proc. IMechE J 225, 740-753, eq. 2 without inertia",
         .bibtex = BIB_likahraman2011 "\n", .licence = "GPL-3.0-or-later",
         .params = FF_TABLE(params), .inputs = FF_TABLE(inputs), .outputs = FF_TABLE(outputs),
         .ready = ready, .evaluate = evaluate, .destroy = free, .cost = 2e-5);
FF_EXPORT_MODELS(&dynamics_quasi_static);
