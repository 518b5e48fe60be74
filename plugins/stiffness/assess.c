/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "assess.h"

#include "inputs.h"
#include "outputs.h"

#include <flankfilm/author.h>

#include <math.h>

/* Smaller deviations of a flank, in m, count as none. */
static const double negligible_deviation = 1e-9;

static bool has_deviations(const ff_array *in)
{
    static const int rows[] = {STIFFNESS_IN_PROFILE_DEVIATION, STIFFNESS_IN_INDEX_1,
                               STIFFNESS_IN_INDEX_2};
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        const ff_array *a = &in[rows[k]];
        size_t count = a->data ? 1 : 0;
        for (uint32_t i = 0; a->data && i < a->rank; i++)
            count *= a->shape[i];
        for (size_t i = 0; i < count; i++)
            if (fabs(a->data[i]) > negligible_deviation)
                return true;
    }
    return false;
}

ff_status stiffness_assess(const stiffness_error_estimate *estimate, uint64_t wanted,
                           const ff_array *in, ff_assessment *a)
{
    static const uint64_t forces = FF_BIT(STIFFNESS_OUT_TOOTH_FORCE) |
                                   FF_BIT(STIFFNESS_OUT_LOAD_SHARE) |
                                   FF_BIT(STIFFNESS_OUT_ENGAGEMENT_FORCE),
                          stiffness = FF_BIT(STIFFNESS_OUT_STIFFNESS) | FF_BIT(STIFFNESS_OUT_MEAN) |
                                      FF_BIT(STIFFNESS_OUT_HARMONICS),
                          transmission = FF_BIT(STIFFNESS_OUT_LOADED_ERROR) |
                                         FF_BIT(STIFFNESS_OUT_ERROR) |
                                         FF_BIT(STIFFNESS_OUT_LOADED_RATIO) |
                                         FF_BIT(STIFFNESS_OUT_HUNTING_ERROR);
    double error = wanted & forces ? estimate->force : 0;
    if (wanted & stiffness)
        error = fmax(error, estimate->stiffness);
    if (wanted & transmission)
        error = fmax(error, estimate->transmission);
    a->applies = FF_APPLIES;
    a->error = (has_deviations(in) ? 2 : 1) * error;
    a->cost = estimate->cost;
    a->reason = estimate->reason;
    return FF_OK;
}
