/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "motion.h"

#include "landings.h"
#include "multipliers.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const ff_port dynamics_motion_outputs[DYNAMICS_POWER_OUTPUT_COUNT] = {
    [DYNAMICS_OUT_PHASE] =
        {.name = "phase",
         .unit = "1",
         .doc = "mesh cycles since the entering pair was at SAP; twice where the excitation "
                "jumps",
         .dims = "cycle"},
    [DYNAMICS_OUT_DTE] =
        {.name = "dte",
         .unit = "m",
         .doc = "dynamic transmission error s; 0 in the middle of the backlash, so that "
                "half of it is in the values",
         .dims = "cycle"},
    [DYNAMICS_OUT_DTE_VELOCITY] = {.name = "dte_velocity",
                                   .unit = "m/s",
                                   .doc = "its rate",
                                   .dims = "cycle"},
    [DYNAMICS_OUT_MESH_FORCE] = {.name = "mesh_force",
                                 .unit = "N",
                                 .doc = "dynamic mesh force DMF of spring and damper; "
                                        "with squeeze, of the oil alone while no flank is held",
                                 .dims = "cycle"},
    [DYNAMICS_OUT_DTE_RMS] = {.name = "dte_rms",
                              .unit = "m",
                              .doc = "root mean square of the alternating part of s",
                              .dims = "",
                              .max = INFINITY},
    [DYNAMICS_OUT_DTE_MEAN] = {.name = "dte_mean", .unit = "m", .doc = "mean of s", .dims = ""},
    [DYNAMICS_OUT_DTE_PEAK_TO_PEAK] = {.name = "dte_peak_to_peak",
                                       .unit = "m",
                                       .doc = "highest less lowest s",
                                       .dims = "",
                                       .max = INFINITY},
    [DYNAMICS_OUT_TOOTH_FORCE] =
        {.name = "tooth_force",
         .unit = "N",
         .doc = "dynamic tooth force W_s DMF/F, not clipped at 0; one row per "
                "engagement when the period is several mesh cycles",
         .dims = "engagement? gear.station"},
    [DYNAMICS_OUT_GAP] = {.name = "gap",
                          .unit = "m",
                          .doc = "separation of the driving flanks; 0 in contact. With squeeze the "
                                 "film between them beyond handover_film, which bends the teeth",
                          .dims = "engagement? gear.station"},
    [DYNAMICS_OUT_DYNAMIC_FACTOR_TOOTH] =
        {.name = "dynamic_factor_tooth",
         .unit = "1",
         .doc = "largest dynamic over largest quasi-static tooth force",
         .dims = ""},
    [DYNAMICS_OUT_DYNAMIC_FACTOR_MESH] = {.name = "dynamic_factor_mesh",
                                          .unit = "1",
                                          .doc = "largest mesh force over the static one",
                                          .dims = ""},
    [DYNAMICS_OUT_CONTACT_LOSS] = {.name = "contact_loss",
                                   .unit = "1",
                                   .doc = "share of the time in which no flanks touch",
                                   .dims = "",
                                   .max = 1},
    [DYNAMICS_OUT_BACK_CONTACT] = {.name = "back_contact",
                                   .unit = "1",
                                   .doc = "share of the time with contact on the back flank",
                                   .dims = "",
                                   .max = 1},
    [DYNAMICS_OUT_NATURAL_FREQUENCY] = {.name = "natural_frequency",
                                        .unit = "Hz",
                                        .doc = "of small vibration, at the mean of the stiffness "
                                               "that is wired: the slope dF/d(e_l) with "
                                               "definition: tangent, the chord F/(e_l - e) with "
                                               "secant",
                                        .dims = "",
                                        .max = INFINITY},
    [DYNAMICS_OUT_PERIOD] =
        {.name = "period",
         .unit = "1",
         .doc = "of the motion in mesh cycles; 0: aperiodic, -1: grows without bound",
         .dims = ""},
    [DYNAMICS_OUT_FLOQUET_MAX] =
        {.name = "floquet_max",
         .unit = "1",
         .doc = "largest modulus of the multipliers: below 1 the motion is stable",
         .dims = ""},
    [DYNAMICS_OUT_MULTIPLIERS] =
        {.name = "multipliers",
         .unit = "1",
         .doc = "real and imaginary part of the growth of a disturbance over the "
                "motion shown",
         .dims = "multiplier part"},
    [DYNAMICS_OUT_DTE_HARMONICS] = {.name = "dte_harmonics",
                                    .unit = "m",
                                    .doc =
                                        "amplitudes of s at 1, 2, 3 ... times the mesh frequency",
                                    .dims = "harmonic"},
    [DYNAMICS_OUT_LANDING_TIME] =
        {.name = "landing_time",
         .unit = "s",
         .doc =
             "when the driving flanks meet after they have parted, since the start of the motion "
             "shown; empty: they do not part",
         .dims = "landing"},
    [DYNAMICS_OUT_LANDING_SPEED] = {.name = "landing_speed",
                                    .unit = "m/s",
                                    .doc = "how fast they approach each other there",
                                    .dims = "landing"},
    [DYNAMICS_OUT_STABLE_MOTIONS] =
        {.name = "stable_motions",
         .unit = "1",
         .doc = "different motions of at most 6 mesh cycles at this speed in which "
                "disturbances die out, of those that both branches and 16 starts "
                "lead to; with known_motions: atlas those of the atlas, too",
         .dims = "",
         .max = INFINITY},
    [DYNAMICS_OUT_ATLAS_FREQUENCY] =
        {.name = "atlas_frequency",
         .unit = "Hz",
         .doc = "mesh frequency of all periodic motions, along their branches",
         .dims = "point"},
    [DYNAMICS_OUT_ATLAS_RMS] = {.name = "atlas_rms",
                                .unit = "m",
                                .doc = "root mean square of the alternating part of s there",
                                .dims = "point"},
    [DYNAMICS_OUT_ATLAS_STABLE] = {.name = "atlas_stable",
                                   .unit = "1",
                                   .doc = "1: disturbances die out, 0: they grow",
                                   .dims = "point"},
    [DYNAMICS_OUT_ATLAS_BRANCH] =
        {.name = "atlas_branch",
         .unit = "1",
         .doc = "number of the branch: 1000 times the period and n for p<period>-<n>",
         .dims = "point"},
    [DYNAMICS_OUT_ATLAS_FLOQUET_MAX] = {.name = "atlas_floquet_max",
                                        .unit = "1",
                                        .doc = "largest modulus of the multipliers",
                                        .dims = "point"},
    [DYNAMICS_OUT_FOLD_FREQUENCY] = {.name = "fold_frequency",
                                     .unit = "Hz",
                                     .doc = "where two branches meet and end",
                                     .dims = "fold"},
    [DYNAMICS_OUT_FOLD_BRANCH] = {.name = "fold_branch",
                                  .unit = "1",
                                  .doc = "the first of the two",
                                  .dims = "fold"},
    [DYNAMICS_OUT_DOUBLING_FREQUENCY] = {.name = "doubling_frequency",
                                         .unit = "Hz",
                                         .doc = "where the period doubles",
                                         .dims = "doubling"},
    [DYNAMICS_OUT_DAMPER_LOSS] = {.name = "damper_loss",
                                  .unit = "W",
                                  .doc = "mean power that the damper takes",
                                  .dims = ""},
    [DYNAMICS_OUT_SQUEEZE_LOSS] = {.name = "squeeze_loss",
                                   .unit = "W",
                                   .doc = "mean power that the oil between parted flanks takes",
                                   .dims = ""},
    [DYNAMICS_OUT_EXCITATION_POWER] =
        {.name = "excitation_power",
         .unit = "W",
         .doc =
             "mean power that the prescribed changes of stiffness and transmission error bring in; "
             "film_power is not in it",
         .dims = ""},
    [DYNAMICS_OUT_TORQUE_POWER] =
        {.name = "torque_power",
         .unit = "W",
         .doc = "mean power that the torques put into friction and rolling at "
                "the mean speeds of the gears; 0 without a film wired back",
         .dims = ""},
    [DYNAMICS_OUT_FRICTION_WORK] =
        {.name = "friction_work",
         .unit = "W",
         .doc = "mean power that friction and rolling take from the vibration; "
                "0 without a film wired back",
         .dims = ""},
    [DYNAMICS_OUT_FILM_POWER] =
        {.name = "film_power",
         .unit = "W",
         .doc = "mean power that the changes of the loaded film's thickness bring "
                "in; 0 without a film wired back",
         .dims = ""},
    [DYNAMICS_OUT_DOUBLING_BRANCH] = {.name = "doubling_branch",
                                      .unit = "1",
                                      .doc = "branch of the shorter period",
                                      .dims = "doubling"},
};

