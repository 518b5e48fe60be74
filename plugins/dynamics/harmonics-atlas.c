/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "harmonics-atlas.h"

#include "bracket.h"
#include "continuation.h"
#include "harmonics-motion.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points after which a curve is given up. */
enum { MAX_POINTS = 8000 };

/* Speeds at which a motion without separation may begin a curve. */
enum { INNER_SPEEDS = 16 };

/* A curve runs away when its rms passes this many times half gap and static deflection. */
static const double runaway = 10;

/* The number of branch n of period 1 in the output, as dynamics/shooting counts. */
static int name_of(int number)
{
    return 1000 + number;
}

/* Makes room for one more element, by doubling from 64 on; NULL: out of memory. */
static void *make_room(void *array, size_t count, size_t size)
{
    int full = count == 0 || (count >= 64 && (count & (count - 1)) == 0);
    return full ? realloc(array, (count ? 2 * count : 64) * size) : array;
}

static int add_point(dynamics_harmonics_atlas *atlas, dynamics_harmonics_point point)
{
    dynamics_harmonics_point *p = make_room(atlas->point, atlas->points, sizeof point);
    if (!p)
        return 0;
    atlas->point = p;
    atlas->point[atlas->points++] = point;
    return 1;
}

static int add_event(dynamics_harmonics_event **events, size_t *count,
                     dynamics_harmonics_event event)
{
    dynamics_harmonics_event *e = make_room(*events, *count, sizeof event);
    if (!e)
        return 0;
    *events = e;
    (*events)[(*count)++] = event;
    return 1;
}

/* ln w at which the cubic through two points, with their slopes along the branch, turns. */
static double fold_between(const dynamics_continuation_point *a,
                           const dynamics_continuation_point *z, double length)
{
    double rise = (z->ln_w - a->ln_w) / length;
    double c2 = (3 * rise - 2 * a->slope - z->slope) / length;
    double c3 = (a->slope + z->slope - 2 * rise) / (length * length);
    double s = length * a->slope / (a->slope - z->slope);
    for (int i = 0; i < 20; i++)
        s -= (a->slope + s * (2 * c2 + 3 * s * c3)) / (2 * c2 + 6 * s * c3);
    if (!(s >= 0 && s <= length))
        s = length * a->slope / (a->slope - z->slope);
    return a->ln_w + s * (a->slope + s * (c2 + s * c3));
}

/* The product of 1 + mu over both multipliers, 1 + tr M + det M, which is below 0 while one of them
   lies beyond -1. `largest` is the largest modulus. */
static double beyond_minus_one(const dynamics_harmonics_range *range, double ln_w, const double *x,
                               double *largest)
{
    double multipliers[4];
    dynamics_motion motion = {.excitation = range->excitation};
    double *m = motion.monodromy;
    dynamics_harmonics_monodromy(range->excitation, 2 * M_PI / exp(ln_w), x, range->harmonics, m);
    *largest = dynamics_motion_multipliers(&motion, multipliers);
    return 1 + m[0] + m[3] + m[0] * m[3] - m[1] * m[2];
}

/* A point of the curve, with a copy of its series that outlives the next step. */
typedef struct station {
    dynamics_continuation_point at;
    double *x, beyond;
} station;

enum { MAX_SECANTS = 20 };

/* The speed between two points at which a multiplier passes -1. `x` has room for a series. */
static double doubling_between(const dynamics_harmonics_range *range, dynamics_continuation *path,
                               const station *a, const station *z, double *x)
{
    dynamics_bracket b = {a->at.ln_w, a->beyond, z->at.ln_w, z->beyond, 0};
    double largest;
    for (int n = 0; n < MAX_SECANTS && fabs(b.high - b.low) > 1e-9; n++) {
        double next = dynamics_bracket_secant(&b);
        double share = (next - a->at.ln_w) / (z->at.ln_w - a->at.ln_w);
        for (size_t i = 0; i <= 2 * range->harmonics; i++)
            x[i] = a->x[i] + share * (z->x[i] - a->x[i]);
        if (!dynamics_continuation_solve(path, next, x))
            break;
        dynamics_bracket_narrow(&b, next, beyond_minus_one(range, next, x, &largest));
    }
    return exp(dynamics_bracket_secant(&b));
}

