/* SPDX-License-Identifier: GPL-3.0-or-later */
/* surface/measured: flanks from the traces of a profilometer. */
#include "record.h"
#include "references.h"
#include "roughness.h"
#include "trace.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NO_DETREND = -1, MEAN = 0, LINEAR = 1 };
enum { PERIODIC, MIRROR, FLAT };

/* The least cut-off, in spacings of the points. For a cut-off of at least this length, a wave as
   long as the cut-off passes the filter with half of its amplitude, to within 1e-4. */
static const double least_cutoff = 5;

typedef struct measured {
    const ff_host *host;
    const char *path[2];
    int detrend; /* order of the polynomial, or NO_DETREND */
    double cutoff_long, cutoff_short, spacing,
        origin; /* NaN: `none` for the cut-offs, `auto` for the others */
    int32_t direction, direction_2, extend; /* direction_2 < 0: the same as `direction` */
    surface_trace trace[2];                 /* n = 0: a smooth flank */
} measured;

static const ff_param params[] = {
    FF_PATH("file_1", measured, path[0], 0, NULL,
            "trace of flank 1 with the header \"position [um], height [um]\", heights positive out "
            "of the metal; left out: a smooth flank"),
    FF_PATH("file_2", measured, path[1], 0, NULL, "trace of flank 2, in the format of file_1"),
    {.name = "detrend",
     .unit = "1",
     .doc = "form that is removed before filtering: none, the mean, the best-fit line (linear), or "
            "the best-fit polynomial of the given order, for the profile of an involute flank",
     .type = FF_INT,
     .preset = "linear",
     .choices = "none|mean|linear",
     .min = 0,
     .max = 20},
    FF_QUANTITY_OR("none", "cutoff_long", "um", measured, cutoff_long, 0, "none", NULL, 1e-3, 1e6,
                   0, 0,
                   "cut-off of the Gaussian filter (ISO 16610-21) that removes longer waves; 800 "
                   "um is usual for Ra from 0.1 to 2 um (ISO 4288)"),
    FF_QUANTITY_OR("none", "cutoff_short", "um", measured, cutoff_short, 0, "none", NULL, 1e-3, 1e6,
                   0, 0,
                   "cut-off of the Gaussian filter that removes shorter waves; 2.5 um is usual "
                   "with a long cut-off of 800 um (ISO 3274)"),
    FF_ONE_OF(
        "forward|reversed", "direction", measured, direction, 0, "forward",
        "forward: positions increase along x, towards the outlet; reversed: they decrease. For a "
        "trace from root to tip, the driving flank is reversed and the driven flank forward"),
    FF_ONE_OF("forward|reversed", "direction_2", measured, direction_2, 0, NULL,
              "direction of flank 2, if it differs from that of flank 1"),
    FF_ONE_OF("periodic|mirror|flat", "extend", measured, extend, 0, "mirror",
              "continuation beyond the record. periodic: the record repeats; mirror: record and "
              "mirror image repeat (no step at the seam); flat: the flanks are flat"),
    FF_QUANTITY_OR("auto", "spacing", "um", measured, spacing, FF_TUNABLE, "auto", NULL, 1e-4, 1e6,
                   0, 0,
                   "point spacing of the record; each point is the mean of the trace around it; "
                   "auto: the spacing of the file, or of the finer file"),
    FF_QUANTITY("origin", "um", measured, origin, 0, "0 um", NULL, -1e9, 1e9, 0, 0,
                "arc coordinate of both flanks, counted from the start of their records, that lies "
                "at x = 0 at the first time"),
};

/* The heights of a flank before they are joined into the record. */
typedef struct flank {
    size_t n;
    double *height;
} flank;

/* Sets `detrend`. Its value is a word or a number, which the engine cannot store by itself
   (ff_param.place). */
static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    measured *s = self;
    (void)param;
    s->detrend = !value->text                   ? (int)value->integer
                 : !strcmp(value->text, "none") ? NO_DETREND
                 : !strcmp(value->text, "mean") ? MEAN
                                                : LINEAR;
    return FF_OK;
}

static const char *const file_names[2] = {"file_1", "file_2"};

