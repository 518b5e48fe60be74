/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "full-contact.h"

#include "../excitation/spring.h"
#include "oscillator.h"

#include <math.h>

/* Finds the fixed point of the affine map y -> y0' + M (y - y0) of one mesh cycle, which takes y0
   to y0', by solving (1 - M) (y - y0) = y0' - y0. Returns 0 if the fixed point is unstable or does
   not exist. */
static int fixed_point(const double *after, double *delta, double *rate)
{
    double a = 1 - after[DYNAMICS_M11], b = -after[DYNAMICS_M12], c = -after[DYNAMICS_M21],
           d = 1 - after[DYNAMICS_M22];
    double trace = after[DYNAMICS_M11] + after[DYNAMICS_M22];
    double det =
        after[DYNAMICS_M11] * after[DYNAMICS_M22] - after[DYNAMICS_M12] * after[DYNAMICS_M21];
    double r1 = after[DYNAMICS_DELTA] - *delta, r2 = after[DYNAMICS_RATE] - *rate,
           scale = a * d - b * c;
    *delta += (d * r1 - b * r2) / scale;
    *rate += (a * r2 - c * r1) / scale;
    return fabs(trace) < 1 + det && det < 1 && isfinite(*delta) && isfinite(*rate);
}

/* Returns whether the flanks of the pair with backlash touch during the whole mesh cycle that
   starts at this state. */
static ff_status stays_in_contact(const dynamics_excitation *excitation, double T, double tolerance,
                                  double delta, double rate)
{
    dynamics_oscillator *o = dynamics_oscillator_new(excitation, tolerance, 1, DYNAMICS_MOTION);
    int touches = 0;
    if (!o)
        return FF_NOMEM;
    if (delta > excitation->half_gap) {
        dynamics_oscillator_start(o, T, delta, rate);
        dynamics_clocks clocks;
        touches = dynamics_oscillator_cycle(o, T, NULL);
        clocks = dynamics_oscillator_clocks(o);
        touches = touches && clocks.parted == 0 && clocks.back == 0;
    }
    dynamics_oscillator_free(o);
    return touches ? FF_OK : FF_NOCONV;
}

/* Applies Newton's method to the return map of the pair without a gap. With a linear spring the map
   is affine, and one step finds its fixed point. With a piecewise linear spring the iteration ends
   when the motion passes through the same bands as before. Returns 0 if the fixed point is unstable
   or does not exist. */
static int find_fixed_point(dynamics_oscillator *o, const dynamics_excitation *closed, double T,
                            double tolerance, double *delta, double *rate)
{
    enum { MAX_STEPS = 30 };
    int bends = dynamics_spring_bends(closed->pieces);
    for (int i = 0; i < (bends ? MAX_STEPS : 1); i++) {
        double from[2] = {*delta, *rate};
        dynamics_oscillator_start(o, T, *delta, *rate);
        if (!dynamics_oscillator_cycle(o, T, NULL))
            return 0;
        int found = fixed_point(dynamics_oscillator_state(o), delta, rate);
        double moved = hypot(*delta - from[0], *rate - from[1]);
        if (!bends || !isfinite(moved))
            return found;
        if (moved <= 10 * tolerance * hypot(*delta, *rate))
            return found;
    }
    return 0;
}

ff_status dynamics_full_contact(const dynamics_excitation *excitation, double T, double tolerance,
                                double *delta, double *rate)
{
    dynamics_excitation closed = *excitation; /* the same springs without a gap */
    closed.half_gap = 0;
    dynamics_oscillator *o =
        dynamics_oscillator_new(&closed, tolerance, 1, DYNAMICS_MOTION_AND_VARIATION);
    if (!o)
        return FF_NOMEM;
    *delta = dynamics_rest_deflection(&closed);
    *rate = 0;
    int found = find_fixed_point(o, &closed, T, tolerance, delta, rate);
    *delta += excitation->half_gap;
    dynamics_oscillator_free(o);
    return found ? stays_in_contact(excitation, T, tolerance, *delta, *rate) : FF_NOCONV;
}
