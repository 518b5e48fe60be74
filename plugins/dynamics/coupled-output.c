/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coupled-motion.h"

#include <flankfilm/author.h>

#include <math.h>

const ff_port ff_coupled_outputs[FF_COUPLED_OUTPUT_COUNT] = {
    [FF_CO_PHASE] = {"phase", "1",
                     "mesh cycles since the entering pair was at SAP; twice where the excitation "
                     "jumps",
                     "cycle", NULL, 0, NULL},
    [FF_CO_DTE] = {"dte", "m",
                   "dynamic transmission error s: of the rotations less that of the turn of the "
                   "line of centres; 0 in the middle of the backlash",
                   "cycle", NULL, 0, NULL},
    [FF_CO_DTE_VELOCITY] = {"dte_velocity", "m/s", "its rate", "cycle", NULL, 0, NULL},
    [FF_CO_MESH_FORCE] = {"mesh_force", "N",
                          "dynamic mesh force DMF of spring and damper, driving "
                          "less back flank",
                          "cycle", NULL, 0, NULL},
    [FF_CO_DTE_RMS] = {"dte_rms", "m", "root mean square of the alternating part of s", "", NULL, 0,
                       NULL},
    [FF_CO_DTE_MEAN] = {"dte_mean", "m", "mean of s", "", NULL, 0, NULL},
    [FF_CO_DTE_PEAK_TO_PEAK] = {"dte_peak_to_peak", "m", "highest less lowest s", "", NULL, 0,
                                NULL},
    [FF_CO_TOOTH_FORCE] =
        {"tooth_force", "N",
         "dynamic tooth force W_s DMF/F, not clipped at 0; one row per engagement "
         "when the period is several mesh cycles",
         "engagement? station", NULL, 0, NULL},
    [FF_CO_GAP] = {"gap", "m", "separation of the driving flanks; 0 in contact",
                   "engagement? station", NULL, 0, NULL},
    [FF_CO_DYNAMIC_FACTOR_TOOTH] = {"dynamic_factor_tooth", "1",
                                    "largest dynamic over largest quasi-static tooth force", "",
                                    NULL, 0, NULL},
    [FF_CO_DYNAMIC_FACTOR_MESH] = {"dynamic_factor_mesh", "1",
                                   "largest mesh force over the static one", "", NULL, 0, NULL},
    [FF_CO_CONTACT_LOSS] = {"contact_loss", "1", "share of the time without force between flanks",
                            "", NULL, 0, NULL},
    [FF_CO_BACK_CONTACT] = {"back_contact", "1", "share of the time with contact on the back flank",
                            "", NULL, 0, NULL},
    [FF_CO_NATURAL_FREQUENCY] = {"natural_frequency", "Hz",
                                 "of the mesh alone, linear, at the mean stiffness", "", NULL, 0,
                                 NULL},
    [FF_CO_PERIOD] = {"period", "1",
                      "of the motion in mesh cycles; 0: aperiodic, -1: grows without bound", "",
                      NULL, 0, NULL},
    [FF_CO_FLOQUET_MAX] = {"floquet_max", "1",
                           "largest modulus of the multipliers: below 1 the motion is stable", "",
                           NULL, 0, NULL},
    [FF_CO_MULTIPLIERS] = {"multipliers", "1",
                           "real and imaginary part of the growth of a disturbance over the motion "
                           "shown",
                           "multiplier part", NULL, 0, NULL},
    [FF_CO_CENTRE_DISTANCE] = {"centre_distance", "m", "distance of the centres", "cycle", NULL, 0,
                               NULL},
    [FF_CO_PRESSURE_ANGLE] = {"pressure_angle", "rad", "working pressure angle", "cycle", NULL, 0,
                              NULL},
    [FF_CO_BACKLASH] = {"backlash", "m", "backlash along the line of action", "cycle", NULL, 0,
                        NULL},
    [FF_CO_CONTACT_RATIO] = {"contact_ratio", "1", "profile contact ratio", "cycle", NULL, 0, NULL},
    [FF_CO_DISPLACEMENT] = {"displacement", "m",
                            "of the gears on their bearings: gear 1 along the line of centres "
                            "towards gear 2 and across it, then gear 2",
                            "direction cycle", NULL, 0, NULL},
    [FF_CO_BEARING_FORCE] = {"bearing_force", "N", "largest elastic force of each gear's bearings",
                             "gear", NULL, 0, NULL},
};

