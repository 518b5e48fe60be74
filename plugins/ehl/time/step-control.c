/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "step-control.h"

#include "../equations/advection.h"
#include "contact-loss.h"
#include "time-stepper.h"
#include "trial.h"
#include "truncation.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* A change of the slope of the load by this share of the largest load per passage is a
   breakpoint. */
static const double SHARP_BREAKPOINT = 0.25;
/* A change of the slope R' of the radius is a breakpoint if it is this share of the entrainment u.
   The flow squeezed from x on, x^3 R'/(6 R^2), then changes by a twelfth of u x^2/(2 R) at x = R,
   which is farther out than most domains begin. */
static const double SHARP_BEND = 0.25;
/* First step after a breakpoint, as a share of the passage time. */
static const double FIRST_STEP = 5e-4;
/* Shortest steps, in units of dx/u: SHORT_STEP if chosen for the truncation error, SHORTEST_STEP if
   needed for convergence. */
static const double SHORT_STEP = 0.02, SHORTEST_STEP = 1e-4;

/* The error that the solver leaves in the flow enters the truncation error, which is computed from
 * differences of films. Its share of the allowed error grows as steps become shorter. A step is
 * futile if it repeats a longer one without a proportionally smaller error, or if it is the
 * shortest and exceeds the allowed error. After MOST_FUTILE of them, more than occur at a kink, the
 * solver must reduce its error by the factor STRICTER, down to STRICTEST of the usual one. CALM
 * steps in a row that are not futile end the count. */
enum { MOST_FUTILE = 12, CALM = 64 };
static const double STRICTER = 0.3, STRICTEST = 0.02;

/* Share of the tolerance by which a straight line between two instants may differ from the film. */
static const double CHORD_SHARE = 1. / 16;
/* A history has at least LEAST_INSTANTS (tolerance/REFERENCE_TOLERANCE)^INSTANTS_EXPONENT steps. */
static const double LEAST_INSTANTS = 100, REFERENCE_TOLERANCE = 5e-3, INSTANTS_EXPONENT = -0.15;

/* A step is repeated if its truncation is above the allowed one by this factor. */
static const double ALLOWED_EXCESS = 2;

/* Truncation allowed while the contact is lost, relative to that under load. It is larger, since
 * the impact at the end squeezes most of that film out. */
static const double CONTACT_LOSS_ALLOWANCE = 10;

static double slope_of_row(const ehl_history *h, const double *y, size_t i)
{
    double span = h->time[i + 1] - h->time[i];
    return span > 0 ? (y[i + 1] - y[i]) / span : 0;
}

/* Returns 1 if at row i the history jumps, its slope changes sharply, or contact is lost or
   regained. */
static int is_breakpoint(const ehl_march *m, size_t i)
{
    const ehl_history *h = m->history;
    double passage = ehl_march_passage(m, fabs(h->speed_1[i] + h->speed_2[i]) / 2);
    double share =
        passage * fabs(slope_of_row(h, h->load, i) - slope_of_row(h, h->load, i - 1)) / h->load_max;
    int lost = ehl_is_lost(h, h->load[i]), before = ehl_is_lost(h, h->load[i - 1]),
        after = ehl_is_lost(h, h->load[i + 1]);
    return share > SHARP_BREAKPOINT || !(h->time[i + 1] > h->time[i]) || lost != before ||
           lost != after;
}

/*
 * Returns 1 if the slope R' of the radius changes sharply at row i, at rest or at creep speed.
 * Flanks far from the contact separate by x^2 R'/(2 R^2), so the rate of change of the film jumps
 * there. (10.2) across the jump gives 3/2 of it, however short the step.
 */
static int radius_bends(const ehl_march *m, size_t i)
{
    const ehl_history *h = m->history;
    double bend = slope_of_row(h, h->radius, i) - slope_of_row(h, h->radius, i - 1);
    int jumps = !(h->time[i] > h->time[i - 1] && h->time[i + 1] > h->time[i]);
    return !jumps && !m->rough &&
           fabs(bend) >
               SHARP_BEND * fmax(fabs(h->speed_1[i] + h->speed_2[i]) / 2, EHL_CREEP * h->speed_max);
}