enum { HARMONICS = 16 };

size_t dynamics_mesh_cycles_of_engagement(const dynamics_inputs *inputs)
{
    return (size_t)ceil(dynamics_station_phase(inputs, inputs->stations - 1) + 1e-9);
}

void dynamics_motion_check_determinant(dynamics_motion *motion)
{
    const double *m = motion->monodromy;
    double expected = exp(-2 * motion->excitation->zeta * motion->clocks.damped);
    double size = fabs(m[0] * m[3]) + fabs(m[1] * m[2]) + expected;
    motion->det_error = fabs(m[0] * m[3] - m[1] * m[2] - expected) / size;
}

void dynamics_motion_check_energy(dynamics_motion *motion, double start, double end, double work,
                                  double loss)
{
    double load = motion->excitation->load;
    double unit = fabs(start) + fabs(end) + 0.5 * load * load + loss;
    double gain = work - loss - (end - start);
    motion->energy_error = unit > 0 ? fabs(gain) / unit : 0;
}

/* Takes over the monodromy and the clocks of the recorded cycles, and checks both invariants. */
static void check_invariants(dynamics_motion *motion, const dynamics_oscillator *o,
                             double start_energy)
{
    const double *y = dynamics_oscillator_state(o);
    memcpy(motion->monodromy, &y[DYNAMICS_M11], sizeof motion->monodromy);
    motion->clocks = dynamics_oscillator_clocks(o);
    dynamics_motion_check_determinant(motion);
    dynamics_motion_check_energy(motion, start_energy, dynamics_oscillator_energy(o),
                                 y[DYNAMICS_WORK], y[DYNAMICS_LOSS]);
}

