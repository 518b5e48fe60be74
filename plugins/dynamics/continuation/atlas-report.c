/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "atlas-report.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

int dynamics_branch_parse(const char *text, dynamics_branch_name *name)
{
    int length = 0;
    int fields = sscanf(text, "p%1d-%4d%n", &name->period, &name->number, &length);
    return fields == 2 && !text[length] && name->period >= 1 &&
           name->period <= DYNAMICS_PERIOD_MAX && name->number >= 1;
}

static double number_of(const dynamics_branch_name *name)
{
    return 1000.0 * name->period + name->number;
}

void dynamics_atlas_list(const dynamics_flow *flow, const dynamics_atlas *atlas, double lambda,
                         char *text, size_t size)
{
    size_t used = 0;
    text[0] = '\0';
    for (size_t i = 0; i < atlas->branch_count && used + 24 < size; i++) {
        const dynamics_atlas_branch *b = &atlas->branches[i];
        dynamics_orbit orbit;
        if (!dynamics_atlas_orbit(flow, atlas, b, lambda, &orbit))
            continue;
        int n = snprintf(text + used, size - used, "%sp%d-%d%s", used ? ", " : "", b->name.period,
                         b->name.number, dynamics_orbit_is_stable(&orbit) ? "" : " unstable");
        used += n > 0 ? (size_t)n : 0;
    }
    if (!used)
        snprintf(text, size, "none");
}

static ff_status put_points(const dynamics_atlas *atlas, const dynamics_excitation *excitation,
                            double frequency, const ff_host *host)
{
    size_t count = 0, n = 0;
    dynamics_atlas_columns c;
    for (size_t i = 0; i < atlas->branch_count; i++)
        count += atlas->branches[i].last - atlas->branches[i].first + 1;
    if (!dynamics_atlas_columns_open(&c, count, host))
        return FF_NOMEM;
    for (size_t i = 0; i < atlas->branch_count; i++) {
        const dynamics_atlas_branch *b = &atlas->branches[i];
        for (size_t k = b->first; k <= b->last; k++, n++) {
            const dynamics_point *p = &atlas->curves[b->curve].points[k];
            c.frequency[n] = frequency * exp(p->lambda);
            c.rms[n] = p->rms * excitation->length;
            c.floquet[n] = p->largest;
            c.stable[n] = p->largest < dynamics_stable_multiplier;
            c.branch[n] = number_of(&b->name);
        }
    }
    return FF_OK;
}

/* Writes the outputs of the folds or of the period doublings. A fold ends one branch and begins the
   next; it is listed with the branch that it ends. */
static ff_status put_events(const dynamics_atlas *atlas, double frequency, int kind, uint32_t at,
                            uint32_t branch, const ff_host *host)
{
    double *out[2] = {NULL, NULL};
    size_t n = 0;
    for (int pass = 0; pass < 2; pass++) {
        if (pass == 1) {
            out[0] = ff_put_series(host, at, n);
            out[1] = ff_put_series(host, branch, n);
            if (!out[0] || !out[1])
                return n ? FF_NOMEM : FF_OK;
            n = 0;
        }
        for (size_t i = 0; i < atlas->branch_count; i++) {
            const dynamics_atlas_branch *b = &atlas->branches[i];
            for (size_t k = b->first + 1; k <= b->last; k++) {
                const dynamics_point *p = &atlas->curves[b->curve].points[k];
                if (p->kind != kind)
                    continue;
                if (pass == 1) {
                    out[0][n] = frequency * exp(p->lambda);
                    out[1][n] = number_of(&b->name);
                }
                n++;
            }
        }
    }
    return FF_OK;
}

ff_status dynamics_atlas_put(const dynamics_atlas *atlas, const dynamics_excitation *excitation,
                             double frequency, const ff_host *host)
{
    ff_status status = put_points(atlas, excitation, frequency, host);
    if (status == FF_OK)
        status = put_events(atlas, frequency, DYNAMICS_POINT_FOLD, DYNAMICS_OUT_FOLD_FREQUENCY,
                            DYNAMICS_OUT_FOLD_BRANCH, host);
    if (status == FF_OK)
        status = put_events(atlas, frequency, DYNAMICS_POINT_DOUBLING,
                            DYNAMICS_OUT_DOUBLING_FREQUENCY, DYNAMICS_OUT_DOUBLING_BRANCH, host);
    return status;
}

