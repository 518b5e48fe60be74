/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "claim.h"

#include <math.h>

ff_status ff_claim_put(const ff_claim *claim, const ff_host *host, const ff_array *in,
                       const ff_inertia *inertia, ff_mesh mesh, ff_assessment *a)
{
    ff_inputs inputs;
    ff_status status = ff_inputs_read(host, in, inertia, &inputs, &mesh);
    ff_mesh_free(&mesh);
    if (status != FF_OK)
        return status;
    double cycle = 2 * acos(-1) * inputs.natural_frequency / inputs.mesh_frequency;
    a->applies = cycle > claim->longest ? FF_APPLIES_NOT : FF_APPLIES;
    a->error = claim->error;
    a->cost = claim->cost;
    a->reason = a->applies == FF_APPLIES ? claim->reason
                                         : "a mesh cycle is too long to follow every vibration";
    return FF_OK;
}
