/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "assess.h"

#include "motion.h"

#include <math.h>

/* Coarse steps are enough to tell which motion the branch leads to. */
static const double settle_tolerance = 1e-4, step_tolerance = 1e-7;

/* Mesh cycles over which the growth of a disturbance tells chaos. */
enum { CYCLES = 64 };

/* Whether a small disturbance of the motion grows without end. */
static ff_status is_chaotic(const dynamics_excitation *excitation, const dynamics_inputs *inputs,
                            double T, const dynamics_settled *settled, int *answer)
{
    dynamics_motion motion = {.excitation = excitation, .T = T, .cycles = CYCLES};
    double multipliers[4];
    ff_status status =
        dynamics_motion_record(&motion, inputs, step_tolerance, 16, settled->delta, settled->rate);
    *answer = status == FF_OK &&
              dynamics_motion_multipliers(&motion, multipliers) > dynamics_chaotic_disturbance;
    dynamics_record_free(&motion.record);
    return status;
}

/* Does not apply, or is ambiguous, where the motion does not repeat itself. A mesh cycle lasts T.
 */
static ff_status assess_repetition(const dynamics_assessment *estimate, const ff_host *host,
                                   const dynamics_inputs *inputs,
                                   const dynamics_excitation *excitation, double T,
                                   ff_assessment *a)
{
    dynamics_settled settled;
    dynamics_settling how = {.branch = estimate->branch,
                             .T = T,
                             .tolerance = settle_tolerance,
                             .step_tolerance = step_tolerance,
                             .host = host};
    if (estimate->from && estimate->from->mesh_frequency > 0) {
        how.from = estimate->from->mesh_frequency / inputs->natural_frequency;
        dynamics_warm_start_state(estimate->from, excitation, how.start);
    }
    dynamics_oscillator *o =
        dynamics_oscillator_new(excitation, step_tolerance, 1, DYNAMICS_MOTION);
    ff_status status = o ? dynamics_settle(o, excitation, &how, &settled) : FF_NOMEM;
    int chaotic = 0;
    if (status == FF_OK && settled.period == DYNAMICS_APERIODIC && excitation->zeta > 0)
        status = is_chaotic(excitation, inputs, T, &settled, &chaotic);
    dynamics_oscillator_free(o);
    if (status == FF_NOCONV) {
        a->applies = FF_APPLIES_NOT;
        a->reason = "the vibration takes too many steps to tell whether it repeats itself";
        return FF_OK;
    }
    if (status != FF_OK || (settled.period == 1 || (settled.period > 1 && !estimate->one_cycle)))
        return status;
    a->applies = chaotic ? FF_AMBIGUOUS : FF_APPLIES_NOT;
    a->reason =
        chaotic ? "chaos: the motion never repeats itself and small disturbances of it grow, so "
                  "that what is shown depends on its start"
        : settled.period > 1 ? "the motion lasts several mesh cycles, the model knows one"
        : settled.period == DYNAMICS_UNBOUNDED ? "the motion grows without bound"
                                               : "the motion does not settle";
    return FF_OK;
}

ff_status dynamics_assess(const dynamics_assessment *estimate, const ff_host *host,
                          const ff_array *in, const dynamics_inertia *inertia,
                          dynamics_excitation excitation, ff_assessment *a)
{
    dynamics_inputs inputs;
    ff_status status = dynamics_inputs_read(host, in, inertia, &inputs, &excitation);
    if (status == FF_OK) {
        double cycle = 2 * acos(-1) * inputs.natural_frequency / inputs.mesh_frequency;
        a->applies = cycle > estimate->longest ? FF_APPLIES_NOT : FF_APPLIES;
        a->error = estimate->error;
        a->cost = estimate->cost;
        a->reason = a->applies == FF_APPLIES ? estimate->reason
                                             : "a mesh cycle is too long to follow every vibration";
        if (a->applies == FF_APPLIES)
            status = assess_repetition(estimate, host, &inputs, &excitation, cycle, a);
    }
    dynamics_excitation_free(&excitation);
    return status;
}