/* Adds the folds and period doublings between two points; a fold begins a branch. */
static int add_events(const dynamics_harmonics_range *range, dynamics_continuation *path,
                      const station *a, const station *z, double *x, int *branch,
                      dynamics_harmonics_atlas *atlas)
{
    dynamics_harmonics_event event = {.branch = name_of(*branch)};
    if ((a->beyond < 0) != (z->beyond < 0)) {
        event.w = doubling_between(range, path, a, z, x);
        if (!add_event(&atlas->doubling, &atlas->doublings, event))
            return 0;
    }
    if ((a->at.slope < 0) != (z->at.slope < 0)) {
        event.w = exp(fold_between(&a->at, &z->at, z->at.length));
        if (!add_event(&atlas->fold, &atlas->folds, event))
            return 0;
        *branch = ++atlas->branches;
    }
    return 1;
}

static int measure_station(const dynamics_harmonics_range *range, const dynamics_continuation *path,
                           station *here, double *largest)
{
    double low = log(range->low), high = log(range->high);
    double *x = here->x;
    here->at = dynamics_continuation_here(path);
    memcpy(x, here->at.x, (2 * range->harmonics + 1) * sizeof *x);
    here->beyond = beyond_minus_one(range, here->at.ln_w, x, largest);
    return here->at.ln_w > high + 1e-12 ? 1 : here->at.ln_w < low - 1e-12 ? -1 : 0;
}

/* Follows a curve from the branch of that number until it leaves the range. `left` says at which
   end: 1 at the high one, -1 at the low one, 0 at neither. */
static ff_status follow_curve(const dynamics_harmonics_range *range, dynamics_continuation *path,
                              int branch, dynamics_harmonics_atlas *atlas, int *left)
{
    size_t size = 2 * range->harmonics + 1;
    double cap = runaway * (range->excitation->half_gap + range->excitation->load), largest;
    double *room = malloc(3 * size * sizeof *room);
    station last = {.x = room}, here = {.x = room ? room + size : NULL};
    ff_status status = room ? FF_OK : FF_NOMEM;
    const char *before = atlas->ended;
    atlas->ended = "a curve has more than 8000 points";
    for (int n = 0; n < MAX_POINTS && status == FF_OK; n++) {
        *left = measure_station(range, path, &here, &largest);
        dynamics_harmonics_point point = {.w = exp(here.at.ln_w),
                                          .rms = dynamics_fourier_rms(here.x, range->harmonics),
                                          .floquet = largest,
                                          .stable = largest < 1};
        if (*left || point.rms > cap) {
            atlas->ended = *left ? before : "a curve grows without bound";
            break;
        }
        if (n && !add_events(range, path, &last, &here, room + 2 * size, &branch, atlas))
            status = FF_NOMEM;
        point.branch = name_of(branch);
        if (!add_point(atlas, point))
            status = FF_NOMEM;
        if (range->host->progress(range->host->ctx, fmin(1e-3 * n, 0.99)))
            status = FF_STOPPED;
        station swap = last;
        last = here;
        here = swap;
        if (!dynamics_continuation_step(path)) {
            atlas->ended = "a curve cannot be followed further: no step is short enough";
            break;
        }
    }
    free(room);
    return status;
}

static dynamics_continuation_request request_over(const dynamics_harmonics_range *range,
                                                  int from_above)
{
    return (dynamics_continuation_request){.excitation = range->excitation,
                                           .host = range->host,
                                           .from_above = from_above,
                                           .w = from_above ? range->low : range->high,
                                           .harmonics = range->harmonics};
}

/* Adds the curve that enters at an end of the range. */
static ff_status add_curve(const dynamics_harmonics_range *range, int from_above,
                           dynamics_harmonics_atlas *atlas, int *left)
{
    dynamics_continuation_request request = request_over(range, from_above);
    dynamics_continuation_result result = {0};
    dynamics_continuation *path = dynamics_continuation_new(&request);
    ff_status status = path ? FF_OK : FF_NOMEM;
    *left = 0;
    if (status == FF_OK)
        status = dynamics_continuation_begin(path, from_above ? range->high : range->low, &result);
    if (status == FF_OK) {
        status = follow_curve(range, path, ++atlas->branches, atlas, left);
    } else if (status == FF_NOCONV) {
        atlas->ended = "at an end of the range no motion of one mesh cycle was found";
        status = FF_OK;
    }
    dynamics_continuation_free(path);
    return status;
}

