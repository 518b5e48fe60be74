/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "motion.h"

#include "../excitation/share.h"
#include "../excitation/tracks.h"
#include "landings.h"
#include "multipliers.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

/* Copies the monodromy and the times of contact of the recorded cycles, and checks both invariants.
 */
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
    if (!isfinite(d)) { /* over a long aperiodic motion the disturbance may overflow */
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

/* The motion at an instant. `behind`: whether the back flanks touch and have their own curves. */
typedef struct instant {
    double force, gap, back_gap;
    int behind;
} instant;

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

/* Interpolates force and gap between two samples of a motion with oil between the flanks. They do
   not follow from s: the film force deflects the teeth, so the flanks are further apart than s
   implies. */
static instant in_films(const dynamics_sample *a, const dynamics_sample *z, double phase)
{
    double h = z->phase - a->phase, x = h > 0 ? fmin(fmax((phase - a->phase) / h, 0), 1) : 0;
    return (instant){.force = a->force + x * (z->force - a->force),
                     .gap = fmax(a->film + x * (z->film - a->film), 0)};
}

static double gap_of(const dynamics_excitation *x, int side, double phase, int left, double s)
{
    const dynamics_piece *p = dynamics_track_piece(dynamics_track_of(x, side), phase, left);
    const double delta = s - dynamics_piece_value(p->e, p->degree, phase - p->start);
    return x->half_gap > 0 ? fmax(x->half_gap - side * delta, 0) : 0;
}

/* Computes force and gaps at any phase of the record. s is a Hermite cubic between samples. At a
   jump of the excitation `left` selects the values before the jump. */
static instant instant_at(const dynamics_motion *motion, double phase, int left)
{
    const dynamics_excitation *excitation = motion->excitation;
    const dynamics_sample *s = motion->record.samples;
    const dynamics_motion_view view = view_of(motion);
    size_t low = dynamics_motion_view_before(&view, phase, left);
    const dynamics_sample *a = &s[low], *z = &s[low + 1];
    if (excitation->film)
        return in_films(a, z, phase);
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
    const dynamics_piece *piece = dynamics_excitation_piece_at(excitation, phase, left, value);
    double since = phase - piece->start;
    double delta = value - dynamics_piece_value(piece->e, piece->degree, since);
    rate -= dynamics_piece_slope(piece->e, piece->degree, since) / motion->T;
    return (instant){.force = dynamics_mesh_force(excitation, piece, since, delta, rate),
                     .gap = gap_of(excitation, 1, phase, left, value),
                     .back_gap = gap_of(excitation, -1, phase, left, value),
                     .behind = dynamics_track_holds(excitation->back, piece)};
}

static void force_and_gap_at(const void *self, double phase, int left, double *force, double *gap)
{
    const instant at = instant_at(self, phase, left);
    *force = at.behind ? 0 : at.force;
    *gap = at.gap;
}

/* Returns the mean force of back flanks with curves of their own, by the trapezoidal rule. The
   force of the damper jumps when these flanks meet or separate, so steps with a change of contact
   are divided. */
static double mean_behind(const dynamics_motion *motion)
{
    enum { PARTS = 64 };
    const dynamics_sample *s = motion->record.samples;
    const dynamics_motion_view view = view_of(motion);
    const size_t count = motion->clocks.back > 0 ? dynamics_motion_view_count(&view) : 1;
    double sum = 0;
    for (size_t i = 0; i + 1 < count; i++) {
        const double from = s[i].phase, h = s[i + 1].phase - from;
        instant a = instant_at(motion, from, 0);
        const int parts = a.behind != instant_at(motion, from + h, 1).behind ? PARTS : 1;
        for (int k = 1; k <= parts; k++) {
            const instant z = instant_at(motion, from + h * k / parts, k == parts);
            sum -= h / parts * (a.behind * a.force + z.behind * z.force) / 2;
            a = z;
        }
    }
    return sum / (double)motion->cycles;
}

/* The outputs that need back flanks with curves of their own. */
static const uint64_t of_back_flanks =
    FF_BIT(DYNAMICS_OUT_BACK_TOOTH_FORCE) | FF_BIT(DYNAMICS_OUT_BACK_GAP);

ff_status dynamics_motion_check_back(const ff_host *host, const dynamics_inputs *inputs,
                                     const dynamics_excitation *excitation)
{
    const uint64_t wanted = inputs->wanted & of_back_flanks;
    const char *why = NULL;
    if (!excitation->both_flanks)
        why = "this motion uses the curves of the driving flanks for the back flanks, and "
              "tooth_force contains their force as a negative force: use dynamics/shooting or "
              "dynamics/time-integration, without oil in the gap and without a film wired back";
    else if (excitation->half_gap == 0)
        why = "gears without backlash touch on both flanks at the same time: tooth_force contains "
              "the force of the back flanks as a negative force";
    else if (!dynamics_tracks_differ(excitation))
        why = "the stiffness does not give the curves of the back flanks: use "
              "stiffness/load-distribution, and gears without index deviations";
    else if (!dynamics_floats(inputs, excitation) &&
             (inputs->back_levels.count < 2 || !inputs->back_levels.tooth_force))
        why = "the stiffness does not give the tooth forces of the back flanks under a load";
    return wanted && why ? ff_failf(host, FF_UNSUPPORTED,
                                    dynamics_motion_outputs[wanted & FF_BIT(DYNAMICS_OUT_BACK_GAP)
                                                                ? DYNAMICS_OUT_BACK_GAP
                                                                : DYNAMICS_OUT_BACK_TOOTH_FORCE]
                                        .name,
                                    "%s", why)
                         : FF_OK;
}

/* Returns whether the station has the roll angle of the previous station. */
static int is_repeated(const dynamics_inputs *inputs, size_t i)
{
    return inputs->roll_angle[i] - inputs->roll_angle[i - 1] < 1e-12 * inputs->pitch;
}

/* Writes the forces and gaps of the pairs of back flanks. A pair is at a station that is a mesh
   cycles after SAP at the phases back_offset - a + n with any integer n (theory, eq. 4.5c). The
   phase decreases along the stations: the second of two coincident stations is the earlier one. */
static ff_status put_back_forces(const dynamics_motion *motion, const dynamics_inputs *inputs,
                                 const ff_host *host)
{
    const dynamics_excitation *x = motion->excitation;
    const double newton = x->stiffness * x->length, span = (double)dynamics_span(inputs);
    const size_t stations = inputs->stations, rows = motion->cycles * dynamics_span(inputs),
                 shape[2] = {rows, stations};
    const uint32_t rank = rows > 1 ? 2 : 1;
    ff_status status =
        ff_put_scalar(host, DYNAMICS_OUT_BACK_FORCE_MEAN, newton * mean_behind(motion));
    if (status != FF_OK || !(inputs->wanted & of_back_flanks))
        return status;
    double *force = host->output(host->ctx, DYNAMICS_OUT_BACK_TOOTH_FORCE, rank, &shape[2 - rank]);
    double *gap = host->output(host->ctx, DYNAMICS_OUT_BACK_GAP, rank, &shape[2 - rank]);
    if (!force || !gap)
        return FF_NOMEM;
    const double last = dynamics_station_phase(inputs, stations - 1) * span;
    for (size_t k = 0; k < rows * stations; k++) {
        const size_t i = k % stations;
        double age = dynamics_station_phase(inputs, i) * span;
        double phase = (double)(k / stations) + inputs->back_offset + ceil(last) - age;
        const instant at = instant_at(motion, phase / span, i == 0 || is_repeated(inputs, i));
        double mesh = at.behind ? -at.force * newton : 0;
        force[k] = dynamics_back_share(inputs, i, mesh) * mesh;
        gap[k] = at.back_gap * x->length;
    }
    dynamics_put_stations(force, stations, rows * stations, inputs->back);
    dynamics_put_stations(gap, stations, rows * stations, inputs->back);
    return FF_OK;
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

/* Returns s cos(2 pi n phase), or s sin(2 pi n phase), at a sample, and its derivative by the
   phase. */
static double fourier_integrand(const dynamics_motion *motion, const dynamics_sample *s, int n,
                                int sine, double *slope)
{
    double x = 2 * M_PI * n, c = cos(x * s->phase), q = sin(x * s->phase);
    *slope = s->s_rate * motion->T * (sine ? q : c) + x * s->s * (sine ? c : -q);
    return s->s * (sine ? q : c);
}

/* Writes the harmonics from Fourier's integrals a_n, b_n = 2 int s (cos, sin)(2 pi n phase) d
   phase, by the Euler-Maclaurin rule: the trapezoidal rule with end corrections from the slopes. */
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
    if (status == FF_OK)
        status = put_back_forces(motion, inputs, host);
    host->quality(host->ctx, "rms_sampling_error", st.rms_error, 1e-3,
                  st.rms_error <= 1e-3 ? FF_GOOD : FF_DOUBTFUL,
                  "estimated relative error of dte_rms due to the spacing of the points shown");
    return status;
}

/* Reports the power balance. Torques and the prescribed changes of stiffness and transmission error
   supply power; films, damper and vibration take it. `films` is the power loss that the film model
   gives. `films` includes the squeeze loss, so the squeeze loss of the motion is not added. */
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
        "difference between the power that torques and excitation supply, %.6g W, and the power "
        "that film, damper and vibration take, %.6g W, over the power of the film. While flanks "
        "are separated, the motion neglects the film that the film model computes%s",
        in, out, knows ? "" : "; squeeze: series includes it");
    host->quality(host->ctx, "power_balance", off, limit, off <= limit ? FF_GOOD : FF_DOUBTFUL,
                  text);
}

ff_status dynamics_motion_put_powers(const dynamics_motion *motion,
                                     const dynamics_film_powers *film, const ff_host *host)
{
    const dynamics_excitation *x = motion->excitation;
    double unit =
        x->stiffness * x->length * x->length * x->omega / ((double)motion->cycles * motion->T);
    /* without a film, the drag is the force of the fluctuation */
    const int swings = x->drags && isnan(film->loss);
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