ff_status dynamics_motion_record(dynamics_motion *motion, const dynamics_inputs *inputs,
                                 double tolerance, size_t per_cycle, double delta, double rate)
{
    size_t tail = dynamics_mesh_cycles_of_engagement(inputs);
    dynamics_oscillator *o =
        dynamics_oscillator_new(motion->excitation, tolerance, 1, DYNAMICS_MOTION_AND_VARIATION);
    int good = o && dynamics_record_init(&motion->record, motion->excitation, per_cycle,
                                         motion->cycles + tail);
    ff_status status = good ? FF_OK : FF_NOMEM;
    if (good) {
        dynamics_oscillator_start(o, motion->T, delta, rate);
        double energy = dynamics_oscillator_energy(o);
        for (size_t i = 0; i < motion->cycles + tail && status == FF_OK; i++) {
            status = dynamics_oscillator_cycle(o, motion->T, &motion->record) ? FF_OK : FF_NOCONV;
            if (i + 1 == motion->cycles)
                check_invariants(motion, o, energy);
        }
    }
    dynamics_oscillator_free(o);
    return status;
}

double dynamics_motion_multipliers(const dynamics_motion *motion, double multipliers[4])
{
    static const double huge = 1e300;
    const double *m = motion->monodromy;
    if (motion->excitation->film) {
        double all[8], largest = dynamics_films_multipliers(motion->in_oil, all);
        memcpy(multipliers, all, 4 * sizeof *multipliers);
        return largest;
    }
    double half = 0.5 * (m[0] + m[3]), det = m[0] * m[3] - m[1] * m[2];
    double d = half * half - det, root = sqrt(fabs(d));
    if (!isfinite(d)) { /* a disturbance of a long aperiodic motion overflows */
        multipliers[0] = huge;
        multipliers[1] = multipliers[2] = multipliers[3] = 0;
        return huge;
    }
    double large = half + (half < 0 ? -root : root);
    if (d < 0) {
        multipliers[0] = multipliers[2] = half;
        multipliers[1] = root;
        multipliers[3] = -root;
        return sqrt(half * half + root * root);
    }
    multipliers[0] = large;
    multipliers[2] = large != 0 ? det / large : 0;
    multipliers[1] = multipliers[3] = 0;
    return fabs(large);
}

