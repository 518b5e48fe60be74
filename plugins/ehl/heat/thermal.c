/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "thermal.h"

#include "../equations/advection.h"

#include <flankfilm/author.h>
#include <flankfilm/simd.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Smallest factor that a prediction may give; the largest factor is its reciprocal. */
static const double LEAST_FACTOR = 1e-3;

/* Largest numbers of rounds for the film of one instant (MOST_ROUNDS); of sweeps in a round of a
   time step (MOST_PASSES) and of a steady film (STEADY_PASSES); of sweeps that always apply the
   whole change (WHOLE_PASSES); and of rounds in which the factors have converged but the
   temperatures have not (MOST_IDLE). A sweep that stagnates alternates between two states; half of
   its change leads to a state between them. Along the nodes of rough flanks the oil of one flank
   flows against that of the other, so that in a thin film whole sweeps may diverge. After a round
   that did not converge, the share of the change that the sweeps of the instant apply is halved. */
enum {
    MOST_ROUNDS = 80,
    MOST_PASSES = 8,
    STEADY_PASSES = 60,
    WHOLE_PASSES = 3,
    MOST_IDLE = 6,
    FACTORS = EHL_THERMAL_FACTORS
};
static const double SHARE_THAT_HESITATES = 0.5, LEAST_SWEEP = 0.125;
/* A sweep of a steady film stagnates if its change is above this share of the previous change. */
static const double SLOW_SWEEP = 0.9;

/* The factors have converged if they change the mass flow by less than this share; h changes by
   about the same share. A steady film begins without heat, a time step close to its solution. With
   a tenth of the bound for rough films, h_min of ten random rough films changes by at most 1.6e-3
   (of eight by less than 3e-4), and friction by less than 3.3e-4 of its largest value. */
static const double SETTLED = 1e-4, SETTLED_STEADY = 1e-5, SETTLED_ROUGH = 1e-3;
/* Number of rounds of a steady film before its factors are accelerated (Anderson), and the mixing
   factor of an accelerated round. */
static const int PLAIN_ROUNDS = 12;
static const double MIXED = 0.5;
/* If the changes do not shrink by this factor, a smaller share of them is applied, down to
   LEAST_SHARE. */
static const double SHRINKING = 0.95, LEAST_SHARE = 0.15;
/* The temperatures have converged if a sweep changes ln(eta) by less than this value. */
static const double WARM = 1e-3, WARM_STEADY = 1e-6;
/* For a steady film the bound on the change of ln(eta) is at most this share of the last error of
   its factors. Otherwise the acceleration would use factors of another film, and the rounds would
   not converge. */
static const double LAGGING = 0.01;
/* Change of ln(eta) up to which a time step extrapolates the laws. ln(eta) is extrapolated along a
   parabola. Half of the squared change times the curvature is a fifth of SETTLED for laws whose
   slopes vary like ln(eta)/10. If the curvature varies at the same rate, a twentieth of this error
   remains. */
static const double REACH = 0.02;
/* Relative change of a column's equations up to which the first pass of a step reuses their
   inverse. The remaining error is about this share of the change in the pass, a tenth of WARM. */
static const double KEPT = 0.1;

/* Finds the fastest and the slowest flank of a history along the nodes. Returns FF_UNSUPPORTED if a
   flank moves against the oil, or is at rest in a steady film. */
static ff_status speeds_of(const ff_host *host, const ehl_history *h, double *least, double *most)
{
    *least = HUGE_VAL;
    *most = 0;
    for (size_t i = 0; i < h->count; i++) {
        double u1 = h->speed_1[i], u2 = h->speed_2[i];
        double slow = fmin(fabs(u1), fabs(u2)), fast = fmax(fabs(u1), fabs(u2));
        if (u1 * u2 < 0)
            return ff_failf(host, FF_UNSUPPORTED, "thermal",
                            "at time %.6g s the flanks move in opposite directions, %.4g and %.4g "
                            "m/s (slide-roll ratio above 2): with thermal: full both flanks must "
                            "move in the direction of the oil; use thermal: inlet or none",
                            h->time[i], u1, u2);
        if (h->count == 1 && !(slow > 0))
            return ff_failf(host, FF_UNSUPPORTED, "thermal",
                            "a flank at rest (slide-roll ratio 2) under constant shear has no "
                            "steady temperature: use thermal: full with a history in time, or "
                            "thermal: inlet or none");
        *least = fmin(*least, slow);
        *most = fmax(*most, fast);
    }
    return FF_OK;
}

