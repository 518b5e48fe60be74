/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "motion-view.h"

#include "../excitation/back-inputs.h"
#include "motion.h"
#include "sharing.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>

static const dynamics_sample *sample_at(const dynamics_motion_view *view, size_t i)
{
    return (const dynamics_sample *)(const void *)((const char *)view->samples + i * view->stride);
}

size_t dynamics_motion_view_count(const dynamics_motion_view *view)
{
    size_t n = 0;
    while (n < view->recorded && sample_at(view, n)->phase < (double)view->cycles)
        n++;
    return n + 1;
}

double dynamics_motion_view_phase(const dynamics_motion_view *view, size_t sample)
{
    return sample_at(view, sample)->phase;
}

/* Integrates by the Euler-Maclaurin rule: the trapezoidal rule with end corrections from the
   slopes. The error of the mean square is estimated by comparison with Simpson's rule on Hermite
   cubics, which has the same order. */
dynamics_statistics dynamics_motion_view_statistics(const dynamics_motion_view *view)
{
    size_t count = dynamics_motion_view_count(view);
    double first = sample_at(view, 0)->s;
    double force = sample_at(view, 0)->force;
    dynamics_statistics st = {.low = first, .high = first, .force = force, .least_force = force};
    for (size_t i = 0; i + 1 < count; i++) {
        const dynamics_sample *a = sample_at(view, i), *z = sample_at(view, i + 1);
        double h = z->phase - a->phase;
        st.mean += h * (a->s + z->s) / 2 + h * h * view->T * (a->s_rate - z->s_rate) / 12;
        st.low = fmin(st.low, z->s);
        st.high = fmax(st.high, z->s);
        st.force = fmax(st.force, z->force);
        st.least_force = fmin(st.least_force, z->force);
    }
    st.mean /= (double)view->cycles;
    double square = 0, doubt = 0;
    for (size_t i = 0; i + 1 < count; i++) {
        const dynamics_sample *p = sample_at(view, i), *q = sample_at(view, i + 1);
        double h = q->phase - p->phase, a = p->s - st.mean, z = q->s - st.mean;
        double middle = (a + z) / 2 + h * view->T * (p->s_rate - q->s_rate) / 8;
        double part =
            h * (a * a + z * z) / 2 + h * h * view->T * (a * p->s_rate - z * q->s_rate) / 6;
        square += part;
        doubt += fabs(h * (a * a + 4 * middle * middle + z * z) / 6 - part);
    }
    st.rms = sqrt(fmax(square / (double)view->cycles, 0));
    st.rms_error = square > 0 ? fmin(doubt / (2 * square), 1) : 0;
    return st;
}

size_t dynamics_motion_view_before(const dynamics_motion_view *view, double phase, int left)
{
    size_t low = 0, high = view->recorded - 1;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        double there = sample_at(view, middle)->phase;
        if (left ? there < phase - 1e-9 : there <= phase + 1e-9)
            low = middle;
        else
            high = middle;
    }
    return low;
}

double dynamics_station_phase(const dynamics_inputs *inputs, size_t station)
{
    return fmax((inputs->roll_angle[station] - inputs->roll_sap) / inputs->pitch, 0) /
           (double)dynamics_span(inputs);
}

/* Returns whether the value before a jump is used at a station: at the first of two coincident
   stations, and at the tip. */
static int is_left(const dynamics_inputs *inputs, size_t i)
{
    return i + 1 == inputs->stations ||
           inputs->roll_angle[i + 1] - inputs->roll_angle[i] < 1e-12 * inputs->pitch;
}