static void force_and_gap_at(const void *self, double phase, int left, double *force, double *gap);

static dynamics_motion_view view_of(const dynamics_motion *motion)
{
    return (dynamics_motion_view){.samples = motion->record.samples,
                                  .stride = sizeof *motion->record.samples,
                                  .recorded = motion->record.count,
                                  .cycles = motion->cycles,
                                  .T = motion->T,
                                  .parted = motion->clocks.parted,
                                  .back = motion->clocks.back,
                                  .period = motion->period,
                                  .look_up = force_and_gap_at,
                                  .self = motion};
}

/* Interpolates force and gap between two samples. With oil between the flanks they do not follow
 * from s: the film bends the teeth, so that the flanks are further apart than s says. */
static void read_films(const dynamics_sample *a, const dynamics_sample *z, double phase,
                       double *force, double *gap)
{
    double h = z->phase - a->phase, x = h > 0 ? fmin(fmax((phase - a->phase) / h, 0), 1) : 0;
    *force = a->force + x * (z->force - a->force);
    *gap = fmax(a->film + x * (z->film - a->film), 0);
}

/* Computes the force and the gap at any phase of the record, from s by Hermite's cubic between
 * samples. At a jump of the excitation `left` asks for the values before the jump. */
static void force_and_gap_at(const void *self, double phase, int left, double *force, double *gap)
{
    const dynamics_motion *motion = self;
    const dynamics_excitation *excitation = motion->excitation;
    const dynamics_sample *s = motion->record.samples;
    const dynamics_motion_view view = view_of(motion);
    size_t low = dynamics_motion_view_before(&view, phase, left);
    const dynamics_sample *a = &s[low], *z = &s[low + 1];
    if (excitation->film) {
        read_films(a, z, phase, force, gap);
        return;
    }
    double h = z->phase - a->phase;
    phase = fmin(fmax(phase, a->phase), z->phase);
    double x = h > 0 ? (phase - a->phase) / h : 0;
    double slope_a = a->s_rate * motion->T * h, slope_z = z->s_rate * motion->T * h;
    double c2 = 3 * (z->s - a->s) - 2 * slope_a - slope_z;
    double c3 = slope_a + slope_z - 2 * (z->s - a->s);
    double value = a->s + x * (slope_a + x * (c2 + x * c3));
    double rate = a->s_rate;
    if (h > 0)
        rate = (slope_a + x * (2 * c2 + 3 * x * c3)) / (h * motion->T);
    phase -= floor(0.5 * (a->phase + z->phase));
    const dynamics_piece *piece = dynamics_excitation_piece(excitation, phase, left);
    double since = phase - piece->start;
    double delta = value - dynamics_piece_value(piece->e, piece->degree, since);
    *force = dynamics_mesh_force(excitation, piece, since, delta,
                                 rate - dynamics_piece_slope(piece->e, piece->degree, since) /
                                            motion->T);
    *gap = excitation->half_gap > 0 ? fmax(excitation->half_gap - delta, 0) : 0;
}

