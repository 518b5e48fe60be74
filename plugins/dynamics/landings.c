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

/* Between two samples of which the first has a gap and the second has none: the phase at which it
   closes, by halving, and the speed there, by the parabola through 0 and two earlier values. */
static void find_landing(const dynamics_motion_view *view, double from, double to, double *phase,
                         double *speed)
{
    enum { HALVINGS = 60 };
    static const double share = 1e-3; /* of the interval, over which the speed is measured */
    double low = from, high = to, h = share * (to - from);
    for (int i = 0; i < HALVINGS && high > low; i++) {
        double middle = low + 0.5 * (high - low);
        *(gap_at(view, middle, 1) > 0 ? &low : &high) = middle;
    }
    *phase = high;
    if (high - 2 * h < from) /* an interval that it crosses at once */
        h = fmax(0.5 * (high - from), 1e-9 * (to - from));
    *speed = (4 * gap_at(view, high - h, 1) - gap_at(view, high - 2 * h, 1)) / (2 * h * view->T);
}

/* The landings of the motion that is shown; `phase` and `speed` may be NULL. */
static size_t list_landings(const dynamics_motion_view *view, double *phase, double *speed)
{
    size_t count = dynamics_motion_view_count(view), found = 0;
    double before = gap_at(view, dynamics_motion_view_phase(view, 0), 0);
    for (size_t i = 1; i < count; i++) {
        double from = dynamics_motion_view_phase(view, i - 1);
        double to = dynamics_motion_view_phase(view, i), now = gap_at(view, to, to > from);
        if (before > 0 && now <= 0 && to > from) {
            if (phase)
                find_landing(view, from, to, &phase[found], &speed[found]);
            found++;
        }
        before = now;
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
