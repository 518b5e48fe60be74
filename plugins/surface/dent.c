/* SPDX-License-Identifier: GPL-3.0-or-later */
/* surface/dent: one dent in otherwise smooth flanks. */
#include "record.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { P_DEPTH, P_WIDTH, P_START, P_FLANK, P_SHAPE, PARAM_COUNT };
enum { COSINE, GAUSSIAN };
enum { PER_WIDTH = 256 }; /* points of the record over the width */

static const ff_param params[] = {
    {.name = "depth",
     .unit = "um",
     .doc = "depth of the middle below the flank; below 0: a bump",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .min = -1e4,
     .max = 1e4},
    {.name = "width",
     .unit = "um",
     .doc = "w of the shape: its wavelength (cosine) or its width at half depth (gaussian)",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .min = 1e-3,
     .max = 1e7},
    {.name = "start",
     .unit = "um",
     .doc = "x of its middle at the first time; the flank carries it towards larger x, so that a "
            "dent below 0 comes from the inlet",
     .type = FF_REAL,
     .preset = "-1000 um",
     .min = -1e9,
     .max = 1e9},
    {.name = "flank",
     .unit = "",
     .doc = "flank that has it: of the driving (1) or driven gear (2)",
     .type = FF_INT,
     .preset = "1",
     .choices = "both",
     .min = 1,
     .max = 2},
    {.name = "shape",
     .unit = "",
     .doc = "cosine: -depth 10^(-10 (d/w)^2) cos(2 pi d/w), with shoulders (Venner, Lubrecht and "
            "ten Napel 1991); gaussian: -depth 2^(-(2 d/w)^2); d from its middle",
     .type = FF_CHOICE,
     .preset = "cosine",
     .choices = "cosine|gaussian"},
};

typedef struct dent {
    const ff_host *host;
    double value[PARAM_COUNT]; /* all but the flank */
    int flanks;
} dent;

static ff_status create(const ff_host *host, void **self)
{
    dent *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    *self = s;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    dent *s = self;
    if (param == P_FLANK)
        s->flanks = surface_flanks_of(value);
    else
        s->value[param] = param == P_SHAPE ? (double)value->integer : value->real;
    return FF_OK;
}

/* Height of a dent of depth 1 at the distance d, in widths, from its middle. */
static double shape_at(int shape, double d)
{
    if (shape == GAUSSIAN)
        return -exp2(-4 * d * d);
    return -pow(10, -10 * d * d) * cos(2 * M_PI * d); /* Venner, Lubrecht and ten Napel 1991 */
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const dent *s = self;
    const double width = s->value[P_WIDTH];
    const int shape = (int)s->value[P_SHAPE];
    const int reach =
        shape == GAUSSIAN ? 3 : 1; /* in widths; beyond it less than 1e-10 of the depth is left */
    const int half = reach * PER_WIDTH;
    surface_record record;
    (void)in;
    ff_status status =
        surface_record_make(s->host, "width", 2 * half + 1, width / PER_WIDTH, &record);
    for (int g = 0; g < 2 && status == FF_OK; g++)
        for (int i = 0; i <= 2 * half && s->flanks & surface_flank(g); i++)
            record.height[g][i] =
                s->value[P_DEPTH] * shape_at(shape, (double)(i - half) / PER_WIDTH);
    record.origin = reach * width - s->value[P_START];
    if (status == FF_OK)
        status = surface_record_publish(s->host, wanted, &record);
    surface_record_free(&record);
    return status;
}

static void destroy(void *self)
{
    free(self);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "surface/dent",
    .version = "1.0.0",
    .summary =
        "one dent or bump in smooth flanks; rq_1 and rq_2 are 0, since a dent is not roughness",
    .reference =
        "Venner, Lubrecht and ten Napel 1991, Numerical simulation of the overrolling of a surface "
        "feature in an EHL line contact, J. Tribol. 113, 777 (cosine)",
    .bibtex =
        "@article{venner1991, author = {Venner, C. H. and Lubrecht, A. A. and ten Napel, W. E.}, "
        "title = {Numerical simulation of the overrolling of a surface feature in an {EHL} line "
        "contact}, journal = {Journal of Tribology}, volume = {113}, pages = {777--783}, year = "
        "{1991}}",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(surface_outputs),
    .create = create,
    .set = set,
    .evaluate = evaluate,
    .destroy = destroy,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