ff_status ehl_step_control_create(ehl_step_control *p, const ehl_march *m, double tolerance,
                                  int equal)
{
    const ehl_history *h = m->history;
    double passage = ehl_march_passage(m, m->at.entrainment);
    *p = (ehl_step_control){.tolerance = tolerance, .dt = FIRST_STEP * passage};
    p->breakpoint = malloc(h->count * sizeof *p->breakpoint);
    if (!p->breakpoint)
        return FF_NOMEM;
    double apart = 1e-9 * passage, before = m->state[0].time;
    for (size_t i = 1; i + 1 < h->count; i++)
        if (((!equal && is_breakpoint(m, i)) || radius_bends(m, i)) && h->time[i] > before + apart)
            before = p->breakpoint[p->breakpoints++] = h->time[i];
    if (!(h->time[h->count - 1] > before + apart) && p->breakpoints > 0)
        p->breakpoints--;
    p->breakpoint[p->breakpoints++] = h->time[h->count - 1];
    return FF_OK;
}

void ehl_step_control_destroy(ehl_step_control *p)
{
    free(p->breakpoint);
    p->breakpoint = NULL;
}

int ehl_step_control_done(const ehl_step_control *p)
{
    return p->next == p->breakpoints;
}

/* Returns the factor from this step to the next one, if the truncation error of this step was
   `error` times the allowed one. */
static double step_growth(const ehl_march *m, double error)
{
    double order = m->scheme == EHL_EULER ? 1 : 2;
    double factor = 0.85 * pow(fmax(error, 1e-9), -1 / order);
    return fmin(fmax(factor, 0.25), 2);
}

/* Returns the step length at which linear interpolation differs from the film by the allowed
   amount, dt^2/8 h''. If the contact takes many passages to change, a bound on the truncation error
   alone would step over whole extrema. */
static double longest_chord(const ehl_step_control *p, const ehl_march *m)
{
    const ehl_state *s = m->state;
    double least = LEAST_INSTANTS * pow(p->tolerance / REFERENCE_TOLERANCE, INSTANTS_EXPONENT);
    double longest = (p->breakpoint[p->breakpoints - 1] - m->history->time[0]) / least;
    if (m->smooth < 3 || s[0].loaded != s[1].loaded || s[1].loaded != s[2].loaded || m->rough)
        return longest;
    double late = (s[0].thinnest - s[1].thinnest) / (s[0].time - s[1].time),
           early = (s[1].thinnest - s[2].thinnest) / (s[1].time - s[2].time),
           bend = 2 * fabs(late - early) / (s[0].time - s[2].time);
    return fmin(longest, sqrt(8 * CHORD_SHARE * p->tolerance * s[0].thinnest / fmax(bend, 1e-300)));
}

/* Returns the time after which an accumulated error has left the film. It is the passage time, or
   if the oil hardly moves the time in which the film changes by its own size. */
static double forgetting_time(const ehl_march *m)
{
    const double hardly = 0.1;
    const ehl_state *s = m->state;
    double time = ehl_march_passage(m, m->at.entrainment);
    if (m->at.entrainment >= hardly * m->history->speed_max || m->smooth < 2)
        return time;
    double change = fabs(log(s[0].thinnest / s[1].thinnest));
    return fmin(time, (s[0].time - s[1].time) / fmax(change, 1e-300));
}

/* Restarts after the breakpoint at the newest state, with short steps. */
static void pass_breakpoint(ehl_step_control *p, ehl_march *m)
{
    p->next++;
    p->dt = fmin(p->dt, FIRST_STEP * forgetting_time(m));
    ehl_march_breakpoint(m);
}

/* Returns the instant at the end of the next step. Sets *last if that is the next breakpoint. */
static ehl_instant next_instant(const ehl_step_control *p, const ehl_march *m, int *last)
{
    double now = m->state[0].time, breakpoint = p->breakpoint[p->next], rest = breakpoint - now,
           dt = p->dt;
    if (m->rough) /* no truncation error is estimated for the film on an asperity; the step
                     length follows from the cells */
        dt = fmin(dt,
                  ehl_largest_advection(m) * m->solver->grid->dx / fmax(m->at.entrainment, 1e-300));
    *last = dt > 0.999 * rest;
    if (!*last && dt > 0.5 * rest)
        dt = 0.5 * rest;
    double to = *last ? breakpoint : now + dt, thinnest = m->state[0].thinnest;
    double straight = ehl_history_straight(m->history, now, to, p->tolerance, thinnest);
    *last = *last && !(straight < to);
    return *last ? ehl_history_before(m->history, to) : ehl_history_at(m->history, straight);
}

/* Returns the change of the film in the trial, over the change that a step may make; the error is
   proportional to its cube. A load that vanishes or returns within a step counts as well, since the
   film of rigid flanks is proportional to 1/load. */
