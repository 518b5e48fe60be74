/* SPDX-License-Identifier: GPL-3.0-or-later */
/* surface/sinusoidal: waviness of one wavelength. */
#include "record.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { P_AMPLITUDE, P_WAVELENGTH, P_FLANK, P_ORIGIN, PARAM_COUNT };
/* Of a wave: straight lines between them are off by 1e-4 of the amplitude. */
enum { POINTS = 256 };

static const ff_param params[] = {
    {.name = "amplitude",
     .unit = "um",
     .doc = "A of A cos(2 pi s/wavelength): half the height from valley to crest",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .min = 0,
     .max = 1e4},
    {.name = "wavelength",
     .unit = "um",
     .doc = "length of a wave",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .min = 1e-3,
     .max = 1e7},
    {.name = "flank",
     .unit = "",
     .doc = "flank that is wavy: of the driving (1) or driven gear (2); the other is smooth",
     .type = FF_INT,
     .preset = "1",
     .choices = "both",
     .min = 1,
     .max = 2},
    {.name = "origin",
     .unit = "um",
     .doc = "arc coordinate at x = 0 at the first time; 0: a crest",
     .type = FF_REAL,
     .preset = "0 um",
     .min = -1e9,
     .max = 1e9},
};

typedef struct sinusoidal {
    const ff_host *host;
    double value[PARAM_COUNT]; /* all but the flank */
    int flanks;
} sinusoidal;

static ff_status create(const ff_host *host, void **self)
{
    sinusoidal *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    *self = s;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    sinusoidal *s = self;
    if (param == P_FLANK)
        s->flanks = surface_flanks_of(value);
    else
        s->value[param] = value->real;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const sinusoidal *s = self;
    const double A = s->value[P_AMPLITUDE];
    surface_record record;
    (void)in;
    ff_status status = surface_record_make(s->host, "wavelength", POINTS,
                                           s->value[P_WAVELENGTH] / POINTS, &record);
    for (int g = 0; g < 2 && status == FF_OK; g++) {
        if (!(s->flanks & surface_flank(g)))
            continue;
        for (int i = 0; i < POINTS; i++)
            record.height[g][i] = A * cos(2 * M_PI * i / POINTS);
        record.rq[g] = A / sqrt(2);
    }
    record.origin = s->value[P_ORIGIN];
    record.repeats = true;
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
    .id = "surface/sinusoidal",
    .version = "1.0.0",
    .summary = "waviness of one wavelength on one flank or both",
    .reference = "Venner, Couhier, Lubrecht and Greenwood 1997, Amplitude reduction of waviness in "
                 "transient "
                 "EHL line contacts, 23rd Leeds-Lyon Symposium",
    .bibtex = "@inproceedings{venner1997, author = {Venner, C. H. and Couhier, F. and Lubrecht, A. "
              "A. and "
              "Greenwood, J. A.}, title = {Amplitude reduction of waviness in transient {EHL} line "
              "contacts}, booktitle = {Elastohydrodynamics '96, Proceedings of the 23rd Leeds-Lyon "
              "Symposium on Tribology}, year = {1997}}",
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
