/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The model around a printer. */
#include "print.h"

static ff_status create(const ff_host *host, void **self)
{
    (void)host;
    *self = NULL;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    static const ff_catalogue_printer printer = {.size = sizeof printer, .print = catalogue_print};
    (void)self, (void)output;
    return &printer;
}

static const ff_port outputs[] = {{.name = "catalogue",
                                   .unit = "",
                                   .doc = "prints what the tables of models say",
                                   .dims = "",
                                   .service = FF_CATALOGUE_ID}};

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 1,
    .id = catalogue_id,
    .version = "1.0.0",
    .summary = catalogue_summary,
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_NO_TABLE,
    .inputs = FF_NO_TABLE,
    .outputs = FF_TABLE(outputs),
    .create = create,
    .service = service,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