static ff_status allocate(ehl_thermal *t, ehl_march *m)
{
    enum { OWN = 8 + 2 * FACTORS, BLOCKS = EHL_STATES + 4 };
    size_t n = t->energy.nodes;
    t->width = n * (t->energy.across.count + t->energy.flank[0].count + t->energy.flank[1].count +
                    FACTORS);
    double *next = t->memory = calloc(BLOCKS * t->width + OWN * n, sizeof *next);
    if (!next)
        return FF_NOMEM;
    for (size_t k = 0; k < EHL_STATES; k++, next += t->width)
        m->state[k].heat = next;
    m->trial.heat = next;
    t->past = next + t->width;
    t->moved[0] = next + 2 * t->width;
    t->moved[1] = next + 3 * t->width;
    next += 4 * t->width;
    double **own[] = {&t->p_t,   &t->through,  &t->ease,     &t->swell,
                      &t->carry, &t->friction, &t->p_before, &t->weight};
    for (size_t k = 0; k < sizeof own / sizeof own[0]; k++, next += n)
        *own[k] = next;
    t->now = next;
    t->change = next + FACTORS * n;
    return ehl_anderson_create(&t->anderson, FACTORS * n) ? FF_OK : FF_NOMEM;
}

ff_status ehl_thermal_create(ehl_thermal *t, const ff_host *host, ehl_march *m,
                             const ehl_thermal_data *data)
{
    const ehl_history *h = m->history;
    const ehl_grid *g = m->solver->grid;
    ehl_reynolds *r = m->solver->reynolds;
    double least, most, length = g->inlet + g->outlet;
    *t = (ehl_thermal){.least_peclet = HUGE_VAL};
    ff_status status = ehl_history_one_way(h, host, "a film with thermal: full");
    if (status == FF_OK)
        status = speeds_of(host, h, &least, &most);
    if (status == FF_OK)
        status = ehl_energy_create(&t->energy, g->nodes, data->across);
    if (status != FF_OK)
        return status;
    double lasts = h->time[h->count - 1] - h->time[0] + length / most;
    if (m->rough) /* plus the distance that rough flanks travel into the contact (start.c) */
        lasts += length / most;
    double longest = least * lasts > length ? length / least : lasts;
    for (size_t k = 0; k < 2; k++) {
        ehl_half_space_create(&t->energy.flank[k], data->flank_contact[k], g->dx / most,
                              fmax(longest, length / most));
        t->diffusivity[k] = data->flank_diffusivity[k];
    }
    t->coefficient = data->friction;
    t->energy.laws = r->laws;
    t->energy.flow = data->flow;
    t->energy.conductivity = data->conductivity;
    t->energy.conducts = data->conducts;
    t->energy.heat_capacity = data->heat_capacity;
    t->energy.T_in = data->bulk;
    status = allocate(t, m);
    if (status != FF_OK)
        return status;
    m->thermal = t;
    r->ease = t->ease;
    r->swell = t->swell;
    r->carry = t->carry;
    ehl_thermal_restart(m);
    return FF_OK;
}

void ehl_thermal_destroy(ehl_thermal *t)
{
    ehl_energy_destroy(&t->energy);
    ehl_anderson_destroy(&t->anderson);
    free(t->memory);
    t->memory = NULL;
}

ehl_temperature ehl_thermal_state(const ehl_thermal *t, double *heat)
{
    size_t n = t->energy.nodes;
    double *modes = heat + n * t->energy.across.count;
    return (ehl_temperature){heat, {modes, modes + n * t->energy.flank[0].count}};
}

static void take_factors(ehl_thermal *t, double *heat)
{
    const double *next = ehl_thermal_factors(t, heat);
    double *to[FACTORS] = {t->ease, t->swell, t->carry};
    for (size_t k = 0; k < FACTORS; k++)
        memcpy(to[k], next + k * t->energy.nodes, t->energy.nodes * sizeof *to[k]);
}

