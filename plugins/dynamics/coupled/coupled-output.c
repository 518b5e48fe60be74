/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The outputs of dynamics/coupled. */
#include "../oscillator/landings.h"
#include "../oscillator/motion-view.h"
#include "coupled-motion.h"
#include "coupled-shooting.h"

#include <flankfilm/author.h>

#include <math.h>

const ff_port dynamics_coupled_outputs[DYNAMICS_COUPLED_OUTPUT_COUNT] = {
    [DYNAMICS_OUT_PHASE] =
        {.name = "phase",
         .unit = "1",
         .label = "mesh cycle",
         .doc = "mesh cycles since the entering pair was at SAP; a repeated value marks a jump "
                "of the excitation",
         .dims = "cycle"},
    [DYNAMICS_OUT_DTE] =
        {.name = "dte",
         .label = "dynamic transmission error",
         .unit = "m",
         .doc = "dynamic transmission error s: from the rotations of the gears minus the "
                "rotation of the line of centres; zero is the middle of the backlash, so that "
                "the values in contact include half the backlash",
         .dims = "cycle"},
    [DYNAMICS_OUT_DTE_VELOCITY] = {.name = "dte_velocity",
                                   .unit = "m/s",
                                   .doc = "rate of the dynamic transmission error",
                                   .dims = "cycle"},
    [DYNAMICS_OUT_MESH_FORCE] = {.name = "mesh_force",
                                 .unit = "N",
                                 .doc = "dynamic mesh force DMF of spring and damper: driving "
                                        "flanks minus back flanks",
                                 .dims = "cycle"},
    [DYNAMICS_OUT_DTE_RMS] = {.name = "dte_rms",
                              .label = "rms of the transmission error",
                              .unit = "m",
                              .doc = "root mean square of the alternating part of the dynamic "
                                     "transmission error s",
                              .dims = "",
                              .max = INFINITY},
    [DYNAMICS_OUT_DTE_MEAN] = {.name = "dte_mean",
                               .unit = "m",
                               .doc = "mean of the dynamic transmission error s",
                               .dims = ""},
    [DYNAMICS_OUT_DTE_PEAK_TO_PEAK] = {.name = "dte_peak_to_peak",
                                       .unit = "m",
                                       .doc = "largest minus smallest dynamic transmission error "
                                              "s",
                                       .dims = "",
                                       .max = INFINITY},
    [DYNAMICS_OUT_TOOTH_FORCE] =
        {.name = "tooth_force",
         .unit = "N",
         .doc = "dynamic tooth force W_s DMF/F, not clipped at 0; one row per engagement "
                "when the period is several mesh cycles",
         .dims = "engagement? gear.station"},
    [DYNAMICS_OUT_GAP] = {.name = "gap",
                          .unit = "m",
                          .doc = "separation of the driving flanks; 0 in contact",
                          .dims = "engagement? gear.station"},
    [DYNAMICS_OUT_DYNAMIC_FACTOR_TOOTH] =
        {.name = "dynamic_factor_tooth",
         .unit = "1",
         .doc = "largest dynamic tooth force over largest quasi-static tooth force",
         .dims = ""},
    [DYNAMICS_OUT_DYNAMIC_FACTOR_MESH] = {.name = "dynamic_factor_mesh",
                                          .unit = "1",
                                          .doc = "largest mesh force over the static mesh force",
                                          .dims = ""},
    [DYNAMICS_OUT_CONTACT_LOSS] = {.name = "contact_loss",
                                   .unit = "1",
                                   .doc = "share of the time without force between the flanks",
                                   .dims = "",
                                   .max = 1},
    [DYNAMICS_OUT_BACK_CONTACT] = {.name = "back_contact",
                                   .unit = "1",
                                   .doc = "share of the time with contact on the back flanks",
                                   .dims = "",
                                   .max = 1},
    [DYNAMICS_OUT_NATURAL_FREQUENCY] = {.name = "natural_frequency",
                                        .unit = "Hz",
                                        .doc = "natural frequency of the linear mesh alone, at "
                                               "the mean stiffness",
                                        .dims = "",
                                        .max = INFINITY},
    [DYNAMICS_OUT_PERIOD] =
        {.name = "period",
         .unit = "1",
         .doc = "period of the motion in mesh cycles; 0: aperiodic, -1: grows without bound",
         .dims = ""},
    [DYNAMICS_OUT_FLOQUET_MAX] =
        {.name = "floquet_max",
         .unit = "1",
         .doc = "largest modulus of the Floquet multipliers; the motion is stable if it is below "
                "1",
         .dims = ""},
    [DYNAMICS_OUT_MULTIPLIERS] =
        {.name = "multipliers",
         .unit = "1",
         .doc = "Floquet multipliers (real and imaginary part): factors by which disturbances grow "
                "over the motion shown",
         .dims = "multiplier part"},
    [DYNAMICS_CO_CENTRE_DISTANCE] = {.name = "centre_distance",
                                     .unit = "m",
                                     .doc = "distance between the centres of the gears",
                                     .dims = "cycle"},
    [DYNAMICS_CO_PRESSURE_ANGLE] = {.name = "pressure_angle",
                                    .unit = "rad",
                                    .doc = "working pressure angle",
                                    .dims = "cycle"},
    [DYNAMICS_CO_BACKLASH] = {.name = "backlash",
                              .unit = "m",
                              .doc = "backlash along the line of action",
                              .dims = "cycle"},
    [DYNAMICS_CO_CONTACT_RATIO] = {.name = "contact_ratio",
                                   .unit = "1",
                                   .doc = "profile contact ratio",
                                   .dims = "cycle",
                                   .max = INFINITY},
    [DYNAMICS_CO_DISPLACEMENT] =
        {.name = "displacement",
         .unit = "m",
         .doc = "displacements of the gears on their bearings: gear 1 along the line of centres "
                "(towards gear 2) and across it, then gear 2",
         .dims = "direction cycle"},
    [DYNAMICS_CO_BEARING_FORCE] = {.name = "bearing_force",
                                   .unit = "N",
                                   .doc = "largest elastic force of each gear's bearings",
                                   .dims = "gear"},
    [DYNAMICS_CO_LANDING_TIME] = {.name = "landing_time",
                                  .unit = "s",
                                  .doc =
                                      "times at which the driving flanks meet again after "
                                      "contact loss, since the start of the motion shown; empty: "
                                      "no contact loss",
                                  .dims = "landing"},
    [DYNAMICS_CO_LANDING_SPEED] = {.name = "landing_speed",
                                   .unit = "m/s",
                                   .doc = "speeds of approach of the flanks at landing_time",
                                   .dims = "landing"},
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

/* Computes the force at a phase (linear between samples) and the gap (by a Hermite cubic). */
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
    double slope_a = a->overlap_rate * motion->T * h, slope_z = z->overlap_rate * motion->T * h;
    double c2 = 3 * (z->overlap - a->overlap) - 2 * slope_a - slope_z;
    double c3 = slope_a + slope_z - 2 * (z->overlap - a->overlap);
    *gap = fmax(-(a->overlap + x * (slope_a + x * (c2 + x * c3))), 0);
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
    if (status == FF_OK)
        status = dynamics_landings_put(&view, pair->excitation, DYNAMICS_CO_LANDING_TIME,
                                       DYNAMICS_CO_LANDING_SPEED, host);
    return status == FF_OK ? dynamics_motion_view_put(&view, &st, pair->excitation, inputs, host)
                           : status;
}
