/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of rest of gears without load, in the backlash. */
#include "motion.h"

#include <math.h>

/* Every position in the backlash is an equilibrium, and the gears stay where a disturbance has
   moved them. Therefore one Floquet multiplier is 1; the other follows from the damper. */
ff_status dynamics_motion_put_floating(const dynamics_inputs *inputs,
                                       const dynamics_excitation *excitation, const ff_host *host)
{
    dynamics_excitation still = *excitation;
    dynamics_motion motion = {.excitation = &still,
                              .period = 1,
                              .cycles = 1,
                              .T = 2 * M_PI * inputs->natural_frequency / inputs->mesh_frequency};
    const size_t cycles = 1 + dynamics_mesh_cycles_of_engagement(inputs);
    const int damped = excitation->damping == DYNAMICS_DAMPING_ALWAYS;
    if (!dynamics_record_init(&motion.record, &still, 1, cycles))
        return FF_NOMEM;
    for (size_t i = 0; i <= cycles; i++)
        motion.record.samples[i] = (dynamics_sample){.phase = (double)i};
    motion.record.count = cycles + 1;
    motion.monodromy[0] = 1;
    motion.monodromy[3] = damped ? exp(-2 * excitation->zeta * motion.T) : 1;
    motion.clocks.parted = motion.T;
    still.zeta = 0; /* without contact the damper must not follow the transmission error */
    still.film = NULL;
    dynamics_floating_line(host);
    ff_status status = dynamics_motion_put(&motion, inputs, host);
    dynamics_record_free(&motion.record);
    return status;
}
