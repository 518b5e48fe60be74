/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "offer.h"

const ff_port conformance_outputs[1] = {{.name = "conformance",
                                         .unit = "",
                                         .doc = "checks of one kind of model",
                                         .dims = "",
                                         .service = FF_CONFORMANCE_ID}};

ff_status conformance_create(const ff_host *host, void **self)
{
    (void)host;
    *self = NULL;
    return FF_OK;
}

const void *conformance_service(void *self, uint32_t output)
{
    (void)self, (void)output;
    return &conformance_offer;
}

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &conformance_model;
}
