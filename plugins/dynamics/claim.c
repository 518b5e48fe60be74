/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "claim.h"

#include "motion.h"

#include <math.h>

/* Which motion the branch leads to is settled here on coarse steps; how exactly is another matter.
 */
static const double settle_tolerance = 1e-4, step_tolerance = 1e-7;

/* Growth of a disturbance over mesh cycles that settling or the shear between neighbours does not
   reach, but chaos does. */
enum { CYCLES = 64 };
static const double chaos = 1e6;

/* Whether a small disturbance of the motion grows for ever. */
static ff_status is_chaotic(const dynamics_mesh *mesh, const dynamics_inputs *inputs, double T,
                            const dynamics_settled *settled, int *answer)
{
    dynamics_motion motion = {.mesh = mesh, .T = T, .cycles = CYCLES};
    double multipliers[4];
    ff_status status =
        dynamics_motion_record(&motion, inputs, step_tolerance, 16, settled->delta, settled->rate);
    *answer = status == FF_OK && dynamics_motion_multipliers(&motion, multipliers) > chaos;
    dynamics_record_free(&motion.record);
    return status;
}

/* Of a mesh cycle that lasts T. */
static ff_status look(const dynamics_claim *claim, const ff_host *host,
                      const dynamics_inputs *inputs, const dynamics_mesh *mesh, double T,
                      ff_assessment *a)
{
    dynamics_settled settled;
    dynamics_settling how = {.branch = claim->branch,
                             .T = T,
                             .tolerance = settle_tolerance,
                             .step_tolerance = step_tolerance,
                             .host = host};
    if (claim->from && claim->from->mesh_frequency > 0) {
        how.from = claim->from->mesh_frequency / inputs->natural_frequency;
        dynamics_carried_state(claim->from, mesh, how.start);
    }
    dynamics_oscillator *o = dynamics_oscillator_new(mesh, step_tolerance, 1, DYNAMICS_MOTION);
    ff_status status = o ? dynamics_settle(o, mesh, &how, &settled) : FF_NOMEM;
    int chaotic = 0;
    if (status == FF_OK && settled.period == DYNAMICS_APERIODIC && mesh->zeta > 0)
        status = is_chaotic(mesh, inputs, T, &settled, &chaotic);
    dynamics_oscillator_free(o);
    if (status == FF_NOCONV) {
        a->applies = FF_APPLIES_NOT;
        a->reason = "the vibration takes too many steps to tell whether it repeats itself";
        return FF_OK;
    }
    if (status != FF_OK || (settled.period == 1 || (settled.period > 1 && !claim->one_cycle)))
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

ff_status dynamics_claim_put(const dynamics_claim *claim, const ff_host *host, const ff_array *in,
                             const dynamics_inertia *inertia, dynamics_mesh mesh, ff_assessment *a)
{
    dynamics_inputs inputs;
    ff_status status = dynamics_inputs_read(host, in, inertia, &inputs, &mesh);
    if (status == FF_OK) {
        double cycle = 2 * acos(-1) * inputs.natural_frequency / inputs.mesh_frequency;
        a->applies = cycle > claim->longest ? FF_APPLIES_NOT : FF_APPLIES;
        a->error = claim->error;
        a->cost = claim->cost;
        a->reason = a->applies == FF_APPLIES ? claim->reason
                                             : "a mesh cycle is too long to follow every vibration";
        if (a->applies == FF_APPLIES)
            status = look(claim, host, &inputs, &mesh, cycle, a);
    }
    dynamics_mesh_free(&mesh);
    return status;
}