/* Writes the tooth force of the pair at each station, taken at the phase of that station. */
static ff_status put_engagements(const dynamics_motion_view *view,
                                 const dynamics_excitation *excitation,
                                 const dynamics_inputs *inputs, const ff_host *host)
{
    const double newton = excitation->stiffness * excitation->length;
    const size_t engagements = view->cycles * dynamics_span(inputs),
                 shape[2] = {engagements, inputs->stations};
    const uint32_t rank = engagements > 1 ? 2 : 1;
    double *force = host->output(host->ctx, DYNAMICS_OUT_TOOTH_FORCE, rank, &shape[2 - rank]);
    double *gap = host->output(host->ctx, DYNAMICS_OUT_GAP, rank, &shape[2 - rank]);
    if (!force || !gap)
        return FF_NOMEM;
    for (size_t cycle = 0, i = 0; cycle < engagements; cycle++)
        for (size_t station = 0; station < inputs->stations; station++, i++) {
            double begin = (double)cycle / (double)dynamics_span(inputs), dmf;
            double phase = begin + dynamics_station_phase(inputs, station);
            view->look_up(view->self, phase, is_left(inputs, station), &dmf, &gap[i]);
            double share = dynamics_share(inputs, station, dmf * newton);
            force[i] = share * dmf * excitation->stiffness * excitation->length;
            gap[i] *= excitation->length;
        }
    dynamics_put_stations(force, inputs->stations, engagements * inputs->stations, inputs->back);
    dynamics_put_stations(gap, inputs->stations, engagements * inputs->stations, inputs->back);
    return FF_OK;
}

/* Returns the maximum of the parabola through three equally spaced points, or the largest point if
   the maximum is outside them. */
static double top_of(const double force[3])
{
    double rise = (force[2] - force[0]) / 2, bend = force[1] - (force[0] + force[2]) / 2;
    double top = fmax(fmax(force[0], force[1]), force[2]);
    return fabs(rise) < 2 * bend ? fmax(top, force[1] + rise * rise / (4 * bend)) : top;
}

/* The tooth force between stations, in units of the excitation's force. */
typedef struct dynamics_between {
    double largest;
    double beyond; /* largest amount by which the force half-way between two stations is outside the
                      range of both */
} dynamics_between;

/* Samples the tooth force on `parts` times the stations; `newton` is the unit of force. */
static dynamics_between look_between(const dynamics_motion_view *view, double newton,
                                     const dynamics_inputs *inputs, size_t parts)
{
    dynamics_between found = {0, 0};
    for (size_t cycle = 0; cycle < view->cycles * dynamics_span(inputs); cycle++)
        for (size_t j = 0; j < (inputs->stations - 1) * parts; j++) {
            size_t i = j / parts;
            double from = (double)(j % parts) / (double)parts, part = 1 / (double)parts;
            double begin = dynamics_station_phase(inputs, i),
                   way = dynamics_station_phase(inputs, i + 1) - begin, gap, force[3];
            if (way < 1e-12)
                continue;
            for (int k = 0; k < 3; k++) {
                double at = from + 0.5 * k * part;
                view->look_up(view->self,
                              (double)cycle / (double)dynamics_span(inputs) + begin + at * way,
                              k == 2, &force[k], &gap);
                double share = dynamics_share(inputs, i, force[k] * newton);
                double next = dynamics_share(inputs, i + 1, force[k] * newton);
                force[k] *= share + at * (next - share);
            }
            double high = fmax(force[0], force[2]), low = fmin(force[0], force[2]);
            found.beyond = fmax(found.beyond, fmax(force[1] - high, low - force[1]));
            found.largest = fmax(found.largest, top_of(force));
        }
    return found;
}

/* Largest factor by which the number of stations is multiplied. */
enum { MOST_PARTS = 27 };

/* Returns the number of stations that resolve the motion. Two, three, five and more times the
   number of stations are tried, and the tooth force between the stations is checked; with too few
   stations a vibration has turning points between two stations that are not noticed. Returns 0 if
   more than MOST_PARTS times as many stations are needed. */
static double enough_stations(const dynamics_motion_view *view, double newton,
                              const dynamics_inputs *inputs, double limit)
{
    size_t parts = 1;
    dynamics_between found;
    do {
        parts += (parts + 1) / 2;
        found = look_between(view, newton, inputs, parts);
    } while (found.beyond > limit * found.largest && parts < MOST_PARTS);
    return found.beyond > limit * found.largest ? 0 : (double)(inputs->stations * parts);
}

