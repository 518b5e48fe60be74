/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "coupled-motion.h"
#include "coupled-shooting.h"
#include "motion-view.h"

#include <flankfilm/author.h>

#include <math.h>

const ff_port dynamics_coupled_outputs[DYNAMICS_COUPLED_OUTPUT_COUNT] = {
    [DYNAMICS_OUT_PHASE] =
        {"phase", "1",
         "mesh cycles since the entering pair was at SAP; twice where the excitation "
         "jumps",
         "cycle", NULL, 0, NULL},
    [DYNAMICS_OUT_DTE] =
        {"dte", "m",
         "dynamic transmission error s: of the rotations less that of the turn of the "
         "line of centres; 0 in the middle of the backlash, so that half of it is in the values",
         "cycle", NULL, 0, NULL},
    [DYNAMICS_OUT_DTE_VELOCITY] = {"dte_velocity", "m/s", "its rate", "cycle", NULL, 0, NULL},
    [DYNAMICS_OUT_MESH_FORCE] = {"mesh_force", "N",
                                 "dynamic mesh force DMF of spring and damper, driving "
                                 "less back flank",
                                 "cycle", NULL, 0, NULL},
    [DYNAMICS_OUT_DTE_RMS] = {"dte_rms", "m", "root mean square of the alternating part of s", "",
                              NULL, 0, NULL},
    [DYNAMICS_OUT_DTE_MEAN] = {"dte_mean", "m", "mean of s", "", NULL, 0, NULL},
    [DYNAMICS_OUT_DTE_PEAK_TO_PEAK] = {"dte_peak_to_peak", "m", "highest less lowest s", "", NULL,
                                       0, NULL},
    [DYNAMICS_OUT_TOOTH_FORCE] =
        {"tooth_force", "N",
         "dynamic tooth force W_s DMF/F, not clipped at 0; one row per engagement "
         "when the period is several mesh cycles",
         "engagement? station", NULL, 0, NULL},
    [DYNAMICS_OUT_GAP] = {"gap", "m", "separation of the driving flanks; 0 in contact",
                          "engagement? station", NULL, 0, NULL},
    [DYNAMICS_OUT_DYNAMIC_FACTOR_TOOTH] = {"dynamic_factor_tooth", "1",
                                           "largest dynamic over largest quasi-static tooth force",
                                           "", NULL, 0, NULL},
    [DYNAMICS_OUT_DYNAMIC_FACTOR_MESH] = {"dynamic_factor_mesh", "1",
                                          "largest mesh force over the static one", "", NULL, 0,
                                          NULL},
    [DYNAMICS_OUT_CONTACT_LOSS] = {"contact_loss", "1",
                                   "share of the time without force between flanks", "", NULL, 0,
                                   NULL},
    [DYNAMICS_OUT_BACK_CONTACT] = {"back_contact", "1",
                                   "share of the time with contact on the back flank", "", NULL, 0,
                                   NULL},
    [DYNAMICS_OUT_NATURAL_FREQUENCY] = {"natural_frequency", "Hz",
                                        "of the mesh alone, linear, at the mean stiffness", "",
                                        NULL, 0, NULL},
    [DYNAMICS_OUT_PERIOD] = {"period", "1",
                             "of the motion in mesh cycles; 0: aperiodic, -1: grows without bound",
                             "", NULL, 0, NULL},
    [DYNAMICS_OUT_FLOQUET_MAX] =
        {"floquet_max", "1", "largest modulus of the multipliers: below 1 the motion is stable", "",
         NULL, 0, NULL},
    [DYNAMICS_OUT_MULTIPLIERS] =
        {"multipliers", "1",
         "real and imaginary part of the growth of a disturbance over the motion "
         "shown",
         "multiplier part", NULL, 0, NULL},
    [DYNAMICS_CO_CENTRE_DISTANCE] = {"centre_distance", "m", "distance of the centres", "cycle",
                                     NULL, 0, NULL},
    [DYNAMICS_CO_PRESSURE_ANGLE] = {"pressure_angle", "rad", "working pressure angle", "cycle",
                                    NULL, 0, NULL},
    [DYNAMICS_CO_BACKLASH] = {"backlash", "m", "backlash along the line of action", "cycle", NULL,
                              0, NULL},
    [DYNAMICS_CO_CONTACT_RATIO] = {"contact_ratio", "1", "profile contact ratio", "cycle", NULL, 0,
                                   NULL},
    [DYNAMICS_CO_DISPLACEMENT] =
        {"displacement", "m",
         "of the gears on their bearings: gear 1 along the line of centres "
         "towards gear 2 and across it, then gear 2",
         "direction cycle", NULL, 0, NULL},
    [DYNAMICS_CO_BEARING_FORCE] = {"bearing_force", "N",
                                   "largest elastic force of each gear's bearings", "gear", NULL, 0,
                                   NULL},
};

static void force_and_gap_at(const void *self, double phase, int left, double *force, double *gap);

