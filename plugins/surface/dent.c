/* SPDX-License-Identifier: GPL-3.0-or-later */
/* surface/dent: one dent in otherwise smooth flanks. */
#include "record.h"
#include "references.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { COSINE, GAUSSIAN };
enum { PER_WIDTH = 256 }; /* points of the record across the width of the dent */

typedef struct dent {
    const ff_host *host;
    double depth, width, start; /* m */
    int64_t flank;
    int32_t shape;
} dent;

static const ff_param params[] = {
    FF_QUANTITY("depth", "um", dent, depth, FF_REQUIRED, NULL, NULL, -1e4, 1e4, 0, 0,
                "depth of the middle of the dent below the flank; negative: a bump"),
    FF_QUANTITY("width", "um", dent, width, FF_REQUIRED, NULL, NULL, 1e-3, 1e7, 0, 0,
                "width w in the shape formula: the wavelength (cosine) or the width at half depth "
                "(gaussian)"),
    FF_QUANTITY("start", "um", dent, start, 0, "-1000 um", NULL, -1e9, 1e9, 0, 0,
                "position x of the middle of the dent at the first time; it moves with the flank "
                "towards larger x, so a dent with negative x comes from the inlet"),
    FF_ROW("flank", "",
           "flank with the dent: flank of the driving gear (1) or of the driven gear "
           "(2)",
           FF_INT, 0, "1", "both", NULL, 1, 2, 0, 0, 0, 0, FF_PLACE(dent, flank, int64_t)),
    FF_ONE_OF("cosine|gaussian", "shape", dent, shape, 0, "cosine",
              "height over the flank. cosine: -depth 10^(-10 (d/w)^2) cos(2 pi d/w), with "
              "shoulders (Venner, Lubrecht and ten Napel 1991); gaussian: -depth 2^(-(2 d/w)^2); d "
              "is the distance from the middle"),
};

/* Returns the height of a dent of depth 1; d is the distance from its middle, in widths. */
static double shape_at(int shape, double d)
{
    if (shape == GAUSSIAN)
        return -exp2(-4 * d * d);
    return -pow(10, -10 * d * d) * cos(2 * M_PI * d); /* Venner, Lubrecht and ten Napel 1991 */
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const dent *s = self;
    const double width = s->width;
    const int shape = s->shape;
    const int reach = shape == GAUSSIAN ? 3 : 1; /* half length of the record, in widths; beyond it,
                                                    less than 1e-10 of the depth remains */
    const int half = reach * PER_WIDTH;
    surface_record record;
    (void)in;
    ff_status status =
        surface_record_make(s->host, "width", 2 * half + 1, width / PER_WIDTH, &record);
    for (int g = 0; g < 2 && status == FF_OK; g++)
        for (int i = 0; i <= 2 * half && surface_has_flank(s->flank, g); i++)
            record.height[g][i] = s->depth * shape_at(shape, (double)(i - half) / PER_WIDTH);
    record.origin = reach * width - s->start;
    if (status == FF_OK)
        status = surface_record_publish(s->host, wanted, &record);
    surface_record_free(&record);
    return status;
}

FF_MODEL(surface_dent, dent, .id = "surface/dent", .version = "1.0.0",
         .summary = "one dent or bump in otherwise smooth flanks; rq_1 and rq_2 are 0, since a "
                    "dent is no roughness",
         .reference =
             "Venner, Lubrecht and ten Napel 1991, Numerical simulation of the overrolling of "
             "a surface feature in an EHL line contact, J. Tribol. 113, 777 (cosine)",
         .bibtex = BIB_venner1991, .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
         .outputs = FF_TABLE(surface_outputs), .evaluate = evaluate, .destroy = free);
