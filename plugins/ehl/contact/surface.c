/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "surface.h"

#include "../../surface/roughness.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static ff_status check(const ehl_roughness *r, const double *position, const ff_host *host)
{
    if (r->count < 2)
        return ff_failf(host, FF_INVALID, "surface.position",
                        "a record needs at least two points, but it has %zu", r->count);
    double spacing = position[1] - position[0];
    for (size_t i = 0; i < r->count; i++)
        if (!(spacing > 0) ||
            !(fabs(position[i] - (double)i * spacing) <= 1e-6 * spacing * (double)r->count))
            return ff_failf(host, FF_INVALID, "surface.position",
                            "the positions must increase from 0 in equal steps; point %zu is at %g "
                            "m",
                            i, position[i]);
    for (int g = 0; g < 2; g++)
        for (size_t i = 0; i < r->count; i++)
            if (!(fabs(r->height[g][i]) < 1e-2))
                return ff_failf(host, FF_INVALID, g ? "surface.height_2" : "surface.height_1",
                                "height %zu is %g m, but must be below 1 cm", i, r->height[g][i]);
    double whole = (double)r->count * spacing;
    if (!(fabs(r->period) <= 0) && !(fabs(r->period - whole) <= 1e-3 * spacing))
        return ff_failf(host, FF_INVALID, "surface.period",
                        "the period must be 0 or the number of points times their step, %g m, but "
                        "it is %g m",
                        whole, r->period);
    if (!(fabs(r->origin) < 1e6))
        return ff_failf(host, FF_INVALID, "surface.origin", "the origin is not a finite length");
    return FF_OK;
}

static void integrate(ehl_roughness *r)
{
    const ehl_history *h = r->history;
    for (int g = 0; g < 2; g++) {
        const double *z = r->height[g], *u = g ? h->speed_2 : h->speed_1;
        for (size_t i = 0; i < r->count; i++) /* the first point follows the last point, since the
                                                 record repeats */
            r->sum[g][i + 1] =
                r->sum[g][i] + r->spacing * (z[i] + z[i + 1 < r->count ? i + 1 : 0]) / 2;
        for (size_t i = 1; i < h->count; i++)
            r->travel[g][i] =
                r->travel[g][i - 1] + (h->time[i] - h->time[i - 1]) * (u[i] + u[i - 1]) / 2;
    }
}

static double curvature(const ehl_roughness *r)
{
    double sum = 0;
    for (int g = 0; g < 2; g++)
        for (size_t i = 1; i + 1 < r->count; i++) {
            const double *z = r->height[g] + i;
            double bend = (z[-1] - 2 * z[0] + z[1]) / (r->spacing * r->spacing);
            sum += bend * bend;
        }
    return sqrt(sum / fmax(1, (double)r->count - 2));
}

ff_status ehl_roughness_create(ehl_roughness *r, const double *position, const ehl_history *h,
                               const ff_host *host)
{
    ff_status status = check(r, position, host);
    if (status != FF_OK)
        return status;
    size_t each = r->count + 1;
    r->spacing = position[r->count - 1] / (double)(r->count - 1);
    r->history = h;
    double *next = r->memory = calloc(2 * (each + h->count), sizeof *next);
    if (!next)
        return FF_NOMEM;
    for (int g = 0; g < 2; g++, next += each + h->count) {
        r->sum[g] = next;
        r->travel[g] = next + each;
    }
    integrate(r);
    r->curvature = curvature(r);
    return FF_OK;
}

void ehl_roughness_destroy(ehl_roughness *r)
{
    free(r->memory);
    free(r->smooth);
    r->memory = r->smooth = NULL;
}

/* Returns the root mean square deviation from the mean. */
static double rms(size_t n, const double *z)
{
    double mean = 0, square = 0;
    for (size_t i = 0; i < n; i++)
        mean += z[i] / (double)n;
    for (size_t i = 0; i < n; i++)
        square += (z[i] - mean) * (z[i] - mean) / (double)n;
    return sqrt(square);
}

/* Copies both flanks. A record with flat ends is extended by `beyond` points of height 0 on either
   side, since the filter spreads heights near the ends beyond them. */
static ff_status make_smooth(ehl_roughness *r, size_t beyond)
{
    size_t n = r->count + 2 * beyond, each = n + 1;
    r->smooth = calloc(4 * each, sizeof *r->smooth);
    if (!r->smooth)
        return FF_NOMEM;
    for (size_t g = 0; g < 2; g++) {
        double *z = r->smooth + g * n;
        memcpy(z + beyond, r->height[g], r->count * sizeof *z);
        r->height[g] = z;
        r->sum[g] = r->smooth + 2 * n + g * each;
    }
    r->count = n;
    r->origin += (double)beyond * r->spacing;
    return FF_OK;
}

