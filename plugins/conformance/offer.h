/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by all conformance plugins. Such a plugin defines conformance_offer and, by the macro, its
   descriptor. It is built with offer.c. */
#ifndef OFFER_H
#define OFFER_H

#include <flankfilm/author.h>
#include <flankfilm/conformance.h>

extern const ff_conformance conformance_offer;
extern const ff_model conformance_model;

extern const ff_port conformance_outputs[1];
ff_status conformance_create(const ff_host *host, void **self);
const void *conformance_service(void *self, uint32_t output);

#define CONFORMANCE_MODEL(kind, text, literature)                                                  \
    const ff_model conformance_model = {.size = sizeof(ff_model),                                  \
                                        .abi_major = FF_ABI_MAJOR,                                 \
                                        .id = "conformance/" kind,                                 \
                                        .version = "1.0.0",                                        \
                                        .summary = text,                                           \
                                        .reference = literature,                                   \
                                        .bibtex = "",                                              \
                                        .licence = "GPL-3.0-or-later",                             \
                                        .outputs = FF_TABLE(conformance_outputs),                  \
                                        .create = conformance_create,                              \
                                        .service = conformance_service}

#endif