static void report_curves(const dynamics_atlas *atlas, const ff_host *host)
{
    size_t ends[DYNAMICS_END_COUNT] = {0}, total = 2 * atlas->curve_count;
    char text[256];
    for (size_t i = 0; i < atlas->curve_count; i++) {
        ends[atlas->curves[i].first]++;
        ends[atlas->curves[i].last]++;
    }
    size_t lost = ends[DYNAMICS_END_STUCK] + ends[DYNAMICS_END_LOOP] + ends[DYNAMICS_END_CROWDED];
    snprintf(
        text, sizeof text,
        "%zu curve ends: %zu at the ends of the range, %zu where the curve closes, %zu where the "
        "curve meets half its period, %zu at 100 times the sum of half backlash and static "
        "deflection%s",
        total, ends[DYNAMICS_END_RANGE], ends[DYNAMICS_END_CLOSED], ends[DYNAMICS_END_HALVED],
        ends[DYNAMICS_END_CAP], lost ? "; the remaining curve ends were not followed further" : "");
    host->quality(host->ctx, "atlas_lost_ends", (double)lost, 0, lost ? FF_DOUBTFUL : FF_GOOD,
                  text);
}

/* Reports an estimate of the share of starts that would lead to motions not yet found: the share of
   starts whose motion was found only once (Good 1953, Biometrika 40, 237-264, eq. 9). Starts that
   have not settled may lead to any motion. */
static void report_unseen(const dynamics_atlas *atlas, const ff_host *host)
{
    char text[320];
    size_t open = atlas->starts - atlas->settled - atlas->unbounded;
    double unseen = atlas->settled ? (double)atlas->met_once / (double)atlas->settled : 1;
    snprintf(text, sizeof text,
             "the search found %zu curves, %zu of them from one start only, so that about %.2g %% "
             "of all starts lead to curves that are not in the atlas; this may also hold for the "
             "%zu starts of %zu that had not settled; a larger search_starts or search_speeds "
             "finds more",
             atlas->searched, atlas->met_once, 100 * unseen, open, atlas->starts);
    host->quality(host->ctx, "atlas_unseen", unseen, 1, FF_GOOD, text);
}

static void report_search(const dynamics_atlas *atlas, const ff_host *host)
{
    char text[256];
    if (!atlas->starts)
        return;
    snprintf(
        text, sizeof text,
        "%zu of %zu starts of the search led to a periodic motion, %zu grew without bound, and "
        "the others had not settled after %d mesh cycles",
        atlas->settled, atlas->starts, atlas->unbounded, DYNAMICS_SEARCH_CYCLES);
    host->quality(host->ctx, "atlas_settled_starts", (double)atlas->settled / (double)atlas->starts,
                  1, FF_GOOD, text);
    report_unseen(atlas, host);
}

static void report_branches(const dynamics_flow *flow, const dynamics_atlas *atlas, double lambda,
                            const dynamics_orbit *orbit, const ff_host *host)
{
    char names[300], text[400];
    const dynamics_atlas_branch *b = orbit ? dynamics_atlas_locate(flow, atlas, orbit) : NULL;
    dynamics_atlas_list(flow, atlas, lambda, names, sizeof names);
    snprintf(text, sizeof text, "motions at this speed: %s", names);
    if (b)
        snprintf(text, sizeof text,
                 "this motion is on branch p%d-%d; the motions at this speed "
                 "are: %s",
                 b->name.period, b->name.number, names);
    host->quality(host->ctx, "atlas_branch", b ? 1000.0 * b->name.period + b->name.number : 0, 0,
                  FF_GOOD, text);
}

void dynamics_atlas_report(const dynamics_flow *flow, const dynamics_atlas *atlas, double lambda,
                           const dynamics_orbit *orbit, const ff_host *host)
{
    report_curves(atlas, host);
    report_search(atlas, host);
    report_branches(flow, atlas, lambda, orbit, host);
}
