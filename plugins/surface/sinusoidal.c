/* SPDX-License-Identifier: GPL-3.0-or-later */
/* surface/sinusoidal: waviness of one wavelength. */
#include "record.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { P_AMPLITUDE, P_WAVELENGTH, P_FLANK, P_ORIGIN, PARAM_COUNT };
enum { BOTH = 3 };
enum { POINTS = 256 }; /* a straight line between two is off by 1e-4 of the amplitude */

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
    double value[PARAM_COUNT];
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
    s->value[param] = param == P_FLANK ? (double)value->integer : value->real;
    if (param == P_FLANK && value->text)
        s->value[param] = BOTH;
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const sinusoidal *s = self;
    const double A = s->value[P_AMPLITUDE];
    const int flank = (int)s->value[P_FLANK];
    surface_record record;
    (void)in;
    ff_status status = surface_record_make(s->host, "wavelength", POINTS,
                                           s->value[P_WAVELENGTH] / POINTS, &record);
    for (int g = 0; g < 2 && status == FF_OK; g++) {
        if (!(flank & (g + 1)))
            continue;
        for (int i = 0; i < POINTS; i++)
            record.height[g][i] = A * cos(2 * M_PI * i / POINTS);
        record.rq[g] = A / sqrt(2);
    }
    record.origin = s->value[P_ORIGIN];
    record.repeats = true;
    if (status == FF_OK)
        status = surface_record_give(s->host, wanted, &record);
    surface_record_free(&record);
    return status;
}

static void destroy(void *self)
{
    free(self);
}

static const ff_model model = {
    sizeof(ff_model),
    FF_ABI_MAJOR,
    FF_ABI_MINOR,
    "surface/sinusoidal",
    "1.0.0",
    "waviness of one wavelength on one flank or both",
    "Venner, Couhier, Lubrecht and Greenwood 1997, Amplitude reduction of waviness in transient "
    "EHL line contacts, 23rd Leeds-Lyon Symposium",
    "@inproceedings{venner1997, author = {Venner, C. H. and Couhier, F. and Lubrecht, A. A. and "
    "Greenwood, J. A.}, title = {Amplitude reduction of waviness in transient {EHL} line "
    "contacts}, booktitle = {Elastohydrodynamics '96, Proceedings of the 23rd Leeds-Lyon "
    "Symposium on Tribology}, year = {1997}}",
    "GPL-3.0-or-later",
    0,
    FF_TABLE(params),
    FF_NO_TABLE,
    FF_TABLE(surface_outputs),
    create,
    set,
    NULL,
    NULL,
    evaluate,
    NULL,
    destroy,
    NULL,
    NULL,
    NULL,
    FF_NO_TABLE,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