static size_t shown_samples(const ff_coupled_motion *motion)
{
    size_t n = 0;
    while (n < motion->record.count && motion->record.samples[n].phase < (double)motion->cycles)
        n++;
    return n + 1;
}

typedef struct statistics {
    double mean, rms, low, high, force;
} statistics;

/* Integrals by Euler and Maclaurin's rule: the trapezium with the slopes at its ends. */
static statistics take_statistics(const ff_coupled_motion *motion)
{
    const ff_coupled_sample *s = motion->record.samples;
    size_t count = shown_samples(motion);
    statistics st = {.low = s[0].s, .high = s[0].s, .force = s[0].force};
    double square = 0;
    for (size_t i = 0; i + 1 < count; i++) {
        double h = s[i + 1].phase - s[i].phase;
        st.mean += h * (s[i].s + s[i + 1].s) / 2 +
                   h * h * motion->T * (s[i].s_rate - s[i + 1].s_rate) / 12;
        st.low = fmin(st.low, s[i + 1].s);
        st.high = fmax(st.high, s[i + 1].s);
        st.force = fmax(st.force, s[i + 1].force);
    }
    st.mean /= (double)motion->cycles;
    for (size_t i = 0; i + 1 < count; i++) {
        double h = s[i + 1].phase - s[i].phase, a = s[i].s - st.mean, z = s[i + 1].s - st.mean;
        square += h * (a * a + z * z) / 2 +
                  h * h * motion->T * (a * s[i].s_rate - z * s[i + 1].s_rate) / 6;
    }
    st.rms = sqrt(fmax(square / (double)motion->cycles, 0));
    return st;
}

/* Force and gap at a phase, straight between samples; `left` asks for the value before a jump. */
static void look_up(const ff_coupled_motion *motion, double phase, int left, double *force,
                    double *gap)
{
    const ff_coupled_sample *s = motion->record.samples;
    size_t low = 0, high = motion->record.count - 1;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (left ? s[middle].phase < phase - 1e-9 : s[middle].phase <= phase + 1e-9)
            low = middle;
        else
            high = middle;
    }
    double h = s[high].phase - s[low].phase;
    double x = h > 0 ? fmin(fmax((phase - s[low].phase) / h, 0), 1) : 0;
    *force = s[low].force + x * (s[high].force - s[low].force);
    *gap = s[low].gap + x * (s[high].gap - s[low].gap);
}

static int is_left(const ff_inputs *inputs, size_t i)
{
    return i + 1 == inputs->stations ||
           inputs->roll_angle[i + 1] - inputs->roll_angle[i] < 1e-12 * inputs->pitch;
}

static double share_of(const ff_inputs *inputs, size_t i)
{
    if (inputs->line_force > 0)
        return inputs->tooth_force[i] / inputs->line_force;
    return inputs->load_share ? inputs->load_share[i] : 0;
}

/* Eq. 5: the static share of the mesh force at the station's phase. Gives the largest force. */
static ff_status put_engagements(const ff_coupled_motion *motion, const ff_coupled *pair,
                                 const ff_inputs *inputs, const ff_host *host, double *largest)
{
    const ff_mesh *mesh = pair->mesh;
    size_t shape[2] = {motion->cycles, inputs->stations};
    uint32_t rank = motion->cycles > 1 ? 2 : 1;
    double *force = host->output(host->ctx, FF_CO_TOOTH_FORCE, rank, &shape[2 - rank]);
    double *gap = host->output(host->ctx, FF_CO_GAP, rank, &shape[2 - rank]);
    if (!force || !gap)
        return FF_NOMEM;
    *largest = -INFINITY;
    for (size_t cycle = 0, i = 0; cycle < motion->cycles; cycle++)
        for (size_t k = 0; k < inputs->stations; k++, i++) {
            double behind = fmax((inputs->roll_angle[k] - inputs->roll_sap) / inputs->pitch, 0);
            look_up(motion, (double)cycle + behind, is_left(inputs, k), &force[i], &gap[i]);
            force[i] *= share_of(inputs, k) * mesh->stiffness * mesh->length;
            gap[i] *= mesh->length;
            *largest = fmax(*largest, force[i]);
        }
    return FF_OK;
}

