/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What every plugin of this kind has alike. It defines the two below, and is built with offer.c. */
#ifndef OFFER_H
#define OFFER_H

#include <flankfilm/conformance.h>

extern const ff_conformance conformance_offer;
extern const ff_model conformance_model;

extern const ff_port conformance_outputs[1];
ff_status conformance_create(const ff_host *host, void **self);
const void *conformance_service(void *self, uint32_t output);

#endif