/* Reports how much of the tooth force the stations miss at a turning point. A vibration whose phase
   advances by the angle w between two stations exceeds the range of both by 1 - cos(w/2) of its
   amplitude, and a monotone cubic cuts off this part. The relative error of the Hertz pressure is
   half as large. A jump between stations becomes a ramp: for instance, the damper force jumps at a
   corner of the transmission error. */
static void report_sampling(const dynamics_motion_view *view, double newton,
                            const dynamics_between *found, const dynamics_inputs *inputs,
                            const ff_host *host)
{
    const double limit = 0.02;
    double error = found->largest > 0 ? found->beyond / found->largest : 0;
    char more[96] = "", text[240];
    double enough = error > limit ? enough_stations(view, newton, inputs, limit) : 0;
    if (enough > 0)
        snprintf(more, sizeof more,
                 "; with %.0f or more stations of the gear the vibration is "
                 "resolved",
                 100 * ceil(enough / 100));
    else if (error > limit)
        snprintf(more, sizeof more,
                 "; more than %d times as many stations of the gear are needed to resolve the "
                 "vibration",
                 MOST_PARTS);
    snprintf(text, sizeof text,
             "largest amount by which the tooth force half-way between two stations of the gear "
             "is outside the range of both, over the largest tooth force%s",
             more);
    host->quality(host->ctx, "station_sampling", error, limit,
                  error <= limit ? FF_GOOD : FF_DOUBTFUL, text);
}

static double largest_static(const dynamics_inputs *inputs)
{
    double largest = 0;
    for (size_t i = 0; i < inputs->stations; i++)
        largest = fmax(largest, inputs->tooth_force[i]);
    return largest;
}

ff_status dynamics_motion_view_put(const dynamics_motion_view *view, const dynamics_statistics *st,
                                   const dynamics_excitation *excitation,
                                   const dynamics_inputs *inputs, const ff_host *host)
{
    static const uint64_t of_stations = FF_BIT(DYNAMICS_OUT_TOOTH_FORCE) |
                                        FF_BIT(DYNAMICS_OUT_GAP) |
                                        FF_BIT(DYNAMICS_OUT_DYNAMIC_FACTOR_TOOTH);
    const double newton = excitation->stiffness * excitation->length, side = inputs->back ? -1 : 1;
    double time = (double)view->cycles * view->T, quasi_static = largest_static(inputs);
    dynamics_between between = {0, 0};
    ff_status status = put_engagements(view, excitation, inputs, host);
    dynamics_back_flank_line(host, inputs, excitation, fmin(view->back / time, 1));
    const int looked = (inputs->wanted & of_stations) != 0;
    if (looked) {
        between = look_between(view, newton, inputs, 1);
        report_sampling(view, newton, &between, inputs, host);
    }
    dynamics_sharing_report(inputs, excitation->on_chord, st->least_force * newton,
                            st->force * newton, host);
    /* NaN: the largest tooth force was not computed */
    double tooth = looked ? between.largest * newton : NAN;
    const struct {
        uint32_t output;
        double value;
    } scalars[] = {
        {DYNAMICS_OUT_DTE_RMS, st->rms * excitation->length},
        {DYNAMICS_OUT_DTE_MEAN, side * st->mean * excitation->length},
        {DYNAMICS_OUT_DTE_PEAK_TO_PEAK, (st->high - st->low) * excitation->length},
        {DYNAMICS_OUT_DYNAMIC_FACTOR_TOOTH, quasi_static > 0 ? tooth / quasi_static : 0},
        {DYNAMICS_OUT_DYNAMIC_FACTOR_MESH, excitation->load > 0 ? st->force / excitation->load : 0},
        {DYNAMICS_OUT_CONTACT_LOSS, fmin(view->parted / time, 1)},
        {DYNAMICS_OUT_BACK_CONTACT, fmin(view->back / time, 1)},
        {DYNAMICS_OUT_NATURAL_FREQUENCY, inputs->natural_frequency},
        {DYNAMICS_OUT_PERIOD,
         view->period > 0 ? view->period * (double)dynamics_span(inputs) : view->period},
    };
    for (size_t i = 0; i < sizeof scalars / sizeof scalars[0] && status == FF_OK; i++)
        status = ff_put_scalar(host, scalars[i].output, scalars[i].value);
    return status;
}
