/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "periodicity.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

const double dynamics_chaotic_growth = 1e-3;

/* Returns a bound on the error of the state due to round-off. Each step has at most one rounding
   error, and the fixed point moves by (M - 1)^-1 times the error of the return map. */
static double state_error(const dynamics_orbit *o)
{
    double steps = o->period * (dynamics_cycle_duration(o->lambda) + 10);
    double size = 1 + fabs(o->m[0]) + fabs(o->m[1]) + fabs(o->m[2]) + fabs(o->m[3]);
    double det = fabs(dynamics_fold_test(o));
    return det > 0 ? fmin(2e-16 * steps * size / det, 1) : 1;
}

static void report_line(const ff_host *host, const char *name, double value, double limit,
                        const char *text)
{
    host->quality(host->ctx, name, value, limit, value <= limit ? FF_GOOD : FF_DOUBTFUL, text);
}

static void report_aperiodic(const dynamics_attractor *a, const dynamics_excitation *excitation,
                             int max_period, const ff_host *host)
{
    const double zeta = excitation->zeta, span = fmax(excitation->span, 1);
    char text[320];
    if (a->period == DYNAMICS_UNBOUNDED) {
        host->quality(host->ctx, "periodicity", 1, 0, FF_BAD,
                      "the motion grows without bound; shown is the mesh cycle before it "
                      "exceeded 1000 times the sum of half backlash and static deflection");
        return;
    }
    if (zeta < 2e-3)
        snprintf(
            text, sizeof text,
            "with so little damping no motion settles, and the periodic motion at a damping ratio "
            "of 0.002 could not be continued down to %g; the motion shown depends on its start",
            zeta);
    else if (a->growth > dynamics_chaotic_growth) {
        dynamics_chaos_line(exp(a->growth / span), host);
        return;
    } else
        snprintf(text, sizeof text,
                 "the motion did not repeat within %g mesh cycles after %g mesh cycles of "
                 "settling: its period is longer, or it needs a larger cycles_settle",
                 max_period * span, (double)a->cycles * span);
    host->quality(host->ctx, "periodicity", 1, 0, FF_DOUBTFUL, text);
}

/* Returns the round-off error of det M. A mesh cycle takes at most as many steps as it has pieces,
   plus twice its length in radians. The relative error of the determinant of a step is about
   DBL_EPSILON. The relative error of the time t is half as large, and exp(-2 zeta t) magnifies it
   by 2 zeta t. */
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
        report_aperiodic(a, excitation, max_period, host);
    } else {
        double largest = dynamics_largest_multiplier(&a->orbit);
        report_line(host, "periodicity", dynamics_orbit_residual(excitation, &a->orbit), 1e-10,
                    "distance between the states at the start and the end of the period, over the "
                    "size of the motion");
        report_line(host, "stability", largest, dynamics_stable_multiplier,
                    largest < 1 ? NULL
                                : "largest Floquet multiplier: a disturbance of this motion "
                                  "does not decay");
        report_line(host, "state_error", state_error(&a->orbit), 1e-6,
                    "round-off error of the state, over the static deflection");
    }
    report_line(host, "energy_balance", motion->energy_error, 1e-9, NULL);
    if (!excitation->film)
        report_line(host, "determinant", motion->det_error, round_off_of_determinant(motion),
                    "relative difference between the determinant of the monodromy and exp(-2 zeta "
                    "omega t), with the time t in which the damper acts");
}
