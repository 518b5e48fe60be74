/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "periodicity.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

const double dynamics_chaotic_growth = 1e-3;

/* Largest error of the state for errors of the return of round-off size: |(M - 1)^-1|, and as many
   roundings as steps. */
static double state_error(const dynamics_orbit *o)
{
    double steps = o->period * (dynamics_cycle_duration(o->lambda) + 10);
    double size = 1 + fabs(o->m[0]) + fabs(o->m[1]) + fabs(o->m[2]) + fabs(o->m[3]);
    double det = fabs(dynamics_fold_test(o));
    return det > 0 ? fmin(2e-16 * steps * size / det, 1) : 1;
}

static void say(const ff_host *host, const char *name, double value, double limit, const char *text)
{
    host->quality(host->ctx, name, value, limit, value <= limit ? FF_GOOD : FF_DOUBTFUL, text);
}

static void report_aperiodic(const dynamics_attractor *a, double zeta, int max_period,
                             const ff_host *host)
{
    char text[320];
    if (a->period == DYNAMICS_UNBOUNDED) {
        host->quality(host->ctx, "periodicity", 1, 0, FF_BAD,
                      "the motion grows without bound; what is shown is the mesh cycle before it "
                      "passed 1000 times half backlash and static deflection");
        return;
    }
    if (zeta < 2e-3)
        snprintf(
            text, sizeof text,
            "with so little damping no motion settles, and the periodic one at a damping ratio "
            "of 0.002 does not go on down to %g; what is shown depends on the start",
            zeta);
    else if (a->growth > dynamics_chaotic_growth) {
        dynamics_chaos_line(exp(a->growth), host);
        return;
    } else
        snprintf(
            text, sizeof text,
            "the motion did not repeat itself within %d mesh cycles after %zu of them: a longer "
            "period, or it needs more cycles_settle",
            max_period, a->cycles);
    host->quality(host->ctx, "periodicity", 1, 0, FF_DOUBTFUL, text);
}

/*
 * What rounding alone may make of det M over all steps, of which there are no more than pieces of a
 * mesh cycle and twice its radians: some units of DBL_EPSILON in the determinant of each, and half
 * of one in the time that a step adds to, of which exp(-2 zeta t) makes 2 zeta t.
 */
static double round_off_of_determinant(const dynamics_motion *motion)
{
    const double each = 16;
    const dynamics_excitation *excitation = motion->excitation;
    double steps = (double)motion->cycles *
                   ((double)excitation->count + 2 * motion->T / dynamics_taylor_longest_step);
    double time = (double)motion->cycles * motion->T;
    return DBL_EPSILON * steps * (each + excitation->zeta * time);
}

void dynamics_periodicity_report(const dynamics_attractor *a, const dynamics_motion *motion,
                                 int max_period, const ff_host *host)
{
    const dynamics_excitation *excitation = motion->excitation;
    if (a->period < 1) {
        report_aperiodic(a, excitation->zeta, max_period, host);
    } else {
        double largest = dynamics_largest_multiplier(&a->orbit);
        say(host, "periodicity", dynamics_orbit_residual(excitation, &a->orbit), 1e-10,
            "distance by which the motion misses its start, over its size");
        say(host, "stability", largest, 1 + 1e-9,
            largest < 1 ? NULL : "a disturbance of this motion does not die out");
        say(host, "state_error", state_error(&a->orbit), 1e-6,
            "round-off carried into the state, over the static deflection");
    }
    say(host, "energy_balance", motion->energy_error, 1e-9, NULL);
    say(host, "determinant", motion->det_error, round_off_of_determinant(motion),
        "of the monodromy, against exp(-2 zeta omega t) while the damper acts");
}
