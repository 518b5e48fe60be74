/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "landings.h"

#include <flankfilm/author.h>

#include <math.h>

static double gap_at(const dynamics_motion_view *view, double phase, int left)
{
    double force, gap;
    view->look_up(view->self, phase, left, &force, &gap);
    return gap;
}

/* The interval between two neighbouring samples. If the excitation jumps at one of the samples, the
   gap has another value outside the interval. */
typedef struct interval {
    const dynamics_motion_view *view;
    double from, to;
} interval;

static double gap_inside(const interval *x, double phase)
{
    return gap_at(x->view, phase, phase > 0.5 * (x->from + x->to));
}

/* Returns the phase at which the gap closes in the interval, by bisection. */
static double closing_phase(const interval *x)
{
    enum { HALVINGS = 60 };
    double low = x->from, high = x->to;
    for (int i = 0; i < HALVINGS && high > low; i++) {
        double middle = low + 0.5 * (high - low);
        *(gap_inside(x, middle) > 0 ? &low : &high) = middle;
    }
    return high;
}

/* Returns the speed at which the gap closes at a phase, from the parabola through the gap there and
   at two earlier phases. */
static double closing_speed(const interval *x, double phase)
{
    static const double share = 1e-3; /* step, as a share of the interval */
    double h = fmin(share * (x->to - x->from), 0.5 * (phase - x->from));
    h = fmax(h, 1e-9 * (x->to - x->from));
    double earlier = 4 * gap_inside(x, phase - h) - gap_inside(x, phase - 2 * h);
    return (earlier - 3 * gap_inside(x, phase)) / (2 * h * x->view->T);
}

static void add_landing(const interval *x, double at, size_t *found, double *phase, double *speed)
{
    if (phase) {
        phase[*found] = at;
        speed[*found] = closing_speed(x, at);
    }
    ++*found;
}

/* Finds the landings of the motion that is shown. `phase` and `speed` may be NULL. A jump of the
   excitation may close the gap; the flanks then meet with the speed before the jump. */
static size_t list_landings(const dynamics_motion_view *view, double *phase, double *speed)
{
    size_t count = dynamics_motion_view_count(view), found = 0;
    for (size_t i = 1; i < count; i++) {
        interval x = {view, dynamics_motion_view_phase(view, i - 1),
                      dynamics_motion_view_phase(view, i)};
        if (!(x.to > x.from))
            continue;
        double end = gap_at(view, x.to, 1);
        if (end <= 0 && gap_at(view, x.from, 0) > 0)
            add_landing(&x, phase ? closing_phase(&x) : 0, &found, phase, speed);
        else if (end > 0 && gap_at(view, x.to, 0) <= 0)
            add_landing(&x, x.to, &found, phase, speed);
    }
    return found;
}

ff_status dynamics_landings_put(const dynamics_motion_view *view,
                                const dynamics_excitation *excitation, uint32_t time_output,
                                uint32_t speed_output, const ff_host *host)
{
    size_t count = list_landings(view, NULL, NULL);
    double *time = ff_put_series(host, time_output, count);
    double *speed = ff_put_series(host, speed_output, count);
    if (count == 0)
        return FF_OK;
    if (!time || !speed)
        return FF_NOMEM;
    list_landings(view, time, speed);
    for (size_t i = 0; i < count; i++) {
        time[i] *= view->T / excitation->omega;
        speed[i] *= excitation->length * excitation->omega;
    }
    return FF_OK;
}
