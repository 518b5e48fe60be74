/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "law.h"

#include <stdlib.h>

const ff_port rheology_law_outputs[1] = {
    {.name = "rheology", .unit = "", .doc = "the law", .dims = "", .service = FF_RHEOLOGY_ID}};

ff_status rheology_law_create(size_t size, double cost, rheology_flow *flow, rheology_shear *shear,
                              void **self)
{
    rheology_law *law = calloc(1, size);
    if (!law)
        return FF_NOMEM;
    law->service =
        (ff_rheology){.size = sizeof law->service, .self = law, .flow = flow, .shear = shear};
    law->cost = cost;
    *self = law;
    return FF_OK;
}

const void *rheology_law_service(void *self, uint32_t output)
{
    const rheology_law *law = self;
    (void)output;
    return &law->service;
}

ff_status rheology_law_assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                              ff_assessment *assessment)
{
    const rheology_law *law = self;
    (void)wanted;
    (void)accuracy;
    (void)in;
    return ff_assess_law(law->cost, "", assessment);
}
