/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "law.h"

#include <stdlib.h>

const ff_port density_law_outputs[1] = {
    {.name = "density", .unit = "", .doc = "the law", .dims = "", .service = FF_DENSITY_ID}};

ff_status density_law_create(size_t size, double cost, density_eval *eval, void **self)
{
    density_law *law = calloc(1, size);
    if (!law)
        return FF_NOMEM;
    law->service = (ff_density){.size = sizeof law->service, .self = law, .eval = eval};
    law->cost = cost;
    *self = law;
    return FF_OK;
}

const void *density_law_service(void *self, uint32_t output)
{
    const density_law *law = self;
    (void)output;
    return &law->service;
}

ff_status density_law_assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                             ff_assessment *assessment)
{
    const density_law *law = self;
    (void)wanted;
    (void)accuracy;
    (void)in;
    return ff_assess_law(law->cost, "", assessment);
}
