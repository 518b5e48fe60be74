/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "march.h"

#include "../contact/simd-reductions.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

ff_status ehl_march_create(ehl_march *m, const ehl_history *h, ehl_solver *s, int scheme)
{
    enum { EACH = 6, FILMS = EHL_STATES + 2, OWN = 6 };
    size_t n = s->grid->nodes;
    *m = (ehl_march){
        .history = h, .solver = s, .scheme = scheme, .exactness = 1, .mirrored = h->mirrored};
    double *next = m->memory = calloc((EACH * FILMS + OWN) * n, sizeof *next);
    unsigned char *full = m->flags_memory = calloc(2 * FILMS * n, 1);
    if (!next || !full)
        return FF_NOMEM;
    for (size_t k = 0; k < FILMS; k++) {
        ehl_state *state = k < EHL_STATES ? &m->state[k] : k == EHL_STATES ? &m->trial : &m->spare;
        state->film.p = next;
        state->film.v = next + n;
        state->mass = next + 2 * n;
        state->film.content = next + 3 * n;
        state->gap = next + 4 * n;
        state->film.plastic = s->reynolds->hardness > 0 ? next + 5 * n : NULL;
        state->film.full = full;
        state->film.asperity = full + n;
        next += EACH * n;
        full += 2 * n;
    }
    double **own[OWN] = {&m->past,   &m->change, &m->deflection, &m->local, &m->accumulated_error,
                         &m->heights};
    for (size_t k = 0; k < OWN; k++, next += n)
        *own[k] = next;
    return FF_OK;
}

void ehl_march_destroy(ehl_march *m)
{
    free(m->memory);
    free(m->flags_memory);
    m->memory = NULL;
    m->flags_memory = NULL;
}

void ehl_copy_film(ehl_film *to, const ehl_film *from, size_t nodes)
{
    memcpy(to->p, from->p, nodes * sizeof *to->p);
    memcpy(to->v, from->v, nodes * sizeof *to->v);
    memcpy(to->full, from->full, nodes);
    memcpy(to->asperity, from->asperity, nodes);
    memcpy(to->content, from->content, nodes * sizeof *to->content);
    to->yielding = from->yielding;
    if (to->plastic && from->plastic)
        memcpy(to->plastic, from->plastic, nodes * sizeof *to->plastic);
    to->h00 = from->h00;
    to->ahead = from->ahead;
}

int ehl_contact_is_lost(const ehl_march *m, const ehl_instant *at)
{
    return ehl_is_lost(m->history, at->load) ||
           (m->contact_lost && at->load < EHL_LOST_FORCE * m->history->load_max);
}

void ehl_feed_step(const ehl_solver *s, const ehl_instant *at, ehl_step *step)
{
    if (s->grid->fed)
        ehl_inlet_ahead(&s->reynolds->oil, at, s->modulus, s->grid->inlet, &step->feed,
                        &step->ahead);
}

ehl_step ehl_instant_step(const ehl_march *m, const ehl_instant *at)
{
    ehl_step step = {
        .entrainment = at->entrainment,
        .sliding = at->sliding,
        .radius = at->radius,
        .load = at->load,
        .loaded = !ehl_contact_is_lost(m, at),
    };
    ehl_feed_step(m->solver, at, &step);
    return step;
}

double ehl_thinnest(ehl_march *m, double radius, const ehl_film *film)
{
    ehl_reynolds *r = m->solver->reynolds;
    ehl_reynolds_gap(r, radius, film);
    double least = ehl_least(r->nodes, r->h);
    return r->rough ? fmax(least, r->contact) : least;
}

double ehl_march_passage(const ehl_march *m, double speed)
{
    double length = 2 * m->solver->grid->half_width;
    double all = m->history->time[m->history->count - 1] - m->history->time[0];
    return speed * all > length ? length / speed : all;
}

int ehl_march_is_loaded(const ehl_march *m)
{
    return m->step.loaded && m->step.load >= EHL_LIGHT_LOAD * m->history->load_max;
}

void ehl_march_breakpoint(ehl_march *m)
{
    m->smooth = 1;
}

void ehl_march_factors(const ehl_march *m, double time, double c[3])
{
    double dt = time - m->state[0].time;
    c[0] = 1 / dt;
    c[1] = -1 / dt;
    c[2] = 0;
    if (m->scheme == EHL_EULER || m->smooth < 2)
        return;
    double ratio = dt / (m->state[0].time - m->state[1].time);
    c[0] = (1 + 2 * ratio) / ((1 + ratio) * dt);
    c[1] = -(1 + ratio) / dt;
    c[2] = ratio * ratio / ((1 + ratio) * dt);
}

void ehl_lagrange_factors(const ehl_march *m, double time, size_t count, double *c)
{
    for (size_t k = 0; k < 3; k++) {
        c[k] = k < count;
        for (size_t j = 0; j < count && k < count; j++)
            if (j != k)
                c[k] *= (time - m->state[j].time) / (m->state[k].time - m->state[j].time);
    }
}

size_t ehl_run_of_states(const ehl_march *m, int loaded, size_t most)
{
    size_t count = 0;
    while (count < most && count < m->smooth && m->state[count].loaded == loaded)
        count++;
    return count;
}

void ehl_remove_pressure(ehl_film *film, const double *mass, size_t nodes)
{
    memcpy(film->content, mass, nodes * sizeof *mass);
    memset(film->p, 0, nodes * sizeof *film->p);
    memset(film->v, 0, nodes * sizeof *film->v);
    film->ahead = 0;
    memset(film->full, 0, nodes);
    memset(film->asperity, 0, nodes);
    film->yielding = 0;
    if (film->plastic)
        memset(film->plastic, 0, nodes * sizeof *film->plastic);
}
