/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "full-contact.h"

#include "oscillator.h"

#include <math.h>

/* Fixed point y of the affine map y0 -> y0' + M (y - y0) of one mesh cycle; 0: not stable. */
static int fixed_point(const double *after, double *delta, double *rate)
{
    double a = 1 - after[FF_M11], b = -after[FF_M12], c = -after[FF_M21], d = 1 - after[FF_M22];
    double trace = after[FF_M11] + after[FF_M22];
    double det = after[FF_M11] * after[FF_M22] - after[FF_M12] * after[FF_M21];
    if (!(fabs(trace) < 1 + det && det < 1))
        return 0;
    double r1 = after[FF_DELTA] - *delta, r2 = after[FF_RATE] - *rate, scale = a * d - b * c;
    *delta += (d * r1 - b * r2) / scale;
    *rate += (a * r2 - c * r1) / scale;
    return isfinite(*delta) && isfinite(*rate);
}

/* The flanks of the true pair touch all along the cycle that starts there. */
static int stays_in_contact(const ff_mesh *mesh, double T, double tolerance, double delta,
                            double rate)
{
    ff_oscillator *o = ff_oscillator_new(mesh, tolerance, 1, FF_MOTION);
    int touches = 0;
    if (o && delta > mesh->half_gap) {
        ff_oscillator_start(o, T, delta, rate);
        ff_clocks clocks;
        touches = ff_oscillator_cycle(o, T, NULL);
        clocks = ff_oscillator_clocks(o);
        touches = touches && clocks.parted == 0 && clocks.back == 0;
    }
    ff_oscillator_free(o);
    return touches;
}

int ff_full_contact(const ff_mesh *mesh, double T, double tolerance, double *delta, double *rate)
{
    ff_mesh closed = *mesh; /* the same springs without a gap */
    closed.half_gap = 0;
    ff_oscillator *o = ff_oscillator_new(&closed, tolerance, 1, FF_MOTION_AND_VARIATION);
    int found = 0;
    if (o) {
        double k = mesh->pieces[0].k > 0 ? mesh->pieces[0].k : 1;
        *delta = mesh->load / k;
        *rate = 0;
        ff_oscillator_start(o, T, *delta, *rate);
        found = ff_oscillator_cycle(o, T, NULL) && fixed_point(ff_oscillator_state(o), delta, rate);
        *delta += mesh->half_gap;
    }
    ff_oscillator_free(o);
    return found && stays_in_contact(mesh, T, tolerance, *delta, *rate);
}