static double change_over_limit(const ehl_step_control *p, const ehl_march *m)
{
    if (m->rough)
        return 0;
    double film = fabs(log(m->trial.thinnest / m->state[0].thinnest));
    double none = 1e-3 * m->history->load_max;
    double load = fabs(log((m->trial_at.load + none) / (m->at.load + none)));
    return fmax(film, load / 2) / cbrt(0.6 * p->tolerance);
}

/* Returns 1 if the step must be repeated, and sets its length p->dt. */
static int repeat_step(ehl_step_control *p, ehl_march *m, ff_status status, double dt, double error,
                       double cell)
{
    int too_large = status == FF_OK && ehl_march_step_too_large(m);
    if ((status == FF_NOCONV || too_large) && dt > SHORTEST_STEP * cell) {
        p->dt = status == FF_NOCONV ? 0.25 * dt : 0.5 * dt;
        m->steps_cut++;
        return 1;
    }
    double change = status == FF_OK ? change_over_limit(p, m) : 0;
    if (status == FF_OK && (error > ALLOWED_EXCESS || change > 1.2) &&
        dt > 1.01 * SHORT_STEP * cell) {
        double factor = fmin(step_growth(m, error), 0.9 / fmax(change, 0.45));
        p->dt = fmax(dt * fmax(factor, 0.25), SHORT_STEP * cell);
        m->steps_refused++;
        return 1;
    }
    return 0;
}

/* Counts futile steps, and makes the solver more accurate if there are many. */
static void make_stricter(ehl_step_control *p, ehl_march *m, int futile)
{
    p->calm = futile ? 0 : p->calm + 1;
    p->futile = p->calm < CALM ? p->futile + futile : 0;
    if (p->futile < MOST_FUTILE || m->exactness * STRICTER < STRICTEST)
        return;
    m->exactness *= STRICTER;
    p->futile = 0;
}

/* Returns the time in which the fastest film moves by a cell; at rest, one cell's share of the
 * history. */
static double cell_time(const ehl_march *m)
{
    const ehl_grid *g = m->solver->grid;
    const ehl_history *h = m->history;
    double all = h->time[h->count - 1] - h->time[0];
    return fmin(g->dx / fmax(h->speed_max, 1e-300), all / (double)g->nodes);
}

ff_status ehl_step_control_to(ehl_step_control *p, ehl_march *m, double time)
{
    const double apart = 1e-6 * (time - m->state[0].time);
    ff_status status;
    do {
        double breakpoint = p->breakpoint[p->next];
        int meets = breakpoint < time + apart;
        status = ehl_march_to(m, breakpoint < time - apart ? breakpoint : time);
        if (status == FF_OK && meets)
            pass_breakpoint(p, m);
    } while (status == FF_OK && m->state[0].time < time);
    return status;
}

ff_status ehl_step_control_next(ehl_step_control *p, ehl_march *m)
{
    double cell = cell_time(m), error = 0, dt = 0;
    ff_status status;
    int last, futile = 0;
    do {
        const double longer = dt, before = error;
        ehl_instant at = next_instant(p, m, &last);
        dt = at.time - m->state[0].time;
        status = ehl_march_try(m, &at);
        double allowed = p->tolerance * (ehl_contact_is_lost(m, &at) ? CONTACT_LOSS_ALLOWANCE : 1);
        error = status == FF_OK ? ehl_truncation_sum(m, forgetting_time(m)) / (dt * allowed) : 0;
        if (status != FF_OK && status != FF_NOCONV)
            return status;
        futile = status == FF_OK && before > ALLOWED_EXCESS && error * longer > before * dt;
        if (status == FF_NOCONV && !(dt > SHORTEST_STEP * cell)) {
            status = ehl_march_without_load(m, &at);
            if (status == FF_OK && last)
                pass_breakpoint(p, m);
            return status;
        }
    } while (repeat_step(p, m, status, dt, error, cell));
    make_stricter(p, m, futile || (error > 1 && dt < 1.01 * SHORT_STEP * cell));
    double longest_change = 0.9 * dt / fmax(change_over_limit(p, m), 1e-3);
    ehl_march_accept(m);
    p->dt =
        last ? fmax(p->dt, dt) : fmax(dt * step_growth(m, error), fmin(2 * dt, SHORT_STEP * cell));
    p->dt = fmin(p->dt, fmax(fmin(longest_chord(p, m), longest_change), SHORT_STEP * cell));
    if (last)
        pass_breakpoint(p, m);
    return FF_OK;
}
