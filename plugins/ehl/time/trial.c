/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One implicit step in time: its equation, its initial guess, and the acceptance of its film as the
   newest state. */
#include "trial.h"

#include "../contact/simd-reductions.h"
#include "../equations/advection.h"
#include "../equations/asperities.h"
#include "../heat/heat.h"
#include "../solvers/grid-level.h"
#include "error-transport.h"
#include "truncation.h"

#include <flankfilm/simd.h>

#include <math.h>
#include <string.h>

/* Below this share of the step's load a film counts as unloaded. */
static const double NO_LOAD = 1e-3;

void ehl_march_update_mass(ehl_march *m)
{
    ehl_reynolds *r = m->solver->reynolds;
    m->trial.thinnest = ehl_thinnest(m, m->trial_step.radius, &m->trial.film);
    m->trial.highest = ehl_greatest(r->nodes, m->trial.film.p, 0);
    ehl_reynolds_mass(r, &m->trial.film);
    memcpy(m->trial.mass, r->mass, r->nodes * sizeof *r->mass);
    memcpy(m->trial.gap, r->h, r->nodes * sizeof *r->h);
    if (m->rough)
        ehl_contact_mass(r, &m->trial_step, &m->trial.film, m->trial.mass);
}

void ehl_march_accept(ehl_march *m)
{
    double dt = m->trial_at.time - m->state[0].time;
    m->trial.time = m->trial_at.time;
    m->trial.moved = m->moved;
    m->trial.loaded = m->trial_step.loaded;
    if (m->transport)
        ehl_transport_step(m);
    if (m->known > 0) {
        double length = 2 * m->solver->grid->half_width, before = m->distance;
        m->distance += m->trial_step.entrainment * dt;
        if (before < length && m->distance >= length)
            m->renewed = m->trial_at.time;
        double worst = ehl_march_truncation(m);
        ehl_advect_error(m, m->trial_step.entrainment * dt);
        if (worst > m->worst_truncation) {
            m->worst_truncation = worst;
            m->worst_truncation_at = m->trial_at.time;
        }
    }
    if (m->known > 0 && m->trial_step.loaded != m->state[0].loaded)
        m->smooth = 0;
    ehl_state oldest = m->state[EHL_STATES - 1];
    memmove(m->state + 1, m->state, (EHL_STATES - 1) * sizeof m->state[0]);
    m->state[0] = m->trial;
    m->trial = oldest;
    m->known += m->known < EHL_STATES;
    m->smooth += m->smooth < EHL_STATES;
    m->contact_lost = ehl_contact_is_lost(m, &m->trial_at);
    m->step = m->trial_step;
    m->at = m->trial_at;
}

/* y = a x1 + b x2 + c x3 */
FF_SIMD
static void combine(size_t n, double a, const double *restrict x1, double b,
                    const double *restrict x2, double c, const double *restrict x3,
                    double *restrict y)
{
    for (size_t i = 0; i < n; i++)
        y[i] = a * x1[i] + b * x2[i] + c * x3[i];
}

/*
 * d(rho h)/dt = rate rho h + past, by backward Euler or by the two-step backward differentiation
 * formula for unequal steps (Hairer, Norsett & Wanner 1993, III.5). With rough flanks the
 * derivative is along the path of the oil, and then includes the wedge.
 */
static void time_derivative(ehl_march *m, ehl_step *step, const ehl_instant *at)
{
    size_t n = m->solver->grid->nodes;
    const double *one = m->state[0].mass, *two = m->state[1].mass;
    double c[3], dt = at->time - m->state[0].time;
    ehl_march_factors(m, at->time, c);
    step->rate = c[0];
    step->past = m->past;
    step->follows = m->rough != NULL;
    if (m->rough)
        ehl_advect_mass(m, &one, &two);
    if (m->scheme == EHL_EULER || m->smooth < 2)
        combine(n, -1 / dt, one, 0, one, 0, one, m->past);
    else
        combine(n, c[1], one, c[2], two, 0, two, m->past);
}