static ff_status put_cycle(const dynamics_motion *motion, const dynamics_inputs *inputs,
                           const ff_host *host)
{
    const dynamics_excitation *excitation = motion->excitation;
    const double length = inputs->back ? -excitation->length : excitation->length;
    dynamics_motion_view view = view_of(motion);
    size_t count = dynamics_motion_view_count(&view);
    double *phase = ff_put_series(host, DYNAMICS_OUT_PHASE, count);
    double *dte = ff_put_series(host, DYNAMICS_OUT_DTE, count);
    double *velocity = ff_put_series(host, DYNAMICS_OUT_DTE_VELOCITY, count);
    double *force = ff_put_series(host, DYNAMICS_OUT_MESH_FORCE, count);
    if (!phase || !dte || !velocity || !force)
        return FF_NOMEM;
    for (size_t i = 0; i < count; i++) {
        const dynamics_sample *s = &motion->record.samples[i];
        phase[i] = s->phase * (double)dynamics_span(inputs);
        dte[i] = s->s * length;
        velocity[i] = s->s_rate * length * excitation->omega;
        force[i] = s->force * length * excitation->stiffness;
    }
    return FF_OK;
}

static ff_status put_multipliers(const dynamics_motion *motion, const ff_host *host)
{
    size_t shape[2] = {2, 2};
    double *multipliers = host->output(host->ctx, DYNAMICS_OUT_MULTIPLIERS, 2, shape);
    if (!multipliers)
        return FF_NOMEM;
    return ff_put_scalar(host, DYNAMICS_OUT_FLOQUET_MAX,
                         dynamics_motion_multipliers(motion, multipliers));
}

/* s cos(2 pi n phase), or with the sine, at a sample, and its derivative by the phase. */
static double fourier_integrand(const dynamics_motion *motion, const dynamics_sample *s, int n,
                                int sine, double *slope)
{
    double x = 2 * M_PI * n, c = cos(x * s->phase), q = sin(x * s->phase);
    *slope = s->s_rate * motion->T * (sine ? q : c) + x * s->s * (sine ? c : -q);
    return s->s * (sine ? q : c);
}

/* Fourier's integrals a_n, b_n = 2 int s (cos, sin)(2 pi n phase) d phase by the Euler-Maclaurin
   rule: the trapezium with the slopes at its ends. */
static ff_status put_harmonics(const dynamics_motion *motion, const dynamics_inputs *inputs,
                               const ff_host *host)
{
    const dynamics_sample *s = motion->record.samples;
    dynamics_motion_view view = view_of(motion);
    size_t count = dynamics_motion_view_count(&view);
    double *out = ff_put_series(host, DYNAMICS_OUT_DTE_HARMONICS, HARMONICS);
    if (!out)
        return FF_NOMEM;
    for (int n = 1; n <= HARMONICS; n++) {
        const int order = n * (int)dynamics_span(inputs);
        double sum[2] = {0}, slope, end_slope;
        for (size_t i = 0; i + 1 < count; i++)
            for (int k = 0; k < 2; k++) {
                double h = s[i + 1].phase - s[i].phase;
                double a = fourier_integrand(motion, &s[i], order, k, &slope);
                double z = fourier_integrand(motion, &s[i + 1], order, k, &end_slope);
                sum[k] += h * (a + z) / 2 + h * h * (slope - end_slope) / 12;
            }
        out[n - 1] =
            2 / (double)motion->cycles * hypot(sum[0], sum[1]) * motion->excitation->length;
    }
    return FF_OK;
}

ff_status dynamics_motion_put(const dynamics_motion *motion, const dynamics_inputs *inputs,
                              const ff_host *host)
{
    dynamics_motion_view view = view_of(motion);
    dynamics_statistics st = dynamics_motion_view_statistics(&view);
    ff_status status = put_cycle(motion, inputs, host);
    if (status == FF_OK)
        status = put_multipliers(motion, host);
    if (status == FF_OK)
        status = put_harmonics(motion, inputs, host);
    if (status == FF_OK)
        status = dynamics_landings_put(&view, motion->excitation, DYNAMICS_OUT_LANDING_TIME,
                                       DYNAMICS_OUT_LANDING_SPEED, host);
    if (status == FF_OK)
        status = dynamics_motion_view_put(&view, &st, motion->excitation, inputs, host);
    host->quality(host->ctx, "rms_sampling_error", st.rms_error, 1e-3,
                  st.rms_error <= 1e-3 ? FF_GOOD : FF_DOUBTFUL,
                  "estimate of the error of dte_rms by the points shown, over it");
    return status;
}

