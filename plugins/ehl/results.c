/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "results.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int wants(const ff_results *r, uint32_t output)
{
    return (r->wanted & FF_BIT(output)) != 0;
}

ff_status ff_results_create(ff_results *r, const ff_host *host, uint64_t wanted, size_t count,
                            const ff_march *m)
{
    size_t nodes = m->solver->grid->nodes, shape[2] = {count, nodes};
    *r = (ff_results){
        .host = host,
        .wanted = wanted,
        .count = count,
        .nodes = nodes,
        .lowest = HUGE_VAL,
        .least_resolution = HUGE_VAL,
        .least_inlet = HUGE_VAL,
    };
    r->memory = calloc(2 * nodes, sizeof *r->memory);
    if (!r->memory)
        return FF_NOMEM;
    r->tau = r->memory;
    r->ln_eta = r->memory + nodes;
    for (uint32_t k = 0; k < FF_EHL_SERIES; k++)
        if (wants(r, k) && !(r->series[k] = ff_put_series(host, k, count)))
            return FF_NOMEM;
    if (wants(r, FF_EHL_FILM) && !(r->film = host->output(host->ctx, FF_EHL_FILM, 2, shape)))
        return FF_NOMEM;
    if (wants(r, FF_EHL_PRESSURE) &&
        !(r->pressure = host->output(host->ctx, FF_EHL_PRESSURE, 2, shape)))
        return FF_NOMEM;
    return FF_OK;
}

void ff_results_destroy(ff_results *r)
{
    free(r->memory);
    r->memory = NULL;
}

static void put(const ff_results *r, uint32_t output, size_t k, double value)
{
    if (r->series[output])
        r->series[output][k] = value;
}

/* Least value of the parabola through the lowest node and its neighbours. */
static double valley(const double *h, size_t nodes, size_t *at)
{
    size_t i = 0;
    for (size_t k = 1; k < nodes; k++)
        if (h[k] < h[i])
            i = k;
    *at = i;
    if (i == 0 || i + 1 == nodes)
        return h[i];
    double slope = (h[i + 1] - h[i - 1]) / 2, bend = h[i + 1] - 2 * h[i] + h[i - 1];
    return bend > 0 ? h[i] - slope * slope / (2 * bend) : h[i];
}

/* Cubic through the four nodes around x = 0. */
static double at_centre(const ff_grid *g, const double *y)
{
    double place = g->inlet / g->dx;
    size_t i = (size_t)place;
    i = i < 1 ? 1 : i > g->nodes - 3 ? g->nodes - 3 : i;
    double t = place - (double)i;
    return -t * (t - 1) * (t - 2) / 6 * y[i - 1] + (t + 1) * (t - 1) * (t - 2) / 2 * y[i] -
           (t + 1) * t * (t - 2) / 2 * y[i + 1] + (t + 1) * t * (t - 1) / 6 * y[i + 2];
}

/* The Poiseuille part of the shear stress, +-h/2 dp/dx, is of opposite sign on the two flanks and
   is left out. */
static void record_friction(ff_results *r, const ff_march *m, size_t k)
{
    const ff_reynolds *eq = m->solver->reynolds;
    const double *p = m->state[0].film.p;
    size_t count = eq->last + 1;
    double sliding = m->at.sliding, sum = 0;
    ff_status status = ff_fluid_shear(&eq->laws, count, p, eq->h, sliding, r->ln_eta, r->tau);
    r->out_of_law |= status != FF_OK;
    for (size_t i = 0; i < count; i++)
        sum += p[i] > 0 ? r->tau[i] : 0;
    double traction = sum * eq->dx;
    put(r, FF_EHL_TRACTION, k, traction);
    put(r, FF_EHL_POWER_LOSS, k, traction * sliding);
    put(r, FF_EHL_FRICTION_COEFFICIENT, k, m->at.load > 0 ? traction / m->at.load : 0);
}

/*
 * Balance of mass of the full film from the first to the last node with 1 % of the highest
 * pressure, and of the nodes that ought to be cavitated, both over the flow. In front of that the
 * gap is so wide that a pressure of a few Pa moves more oil than the contact passes.
 */
static double record_mass(ff_results *r, const ff_march *m, double h, double p_max)
{
    ff_reynolds *eq = m->solver->reynolds;
    const ff_film *film = &m->state[0].film;
    double sum = 0, inside = 0, gain = 0;
    int begun = 0;
    double speed = m->step.entrainment + m->step.rate * m->solver->grid->half_width;
    ff_reynolds_evaluate(eq, &m->step, film);
    r->out_of_law |= eq->law_status != FF_OK;
    for (size_t i = 1; i + 1 < eq->nodes; i++) {
        begun |= film->p[i] > 0.01 * p_max;
        inside += begun && film->wet[i] ? eq->residual[i] : 0;
        if (film->p[i] > 0.01 * p_max)
            sum = inside; /* what comes later counts when such a pressure follows */
        if (!film->wet[i])
            gain = fmax(gain, eq->residual[i] / fmax(eq->h[i], h));
    }
    sum = fabs(sum) / (eq->oil.density * h * speed);
    r->worst_mass = fmax(r->worst_mass, sum);
    r->worst_complement = fmax(r->worst_complement, gain / (eq->oil.density * speed));
    return sum;
}