/* Keeps an extrapolated pressure above 0 at nodes where oil, or statistical asperities, carried
   load before. If the film shrinks (`shrinks`), the nodes with a negative pressure are removed; a
   node removed by mistake is found at once, since it gains mass. */
FF_SIMD
static void keep_carried(size_t n, const double *restrict before, int shrinks, double *restrict p,
                         unsigned char *restrict full)
{
    for (size_t i = 0; i < n; i++) {
        double most = p[i] > 0 ? p[i] : 0;
        int carries = (full[i] != 0) | (before[i] > 0);
        p[i] = carries ? most : 0;
    }
    for (size_t i = 0; shrinks && i < n; i++)
        full[i] = full[i] & (p[i] > 0);
}

/*
 * Sets the deflection of the trial. `free` is its pressure before keep_carried. The deflection is
 * extrapolated like the pressure, and corrected where the pressure was cut off. The round-off error
 * of this recursion grows with the square of the number of steps, and faster with unequal steps.
 * With unequal steps, and after MOST steps, the deflection is recomputed from scratch.
 */
static void extrapolate_deflection(ehl_march *m, const double c[3], const double *free)
{
    enum { MOST = 8, MOST_CUT = 32 };
    const double equal = 8; /* number of steps that count as equal: the factors of extrapolation
                               are then 3, -3 and 1 */
    const ehl_state *s = m->state;
    ehl_film *film = &m->trial.film;
    size_t n = m->solver->grid->nodes, cut = 0, place[MOST_CUT];
    for (size_t i = 0; i < n && cut < MOST_CUT; i++)
        if (film->p[i] < free[i] || film->p[i] > free[i])
            place[cut++] = i;
    int recursion = 0;
    for (size_t k = 0; k < EHL_STATES; k++)
        if (s[k].recursion > recursion)
            recursion = s[k].recursion;
    m->trial.recursion = recursion + 1;
    if (cut == MOST_CUT || recursion >= MOST || fabs(c[0]) + fabs(c[1]) + fabs(c[2]) > equal) {
        m->solver->deflect(m->solver, film->p, film->v);
        m->trial.recursion = 0;
        return;
    }
    combine(n, c[0], s[0].film.v, c[1], s[1].film.v, c[2], s[2].film.v, film->v);
    for (size_t k = 0; k < cut; k++)
        ehl_deflect_by(n, place[k], film->p[place[k]] - free[place[k]], m->solver->kernel, film->v);
}

/* Returns the last full node. */
static size_t end_of_film(const ehl_film *film, size_t nodes)
{
    size_t i = nodes - 1;
    while (i > 0 && !film->full[i])
        i--;
    return i;
}

/* Fills the nodes that the end of the film is about to pass, as far as it moved in the last step,
   except one. A Newton step finds the next node, and removing a superfluous one costs a
   convolution. */
static void lengthen(const ehl_march *m, double time, ehl_film *film)
{
    const ehl_state *s = m->state;
    size_t n = m->solver->grid->nodes, now = end_of_film(&s[0].film, n);
    double moved = (double)now - (double)end_of_film(&s[1].film, n);
    double end = (double)now - 1 + moved * (time - s[0].time) / (s[0].time - s[1].time);
    for (size_t i = now + 1; i + 1 < n && (double)i <= end; i++)
        film->full[i] = 1;
}

/* Sets the trial to a line or parabola in time through the last films. Returns 0 if there are too
   few. */
