/* SPDX-License-Identifier: GPL-3.0-or-later */
/* surface/synthetic: rough flanks with a given spectrum, bitwise equal on every machine. */
#include "fourier.h"
#include "record.h"
#include "references.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { FIXED, GAUSSIAN };

static const double longest_per_length =
    10; /* if the length is auto, the record is this many times as long as the longest wave */
static const double points_per_shortest = 32; /* linear interpolation between the points has an
                                                 error of 0.5 % */
static const double least_per_shortest = 4;   /* fewer points cannot represent the shortest wave */
static const double slack = 1e-9;             /* rounding of a length, relative */

typedef struct synthetic {
    const ff_host *host;
    ff_reals rq, seed; /* one value or two */
    double shortest, longest, spectrum_slope, origin;
    double length, spacing; /* NaN: auto */
    int32_t amplitudes;
} synthetic;

static const ff_param params[] = {
    FF_LIST("rq", "um", synthetic, rq, FF_REQUIRED, NULL, NULL, 0, 100, 0, 10, 1, 2,
            "root mean square roughness of flank 1 and flank 2, which the record has exactly; one "
            "number: both"),
    FF_LIST("seed", "1", synthetic, seed, FF_WHOLE, "1", NULL, 0, 9007199254740992, 0, 0, 1, 2,
            "random seeds of the phases of flank 1 and flank 2; with one seed the flanks still "
            "differ, and the second seed does not affect flank 1"),
    FF_QUANTITY("shortest", "um", synthetic, shortest, 0, "20 um", NULL, 1e-3, 1e6, 0, 0,
                "shortest wavelength"),
    FF_QUANTITY("longest", "um", synthetic, longest, 0, "800 um", NULL, 1e-3, 1e6, 0, 0,
                "longest wavelength"),
    FF_QUANTITY("spectrum_slope", "1", synthetic, spectrum_slope, 0, "2", NULL, -10, 10, 0, 4,
                "exponent by which the power spectral density falls with the wavenumber; 2: "
                "amplitudes proportional to the wavelength (Sayles and Thomas 1978)"),
    FF_ONE_OF("fixed|gaussian", "amplitudes", synthetic, amplitudes, 0, "fixed",
              "fixed: each wave has the amplitude of the spectrum and a random phase; gaussian: "
              "sine and cosine have Gaussian amplitudes, which match the spectrum on average"),
    FF_QUANTITY_OR(
        "auto", "length", "um", synthetic, length, 0, "auto", NULL, 1e-3, 1e7, 0, 0,
        "length of the record, after which it repeats; auto: 10 times the longest wavelength"),
    FF_QUANTITY_OR("auto", "spacing", "um", synthetic, spacing, FF_TUNABLE, "auto", NULL, 1e-4, 1e6,
                   0, 0,
                   "largest point spacing; the number of points is a power of 2; auto: a 32nd of "
                   "the shortest wavelength"),
    FF_QUANTITY("origin", "um", synthetic, origin, 0, "0 um", NULL, -1e9, 1e9, 0, 0,
                "arc coordinate of both flanks that lies at x = 0 at the first time"),
};

/* The waves: harmonics `first` to `last` of the record length, sampled at n points. */
typedef struct band {
    size_t n, first, last;
    double length;
} band;

static double length_of(const synthetic *s)
{
    double length = s->length;
    return length > 0 ? length : longest_per_length * s->longest;
}

static double spacing_of(const synthetic *s)
{
    double spacing = s->spacing;
    return spacing > 0 ? spacing : s->shortest / points_per_shortest;
}

static ff_status ready(void *self)
{
    const synthetic *s = self;
    const double um = 1e6, shortest = s->shortest, longest = s->longest;
    const double length = length_of(s), spacing = spacing_of(s);
    if (!(shortest <= longest))
        return ff_failf(s->host, FF_INVALID, "shortest",
                        "shortest is %g um; it must not exceed longest, %g um", shortest * um,
                        longest * um);
    if (!(longest <= length * (1 + slack)))
        return ff_failf(s->host, FF_INVALID, "length",
                        "length is %g um; it must be at least the longest wavelength, %g um",
                        length * um, longest * um);
    if (!(spacing * least_per_shortest <= shortest * (1 + slack)))
        return ff_failf(s->host, FF_INVALID, "spacing",
                        "spacing %g um is too coarse for the shortest wave; it must be at most "
                        "%g um, a quarter of it",
                        spacing * um, shortest * um / least_per_shortest);
    if (floor(length / shortest * (1 + slack)) < ceil(length / longest * (1 - slack)))
        return ff_failf(s->host, FF_INVALID, "longest",
                        "no wave between %g and %g um fits a whole number of times into the length "
                        "%g um",
                        shortest * um, longest * um, length * um);
    return FF_OK;
}

