/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters that a law replaces, one required, one with a preset, one of a required group; and one
   that a data input replaces. */
#include <flankfilm/author.h>

#include "toy.h"

#include <math.h>

typedef struct replaced {
    const ff_host *host;
    const toy_law *law;
    double gain, scale, near, far, offset;
} replaced;

static const ff_param params[] = {
    {.name = "gain",
     .unit = "1",
     .doc = "what the law says",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .place = FF_PLACE(replaced, gain, double),
     .instead = "law"},
    {.name = "scale",
     .unit = "1",
     .doc = "a factor",
     .type = FF_REAL,
     .preset = "2",
     .place = FF_PLACE(replaced, scale, double),
     .instead = "law"},
    {.name = "near",
     .unit = "m",
     .doc = "a length",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .group = "length",
     .place = FF_PLACE(replaced, near, double),
     .instead = "law"},
    {.name = "far",
     .unit = "m",
     .doc = "a length",
     .type = FF_REAL,
     .group = "length",
     .place = FF_PLACE(replaced, far, double),
     .instead = "law"},
    {.name = "offset",
     .unit = "m",
     .doc = "added to the gain",
     .type = FF_REAL,
     .preset = "0 m",
     .place = FF_PLACE(replaced, offset, double),
     .instead = "source.level"},
};

static const ff_port inputs[] = {
    {.name = "law",
     .unit = "",
     .doc = "in place of all parameters",
     .service = TOY_LAW_ID,
     .flags = FF_OPTIONAL,
     .from = "toy"},
    {.name = "source.level", .unit = "m", .doc = "the offset", .dims = "", .flags = FF_OPTIONAL},
};

static const ff_port outputs[] = {
    {.name = "gain", .unit = "1", .doc = "of the parameter, or of the law", .dims = ""},
    {.name = "absent", .unit = "1", .doc = "parameters that were not given", .dims = ""},
};

static ff_status wire(void *self, uint32_t input, const void *service)
{
    (void)input;
    ((replaced *)self)->law = service;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const replaced *r = self;
    (void)wanted;
    double offset = in[1].data ? in[1].data[0] : r->offset;
    double absent = !!isnan(r->gain) + !!isnan(r->scale) + !!isnan(r->near) + !!isnan(r->far);
    ff_status status =
        ff_put_scalar(r->host, 0, (r->law ? r->law->eval(r->law->self, 1) : r->gain) + offset);
    return status == FF_OK ? ff_put_scalar(r->host, 1, absent) : status;
}

FF_MODEL(replaced_model, replaced, .id = "toy/replaced", .version = "1.0.0",
         .summary = "Takes a law in place of its parameters", .reference = "", .bibtex = "",
         .licence = "GPL-3.0-or-later", .params = FF_TABLE(params), .inputs = FF_TABLE(inputs),
         .outputs = FF_TABLE(outputs), .wire = wire, .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&replaced_model);
