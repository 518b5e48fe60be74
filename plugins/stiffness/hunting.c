/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Solves all mesh cycles of a hunting period. */
#include "hunting.h"

#include "contact-point.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* Returns the Hertz pressure of a line contact (Johnson 1985, eq. 4.45): p = sqrt(f Er/(pi R b)),
   1/Er = sum of (1 - nu^2)/E. */
static double pressure_of(const stiffness_gears *g, double force, double age)
{
    double softness = 0;
    for (int k = 0; k < 2; k++)
        softness +=
            (1 - g->gear[k].poisson_ratio * g->gear[k].poisson_ratio) / g->gear[k].elastic_modulus;
    return sqrt(force / (M_PI * softness * stiffness_gears_curvature(g, age) * g->width));
}

/* Returns the mesh cycle in which a pair entered contact that has the age `age` at this phase of
   `cycle`. A pair that is at SAP at the end of `cycle` enters in the next cycle. */
static size_t entered_in(size_t period, size_t cycle, double age, double phase)
{
    long number = ((long)cycle - lround(age - phase)) % (long)period;
    return (size_t)(number < 0 ? number + (long)period : number);
}

/* Records the pressure on the pairs on the path of contact. Beyond the path a tip corner meets the
   flank, and Hertz's theory does not hold. */
static void note_pairs(const stiffness_source *s, const stiffness_loaded *r, size_t cycle,
                       double phase, stiffness_hunting *h)
{
    for (size_t i = 0; i < r->at.count; i++) {
        double age = r->at.age[i];
        if (age < 0 || age > s->conditions->gears.contact_ratio || !(r->sharing.force[i] > 0))
            continue;
        size_t number = entered_in(h->period, cycle, age, phase);
        double pressure = pressure_of(&s->conditions->gears, r->sharing.force[i], age);
        h->pressure[number] = fmax(h->pressure[number], pressure);
    }
}

static ff_status scan_cycle(const stiffness_source *s, const stiffness_cycle *grid, size_t cycle,
                            stiffness_hunting *h)
{
    stiffness_error_range here = {INFINITY, -INFINITY};
    for (size_t i = 0; i < grid->count; i++) {
        stiffness_loaded r =
            stiffness_source_solve(s, cycle, grid->phase[i], stiffness_cycle_side(grid, i));
        if (!r.solved)
            return ff_failf(s->host, FF_INVALID, s->fault,
                            "in mesh cycle %zu at phase %g the teeth cannot carry F = %g N", cycle,
                            grid->phase[i], s->conditions->path.line_force);
        double error = r.sharing.unloaded + r.sharing.deflection;
        here.low = fmin(here.low, error);
        here.high = fmax(here.high, error);
        note_pairs(s, &r, cycle, grid->phase[i], h);
    }
    h->all.low = fmin(h->all.low, here.low);
    h->all.high = fmax(h->all.high, here.high);
    h->narrowest = fmin(h->narrowest, here.high - here.low);
    return FF_OK;
}

ff_status stiffness_hunting_scan(const stiffness_source *s, const stiffness_cycle *grid,
                                 stiffness_hunting *h)
{
    enum { REPORT_EVERY = 64 }; /* mesh cycles */
    *h = (stiffness_hunting){.period = stiffness_hunting_period(&s->conditions->deviations),
                             .all = {INFINITY, -INFINITY},
                             .narrowest = INFINITY};
    h->pressure = calloc(h->period, sizeof *h->pressure);
    ff_status status = h->pressure ? FF_OK : FF_NOMEM;
    for (size_t cycle = 0; cycle < h->period && status == FF_OK; cycle++) {
        status = scan_cycle(s, grid, cycle, h);
        if (cycle % REPORT_EVERY == 0 && status == FF_OK &&
            s->host->progress(s->host->ctx, (double)cycle / (double)h->period) != 0)
            status = FF_STOPPED;
    }
    for (size_t cycle = 1; cycle < h->period && status == FF_OK; cycle++)
        if (h->pressure[cycle] > h->pressure[h->worst])
            h->worst = cycle;
    for (int g = 0; g < 2; g++)
        h->teeth[g] = h->worst % (size_t)lround(s->conditions->gears.gear[g].teeth) + 1;
    return status;
}

void stiffness_hunting_report(const stiffness_source *s, const stiffness_hunting *h, size_t number)
{
    const double limit = 0.01, alike = 1.1;
    char text[320];
    double more = h->pressure[h->worst] / h->pressure[number] - 1;
    snprintf(text, sizeof text,
             "relative excess of the Hertz pressure in mesh cycle %zu, %.4g MPa, over that in "
             "cycle %zu. It is the highest of the %zu mesh cycles of the hunting period, of tooth "
             "%zu of gear 1 and tooth %zu of gear 2; mesh_cycle: worst or all outputs it",
             h->worst, 1e-6 * h->pressure[h->worst], number, h->period, h->teeth[0], h->teeth[1]);
    s->host->quality(s->host->ctx, "worst_pair", more, limit, more <= limit ? FF_GOOD : FF_DOUBTFUL,
                     text);
    double swing = (h->all.high - h->all.low) / fmax(h->narrowest, 1e-300);
    snprintf(text, sizeof text,
             "range of the loaded transmission error over all %zu mesh cycles, %.3g um, over the "
             "smallest range within one mesh cycle; above 1.1 the index deviations excite "
             "vibrations that a motion with the period of one mesh cycle lacks",
             h->period, 1e6 * (h->all.high - h->all.low));
    s->host->quality(s->host->ctx, "index_excitation", swing, alike,
                     swing <= alike ? FF_GOOD : FF_DOUBTFUL, text);
}
