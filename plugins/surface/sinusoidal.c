/* SPDX-License-Identifier: GPL-3.0-or-later */
/* surface/sinusoidal: waviness of one wavelength. */
#include "record.h"
#include "references.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

/* Points per wave; linear interpolation between them has an error of 1e-4 of the amplitude. */
enum { POINTS = 256 };

typedef struct sinusoidal {
    const ff_host *host;
    double amplitude, wavelength, origin; /* m */
    int64_t flank;
} sinusoidal;

static const ff_param params[] = {
    FF_QUANTITY("amplitude", "um", sinusoidal, amplitude, FF_REQUIRED, NULL, NULL, 0, 1e4, 0, 0,
                "amplitude A in A cos(2 pi s/wavelength): half the height from valley to crest"),
    FF_QUANTITY("wavelength", "um", sinusoidal, wavelength, FF_REQUIRED, NULL, NULL, 1e-3, 1e7, 0,
                0, "length of a wave"),
    FF_ROW("flank", "",
           "flank with the waviness: flank of the driving gear (1) or of the driven gear (2); the "
           "other is smooth",
           FF_INT, 0, "1", "both", NULL, 1, 2, 0, 0, 0, 0, FF_PLACE(sinusoidal, flank, int64_t)),
    FF_QUANTITY("origin", "um", sinusoidal, origin, 0, "0 um", NULL, -1e9, 1e9, 0, 0,
                "arc coordinate that lies at x = 0 at the first time; 0: a crest"),
};

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const sinusoidal *s = self;
    const double A = s->amplitude;
    surface_record record;
    (void)in;
    ff_status status =
        surface_record_make(s->host, "wavelength", POINTS, s->wavelength / POINTS, &record);
    for (int g = 0; g < 2 && status == FF_OK; g++) {
        if (!surface_has_flank(s->flank, g))
            continue;
        for (int i = 0; i < POINTS; i++)
            record.height[g][i] = A * cos(2 * M_PI * i / POINTS);
        record.rq[g] = A / sqrt(2);
    }
    record.origin = s->origin;
    record.repeats = true;
    if (status == FF_OK)
        status = surface_record_publish(s->host, wanted, &record);
    surface_record_free(&record);
    return status;
}

FF_MODEL(surface_sinusoidal, sinusoidal, .id = "surface/sinusoidal", .version = "1.0.0",
         .summary = "waviness of one wavelength on one flank or both",
         .reference = "Venner, Couhier, Lubrecht and Greenwood 1997, Amplitude reduction of "
                      "waviness in transient EHL line contacts, 23rd Leeds-Lyon Symposium",
         .bibtex = BIB_venner1997, .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
         .outputs = FF_TABLE(surface_outputs), .evaluate = evaluate, .destroy = free);
