/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "lambda.h"

#include "assess.h"

#include <flankfilm/author.h>

#include <math.h>

ff_status ehl_combined_roughness(const ff_host *host, const ff_array *gear, const ff_array *rq_1,
                                 const ff_array *rq_2, double *rq)
{
    *rq = 0;
    if (rq_1->data || rq_2->data) {
        *rq = hypot(rq_1->data ? *rq_1->data : 0, rq_2->data ? *rq_2->data : 0);
        if (!isfinite(*rq))
            return ff_failf(host, FF_INVALID, "surface.rq_1",
                            "the roughness is not a finite length");
        return FF_OK;
    }
    if (!gear->data)
        return FF_OK;
    if (gear->shape[0] != 2)
        return ff_failf(host, FF_INVALID, "gear.roughness", "two values are needed, not %zu",
                        gear->shape[0]);
    for (int i = 0; i < 2; i++)
        if (!(gear->data[i] >= 0 && isfinite(gear->data[i])))
            return ff_failf(host, FF_INVALID, "gear.roughness",
                            "the roughness of gear %d is not a usable length", i + 1);
    *rq = hypot(gear->data[0], gear->data[1]);
    return FF_OK;
}

ff_status ehl_lambda_check(const ff_host *host, uint64_t wanted, uint32_t output, const char *name,
                           double rq)
{
    if (!(wanted & FF_BIT(output)) || rq > 0)
        return FF_OK;
    return ff_failf(host, FF_UNSUPPORTED, name,
                    "this output needs the roughness of the flanks: give roughness_rq or "
                    "roughness_ra to the gear stage, or wire a surface that is not flat");
}

void ehl_lambda_report(const ff_host *host, double lowest)
{
    host->quality(host->ctx, "lambda", lowest, EHL_MIXED_BELOW,
                  lowest < EHL_MIXED_BELOW ? FF_DOUBTFUL : FF_GOOD,
                  "lowest film over the roughness of the flanks, which this smooth film does not "
                  "feel; below 3 asperities touch: add a stage of the kind surface");
}
