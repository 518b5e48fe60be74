/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Solves the film while the contact is lost. The dynamics then prescribes the gap between the
 * flanks, and the film follows: it cavitates as the gap opens and is squeezed as it closes. The
 * flanks have no mass here, so that any force of the film, however small, would push them apart and
 * the prescribed gap would never hold. The gap therefore yields only to a force above a share of
 * the largest load: the flanks then stand as far apart as that force keeps them, which is further
 * than the prescribed gap. The contact loss ends when the load has grown to that share.
 */
#include "contact-loss.h"

#include "../equations/advection.h"
#include "../heat/thermal.h"
#include "trial.h"

#include <stdio.h>
#include <string.h>

/* Returns 1 when the trial is consistent: its flanks stand further apart than the prescribed gap,
   or at the prescribed gap its force is small. */
static int is_admissible(const ehl_march *m, const ehl_step *step, const ehl_instant *at)
{
    const ehl_grid *g = m->solver->grid;
    const ehl_film *film = &m->trial.film;
    if (step->loaded)
        return film->h00 >= at->gap;
    return ehl_film_load(film, g->nodes, g->dx) <= EHL_LOST_FORCE * m->history->load_max;
}

ff_status ehl_solve_contact_loss(ehl_march *m, ehl_step *step, const ehl_instant *at)
{
    ff_status status = FF_NOCONV, first = FF_NOCONV;
    for (int turn = 0; turn < 2; turn++) {
        step->loaded = m->state[0].loaded ^ turn;
        step->load = EHL_LOST_FORCE * m->history->load_max;
        if (!step->loaded && !(at->gap > 0))
            continue;
        status = ehl_solve_trial(m, step, at);
        if (status == FF_OK && is_admissible(m, step, at))
            return FF_OK;
        if (turn == 0)
            first = status;
    }
    return status == FF_OK || first != FF_OK ? status : FF_NOCONV;
}

ff_status ehl_march_without_load(ehl_march *m, const ehl_instant *at)
{
    ehl_step step = ehl_instant_step(m, at);
    if (!ehl_contact_is_lost(m, at) || !(at->gap > 0)) {
        snprintf(m->why, sizeof m->why,
                 "Newton's method did not converge in a time step that was cut to %.3g s",
                 at->time - m->state[0].time);
        return FF_NOCONV;
    }
    const double *mass = m->state[0].mass, *before;
    ehl_march_place(m, at);
    if (m->rough)
        ehl_advect_mass(m, &mass, &before);
    step.past = m->past;
    step.rate = 1 / (at->time - m->state[0].time);
    for (size_t i = 0; i < m->solver->grid->nodes; i++)
        m->past[i] = -step.rate * mass[i];
    ehl_copy_film(&m->trial.film, &m->state[0].film, m->solver->grid->nodes);
    ehl_remove_pressure(&m->trial.film, mass, m->solver->grid->nodes);
    m->trial.film.h00 = at->gap;
    memset(m->local, 0, m->solver->grid->nodes * sizeof *m->local);
    m->trial_step = step;
    m->trial_at = *at;
    m->evaluated = 0;
    ehl_march_update_mass(m);
    if (m->thermal)
        ehl_thermal_rest(m, &step, at->time);
    ehl_march_accept(m);
    m->pressureless_steps++;
    return FF_OK;
}