static ff_status put_cycle(const ff_coupled_motion *motion, const ff_coupled *pair,
                           const ff_host *host)
{
    static const uint32_t series[] = {FF_CO_PHASE,           FF_CO_DTE,
                                      FF_CO_DTE_VELOCITY,    FF_CO_MESH_FORCE,
                                      FF_CO_CENTRE_DISTANCE, FF_CO_PRESSURE_ANGLE,
                                      FF_CO_BACKLASH,        FF_CO_CONTACT_RATIO};
    enum { SERIES = sizeof series / sizeof series[0] };
    const ff_mesh *mesh = pair->mesh;
    size_t count = shown_samples(motion), shape[2] = {FF_COORDINATES - 1, count};
    double *out[SERIES], *moved = host->output(host->ctx, FF_CO_DISPLACEMENT, 2, shape);
    for (int k = 0; k < SERIES; k++)
        if (!(out[k] = ff_put_series(host, series[k], count)))
            return FF_NOMEM;
    if (!moved)
        return FF_NOMEM;
    for (size_t i = 0; i < count; i++) {
        const ff_coupled_sample *s = &motion->record.samples[i];
        ff_place place;
        ff_coupled_locate(pair, s->position, &place);
        const double values[SERIES] = {s->phase,
                                       s->s * mesh->length,
                                       s->s_rate * mesh->length * mesh->omega,
                                       s->force * mesh->length * mesh->stiffness,
                                       place.centre * mesh->length,
                                       place.angle,
                                       2 * place.half_gap * mesh->length,
                                       place.exit - place.entry};
        for (int k = 0; k < SERIES; k++)
            out[k][i] = values[k];
        for (size_t k = 0; k + 1 < FF_COORDINATES; k++)
            moved[k * count + i] = s->position[FF_X1 + k] * mesh->length;
    }
    return FF_OK;
}

static ff_status put_bearings(const ff_coupled_motion *motion, const ff_coupled *pair,
                              const ff_host *host)
{
    double *force = ff_put_series(host, FF_CO_BEARING_FORCE, 2);
    size_t count = shown_samples(motion);
    for (int gear = 0; force && gear < 2; gear++)
        for (size_t i = 0; i < count; i++) {
            const double *x = &motion->record.samples[i].position[gear ? FF_X2 : FF_X1];
            force[gear] = fmax(force[gear], pair->bearing[gear] * hypot(x[0], x[1]) *
                                                pair->mesh->stiffness * pair->mesh->length);
        }
    return force ? FF_OK : FF_NOMEM;
}

static ff_status put_multipliers(const ff_coupled_motion *motion, const ff_host *host)
{
    size_t shape[2] = {FF_TAKEN, 2};
    double largest, *multipliers = host->output(host->ctx, FF_CO_MULTIPLIERS, 2, shape);
    ff_status status =
        multipliers ? ff_coupled_multipliers(motion, multipliers, &largest) : FF_NOMEM;
    return status == FF_OK ? ff_put_scalar(host, FF_CO_FLOQUET_MAX, largest) : status;
}

ff_status ff_coupled_put(const ff_coupled_motion *motion, const ff_coupled *pair,
                         const ff_inputs *inputs, const ff_host *host)
{
    const ff_mesh *mesh = pair->mesh;
    statistics st = take_statistics(motion);
    double time = (double)motion->cycles * motion->T, tooth = 0, still = 0;
    ff_status status = put_cycle(motion, pair, host);
    if (status == FF_OK)
        status = put_engagements(motion, pair, inputs, host, &tooth);
    if (status == FF_OK)
        status = put_bearings(motion, pair, host);
    if (status == FF_OK)
        status = put_multipliers(motion, host);
    for (size_t i = 0; i < inputs->stations; i++)
        still = fmax(still, inputs->tooth_force[i]);
    const struct {
        uint32_t output;
        double value;
    } scalars[] = {
        {FF_CO_DTE_RMS, st.rms * mesh->length},
        {FF_CO_DTE_MEAN, st.mean * mesh->length},
        {FF_CO_DTE_PEAK_TO_PEAK, (st.high - st.low) * mesh->length},
        {FF_CO_DYNAMIC_FACTOR_TOOTH, still > 0 ? tooth / still : 0},
        {FF_CO_DYNAMIC_FACTOR_MESH, mesh->load > 0 ? st.force / mesh->load : 0},
        {FF_CO_CONTACT_LOSS, fmin(motion->parted / time, 1)},
        {FF_CO_BACK_CONTACT, fmin(motion->back / time, 1)},
        {FF_CO_NATURAL_FREQUENCY, inputs->natural_frequency},
        {FF_CO_PERIOD, motion->period},
    };
    for (size_t i = 0; i < sizeof scalars / sizeof scalars[0] && status == FF_OK; i++)
        status = ff_put_scalar(host, scalars[i].output, scalars[i].value);
    return status;
}