static int extrapolate_films(ehl_march *m, double time, int loaded)
{
    const ehl_state *s = m->state;
    size_t n = m->solver->grid->nodes, count = ehl_run_of_states(m, loaded, 3);
    if (count < 2 || (count < 3 && m->known == m->smooth))
        return 0;
    double c[3];
    ehl_lagrange_factors(m, time, count, c);
    ehl_film *film = &m->trial.film;
    const ehl_film *f0 = &s[0].film, *f1 = &s[1].film, *f2 = &s[2].film;
    const int shrinks = !m->solver->reynolds->conserving;
    memcpy(film->full, f0->full, n);
    memcpy(film->asperity, f0->asperity, n);
    combine(n, c[0], f0->p, c[1], f1->p, c[2], f2->p, film->p);
    memcpy(m->change, film->p, n * sizeof *film->p);
    keep_carried(n, f0->p, shrinks, film->p, film->full);
    if (shrinks)
        lengthen(m, time, film);
    for (size_t i = 0; i < n && m->solver->reynolds->conserving; i++)
        film->content[i] = fmax(0, c[0] * s[0].mass[i] + c[1] * s[1].mass[i] + c[2] * s[2].mass[i]);
    film->h00 = c[0] * f0->h00 + c[1] * f1->h00 + c[2] * f2->h00;
    extrapolate_deflection(m, c, m->change);
    return 1;
}

/* Sets the trial to the last film: without pressure when contact is lost, and with a first guess of
   the pressure when it is regained. */
static void repeat_last_film(ehl_march *m, const ehl_step *step, const ehl_instant *at)
{
    const ehl_grid *g = m->solver->grid;
    ehl_film *film = &m->trial.film;
    ehl_copy_film(film, &m->state[0].film, g->nodes);
    if (!step->loaded && m->state[0].loaded)
        ehl_remove_pressure(film, m->state[0].mass, g->nodes);
    else if (step->loaded && ehl_film_load(film, g->nodes, g->dx) < NO_LOAD * step->load)
        ehl_first_guess(m->solver, at, m->history->modulus, ehl_thinnest(m, at->radius, film),
                        film);
}

/*
 * Extrapolates the flanks of the last film with the speed that they had. This speed is continuous
 * where the slope of the load has a kink, since load and film are. Flanks that separate move the
 * end of the film backwards by it. From flanks at rest that end would otherwise be searched among
 * nodes which only the wedge would fill. The pressures cut off there would destroy the balance of
 * the load.
 */
static int move_on_last_film(ehl_march *m, const ehl_step *step, const ehl_instant *at)
{
    const ehl_state *s = m->state;
    if (m->known < 2 || !step->loaded || !s[0].loaded || !s[1].loaded)
        return 0;
    repeat_last_film(m, step, at);
    m->trial.film.h00 +=
        (at->time - s[0].time) * (s[0].film.h00 - s[1].film.h00) / (s[0].time - s[1].time);
    return 1;
}

static ff_status solve_with_positive_gap(ehl_march *m, const ehl_step *step, const ehl_instant *at,
                                         int limit)
{
    ff_status status = ehl_heat_solve(m, step, &m->trial.film, at->time, limit);
    if (ehl_laws_failed(&m->solver->reynolds->laws))
        return FF_BUG; /* a shorter step will not help */
    if (status == FF_OK && !(ehl_thinnest(m, at->radius, &m->trial.film) > 0))
        status = FF_NOCONV;
    return status;
}

/* Continuation in the load, for a sudden load on a film that has no time to yield. It goes from the
   load of the last film to that of the step by ratios, which shrink if a solution fails. */
static ff_status continue_in_load(ehl_march *m, const ehl_step *step, const ehl_instant *at)
{
    enum { MOST_LOADS = 60 };
    const ehl_grid *g = m->solver->grid;
    ehl_step load_step = *step;
    ehl_film *film = &m->trial.film, *kept = &m->spare.film;
    ehl_copy_film(film, &m->state[0].film, g->nodes);
    double reached = ehl_film_load(film, g->nodes, g->dx);
    if (!(reached > 0))
        return FF_NOCONV;
    double ratio = step->load / reached > 1 ? 2 : 0.5;
    ehl_copy_film(kept, film, g->nodes);
    for (int k = 0; k < MOST_LOADS && fabs(ratio - 1) > 1e-3; k++) {
        int last = ratio > 1 ? reached * ratio >= step->load : reached * ratio <= step->load;
        load_step.load = last ? step->load : reached * ratio;
        ff_status status = solve_with_positive_gap(m, &load_step, at, EHL_LIMIT_PLAIN);
        if (status < 0 || (status == FF_OK && last))
            return status;
        if (status == FF_OK) {
            reached = load_step.load;
            ehl_copy_film(kept, film, g->nodes);
        } else {
            ehl_copy_film(film, kept, g->nodes);
            do /* with the same film the same solution would fail again */
                ratio = sqrt(ratio);
            while (last && fabs(ratio - 1) > 1e-3 &&
                   (ratio > 1 ? reached * ratio >= step->load : reached * ratio <= step->load));
        }
    }
    return FF_NOCONV;
}