/* Reports the balance of powers: torques and the prescribed changes of stiffness and transmission
   error put power in; films, damper and vibration take it. `films` is the loss of the films by
   their own model. It includes squeezing, so that the motion's squeeze loss is not added. */
static void check_powers(const double power[DYNAMICS_POWER_OUTPUT_COUNT], double films, int knows,
                         const ff_host *host)
{
    static const double limit = 1e-3;
    double in = power[DYNAMICS_OUT_TORQUE_POWER] + power[DYNAMICS_OUT_EXCITATION_POWER];
    double out = films + power[DYNAMICS_OUT_FRICTION_WORK] + power[DYNAMICS_OUT_DAMPER_LOSS];
    double off = films > 0 ? fabs(in - out) / films : 0;
    char text[320];
    snprintf(
        text, sizeof text,
        "torques and excitation put in %.6g W, film, damper and vibration take %.6g W: the "
        "difference over what the film takes. Where flanks part it is what the motion does not "
        "know of the film in flight%s",
        in, out, knows ? "" : "; squeeze: series gives it one");
    host->quality(host->ctx, "power_balance", off, limit, off <= limit ? FF_GOOD : FF_DOUBTFUL,
                  text);
}

ff_status dynamics_motion_put_powers(const dynamics_motion *motion,
                                     const dynamics_film_powers *film, const ff_host *host)
{
    const dynamics_excitation *x = motion->excitation;
    double unit =
        x->stiffness * x->length * x->length * x->omega / ((double)motion->cycles * motion->T);
    const int swings = x->drags && isnan(film->loss); /* the drag is then that of the torque */
    const double power[DYNAMICS_POWER_OUTPUT_COUNT] = {
        [DYNAMICS_OUT_DAMPER_LOSS] = unit * (motion->loss - motion->squeeze),
        [DYNAMICS_OUT_SQUEEZE_LOSS] = unit * motion->squeeze,
        [DYNAMICS_OUT_EXCITATION_POWER] = unit * (motion->work - motion->thickness),
        [DYNAMICS_OUT_TORQUE_POWER] = film->torques - (swings ? unit * motion->drag : 0),
        [DYNAMICS_OUT_FRICTION_WORK] = swings ? 0 : unit * motion->drag,
        [DYNAMICS_OUT_FILM_POWER] = unit * motion->thickness,
    };
    ff_status status = FF_OK;
    for (uint32_t i = DYNAMICS_OUT_DAMPER_LOSS; i < DYNAMICS_POWER_OUTPUT_COUNT; i++)
        if (status == FF_OK)
            status = ff_put_scalar(host, i, power[i]);
    if (status == FF_OK && !isnan(film->loss) && motion->period > 0)
        check_powers(power, film->loss, x->film != NULL, host);
    return status;
}

int dynamics_atlas_columns_open(dynamics_atlas_columns *c, size_t points, const ff_host *host)
{
    c->frequency = ff_put_series(host, DYNAMICS_OUT_ATLAS_FREQUENCY, points);
    c->rms = ff_put_series(host, DYNAMICS_OUT_ATLAS_RMS, points);
    c->stable = ff_put_series(host, DYNAMICS_OUT_ATLAS_STABLE, points);
    c->branch = ff_put_series(host, DYNAMICS_OUT_ATLAS_BRANCH, points);
    c->floquet = ff_put_series(host, DYNAMICS_OUT_ATLAS_FLOQUET_MAX, points);
    return c->frequency && c->rms && c->stable && c->branch && c->floquet;
}