/* Whether the atlas has a motion of that rms, within 5 %, at that speed. */
static int is_known(const dynamics_harmonics_atlas *atlas, double w, double rms)
{
    for (size_t i = 0; i + 1 < atlas->points; i++) {
        const dynamics_harmonics_point *a = &atlas->point[i], *z = a + 1;
        if (a->branch != z->branch || (a->w - w) * (z->w - w) > 0)
            continue;
        double share = z->w != a->w ? (w - a->w) / (z->w - a->w) : 0;
        if (fabs(a->rms + share * (z->rms - a->rms) - rms) < 0.05 * rms)
            return 1;
    }
    return 0;
}

/* Adds the curve, both ways, of the motion at w that never loses contact, when it is new. */
static ff_status add_inner_curve(const dynamics_harmonics_range *range, double w,
                                 dynamics_harmonics_atlas *atlas)
{
    ff_status status = FF_OK;
    int first = 0, left;
    for (int from_above = 0; from_above < 2 && status == FF_OK; from_above++) {
        dynamics_continuation_request request = request_over(range, from_above);
        dynamics_continuation *path = dynamics_continuation_new(&request);
        status = path ? FF_OK : FF_NOMEM;
        int found = path && dynamics_continuation_begin_in_contact(path, w);
        if (found && !from_above &&
            is_known(atlas, w,
                     dynamics_fourier_rms(dynamics_continuation_here(path).x, range->harmonics)))
            found = 0;
        else if (found && !from_above)
            first = ++atlas->branches;
        if (found && first)
            status = follow_curve(range, path, first, atlas, &left);
        dynamics_continuation_free(path);
        if (!first)
            break;
    }
    return status;
}

ff_status dynamics_harmonics_atlas_build(const dynamics_harmonics_range *range,
                                         dynamics_harmonics_atlas *atlas)
{
    int left;
    *atlas = (dynamics_harmonics_atlas){0};
    ff_status status = add_curve(range, 0, atlas, &left);
    if (status == FF_OK && left != 1) /* the curve from the low end did not reach the other */
        status = add_curve(range, 1, atlas, &left);
    for (int i = 1; i < INNER_SPEEDS && status == FF_OK; i++)
        status = add_inner_curve(
            range, range->low * pow(range->high / range->low, (double)i / INNER_SPEEDS), atlas);
    return status;
}

void dynamics_harmonics_atlas_free(dynamics_harmonics_atlas *atlas)
{
    free(atlas->point);
    free(atlas->fold);
    free(atlas->doubling);
}

static ff_status put_events(const dynamics_harmonics_event *events, size_t count, uint32_t first,
                            double frequency, const ff_host *host)
{
    double *at = ff_put_series(host, first, count), *branch = ff_put_series(host, first + 1, count);
    if (!at || !branch)
        return FF_NOMEM;
    for (size_t i = 0; i < count; i++) {
        at[i] = events[i].w * frequency;
        branch[i] = events[i].branch;
    }
    return FF_OK;
}

ff_status dynamics_harmonics_atlas_put(const dynamics_harmonics_atlas *atlas,
                                       const dynamics_excitation *excitation, double frequency,
                                       const ff_host *host)
{
    dynamics_atlas_columns c;
    if (!dynamics_atlas_columns_open(&c, atlas->points, host))
        return FF_NOMEM;
    for (size_t i = 0; i < atlas->points; i++) {
        const dynamics_harmonics_point *p = &atlas->point[i];
        c.frequency[i] = p->w * frequency;
        c.rms[i] = p->rms * excitation->length;
        c.stable[i] = p->stable;
        c.branch[i] = p->branch;
        c.floquet[i] = fmin(p->floquet, 1e300);
    }
    ff_status status =
        put_events(atlas->fold, atlas->folds, DYNAMICS_OUT_FOLD_FREQUENCY, frequency, host);
    return status == FF_OK ? put_events(atlas->doubling, atlas->doublings,
                                        DYNAMICS_OUT_DOUBLING_FREQUENCY, frequency, host)
                           : status;
}
