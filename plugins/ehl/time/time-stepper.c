/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "time-stepper.h"

#include "../equations/advection.h"
#include "contact-loss.h"
#include "trial.h"
#include "truncation.h"

#include <math.h>

enum { MOST_HALVINGS = 12, MOST_THINNING_HALVINGS = 6 };

/* A step that leaves less than this share of the least film is cut if possible, with smooth flanks.
 */
static const double MOST_THINNING = 0.5;
/* A step is also cut if it changes the least film by more than this share as the contact opens or
 * closes. */
static const double MOST_CHANGE_AT_CONTACT_LOSS = 0.05;

/* The last step of an interval takes all that is left if a shorter one would leave less than 1e-3
 * of the interval. */
static const double ALMOST_ALL = 0.999;
/* After a step without load for which Newton's method has failed, the next step is one 16th of the
 * interval. */
static const double AFTER_FAILURE = 16;

int ehl_march_step_too_large(const ehl_march *m)
{
    double kept = m->trial.thinnest / m->state[0].thinnest;
    int changed = m->trial_step.loaded != m->state[0].loaded;
    return (!m->rough && kept < MOST_THINNING) ||
           (changed && fabs(kept - 1) > MOST_CHANGE_AT_CONTACT_LOSS);
}

ff_status ehl_march_try(ehl_march *m, const ehl_instant *at)
{
    ehl_march_place(m, at);
    ehl_step step = ehl_instant_step(m, at);
    ff_status status =
        step.loaded ? ehl_solve_trial(m, &step, at) : ehl_solve_contact_loss(m, &step, at);
    if (status != FF_OK)
        return status;
    m->trial_step = step;
    m->trial_at = *at;
    m->evaluated = 1;
    ehl_march_update_mass(m);
    ehl_estimate_truncation(m);
    return FF_OK;
}

/* Keeps last_good_step: a length that failed is not tried again before STREAK shorter steps
   passed. */
static void limit_step_length(ehl_march *m, ff_status status, double dt)
{
    enum { STREAK = 4 };
    m->good_steps = status == FF_OK ? m->good_steps + 1 : 0;
    if (status != FF_OK)
        m->last_good_step = dt / 2;
    else if (!(m->last_good_step > 0) || m->good_steps >= STREAK) {
        m->last_good_step = 2 * fmax(dt, m->last_good_step / 2);
        m->good_steps = 0;
    }
}

/* Returns the longest step towards `time`, s. With rough flanks the steps are equal, and none moves
 * the oil by more cells than ehl_largest_advection. */
static double longest_step(const ehl_march *m, double time)
{
    double now = m->state[0].time, steps = 1;
    if (m->rough)
        steps = (ehl_roughness_travel(m->rough, time) - ehl_roughness_travel(m->rough, now)) /
                (m->solver->grid->dx * ehl_largest_advection(m));
    return (time - now) / fmax(1, ceil(steps - 1e-3));
}

ff_status ehl_march_to(ehl_march *m, double time)
{
    double span = longest_step(m, time), dt = span;
    int cut = 0;
    if (m->rough && m->last_good_step > 0)
        dt = fmin(m->last_good_step, span);
    while (m->state[0].time < time) {
        double now = m->state[0].time;
        double target = dt > ALMOST_ALL * (time - now) ? time : now + dt;
        ehl_instant at = ehl_history_at(m->history, target);
        ff_status status = ehl_march_try(m, &at);
        int too_large = status == FF_OK && ehl_march_step_too_large(m) &&
                        target - now > span / (1 << MOST_THINNING_HALVINGS);
        cut |= too_large || status == FF_NOCONV;
        if (m->rough)
            limit_step_length(m, status, target - now);
        if (status == FF_OK && !too_large) {
            ehl_march_accept(m);
            span = m->rough && target < time ? longest_step(m, time) : span;
            dt = fmin(m->rough ? m->last_good_step : 2 * dt, span);
        } else if (too_large || (status == FF_NOCONV && dt > span / (1 << MOST_HALVINGS))) {
            dt = (target - now) / 2;
        } else if (status == FF_NOCONV) {
            status = ehl_march_without_load(m, &at);
            dt = span / AFTER_FAILURE;
        }
        if (status != FF_OK && (status != FF_NOCONV || m->why[0]))
            return status;
    }
    m->steps_cut += cut || dt < span;
    return FF_OK;
}
