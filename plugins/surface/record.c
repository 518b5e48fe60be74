/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the heights of both flanks and their roughness. */
#include "record.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

const ff_port surface_outputs[SURFACE_OUTPUTS] = {
    {.name = "position",
     .unit = "m",
     .doc = "arc coordinate of the points along x, in equal steps from 0",
     .dims = "arc"},
    {.name = "height_1",
     .unit = "m",
     .doc = "heights of flank 1, positive out of the metal",
     .dims = "arc"},
    {.name = "height_2",
     .unit = "m",
     .doc = "heights of flank 2, positive out of the metal",
     .dims = "arc"},
    {.name = "rq_1",
     .unit = "m",
     .doc = "root mean square roughness of flank 1",
     .dims = "",
     .max = 100e-6},
    {.name = "rq_2",
     .unit = "m",
     .doc = "root mean square roughness of flank 2",
     .dims = "",
     .max = 100e-6},
    {.name = "period",
     .unit = "m",
     .doc = "length after which the record repeats; 0: the flanks are flat outside the record",
     .dims = ""},
    {.name = "origin",
     .unit = "m",
     .doc = "arc coordinate of both flanks that lies at x = 0 at the first time",
     .dims = ""},
};

ff_status surface_record_make(const ff_host *host, const char *item, double n, double spacing,
                              surface_record *record)
{
    *record = (surface_record){.spacing = spacing};
    if (!(n <= SURFACE_POINTS))
        return ff_failf(host, FF_INVALID, item,
                        "the record needs %.4g points; at most %d are allowed: use a coarser "
                        "spacing or a shorter record",
                        n, SURFACE_POINTS);
    record->n = (size_t)n;
    for (int g = 0; g < 2; g++)
        if (!(record->height[g] = calloc(record->n, sizeof *record->height[g])))
            return FF_NOMEM;
    return FF_OK;
}

void surface_record_free(surface_record *record)
{
    free(record->height[0]);
    free(record->height[1]);
    record->height[0] = record->height[1] = NULL;
}

double surface_rms(size_t n, const double *height)
{
    double sum = 0, square = 0;
    for (size_t i = 0; i < n; i++)
        sum += height[i];
    for (size_t i = 0; i < n; i++) {
        double z = height[i] - sum / (double)n;
        square += z * z;
    }
    return sqrt(square / (double)n);
}

static ff_status write_series(const ff_host *host, uint64_t wanted, uint32_t output, size_t n,
                              const double *from)
{
    if (!(wanted & FF_BIT(output)))
        return FF_OK;
    double *to = ff_put_series(host, output, n);
    if (!to)
        return FF_NOMEM;
    memcpy(to, from, n * sizeof *to);
    return FF_OK;
}

static ff_status write_positions(const ff_host *host, const surface_record *record)
{
    double *position = ff_put_series(host, SURFACE_POSITION, record->n);
    for (size_t i = 0; position && i < record->n; i++)
        position[i] = record->spacing * (double)i;
    return position ? FF_OK : FF_NOMEM;
}

/* Writes the roughness of both flanks even if it is not requested, so that its bounds are checked
   for every record. */
static ff_status give_roughness(const ff_host *host, const surface_record *record)
{
    static const double finished = 10e-6; /* roughest flank that is milled or ground */
    ff_status status = FF_OK;
    for (uint32_t g = 0; g < 2 && status == FF_OK; g++) {
        const double rq = record->rq[g];
        host->quality(host->ctx, g ? "roughness_2" : "roughness_1", rq, finished,
                      rq <= finished ? FF_GOOD : FF_RANGE,
                      "root mean square roughness, m; gear flanks are smoother: check the unit of "
                      "the heights, and whether missing points are marked by a number");
        status = ff_put_scalar(host, SURFACE_RQ_1 + g, rq);
    }
    return status;
}

ff_status surface_record_publish(const ff_host *host, uint64_t wanted, const surface_record *record)
{
    const double scalars[] = {record->repeats ? record->spacing * (double)record->n : 0,
                              record->origin};
    ff_status status = give_roughness(host, record);
    if (wanted & FF_BIT(SURFACE_POSITION) && status == FF_OK)
        status = write_positions(host, record);
    for (uint32_t g = 0; g < 2 && status == FF_OK; g++)
        status = write_series(host, wanted, SURFACE_HEIGHT_1 + g, record->n, record->height[g]);
    for (uint32_t i = 0; i < 2 && status == FF_OK; i++)
        if (wanted & FF_BIT(SURFACE_PERIOD + i))
            status = ff_put_scalar(host, SURFACE_PERIOD + i, scalars[i]);
    return status;
}