static dynamics_motion_view view_of(const dynamics_coupled_motion *motion)
{
    return (dynamics_motion_view){.samples = motion->record.samples,
                                  .stride = sizeof *motion->record.samples,
                                  .recorded = motion->record.count,
                                  .cycles = motion->cycles,
                                  .T = motion->T,
                                  .parted = motion->parted,
                                  .back = motion->back,
                                  .period = motion->settled.period,
                                  .look_up = force_and_gap_at,
                                  .self = motion};
}

/* The force and the gap at a phase, straight between samples. */
static void force_and_gap_at(const void *self, double phase, int left, double *force, double *gap)
{
    const dynamics_coupled_motion *motion = self;
    const dynamics_motion_view view = view_of(motion);
    const dynamics_coupled_sample *a =
        &motion->record.samples[dynamics_motion_view_before(&view, phase, left)];
    const dynamics_coupled_sample *z = a + 1;
    double h = z->excitation.phase - a->excitation.phase;
    double x = h > 0 ? fmin(fmax((phase - a->excitation.phase) / h, 0), 1) : 0;
    *force = a->excitation.force + x * (z->excitation.force - a->excitation.force);
    *gap = a->gap + x * (z->gap - a->gap);
}

static ff_status put_cycle(const dynamics_coupled_motion *motion, const dynamics_coupled *pair,
                           const ff_host *host)
{
    static const uint32_t series[] = {DYNAMICS_OUT_PHASE,          DYNAMICS_OUT_DTE,
                                      DYNAMICS_OUT_DTE_VELOCITY,   DYNAMICS_OUT_MESH_FORCE,
                                      DYNAMICS_CO_CENTRE_DISTANCE, DYNAMICS_CO_PRESSURE_ANGLE,
                                      DYNAMICS_CO_BACKLASH,        DYNAMICS_CO_CONTACT_RATIO};
    enum { SERIES = sizeof series / sizeof series[0] };
    const dynamics_excitation *excitation = pair->excitation;
    dynamics_motion_view view = view_of(motion);
    size_t count = dynamics_motion_view_count(&view), shape[2] = {DYNAMICS_COORDINATES - 1, count};
    double *out[SERIES], *moved = host->output(host->ctx, DYNAMICS_CO_DISPLACEMENT, 2, shape);
    for (int k = 0; k < SERIES; k++)
        if (!(out[k] = ff_put_series(host, series[k], count)))
            return FF_NOMEM;
    if (!moved)
        return FF_NOMEM;
    for (size_t i = 0; i < count; i++) {
        const dynamics_coupled_sample *s = &motion->record.samples[i];
        dynamics_place place;
        dynamics_coupled_locate(pair, s->position, &place);
        const double values[SERIES] = {
            s->excitation.phase,
            s->excitation.s * excitation->length,
            s->excitation.s_rate * excitation->length * excitation->omega,
            s->excitation.force * excitation->length * excitation->stiffness,
            place.centre * excitation->length,
            place.angle,
            2 * place.half_gap * excitation->length,
            place.exit - place.entry};
        for (int k = 0; k < SERIES; k++)
            out[k][i] = values[k];
        for (size_t k = 0; k + 1 < DYNAMICS_COORDINATES; k++)
            moved[k * count + i] = s->position[DYNAMICS_X1 + k] * excitation->length;
    }
    return FF_OK;
}

static ff_status put_bearings(const dynamics_coupled_motion *motion, const dynamics_coupled *pair,
                              const ff_host *host)
{
    double *force = ff_put_series(host, DYNAMICS_CO_BEARING_FORCE, 2);
    dynamics_motion_view view = view_of(motion);
    size_t count = dynamics_motion_view_count(&view);
    for (int gear = 0; force && gear < 2; gear++)
        for (size_t i = 0; i < count; i++) {
            const double *x = &motion->record.samples[i].position[gear ? DYNAMICS_X2 : DYNAMICS_X1];
            force[gear] =
                fmax(force[gear], pair->bearing[gear] * hypot(x[0], x[1]) *
                                      pair->excitation->stiffness * pair->excitation->length);
        }
    return force ? FF_OK : FF_NOMEM;
}

static ff_status put_multipliers(const dynamics_coupled_motion *motion, const ff_host *host)
{
    size_t shape[2] = {DYNAMICS_TAKEN, 2};
    double largest, *multipliers = host->output(host->ctx, DYNAMICS_OUT_MULTIPLIERS, 2, shape);
    ff_status status = multipliers
                           ? dynamics_coupled_multipliers(motion->monodromy, multipliers, &largest)
                           : FF_NOMEM;
    return status == FF_OK ? ff_put_scalar(host, DYNAMICS_OUT_FLOQUET_MAX, largest) : status;
}

ff_status dynamics_coupled_put(const dynamics_coupled_motion *motion, const dynamics_coupled *pair,
                               const dynamics_inputs *inputs, const ff_host *host)
{
    dynamics_motion_view view = view_of(motion);
    dynamics_statistics st = dynamics_motion_view_statistics(&view);
    ff_status status = put_cycle(motion, pair, host);
    if (status == FF_OK)
        status = put_bearings(motion, pair, host);
    if (status == FF_OK)
        status = put_multipliers(motion, host);
    return status == FF_OK ? dynamics_motion_view_put(&view, &st, pair->excitation, inputs, host)
                           : status;
}