void ehl_thermal_restart(ehl_march *m)
{
    ehl_thermal *t = m->thermal;
    double *heat = m->trial.heat;
    size_t n = t->energy.nodes;
    memset(heat, 0, t->width * sizeof *heat);
    for (size_t j = 0; j < n * t->energy.across.count; j++)
        heat[j] = t->energy.T_in;
    ehl_energy_restart(&t->energy);
    double *next = ehl_thermal_factors(t, heat);
    for (size_t j = 0; j < FACTORS * n; j++)
        next[j] = 1;
    take_factors(t, heat);
}

/* Extrapolates n values linearly in time from the last two states, and limits them to the range
   from `least` to `most`. */
FF_SIMD
static void go_on(size_t n, const double *restrict one, const double *restrict two, double ahead,
                  double least, double most, double *restrict now)
{
    for (size_t j = 0; j < n; j++) {
        double line = one[j] + ahead * (one[j] - two[j]);
        line = line > least ? line : least;
        now[j] = line < most ? line : most;
    }
}

/* Sets `past` to the contribution of two earlier states, of n values each, to the difference
   formula in time. */
FF_SIMD
static void look_back(size_t n, const double *restrict one, const double *restrict two,
                      const double c[3], double *restrict past)
{
    const double by_one = c[1], by_two = c[2];
    for (size_t j = 0; j < n; j++)
        past[j] = by_one * one[j] + by_two * two[j];
}

/* Sets moved[k] to state k, transported with the oil. */
static void move_state(const ehl_march *m, size_t k)
{
    const ehl_thermal *t = m->thermal;
    const ehl_energy *e = &t->energy;
    const ehl_state *s = &m->state[k];
    const double *from = s->heat;
    double *to = t->moved[k];
    const size_t parts[] = {e->across.count, e->flank[0].count, e->flank[1].count, 1, 1, 1};
    for (size_t j = 0; j < sizeof parts / sizeof parts[0]; j++) {
        ehl_advect_values(m, s, parts[j], from, to);
        from += parts[j] * e->nodes;
        to += parts[j] * e->nodes;
    }
}

/* Extrapolates the temperatures of the trial and its factors linearly in time. Sets `past` to the
   contribution of earlier states to their change in time. */
static void predict(ehl_march *m, double time, double c[3])
{
    ehl_thermal *t = m->thermal;
    double *now = m->trial.heat, *past = t->past;
    for (size_t k = 0; m->rough && k < 2; k++)
        move_state(m, k);
    const double *one = m->rough ? t->moved[0] : m->state[0].heat;
    const double *two = m->rough ? t->moved[1] : m->state[1].heat;
    size_t n = t->energy.nodes, temperatures = n * t->energy.across.count;
    size_t kept = t->width - FACTORS * n;
    ehl_march_factors(m, time, c);
    double ahead = 0;
    if (m->smooth >= 2)
        ahead = (time - m->state[0].time) / (m->state[0].time - m->state[1].time);
    look_back(t->width, one, two, c, past);
    if (m->rough) /* the modes of a flank that moves backwards come from the next node */
        memcpy(now + temperatures, one + temperatures, (kept - temperatures) * sizeof *now);
    go_on(temperatures, one, two, ahead, t->energy.lowest, t->energy.highest, now);
    go_on(FACTORS * n, one + kept, two + kept, ahead, LEAST_FACTOR, 1 / LEAST_FACTOR, now + kept);
}

/* Sets p_t, along the path of the nodes if they move. p_t is 0 where asperities were or are in
   contact, since their pressure is not that of the oil. */
static void pressure_in_time(const ehl_march *m, const ehl_film *film, const double c[3])
{
    ehl_thermal *t = m->thermal;
    size_t n = t->energy.nodes;
    const ehl_reynolds *r = m->solver->reynolds;
    const double *p = ehl_fluid(r, film);
    for (size_t i = 0; i < n; i++)
        t->p_t[i] = c[0] * p[i];
    for (size_t k = 0; k < 2; k++) {
        const double *before = ehl_fluid_of(r, &m->state[k].film, m->state[k].gap, t->p_before);
        if (m->rough) {
            ehl_advect_values(m, &m->state[k], 1, before, t->p_before);
            before = t->p_before;
        }
        for (size_t i = 0; i < n; i++)
            t->p_t[i] += c[k + 1] * before[i];
    }
    for (size_t i = 0; m->rough && i < n; i++) {
        int touches = film->asperity[i];
        for (size_t k = 0; k < 2; k++)
            if (fabs(c[k + 1]) > 0)
                touches |= m->state[k].film.asperity[ehl_upstream_node(m, &m->state[k], i)];
        t->p_t[i] = touches ? 0 : t->p_t[i];
    }
}

