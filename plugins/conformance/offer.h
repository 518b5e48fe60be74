/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every model of this kind offers. */
#ifndef OFFER_H
#define OFFER_H

#include <flankfilm/conformance.h>

static const ff_port offer_outputs[] = {{.name = "conformance",
                                         .unit = "",
                                         .doc = "checks of one kind of model",
                                         .dims = "",
                                         .service = FF_CONFORMANCE_ID}};

static ff_status offer_create(const ff_host *host, void **self)
{
    (void)host;
    *self = NULL;
    return FF_OK;
}

#endif