/* The mixing function of splitmix64 (Steele, Lea and Flood 2014). */
static uint64_t mix(uint64_t z)
{
    z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
    return z ^ (z >> 31);
}

/* Draws a uniform number from [0, 1) that depends only on the arguments. */
static double draw(double seed, size_t flank, size_t harmonic, size_t which)
{
    const uint64_t golden = UINT64_C(0x9e3779b97f4a7c15);
    uint64_t state = mix((uint64_t)seed + golden);
    state = mix(state + golden * (flank + 1));
    state = mix(state + golden * (2 * harmonic + which + 1));
    return (double)(state >> 11) * 0x1p-53;
}

/* Sums the waves of the spectrum and scales them to the Rq of the flank; `wave` is work space
 * for n numbers. */
static ff_status make_flank(const synthetic *s, const band *b, int flank, double complex *wave,
                            surface_record *record)
{
    const double rq = ff_of_both(&s->rq, flank), slope = s->spectrum_slope;
    const double seed = ff_of_both(&s->seed, flank);
    double *height = record->height[flank];
    for (size_t k = 0; k < b->n; k++)
        wave[k] = 0;
    for (size_t k = b->first; k <= b->last; k++) {
        double amplitude = pow((double)k / (double)b->first, -slope / 2);
        double phase = 2 * M_PI * draw(seed, (size_t)flank, k, 0);
        if (s->amplitudes == GAUSSIAN) /* Box & Muller 1958 */
            amplitude *= sqrt(-log1p(-draw(seed, (size_t)flank, k, 1)));
        wave[k] = amplitude * cexp(phase * I);
    }
    ff_status status = surface_fourier(b->n, wave, 1);
    if (status != FF_OK)
        return status;
    for (size_t i = 0; i < b->n; i++)
        height[i] = creal(wave[i]);
    double rms = surface_rms(b->n, height);
    if (rq > 0 && !(rms > 0 && isfinite(rms)))
        return ff_failf(s->host, FF_INVALID, "spectrum_slope",
                        "the Rq of the spectrum overflows: use a smaller spectrum_slope");
    for (size_t i = 0; i < b->n; i++)
        height[i] *= rq > 0 ? rq / rms : 0;
    record->rq[flank] = rq;
    return FF_OK;
}

static void report(const synthetic *s, const band *b, const surface_record *record)
{
    double worst = 0, shortest = b->length / (double)b->last;
    for (int g = 0; g < 2; g++)
        if (record->rq[g] > 0)
            worst =
                fmax(worst, fabs(surface_rms(record->n, record->height[g]) / record->rq[g] - 1));
    s->host->quality(s->host->ctx, "rq_error", worst, 1e-12, worst <= 1e-12 ? FF_GOOD : FF_BAD,
                     "relative difference between the Rq of the record and the given rq");
    double points = shortest / record->spacing;
    s->host->quality(s->host->ctx, "points_per_shortest_wave", points, 16,
                     points >= 16 ? FF_GOOD : FF_DOUBTFUL,
                     "number of points of the record on its shortest wave");
    double waves = (double)(b->last - b->first + 1);
    s->host->quality(s->host->ctx, "waves", waves, 10, waves >= 10 ? FF_GOOD : FF_DOUBTFUL,
                     "number of waves in the record; the sum of a few is not a random surface");
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const synthetic *s = self;
    surface_record record;
    band b = {.length = length_of(s)};
    (void)in;
    b.n = surface_power_of_two(b.length / spacing_of(s) * (1 - slack));
    b.first = (size_t)ceil(b.length / s->longest * (1 - slack));
    b.last = (size_t)floor(b.length / s->shortest * (1 + slack));
    ff_status status =
        surface_record_make(s->host, "length", (double)b.n, b.length / (double)b.n, &record);
    double complex *wave = status == FF_OK ? malloc(b.n * sizeof *wave) : NULL;
    if (status == FF_OK && !wave)
        status = FF_NOMEM;
    for (int g = 0; g < 2 && status == FF_OK; g++)
        status = make_flank(s, &b, g, wave, &record);
    record.repeats = true;
    record.origin = s->origin;
    if (status == FF_OK)
        status = surface_record_publish(s->host, wanted, &record);
    if (status == FF_OK)
        report(s, &b, &record);
    free(wave);
    surface_record_free(&record);
    return status;
}

FF_MODEL(
    surface_synthetic, synthetic, .id = "surface/synthetic", .version = "1.0.0",
    .summary = "rough flanks of a given spectrum and Rq",
    .reference =
        "Sayles and Thomas 1978, Surface topography as a nonstationary random process, Nature 271, "
        "431; Steele, Lea and Flood 2014, Fast splittable pseudorandom number generators, OOPSLA",
    .bibtex = BIB_sayles1978 "\n" BIB_steele2014, .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params), .outputs = FF_TABLE(surface_outputs), .ready = ready,
    .evaluate = evaluate, .destroy = free);