/*
 * Cells over the length in which the pressure of the inlet rises: where the Hertzian gap in front
 * of the contact has grown by h (Greenwood 1972), and not longer than sqrt(2 R h).
 */
static double resolution(const ff_march *m, double h)
{
    double radius = m->at.radius;
    double a = ff_hertz_half_width(m->at.load, radius, m->history->modulus);
    double sharp = a * pow(3 / (2 * sqrt(2)) * h * radius / (a * a), 2. / 3);
    return fmin(sharp, sqrt(2 * radius * h)) / m->solver->grid->dx;
}

/*
 * Truncation of the last step at a node, from differences of equal steps: second derivative/2 of
 * Euler, 2/9 of the third of BDF2. It is carried off with the film in one passage 2 a/u.
 */
static double time_error(ff_results *r, const ff_march *m, size_t node)
{
    double y[FF_STATES];
    if (m->known < FF_STATES)
        return 0;
    for (size_t s = 0; s < FF_STATES; s++)
        y[s] = m->state[s].film.v[node] + m->state[s].film.h00;
    double second = y[0] - 2 * y[1] + y[2], third = second - (y[1] - 2 * y[2] + y[3]);
    double step = m->scheme == FF_EULER ? second / 2 : 2 * third / 9;
    double dt = m->state[0].time - m->state[1].time;
    double passed = dt * m->at.entrainment / (2 * m->solver->grid->half_width);
    r->time_error = r->time_error * fmax(0, 1 - passed) + step;
    return fabs(r->time_error);
}

static void record_errors(ff_results *r, const ff_march *m, size_t k, size_t node, double h_min,
                          double h_central)
{
    const ff_grid *g = m->solver->grid;
    double error = time_error(r, m, node);
    double carried = ff_film_load(&m->state[0].film, g->nodes, g->dx);
    double off = fabs(carried - m->step.load) / m->history->load_max;
    put(r, FF_EHL_LOAD_ERROR, k, off);
    if (!m->step.loaded)
        r->lost_force = fmax(r->lost_force, off);
    else if (k > 0 || !m->start_unloaded)
        r->worst_load = fmax(r->worst_load, off);
    if (m->step.loaded && m->step.load >= 0.02 * m->history->load_max) {
        double cells = resolution(m, h_central);
        double a = ff_hertz_half_width(m->at.load, m->at.radius, m->history->modulus);
        r->least_resolution = fmin(r->least_resolution, cells);
        r->least_inlet = fmin(r->least_inlet, (g->inlet - a) / sqrt(2 * m->at.radius * h_central));
        int second = m->solver->reynolds->wedge == 2;
        error += fmin(1, second ? 0.3 / (cells * cells) : 0.3 / cells) * h_min;
    }
    put(r, FF_EHL_H_MIN_ERROR, k, error);
}

static void record_fields(ff_results *r, const ff_march *m, size_t k)
{
    const double *p = m->state[0].film.p, *h = m->solver->reynolds->h;
    size_t n = r->nodes;
    for (size_t i = 0; i < n; i++) {
        size_t to = k * n + (m->history->mirrored ? n - 1 - i : i);
        if (r->film)
            r->film[to] = h[i];
        if (r->pressure)
            r->pressure[to] = p[i];
    }
}

void ff_results_record(ff_results *r, ff_march *m, size_t k)
{
    enum { SAMPLE = 16 };
    const ff_film *film = &m->state[0].film;
    ff_reynolds *eq = m->solver->reynolds;
    ff_reynolds_gap(eq, m->step.radius, film);
    size_t node;
    double h_min = valley(eq->h, r->nodes, &node), h_central = at_centre(m->solver->grid, eq->h);
    double p_max = 0;
    for (size_t i = 0; i < r->nodes; i++)
        p_max = film->p[i] > p_max ? film->p[i] : p_max;
    ff_instant at = m->at;
    put(r, FF_EHL_TIME, k, at.time);
    put(r, FF_EHL_ROLL_ANGLE, k, at.roll);
    put(r, FF_EHL_H_MIN, k, h_min);
    put(r, FF_EHL_H_CENTRAL, k, h_central);
    put(r, FF_EHL_P_MAX, k, p_max);
    if (h_min < r->lowest) {
        r->lowest = h_min;
        r->lowest_at = at.roll;
    }
    r->highest = fmax(r->highest, p_max);
    if (wants(r, FF_EHL_FRICTION_COEFFICIENT) || wants(r, FF_EHL_TRACTION) ||
        wants(r, FF_EHL_POWER_LOSS))
        record_friction(r, m, k);
    if (r->film || r->pressure)
        record_fields(r, m, k);
    record_errors(r, m, k, node, h_min, h_central);
    if (r->series[FF_EHL_MASS_ERROR] || k % SAMPLE == 0 || k + 1 == r->count)
        put(r, FF_EHL_MASS_ERROR, k, record_mass(r, m, h_central, p_max));
}