/* Returns the film in the form that the energy equation needs. r has been evaluated for the
   film. */
static ehl_energy_film film_of(const ehl_march *m, const ehl_step *step, const ehl_film *film,
                               const double c[3])
{
    ehl_thermal *t = m->thermal;
    const ehl_reynolds *r = m->solver->reynolds;
    size_t n = r->nodes;
    double slide = (m->mirrored ? -step->sliding : step->sliding) / 2;
    double frame = step->follows ? step->entrainment : 0;
    ehl_energy_film f = {
        .count = r->last + 1,
        .dx = r->dx,
        .frame = frame,
        .speed = {fmax(step->entrainment + slide, 0) - frame,
                  fmax(step->entrainment - slide, 0) - frame},
        .rate = c[0],
        .p = ehl_fluid(r, film),
        .h = r->thick,
        .through = t->through,
        .full = film->full,
        .asperity = m->rough ? film->asperity : NULL,
        .friction = t->friction,
    };
    for (size_t i = 0; i < n; i++) {
        double carried = r->statistical.law ? r->p_a[i] : film->asperity[i] ? film->p[i] : 0;
        t->friction[i] = t->coefficient * carried * fabs(step->sliding);
    }
    for (size_t i = 0; i < n; i++) { /* the faces are at the nodes or between them, depending on the
                                        discretisation */
        double before = r->flux[r->asymmetric || i < 1 ? i : i - 1];
        t->through[i] = i > 0 && i + 1 < n ? -(before + r->flux[i]) / 2 : 0;
    }
    if (!(c[0] > 0)) {
        ehl_thermal_weigh(t, r, film);
        f.weight = t->weight;
        return f;
    }
    pressure_in_time(m, film, c);
    f.p_t = t->p_t;
    ehl_temperature past = ehl_thermal_state(t, t->past);
    f.past = past.T;
    f.past_modes[0] = past.modes[0];
    f.past_modes[1] = past.modes[1];
    return f;
}

/* Returns the factor on the tolerances above for a film whose `tolerance` is below the default, or
   whose time steps need a smaller error. */
static double tightness(const ehl_march *m)
{
    const double usual = 1e-5, least = 1e-4;
    return fmax(fmin(m->solver->tolerance / usual, 1) * m->exactness, least);
}

/* Computes the temperatures of the film and its factors. Returns 1 if both have converged. */
static int update(ehl_march *m, const ehl_step *step, const ehl_film *film, const double c[3])
{
    ehl_thermal *t = m->thermal;
    ehl_reynolds *r = m->solver->reynolds;
    const double part = tightness(m);
    const double in_time = m->rough ? SETTLED_ROUGH : SETTLED;
    const double settled = part * (c[0] > 0 ? in_time : SETTLED_STEADY);
    const double warm = part * t->share * (c[0] > 0 ? WARM : WARM_STEADY);
    ehl_reynolds_evaluate(r, step, film);
    ehl_energy_film f = film_of(m, step, film, c);
    ehl_temperature temperature = ehl_thermal_state(t, m->trial.heat);
    const double lag = c[0] > 0 ? warm : fmax(warm, LAGGING * fmin(t->off, EHL_LARGE_FACTOR));
    const int most = c[0] > 0 ? MOST_PASSES : STEADY_PASSES;
    int passes = 0;
    double before = HUGE_VAL;
    t->film = f;
    if (!(c[0] > 0)) /* a steady film evaluates all laws again, so earlier failures of laws are not
                        recorded */
        t->energy.law_status = FF_OK;
    do {
        ehl_energy_flow(&t->energy, &f, temperature.T);
        t->energy.keep = passes == 0 && c[0] > 0 && !m->rough ? KEPT * sqrt(part) : 0;
        const int slows = t->energy.change > SLOW_SWEEP * before || c[0] > 0;
        before = t->energy.change;
        t->energy.share =
            passes < WHOLE_PASSES || !slows ? t->share : fmin(t->share, SHARE_THAT_HESITATES);
        ehl_energy_sweep(&t->energy, &f, &temperature);
    } while (++passes < most && t->energy.change > lag);
    const int hesitates = c[0] > 0 && passes == MOST_PASSES && t->energy.change > warm;
    if (hesitates)
        t->share = fmax(SHARE_THAT_HESITATES * t->share, LEAST_SWEEP);
    before = t->off;
    t->off = ehl_thermal_find_factors(t, r, &f, film, ehl_thermal_factors(t, m->trial.heat));
    t->damping = t->off > SHRINKING * before ? fmax(LEAST_SHARE, 0.7 * t->damping)
                                             : fmin(1, 1.3 * t->damping);
    if (!(c[0] > 0) && t->round >= PLAIN_ROUNDS) {
        ehl_thermal_accelerate(t, f.count, ehl_thermal_factors(t, m->trial.heat));
        t->damping = MIXED;
    }
    t->idle = hesitates && t->off <= settled ? t->idle + 1 : 0;
    return t->off <= settled && t->energy.change <= warm;
}

