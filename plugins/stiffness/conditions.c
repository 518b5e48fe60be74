/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the inputs of mesh stiffness models, and the parameter mesh_cycle. */
#include "conditions.h"

#include <flankfilm/author.h>

/* The value is a number or one of the words `worst` and `all`. */
stiffness_mesh_cycles stiffness_mesh_cycles_set(const ff_value *value)
{
    if (!value->text)
        return (stiffness_mesh_cycles){.number = (size_t)value->integer};
    return (stiffness_mesh_cycles){.which = value->text[0] == 'w' ? STIFFNESS_CYCLE_WORST
                                                                  : STIFFNESS_CYCLE_ALL};
}

static ff_status check_cycle(const ff_host *host, const stiffness_deviations *d, size_t cycle)
{
    size_t period = stiffness_hunting_period(d);
    if (cycle == 0 || cycle < period)
        return FF_OK;
    return ff_failf(host, FF_INVALID, "mesh_cycle",
                    "the same teeth meet again after %zu mesh cycles: the last mesh cycle is "
                    "number %zu, not %zu",
                    period, period - 1, cycle);
}

ff_status stiffness_conditions_read(const ff_host *host, const ff_array *in, const ff_reals *rim,
                                    stiffness_mesh_cycles cycles, stiffness_conditions *conditions)
{
    ff_status status = stiffness_path_read(host, in, &conditions->path);
    if (status == FF_OK)
        status = stiffness_deviations_read(host, in, &conditions->deviations);
    if (status == FF_OK)
        status = stiffness_deviations_read_back(host, in, &conditions->deviations,
                                                &conditions->back, &conditions->same_back);
    if (status == FF_OK)
        status = check_cycle(host, &conditions->deviations, cycles.number);
    return status == FF_OK
               ? stiffness_gears_read(host, in, &conditions->path, rim, &conditions->gears)
               : status;
}