static void quality_line(const ff_results *r, const char *name, double value, double limit,
                         int32_t beyond, const char *text)
{
    r->host->quality(r->host->ctx, name, value, limit, value <= limit ? FF_GOOD : beyond, text);
}

static void quality(const ff_results *r, const ff_march *m)
{
    const ff_host *host = r->host;
    double limit = fmax(10 * m->solver->tolerance, 1e-9);
    char text[256];
    quality_line(r, "load_balance", r->worst_load, 1e-8, FF_BAD,
                 "integral of p against the load, over the largest load; loaded instants");
    quality_line(r, "mass_balance", r->worst_mass, limit, FF_DOUBTFUL,
                 "inflow - outflow - storage of the film with pressure, over the flow");
    /* a pressure within the tolerance moves that times about sqrt(2 R h)/dx, some 100, of the flow
     */
    quality_line(r, "complementarity", r->worst_complement, 10 * limit, FF_DOUBTFUL,
                 "mass gained by a cell with p = 0, over the flow there");
    quality_line(r, "steps_cut", m->steps_cut, 0.01 * (double)r->count, FF_DOUBTFUL,
                 "time steps that had to be cut");
    if (isfinite(r->least_resolution))
        host->quality(host->ctx, "film_resolution", r->least_resolution, 4,
                      r->least_resolution >= 4 ? FF_GOOD : FF_DOUBTFUL,
                      "least cells over the inlet's pressure rise; below 4 the film depends on the "
                      "grid by more than 2 %: use more cells");
    if (isfinite(r->least_inlet))
        host->quality(
            host->ctx, "inlet_length", r->least_inlet, 4,
            r->least_inlet >= 4 ? FF_GOOD : FF_DOUBTFUL,
            "least length of the domain in front of the contact over sqrt(2 R h); below 4 "
            "the film is starved by about 1 % or more: move the inlet out");
    if (r->out_of_law)
        host->quality(host->ctx, "law_range", 1, 0, FF_DOUBTFUL,
                      "an oil law was continued outside its range");
    if (m->bare_steps > 0)
        host->quality(host->ctx, "bare_steps", m->bare_steps, 0, FF_DOUBTFUL,
                      "steps without load that were carried on without pressure, because Newton's "
                      "method failed there");
    if (r->lost_force > 0)
        host->quality(host->ctx, "unloaded_force", r->lost_force, 1, FF_GOOD,
                      "largest force of the film without contact, over the largest load");
    const ff_tally *tally = &m->solver->tally;
    snprintf(text, sizeof text, "%s%s; %.3g Newton steps and %.3g convolutions per instant",
             r->count > 1 ? "converged at every instant" : "converged",
             m->start_unloaded ? "; begins without load, from the film of 1 % of the largest load"
                               : "",
             tally->newton / (double)r->count, tally->convolutions / (double)r->count);
    host->quality(host->ctx, "status", 0, 0, FF_GOOD, text);
}

ff_status ff_results_finish(ff_results *r, const ff_march *m)
{
    const ff_tally *tally = &m->solver->tally;
    const struct {
        uint32_t output;
        double value;
    } scalar[] = {
        {FF_EHL_H_MIN_LOWEST, r->lowest},           {FF_EHL_H_MIN_LOWEST_AT, r->lowest_at},
        {FF_EHL_P_MAX_HIGHEST, r->highest},         {FF_EHL_NEWTON_STEPS, tally->newton},
        {FF_EHL_CONVOLUTIONS, tally->convolutions}, {FF_EHL_STEPS_CUT, m->steps_cut},
    };
    for (size_t k = 0; k < sizeof scalar / sizeof scalar[0]; k++)
        if (wants(r, scalar[k].output) &&
            ff_put_scalar(r->host, scalar[k].output, scalar[k].value) != FF_OK)
            return FF_NOMEM;
    if (wants(r, FF_EHL_X)) {
        const ff_grid *g = m->solver->grid;
        double *x = ff_put_series(r->host, FF_EHL_X, r->nodes);
        if (!x)
            return FF_NOMEM;
        for (size_t i = 0; i < r->nodes; i++) {
            double at = g->first + (double)i * g->dx;
            x[m->history->mirrored ? r->nodes - 1 - i : i] = m->history->mirrored ? -at : at;
        }
    }
    quality(r, m);
    return FF_OK;
}