ff_status ehl_thermal_solve(ehl_march *m, const ehl_step *step, ehl_film *film, double time,
                            int limit)
{
    ehl_thermal *t = m->thermal;
    double c[3] = {0, 0, 0};
    if (t->without)
        return m->solver->solve(m->solver, step, film, limit);
    if (m->known > 0)
        predict(m, time, c);
    t->solved++;
    t->off = HUGE_VAL;
    t->damping = t->share = 1;
    t->idle = 0;
    ehl_anderson_begin(&t->anderson);
    t->energy.reach = REACH * sqrt(tightness(m));
    for (t->round = 0; t->round < MOST_ROUNDS; t->round++) {
        take_factors(t, m->trial.heat);
        ff_status status = m->solver->solve(m->solver, step, film, limit);
        if (status != FF_OK)
            return status;
        t->rounds++;
        if (update(m, step, film, c))
            return FF_OK;
        if (t->idle > MOST_IDLE)
            return FF_NOCONV;
    }
    return FF_NOCONV;
}

void ehl_thermal_rest(ehl_march *m, const ehl_step *step, double time)
{
    ehl_thermal *t = m->thermal;
    double c[3];
    predict(m, time, c);
    ehl_reynolds_evaluate(m->solver->reynolds, step, &m->trial.film);
    ehl_energy_film f = film_of(m, step, &m->trial.film, c);
    ehl_temperature temperature = ehl_thermal_state(t, m->trial.heat);
    f.count = 1;
    ehl_energy_sweep(&t->energy, &f, &temperature);
    memcpy(ehl_thermal_factors(t, m->trial.heat), ehl_thermal_factors(t, m->state[0].heat),
           FACTORS * t->energy.nodes * sizeof *t->ease);
}

double ehl_thermal_mean(const ehl_march *m, size_t i)
{
    const ehl_across *a = &m->thermal->energy.across;
    const double *T = m->state[0].heat + i * a->count;
    double sum = 0;
    for (size_t k = 0; k < a->count; k++)
        sum += a->weight[k] * T[k];
    return sum;
}

double ehl_thermal_highest(const ehl_march *m)
{
    const ehl_thermal *t = m->thermal;
    const ehl_across *a = &t->energy.across;
    double most = t->energy.T_in;
    for (size_t i = 0; i < t->energy.nodes; i++)
        if (m->state[0].film.full[i])
            most = ehl_across_highest(a, m->state[0].heat + i * a->count, most);
    return most;
}

double ehl_thermal_flash(const ehl_march *m)
{
    const ehl_thermal *t = m->thermal;
    size_t n = t->energy.across.count;
    double most = 0;
    for (size_t i = 0; i < t->energy.nodes; i++)
        if (m->state[0].film.full[i])
            most = fmax(most, fmax(m->state[0].heat[i * n], m->state[0].heat[i * n + n - 1]) -
                                  t->energy.T_in);
    return most;
}

double ehl_thermal_stress(const ehl_march *m, size_t i)
{
    const ehl_energy *e = &m->thermal->energy;
    size_t n = e->across.count;
    double sum = 0; /* at mid-film, since the stress is linear across the film */
    for (size_t k = 0; k < n; k++)
        sum += e->across.weight[k] * e->tau[i * n + k];
    return m->mirrored ? sum : -sum;
}