ff_status ehl_solve_trial(ehl_march *m, ehl_step *step, const ehl_instant *at)
{
    ff_status status = FF_NOCONV;
    ehl_film *film = &m->trial.film;
    m->trial.recursion = m->state[0].recursion + 1; /* unless it is computed from scratch */
    time_derivative(m, step, at);
    int carried = m->rough && step->loaded == m->state[0].loaded;
    for (int plain = 0; plain < 2 && status == FF_NOCONV && !(carried && plain); plain++) {
        if (carried)
            ehl_advect_film(m, at);
        else if (plain)
            repeat_last_film(m, step, at);
        else if (!extrapolate_films(m, at->time, step->loaded))
            continue;
        if (!step->loaded)
            film->h00 = at->gap;
        int limit = carried ? EHL_LIMIT_REPEATED : EHL_LIMIT_GUESSED;
        if (carried && m->thermal) /* with heat the mobilities of neighbouring nodes may differ
                                      by decades */
            limit = EHL_LIMIT_START;
        status = solve_with_positive_gap(m, step, at, plain ? EHL_LIMIT_PLAIN : limit);
    }
    if (status == FF_NOCONV && !m->rough && move_on_last_film(m, step, at))
        status = solve_with_positive_gap(m, step, at, EHL_LIMIT_PLAIN);
    if (status == FF_NOCONV && step->loaded && !m->rough)
        status = continue_in_load(m, step, at);
    return status;
}

static void reverse_values(double *y, size_t n)
{
    for (size_t i = 0; i < n / 2; i++) {
        double kept = y[i];
        y[i] = y[n - 1 - i];
        y[n - 1 - i] = kept;
    }
}

static void reverse_flags(unsigned char *y, size_t n)
{
    for (size_t i = 0; i < n / 2; i++) {
        unsigned char kept = y[i];
        y[i] = y[n - 1 - i];
        y[n - 1 - i] = kept;
    }
}

/* The equations assume that the oil moves in the direction of the nodes. When the entrainment
   changes its sign, the states are mirrored; the domain has the same length on both sides. */
static void mirror_states(ehl_march *m, const ehl_instant *at)
{
    size_t n = m->solver->grid->nodes;
    if (!(at->entrainment > 0) || at->mirrored == m->mirrored)
        return;
    for (size_t k = 0; k < m->known; k++) {
        ehl_state *s = &m->state[k];
        double *values[] = {s->film.p, s->film.v, s->film.content, s->mass, s->gap};
        for (size_t j = 0; j < sizeof values / sizeof values[0]; j++)
            reverse_values(values[j], n);
        reverse_flags(s->film.full, n);
        reverse_flags(s->film.asperity, n);
    }
    reverse_values(m->accumulated_error, n);
    for (size_t k = 0; m->transport && k < EHL_TRANSPORT_ARRAYS; k++)
        reverse_values(m->transport->memory + k * n, n);
    m->mirrored = at->mirrored;
}

void ehl_march_place(ehl_march *m, const ehl_instant *at)
{
    ehl_reynolds *r = m->solver->reynolds;
    r->rough = m->rough ? m->heights : NULL;
    mirror_states(m, at);
    if (!m->rough)
        return;
    ehl_grid g = *m->solver->grid;
    double cells = ehl_roughness_travel(m->rough, at->time) / g.dx;
    m->moved = floor(cells);
    g.first += (cells - m->moved) * g.dx;
    ehl_reynolds_place(r, g.first);
    ehl_roughness_heights(m->rough, &g, at->time, m->heights);
}