ff_status ehl_roughness_cut(ehl_roughness *r, double cutoff, const ff_host *host)
{
    const double most = 1 << 21; /* larger than any real record */
    const double reach = cutoff / r->spacing, beyond = r->period > 0 ? 0 : ceil(reach) + 1;
    double square = 0, whole = 0;
    if (beyond > most)
        return ff_failf(host, FF_INVALID, "surface.position",
                        "the points of the surface are %.3g um apart, too close to remove waves of "
                        "%.3g um: reduce roughness_cutoff to at most %.3g um, or increase the "
                        "spacing of the surface",
                        1e6 * r->spacing, 1e6 * cutoff, 1e6 * most * r->spacing);
    for (size_t g = 0; g < 2; g++)
        whole += pow(rms(r->count, r->height[g]), 2);
    const double *was[2] = {r->height[0], r->height[1]};
    const size_t count = r->count, first = (size_t)beyond;
    ff_status status = make_smooth(r, first);
    for (size_t g = 0; g < 2 && status == FF_OK; g++) {
        double *z = r->smooth + g * r->count;
        status = surface_remove_shorter(r->count, reach, SURFACE_REPEATED, z);
        for (size_t i = 0; i < r->count && status == FF_OK; i++) {
            double off = z[i] - (i >= first && i - first < count ? was[g][i - first] : 0);
            square += off * off / (double)count;
        }
    }
    if (status != FF_OK)
        return status;
    r->cutoff = cutoff;
    r->given = sqrt(whole);
    r->left_out = sqrt(square);
    integrate(r);
    r->curvature = curvature(r);
    return FF_OK;
}

double ehl_roughness_wavelength(const ehl_roughness *r)
{
    size_t most = 0;
    for (int g = 0; g < 2; g++) {
        const double *z = r->height[g];
        size_t peaks = 0;
        for (size_t i = 1; i + 1 < r->count; i++)
            peaks += z[i] > z[i - 1] && z[i] >= z[i + 1];
        most = peaks > most ? peaks : most;
    }
    double length = (double)r->count * r->spacing;
    return most > 0 ? length / (double)most : length;
}

double ehl_roughness_inlet(const ehl_roughness *r, double film)
{
    return r->curvature > 0 ? sqrt(2 * film / r->curvature) : HUGE_VAL;
}

/* Returns the mean square of the k-th harmonic of n values. */
static double harmonic(const double *z, size_t n, size_t k)
{
    const double turn = 2 * 3.14159265358979323846 * (double)k / (double)n;
    const double step_c = cos(turn), step_s = sin(turn);
    double c = 1, s = 0, sum_c = 0, sum_s = 0;
    for (size_t i = 0; i < n; i++) {
        double next = c * step_c - s * step_s;
        sum_c += z[i] * c;
        sum_s += z[i] * s;
        s = s * step_c + c * step_s;
        c = next;
    }
    return 2 * (sum_c * sum_c + sum_s * sum_s) / ((double)n * (double)n);
}

double ehl_roughness_longer(const ehl_roughness *r, double length)
{
    const double whole = (double)r->count * r->spacing, most = 5e7 / (double)r->count;
    const double last = fmin(ceil(whole / length) - 1, most);
    double all = 0, longer = 0;
    for (int g = 0; g < 2; g++) {
        all += pow(rms(r->count, r->height[g]), 2);
        for (size_t k = 1; (double)k <= last && 2 * k < r->count; k++)
            longer += harmonic(r->height[g], r->count, k);
    }
    return all > 0 ? longer / all : 0;
}

double ehl_roughness_beyond(const ehl_roughness *r)
{
    const double end = (double)(r->count - 1) * r->spacing;
    double all = 0, beyond = 0;
    for (size_t g = 0; g < 2 && r->period <= 0; g++) {
        double way = r->rq[g] > 0 ? r->travel[g][r->history->count - 1] : 0;
        double low = r->origin - fmax(way, 0), high = r->origin - fmin(way, 0);
        all += high - low;
        beyond += high - low - fmax(0, fmin(high, end) - fmax(low, 0));
    }
    return all > 0 ? beyond / all : 0;
}

double ehl_roughness_rq(const ehl_roughness *r)
{
    return hypot(r->rq[0], r->rq[1]);
}

/* Returns the integral of u_i from the first time, exact for speeds that are linear between
   rows. */
static double travelled(const ehl_roughness *r, int g, double time)
{
    const ehl_history *h = r->history;
    const double *u = g ? h->speed_2 : h->speed_1;
    size_t next = ehl_history_rows_before(h, time), i = next > 0 ? next - 1 : 0;
    double since = time - h->time[i], rise = 0;
    if (next > 0 && next < h->count)
        rise = (u[next] - u[i]) / (h->time[next] - h->time[i]);
    return r->travel[g][i] + since * (u[i] + rise * since / 2);
}

double ehl_roughness_travel(const ehl_roughness *r, double time)
{
    return fabs(travelled(r, 0, time) + travelled(r, 1, time)) / 2 *
           (time < r->history->time[0] ? -1 : 1);
}

/* Returns the integral of the heights of the record from 0 to `place` (in spacings). The height is
   linear between samples. */