/* Whether flank g is reversed. */
static bool is_reversed(const measured *s, size_t g)
{
    return (g == 1 && s->direction_2 >= 0 ? s->direction_2 : s->direction) == 1;
}

static ff_status ready(void *self)
{
    measured *s = self;
    if (!s->path[0] && !s->path[1])
        return ff_failf(s->host, FF_INVALID, "file_1", "a trace is needed: file_1, file_2 or both");
    if (s->cutoff_long > 0 && s->cutoff_short >= s->cutoff_long)
        return ff_failf(s->host, FF_INVALID, "cutoff_short",
                        "cutoff_short %g um must be less than cutoff_long %g um",
                        s->cutoff_short * 1e6, s->cutoff_long * 1e6);
    ff_status status = FF_OK;
    for (size_t g = 0; g < 2 && status == FF_OK; g++) {
        if (s->path[g])
            status = surface_trace_read(s->host, file_names[g], s->path[g], &s->trace[g]);
    }
    return status;
}

/* Returns the given spacing, or the mean spacing of the finer of the files. */
static double spacing_of(const measured *s)
{
    double spacing = s->spacing;
    for (size_t g = 0; g < 2 && !(s->spacing > 0); g++) {
        const surface_trace *t = &s->trace[g];
        double mean = t->n ? (t->position[t->n - 1] - t->position[0]) / (double)(t->n - 1) : 0;
        if (mean > 0 && (!(spacing > 0) || mean < spacing))
            spacing = mean;
    }
    return spacing;
}

static ff_status check_cutoff(const measured *s, const char *param, double cutoff, size_t n,
                              double spacing)
{
    if (!(cutoff > 0))
        return FF_OK;
    if (cutoff < least_cutoff * spacing)
        return ff_failf(s->host, FF_INVALID, param,
                        "%s is %g um; with a point spacing of %g um it must be at least %g um",
                        param, cutoff * 1e6, spacing * 1e6, least_cutoff * spacing * 1e6);
    if (cutoff > spacing * (double)n)
        return ff_failf(s->host, FF_INVALID, param, "%s is %g um, longer than the record of %g um",
                        param, cutoff * 1e6, spacing * (double)n * 1e6);
    return FF_OK;
}

static void reverse(size_t n, double *height)
{
    for (size_t i = 0; i < n / 2; i++) {
        double z = height[i];
        height[i] = height[n - 1 - i];
        height[n - 1 - i] = z;
    }
}

/* Resamples the trace, removes form and waviness, and orients it along x. */
static ff_status make_flank(const measured *s, size_t g, double spacing, flank *f)
{
    const surface_trace *trace = &s->trace[g];
    f->n = surface_trace_cells(trace, spacing);
    if (f->n > SURFACE_POINTS || f->n < 2 || (size_t)(s->detrend + 1) >= f->n)
        return ff_failf(s->host, FF_INVALID, s->spacing > 0 ? "spacing" : file_names[g],
                        "%s gives %zu%s points with a spacing of %g um; the number of points must "
                        "be between %d and %d",
                        file_names[g], f->n, f->n > SURFACE_POINTS ? " or more" : "", spacing * 1e6,
                        s->detrend < 1 ? 2 : s->detrend + 2, SURFACE_POINTS);
    f->height = malloc(f->n * sizeof *f->height);
    if (!f->height)
        return FF_NOMEM;
    surface_trace_resample(trace, spacing, f->n, f->height);
    double distance = surface_trace_distance(trace, spacing, f->n, f->height);
    ff_status status = FF_OK;
    if (s->detrend != NO_DETREND)
        status = surface_detrend(f->n, s->detrend, f->height);
    if (status == FF_OK)
        status = check_cutoff(s, "cutoff_long", s->cutoff_long, f->n, spacing);
    if (status == FF_OK)
        status = check_cutoff(s, "cutoff_short", s->cutoff_short, f->n, spacing);
    if (status == FF_OK && s->cutoff_long > 0)
        status = surface_remove_longer(f->n, s->cutoff_long / spacing, f->height);
    if (status == FF_OK && s->cutoff_short > 0)
        status =
            surface_remove_shorter(f->n, s->cutoff_short / spacing, SURFACE_MIRRORED, f->height);
    if (status != FF_OK)
        return status;
    if (is_reversed(s, g))
        reverse(f->n, f->height);
    double rq = surface_rms(f->n, f->height), share = rq > 0 ? distance / rq : 0;
    s->host->quality(s->host->ctx, g ? "resampling_2" : "resampling_1", share, 0.05,
                     share <= 0.05 ? FF_GOOD : FF_DOUBTFUL,
                     "root mean square difference between the record and the points of the file, "
                     "relative to Rq; it is caused by a coarser spacing");
    return FF_OK;
}

