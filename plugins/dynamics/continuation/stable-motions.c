/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "stable-motions.h"

#include "../orbits/attractor.h"
#include "../oscillator/motion.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { STARTS = 16, LEAST_CYCLES = 32 };

/* Longest mesh cycle, in radians of the natural frequency, for which further starts are tried. In a
   longer cycle every vibration decays before the next cycle begins, so that further starts would
   find no other motion. */
static const double slow_cycle = 2000;
/* Longest time that a start gets to settle, in radians of the natural frequency. */
static const double longest_settling = 3000;

static int is_known(const dynamics_flow *flow, const dynamics_orbit *orbit,
                    const dynamics_known_motions *known)
{
    static const double same = 1e-6; /* in units of dynamics_state_unit */
    double distance;
    for (size_t i = 0; i < known->count; i++)
        if (known->orbits[i].period == orbit->period &&
            dynamics_orbit_distance(flow, &known->orbits[i], orbit->x, &distance) &&
            distance < same)
            return 1;
    return 0;
}

int dynamics_known_motions_add(const dynamics_flow *flow, const dynamics_orbit *orbit,
                               dynamics_known_motions *known)
{
    dynamics_orbit o = *orbit;
    if (!(dynamics_largest_multiplier(&o) < 1 - 1e-9))
        return 1;
    dynamics_orbit_reduce(flow, &o);
    if (is_known(flow, &o, known))
        return 1;
    if (known->count == known->capacity) {
        size_t capacity = known->capacity ? 2 * known->capacity : 16;
        dynamics_orbit *more = realloc(known->orbits, capacity * sizeof *more);
        if (!more)
            return 0;
        known->orbits = more;
        known->capacity = capacity;
    }
    known->orbits[known->count++] = o;
    return 1;
}

void dynamics_known_motions_free(dynamics_known_motions *known)
{
    free(known->orbits);
    *known = (dynamics_known_motions){.count = 0};
}

static int add_if_periodic(const dynamics_flow *flow, const dynamics_attractor *a,
                           dynamics_known_motions *known)
{
    return a->period <= 0 || dynamics_known_motions_add(flow, &a->orbit, known);
}

int dynamics_known_motions_add_atlas(const dynamics_flow *flow, const dynamics_atlas *atlas,
                                     double lambda, dynamics_known_motions *known)
{
    size_t before = known->count;
    for (size_t i = 0; i < atlas->branch_count; i++) {
        dynamics_orbit orbit;
        if (atlas->branches[i].stable &&
            dynamics_atlas_orbit(flow, atlas, &atlas->branches[i], lambda, &orbit) &&
            !dynamics_known_motions_add(flow, &orbit, known))
            return 0;
    }
    known->of_atlas = known->count - before;
    return 1;
}

/* Collects the motions of both branches and the motions to which evenly spread starts lead. */
static ff_status search(const dynamics_flow *flow, double lambda, const ff_host *host,
                        dynamics_known_motions *f)
{
    double T = dynamics_cycle_duration(lambda);
    if (T > dynamics_longest_cycle)
        return ff_failf(host, FF_NOCONV, "operating.mesh_frequency",
                        "the mesh frequency is so far below the natural frequency that vibrations "
                        "are not computed, so stable_motions cannot be counted");
    dynamics_search one = {lambda, DYNAMICS_PERIOD_MAX,
                           dynamics_settle_limit(flow->excitation, T, 1e-4), 0};
    for (int branch = DYNAMICS_BRANCH_LOWER; branch <= DYNAMICS_BRANCH_UPPER; branch++) {
        dynamics_attractor a = {.period = DYNAMICS_APERIODIC};
        ff_status status = dynamics_attract_branch(flow, (dynamics_branch)branch, &one, host, &a);
        if (status == FF_OK && !add_if_periodic(flow, &a, f))
            return FF_NOMEM;
        if (status != FF_OK && status != FF_NOCONV)
            return status;
    }
    one.cycles = dynamics_settle_limit(flow->excitation, T, 1e-2);
    double most = fmax(longest_settling / T, LEAST_CYCLES);
    if ((double)one.cycles > most)
        one.cycles = (size_t)most;
    for (size_t i = 0; i < STARTS && T < slow_cycle; i++) {
        dynamics_attractor a = {.period = DYNAMICS_APERIODIC};
        if (host->progress(host->ctx, (double)i / STARTS))
            return FF_STOPPED;
        dynamics_search_start(flow->excitation, i, a.x);
        if (dynamics_attract(flow, &one, &a) && !add_if_periodic(flow, &a, f))
            return FF_NOMEM;
    }
    return FF_OK;
}

static void report(const dynamics_flow *flow, const dynamics_known_motions *f, const ff_host *host)
{
    char text[400] = "no stable periodic motion was found";
    size_t used = 0;
    if (f->count > 0)
        used = (size_t)snprintf(
            text, sizeof text,
            f->count > 1 ? "%zu stable motions coexist:" : "%zu stable motion:", f->count);
    for (size_t i = 0; i < f->count && used < sizeof text - 60; i++) {
        double rms;
        if (dynamics_orbit_rms(flow, &f->orbits[i], &rms))
            used += (size_t)snprintf(text + used, sizeof text - used,
                                     "%s period %d with a dte rms of %.4g um", i ? "," : "",
                                     f->orbits[i].period, 1e6 * rms * flow->excitation->length);
    }
    host->quality(host->ctx, "stable_motions", (double)f->count, 1, FF_GOOD, text);
}

ff_status dynamics_known_motions_find(const dynamics_flow *flow, double lambda,
                                      const dynamics_atlas *atlas, const ff_host *host,
                                      dynamics_known_motions *known)
{
    ff_status status = search(flow, lambda, host, known);
    if (status == FF_OK && atlas && !dynamics_known_motions_add_atlas(flow, atlas, lambda, known))
        status = FF_NOMEM;
    return status;
}

int dynamics_known_motions_largest(const dynamics_flow *flow, const dynamics_known_motions *known,
                                   dynamics_orbit *orbit)
{
    double most = -1, rms;
    for (size_t i = 0; i < known->count; i++)
        if (dynamics_orbit_rms(flow, &known->orbits[i], &rms) && rms > most) {
            most = rms;
            *orbit = known->orbits[i];
        }
    return most >= 0;
}

ff_status dynamics_known_motions_put(const dynamics_flow *flow, const dynamics_known_motions *known,
                                     const ff_host *host)
{
    report(flow, known, host);
    return ff_put_scalar(host, DYNAMICS_OUT_STABLE_MOTIONS, (double)known->count);
}

ff_status dynamics_stable_motions_put(const dynamics_excitation *excitation, double frequency,
                                      const ff_host *host)
{
    dynamics_flow flow = {0};
    dynamics_known_motions known = {.count = 0};
    ff_status status = dynamics_flow_init(&flow, excitation) ? FF_OK : FF_NOMEM;
    if (status == FF_OK)
        status = dynamics_known_motions_find(&flow, log(frequency), NULL, host, &known);
    if (status == FF_OK)
        status = dynamics_known_motions_put(&flow, &known, host);
    dynamics_known_motions_free(&known);
    dynamics_flow_free(&flow);
    return status;
}