static inline double integral(const ehl_roughness *r, int g, double place)
{
    const double *z = r->height[g], *sum = r->sum[g];
    const size_t last = r->period > 0 ? r->count : r->count - 1;
    if (!(place > 0))
        return 0;
    if (!(place < (double)last))
        return sum[last];
    size_t i = (size_t)place;
    double part = place - (double)i, next = z[i + 1 < r->count ? i + 1 : 0];
    return sum[i] + r->spacing * part * (z[i] + part * (next - z[i]) / 2);
}

/* Adds the mean heights of a flank over consecutive cells, starting at the arc coordinate s. With a
   negative width the coordinate decreases. */
static void add_flank(const ehl_roughness *r, int g, double s, double width, size_t nodes,
                      double *sum)
{
    const int repeats = r->period > 0;
    const double cycle = (double)r->count, all = r->sum[g][r->count], step = width / r->spacing;
    const double per_width = 1 / width;
    double start = s / r->spacing, gone = 0;
    if (repeats)
        start -= cycle * floor(start / cycle);
    double before = integral(r, g, start);
    for (size_t i = 0; i < nodes; i++) {
        double place = start + (double)(i + 1) * step, rest = place - gone * cycle;
        if (repeats && !(rest >= 0 && rest <= cycle))
            gone = floor(place / cycle);
        double behind = gone * all + integral(r, g, place - gone * cycle);
        sum[i] += (behind - before) * per_width;
        before = behind;
    }
}

/* Returns the factor on the height, from 1 to 0, at the distance `beyond` from the start of the
   transition. The slope of the factor is 0 at both ends of the transition. */
static double run_in(const ehl_roughness *r, double beyond)
{
    double share = fmin(fmax(1 - beyond / r->ramp, 0), 1);
    return share * share * (3 - 2 * share);
}

void ehl_roughness_heights(const ehl_roughness *r, const ehl_grid *g, double time, double *sum)
{
    double sign = r->history->mirrored ? -1 : 1;
    memset(sum, 0, g->nodes * sizeof *sum);
    for (int flank = 0; flank < 2; flank++) {
        double start = r->origin - travelled(r, flank, time), width = sign * g->dx;
        add_flank(r, flank, start + sign * g->first - width / 2, width, g->nodes, sum);
    }
    double front = r->front + ehl_roughness_travel(r, time);
    for (size_t i = 0; r->ramp > 0 && i < g->nodes; i++)
        sum[i] *= run_in(r, g->first + (double)i * g->dx - front);
}

ff_status ehl_combined_roughness(const ff_host *host, const ff_array *gear, const ff_array *rq_1,
                                 const ff_array *rq_2, double *rq)
{
    *rq = 0;
    if (rq_1->data || rq_2->data) {
        *rq = hypot(rq_1->data ? *rq_1->data : 0, rq_2->data ? *rq_2->data : 0);
        if (!isfinite(*rq))
            return ff_failf(host, FF_INVALID, "surface.rq_1",
                            "the roughness is not a finite length");
        return FF_OK;
    }
    if (!gear->data)
        return FF_OK;
    if (gear->shape[0] != 2)
        return ff_failf(host, FF_INVALID, "gear.roughness", "two values are needed, not %zu",
                        gear->shape[0]);
    for (int i = 0; i < 2; i++)
        if (!(gear->data[i] >= 0 && isfinite(gear->data[i])))
            return ff_failf(host, FF_INVALID, "gear.roughness",
                            "the roughness of gear %d must be finite and not negative", i + 1);
    *rq = hypot(gear->data[0], gear->data[1]);
    return FF_OK;
}

ff_status ehl_lambda_check(const ff_host *host, uint64_t wanted, uint32_t output, const char *name,
                           double rq)
{
    if (!(wanted & FF_BIT(output)) || rq > 0)
        return FF_OK;
    return ff_failf(host, FF_UNSUPPORTED, name,
                    "this output needs the roughness of the flanks: give roughness_rq or "
                    "roughness_ra to the gear stage, or wire a surface that is not flat");
}

ff_status ehl_read_hardness(const ff_host *host, const ff_array *gears, double otherwise,
                            double *hardness)
{
    *hardness = gears->data ? HUGE_VAL : otherwise;
    for (size_t i = 0; gears->data && i < gears->shape[0]; i++) {
        if (!(gears->data[i] > 0))
            return ff_failf(host, FF_INVALID, "gear.hardness",
                            "the hardness of gear %zu is not known, but rough flanks need it; give "
                            "hardness to the gear stage, or name the material",
                            i + 1);
        *hardness = fmin(*hardness, gears->data[i]);
    }
    return FF_OK;
}

void ehl_lambda_carried(const ff_host *host, double lowest)
{
    host->quality(host->ctx, "lambda", lowest, 0, FF_GOOD,
                  "lowest film thickness over the roughness of the flanks; their asperities carry "
                  "a share of the load");
}

void ehl_lambda_report(const ff_host *host, double lowest)
{
    host->quality(host->ctx, "lambda", lowest, EHL_MIXED_BELOW,
                  lowest < EHL_MIXED_BELOW ? FF_RANGE : FF_GOOD,
                  "lowest film thickness over the roughness of the flanks; below 3 asperities "
                  "touch, but this smooth film neglects them and their friction: add "
                  "surface/statistical, or another stage of the kind surface");
}