/* Returns the step between the end of the record and its continuation, relative to the largest step
   within it. */
static double seam_of(int extend, size_t n, const double *height)
{
    double most = 0;
    for (size_t i = 1; i < n; i++)
        most = fmax(most, fabs(height[i] - height[i - 1]));
    double seam = extend == PERIODIC ? fabs(height[n - 1] - height[0])
                  : extend == FLAT   ? fmax(fabs(height[0]), fabs(height[n - 1]))
                                     : 0;
    return most > 0 ? seam / most : 0;
}

static void report(const measured *s, double length, double seam)
{
    s->host->quality(
        s->host->ctx, "seam", seam, 2, seam <= 2 ? FF_GOOD : FF_DOUBTFUL,
        "step at the end of the record relative to the largest step between its points");
    if (!(s->cutoff_long > 0))
        return;
    double lengths = length / s->cutoff_long;
    s->host->quality(s->host->ctx, "sampling_lengths", lengths, 5,
                     lengths >= 5 ? FF_GOOD : FF_DOUBTFUL,
                     "length of the record over cutoff_long; ISO 4288 requires 5");
}

/* Joins both flanks over their common length, with zero mean. Appends the mirror image if the
   record is extended in that way. */
static ff_status join(const measured *s, const flank f[2], double spacing, surface_record *record)
{
    size_t n = f[0].height ? f[0].n : f[1].n;
    if (f[1].height && f[1].n < n)
        n = f[1].n;
    size_t whole = s->extend == MIRROR ? 2 * n : n;
    ff_status status = surface_record_make(s->host, "extend", (double)whole, spacing, record);
    double seam = 0;
    for (size_t g = 0; g < 2 && status == FF_OK; g++) {
        double mean = 0, *height = record->height[g];
        if (!f[g].height)
            continue;
        for (size_t i = 0; i < n && s->detrend != NO_DETREND; i++)
            mean += f[g].height[i] / (double)n;
        for (size_t i = 0; i < n; i++)
            height[i] = f[g].height[i] - mean;
        for (size_t i = n; i < whole; i++)
            height[i] = height[whole - 1 - i];
        record->rq[g] = surface_rms(n, height);
        seam = fmax(seam, seam_of(s->extend, n, height));
    }
    record->origin = s->origin;
    record->repeats = s->extend != FLAT;
    if (status == FF_OK)
        report(s, spacing * (double)n, seam);
    return status;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const measured *s = self;
    flank f[2] = {{0, NULL}, {0, NULL}};
    surface_record record = {0};
    const double spacing = spacing_of(s);
    ff_status status = FF_OK;
    (void)in;
    for (size_t g = 0; g < 2 && status == FF_OK; g++)
        if (s->path[g])
            status = make_flank(s, g, spacing, &f[g]);
    if (status == FF_OK)
        status = join(s, f, spacing, &record);
    if (status == FF_OK)
        status = surface_record_publish(s->host, wanted, &record);
    free(f[0].height);
    free(f[1].height);
    surface_record_free(&record);
    return status;
}

FF_MODEL(surface_measured, measured, .id = "surface/measured", .version = "1.0.0",
         .summary = "flanks from the traces of a profilometer, filtered",
         .reference =
             "ISO 16610-21:2011, Geometrical product specifications, Filtration, Linear profile "
             "filters: Gaussian filters; ISO/TS 16610-28:2010, Profile filters: End effects",
         .bibtex = BIB_iso16610_21 "\n" BIB_iso16610_28, .licence = "GPL-3.0-or-later",
         .params = FF_TABLE(params), .outputs = FF_TABLE(surface_outputs), .set = set,
         .ready = ready, .evaluate = evaluate, .destroy = free,
         .columns = FF_TABLE(surface_trace_columns));
