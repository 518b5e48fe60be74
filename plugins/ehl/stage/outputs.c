/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "outputs.h"

#include "../contact/simd-reductions.h"
#include "../equations/asperities.h"
#include "../errors/time-error.h"
#include "../heat/heat.h"
#include "../heat/thermal.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int wants(const ehl_results *r, uint32_t output)
{
    return (r->wanted & FF_BIT(output)) != 0;
}

static void table_destroy(ehl_rows *t)
{
    free(t->data);
    t->data = NULL;
}

/* Appends a row and returns it. Returns NULL if out of memory. */
static double *table_row(ehl_rows *t)
{
    if (t->count == t->room) {
        size_t room = t->room > 0 ? 2 * t->room : 16;
        double *data = realloc(t->data, room * t->width * sizeof *data);
        if (!data)
            return NULL;
        t->data = data;
        t->room = room;
    }
    return t->data + t->width * t->count++;
}

ff_status ehl_results_create(ehl_results *r, const ff_host *host, uint64_t wanted, int judged,
                             const ehl_march *m)
{
    size_t nodes = m->solver->grid->nodes;
    /* without a law of rheology the friction at a spike goes with its viscosity */
    const int newtonian = !m->solver->reynolds->laws.rheology && ehl_loss_of_shear(wanted);
    *r = (ehl_results){
        .host = host,
        .wanted = wanted,
        .judged = judged,
        .peaks = newtonian || ehl_wants_p_max(wanted),
        .nodes = nodes,
        .rough = m->rough != NULL,
        .lowest_alone = !m->solver->outside && ehl_wants_lowest_alone(wanted),
        .highest_alone = !m->solver->outside && !newtonian && ehl_wants_highest_alone(wanted),
        .series.width = EHL_SERIES,
        .space.width = EHL_SPACE,
        .share = 1,
        .lowest = HUGE_VAL,
        .least_in_time = HUGE_VAL,
        .least_lambda = HUGE_VAL,
        .least_resolution = HUGE_VAL,
        .least_inlet = HUGE_VAL,
        .least_gap = HUGE_VAL,
    };
    for (uint32_t k = 0; k < EHL_FIELDS; k++)
        r->field[k].width = wants(r, EHL_FIRST_FIELD + k) ? nodes : 0;
    if (ehl_balance_create(&r->balance, m) != FF_OK)
        return FF_NOMEM;
    r->memory = calloc(2 * nodes, sizeof *r->memory);
    if (!r->memory)
        return FF_NOMEM;
    r->tau = r->memory;
    r->ln_eta = r->memory + nodes;
    return FF_OK;
}

void ehl_results_destroy(ehl_results *r)
{
    table_destroy(&r->series);
    table_destroy(&r->space);
    for (size_t k = 0; k < EHL_FIELDS; k++)
        table_destroy(&r->field[k]);
    ehl_balance_destroy(&r->balance);
    free(r->memory);
    r->memory = NULL;
}

/* Returns the mean film thickness over the middle half of the Hertz width, m. */
static double mean_film(const ehl_march *m)
{
    const ehl_grid *g = m->solver->grid;
    double a = ehl_hertz_half_width(m->step.load, m->at.radius, m->history->modulus), sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < g->nodes; i++)
        if (fabs(m->solver->reynolds->first + (double)i * g->dx) <= fmax(a / 2, g->dx)) {
            sum += m->solver->reynolds->h[i];
            count++;
        }
    return sum / (double)count;
}

/* Returns the film thickness as a spring in series with the teeth: h00 minus the gap that the model
   of the motion includes, minus h00 of the dry Hertzian contact under the same force. The pressure
   deflects the middle by (4/(pi E')) w (ln(2 X/a) + 1/2), where X = half_width is the distance at
   which the kernel is 0. */
static double separation_of(const ehl_march *m)
{
    const ehl_grid *g = m->solver->grid;
    const ehl_film *film = &m->state[0].film;
    double load = ehl_film_load(film, g->nodes, g->dx), modulus = m->history->modulus;
    double a = ehl_hertz_half_width(load, m->step.radius, modulus), beyond = film->h00 - m->at.gap;
    if (load > 0)
        beyond += 4 * load / (M_PI * modulus) * (log(2 * g->half_width / a) + 0.5);
    return beyond < 0 ? 0 : beyond;
}

/* Records the load on asperities, and the load on oil that is trapped between two asperities. */
static void record_contact(ehl_results *r, const ehl_march *m)
{
    const ehl_grid *g = m->solver->grid;
    const ehl_film *film = &m->state[0].film;
    double load = ehl_film_load(film, g->nodes, g->dx) / g->dx, carried = 0, between = 0, shut = 0;
    size_t touching = 0;
    for (size_t i = 1; i + 1 < g->nodes; i++) {
        if (film->asperity[i]) {
            carried += film->p[i];
            shut = between;
            touching++;
        } else if (touching > 0)
            between += film->p[i];
    }
    double a = ehl_hertz_half_width(m->at.load, m->at.radius, m->history->modulus);
    if (!(load > 0 && m->at.load > 0) || m->contact_lost)
        return;
    r->row[EHL_ASPERITY_LOAD_SHARE] = carried / load;
    r->row[EHL_TRAPPED_SHARE] = shut / load;
    r->row[EHL_CONTACT_RATIO] = fmin(1, (double)touching * g->dx / (2 * a));
    r->share_sum += carried / load;
    r->trapped_sum += shut / load;
    r->ratio_sum += r->row[EHL_CONTACT_RATIO];
    r->loaded++;
}

/* Records the load that the asperities of statistical flanks carry. */
static void record_statistical(ehl_results *r, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    double load = ehl_film_load(&m->state[0].film, eq->nodes, eq->dx) / eq->dx;
    double carried = ehl_sum(eq->nodes, eq->p_a), least = ehl_least(eq->nodes, eq->h);
    r->least_gap = fmin(r->least_gap, least / eq->statistical.law->sigma);
    if (!(load > 0 && m->at.load > 0) || m->contact_lost)
        return;
    r->row[EHL_ASPERITY_LOAD_SHARE] = carried / load;
    r->share_sum += carried / load;
    r->loaded++;
}

/* Records the load on yielding metal, and the error in plastic (H - p) = 0 (asperities.h). The
   plastic part is recomputed from the gap: the gap minus that of elastic flanks. */
static void record_yield(ehl_results *r, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_film *film = &m->state[0].film;
    const double molecule = 1e-9; /* m; a smaller gap is not used as the reference of the plastic
                                     part */
    double deepest = 0, load = ehl_film_load(film, eq->nodes, eq->dx);
    for (size_t i = 1; i + 1 < eq->nodes; i++) {
        double elastic =
            film->h00 + eq->half_square[i] / m->step.radius + film->v[i] - eq->rough[i];
        double plastic = eq->h[i] - elastic, below = 1 - film->p[i] / eq->hardness;
        deepest = fmax(deepest, plastic);
        plastic /= fmax(eq->h[i], molecule);
        r->worst_yield = fmax(r->worst_yield, fabs(fmin(plastic, below)));
    }
    double share = load > 0 ? ehl_yield_load(eq, film) / load : 0;
    r->row[EHL_YIELD_SHARE] = share;
    r->row[EHL_PLASTIC_DEPTH_MAX] = share > 0 ? deepest : 0;
    r->yield_sum += share;
    r->deepest_yield = fmax(r->deepest_yield, r->row[EHL_PLASTIC_DEPTH_MAX]);
}

/* Returns the largest imbalance of mass between the highest pressure and another node: the sum of
   the residuals over the flow at that node. The flow is the sum of the entrained flow and the
   pressure flow of p_max over one cell (check_mass in balance.c). */
static double unbalanced(const ehl_reynolds *eq, const ehl_film *film, double flow)
{
    size_t peak = 1;
    double most = 0, sum = 0;
    for (size_t i = 1; i + 1 < eq->nodes; i++)
        peak = film->p[i] > film->p[peak] ? i : peak;
    double per_cell = film->p[peak] / eq->dx;
    for (size_t i = peak; i + 1 < eq->nodes; i++) {
        sum += film->asperity[i] ? 0 : eq->residual[i];
        most = fmax(most, fabs(sum) / (flow + eq->f[i] * per_cell));
    }
    sum = 0;
    for (size_t i = peak; i > 0; i--) {
        sum += film->asperity[i] ? 0 : eq->residual[i];
        most = fmax(most, fabs(sum) / (flow + eq->f[i] * per_cell));
    }
    return most;
}

/*
 * Records the balance of mass with rough flanks, relative to the flow: of the nodes outside
 * contacts, of cavitated nodes, and of nodes in contact. The nodes move with the oil. The residuals
 * are those of the solver's equations.
 */
static double record_mass(ehl_results *r, const ehl_march *m)
{
    ehl_reynolds *eq = m->solver->reynolds;
    const ehl_film *film = &m->state[0].film;
    double gain = 0, supply = 0;
    double speed = m->at.entrainment + m->step.rate * m->solver->grid->half_width;
    ehl_reynolds_evaluate(eq, &m->step, film);
    ehl_law_note(&r->laws, eq->law_status);
    for (size_t i = 1; i + 1 < eq->nodes; i++) {
        if (film->asperity[i]) { /* oil that would be missing even if the cell were emptied */
            double lacking = eq->dx * m->step.rate * (eq->mass[i] - m->state[0].mass[i]);
            supply -= fmin(0, eq->residual[i] + lacking);
        } else if (ehl_is_cavitated(eq, film, i)) {
            gain = fmax(gain, film->content[i] / (eq->oil.density * eq->h[i]) - 1);
        }
    }
    double flow = eq->oil.density * mean_film(m) * speed, off = unbalanced(eq, film, flow);
    r->worst_supply = fmax(r->worst_supply, supply / flow);
    r->worst_mass = fmax(r->worst_mass, off);
    r->worst_complement = fmax(r->worst_complement, gain);
    return off;
}

static void record_balance(ehl_results *r, const ehl_march *m)
{
    const ehl_grid *g = m->solver->grid;
    const ehl_film *film = &m->state[0].film;
    double carried = ehl_film_load(film, g->nodes, g->dx), most = m->history->load_max;
    double off = fabs(carried - (m->contact_lost ? m->at.load : m->step.load)) / most;
    r->row[EHL_LOAD_ERROR] = off;
    /* p[0] dx/2: from the start of the cell to the first node */
    r->row[EHL_LOAD_AHEAD] = film->ahead + film->p[0] * g->dx / 2;
    if (m->contact_lost)
        r->lost_force = fmax(r->lost_force, off);
    else
        r->worst_load = fmax(r->worst_load, off);
    double gap_excess = m->contact_lost && m->step.loaded ? film->h00 - m->at.gap : 0;
    r->row[EHL_ONE_WAY_GAP_ERROR] = gap_excess;
    r->worst_gap_excess = fmax(r->worst_gap_excess, gap_excess);
    r->widest_gap = fmax(r->widest_gap, m->at.gap);
}

/* Returns the value of a field at node i. */
static double field_value(const ehl_reynolds *eq, const ehl_film *film, uint32_t output, size_t i)
{
    switch (output) {
    case EHL_FILM:
        return eq->h[i];
    case EHL_PRESSURE:
        return film->p[i];
    case EHL_ASPERITY_PRESSURE:
        return eq->statistical.law ? eq->p_a[i] : film->asperity[i] ? film->p[i] : 0;
    case EHL_PLASTIC_DEPTH:
        return film->plastic ? film->plastic[i] : 0;
    case EHL_ROUGHNESS:
        return eq->rough ? eq->rough[i] : 0;
    default: /* fraction of the gap that is filled */
        return ehl_is_cavitated(eq, film, i)
                   ? fmin(film->content[i] / (eq->oil.density * eq->h[i]), 1)
                   : 1;
    }
}

/* Records the fields. Nodes that move with the oil are up to a cell away from the places of the
   outputs. An output takes the value of the nearest node, since a mean of two nodes would hide a
   contact at only one of them. */
static ff_status record_fields(ehl_results *r, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    size_t n = r->nodes, behind = eq->first - m->solver->grid->first > eq->dx / 2;
    for (uint32_t k = 0; k < EHL_FIELDS; k++) {
        if (r->field[k].width == 0)
            continue;
        double *row = table_row(&r->field[k]);
        if (!row)
            return FF_NOMEM;
        for (size_t i = 0; i < n; i++)
            row[m->mirrored ? n - 1 - i : i] =
                EHL_FIRST_FIELD + k == EHL_TEMPERATURE
                    ? ehl_thermal_mean(m, i)
                    : field_value(eq, &m->state[0].film, EHL_FIRST_FIELD + k,
                                  i > 0 ? i - behind : 0);
    }
    return FF_OK;
}

/* Records film and pressure, their extremes over all rows, and the errors of this row. */
static void record_film(ehl_results *r, const ehl_march *m)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = m->state[0].film.p;
    size_t node, peak = 0;
    double h_min = ehl_least_film(eq, &node), h_central = ehl_central_film(m->solver->grid, eq),
           p_max = m->state[0].highest;
    while (peak + 1 < r->nodes && !(p[peak] >= p_max))
        peak++;
    r->row[EHL_H_MIN] = h_min;
    r->row[EHL_H_CENTRAL] = h_central;
    r->row[EHL_P_MAX] = p_max;
    r->row[EHL_SEPARATION] = separation_of(m);
    r->row[EHL_LOAD_PER_WIDTH] = ehl_film_load(&m->state[0].film, r->nodes, m->solver->grid->dx);
    ehl_lowest_add(&r->engagements, r->row[EHL_ENGAGEMENT], h_min);
    if (h_min < r->lowest) {
        r->lowest = h_min;
        r->lowest_at = m->at.roll;
    }
    r->highest = fmax(r->highest, p_max);
    double middle = m->rough ? mean_film(m) : h_central;
    ehl_results_errors(r, m, node, middle, p_max);
    ehl_results_peak_in_time(r, m, peak, p_max);
    if (r->roughness > 0) {
        r->row[EHL_LAMBDA_RATIO] = middle / r->roughness;
        r->least_lambda = fmin(r->least_lambda, r->row[EHL_LAMBDA_RATIO]);
    }
}

ff_status ehl_results_record(ehl_results *r, ehl_march *m, int last)
{
    enum { SAMPLE = 16 };
    const ehl_film *film = &m->state[0].film;
    ehl_reynolds *eq = m->solver->reynolds;
    size_t k = r->series.count;
    r->row = table_row(&r->series);
    r->row_in_space = table_row(&r->space);
    if (!r->row || !r->row_in_space)
        return FF_NOMEM;
    memset(r->row, 0, EHL_SERIES * sizeof *r->row);
    memset(r->row_in_space, 0, EHL_SPACE * sizeof *r->row_in_space);
    ehl_reynolds_gap(eq, m->step.radius, film);
    r->row[EHL_TIME] = m->at.time;
    r->row[EHL_ROLL_ANGLE] = m->at.roll;
    r->row[EHL_ENGAGEMENT] = m->history->engagement ? m->history->engagement[0] : 0;
    const double *before = r->row - EHL_SERIES;
    if (k > 0 && r->row[EHL_ENGAGEMENT] == before[EHL_ENGAGEMENT])
        ehl_history_sample(m->history, before[EHL_TIME], m->at.time, &r->sampling);
    r->tolerance = fmax(r->tolerance, m->solver->tolerance);
    record_film(r, m);
    ehl_results_loss(r, m);
    record_balance(r, m);
    ehl_law_note(&r->laws, eq->law_status);
    if (m->thermal)
        ehl_law_note(&r->laws, m->thermal->energy.law_status);
    if (m->heat)
        ehl_law_note(&r->laws, m->heat->law_status);
    if (m->rough)
        record_contact(r, m);
    if (eq->statistical.law)
        record_statistical(r, m);
    if (film->plastic)
        record_yield(r, m);
    if (wants(r, EHL_TEMPERATURE_MAX))
        r->row[EHL_TEMPERATURE_MAX] = ehl_thermal_highest(m);
    if (wants(r, EHL_FLASH_TEMPERATURE))
        r->row[EHL_FLASH_TEMPERATURE] = ehl_thermal_flash(m);
    ff_status status = record_fields(r, m);
    int undecided = m->solver->counters.undecided > r->undecided;
    r->undecided = m->solver->counters.undecided;
    int begins = m->smooth < EHL_STATES; /* the time integration formula restarts at these films */
    int wholly = wants(r, EHL_MASS_ERROR) || k % SAMPLE == 0 || last || undecided || begins;
    double mass = ehl_balance_hold(&r->balance, m, wholly);
    if (wholly && m->thermal)
        ehl_thermal_hold(m);
    if (wholly) {
        ehl_balance_outputs(&r->balance, m, r->row, r->wanted, r->boundary_friction);
        r->row[EHL_MASS_ERROR] = m->rough ? record_mass(r, m) : mass;
    }
    return status;
}

/* Returns the error of a film due to the cells. Between parted flanks it is not known: the film
   follows from their separation, in which the steps of a landing and of a take-off add up. */
static double space_part_of_film(const ehl_results *r, size_t i, int kind)
{
    const int parted = r->space.data[i * EHL_SPACE + EHL_PARTED] > 0;
    return parted ? (double)INFINITY : ehl_space_part(r, i, kind);
}

/* Returns the error due to the cells that an error output must include, or 0 for other outputs. */
static double space_part(const ehl_results *r, size_t i, uint32_t k)
{
    return k == EHL_H_MIN_ERROR       ? space_part_of_film(r, i, EHL_LEAST)
           : k == EHL_H_CENTRAL_ERROR ? space_part_of_film(r, i, EHL_CENTRAL)
           : k == EHL_P_MAX_ERROR     ? ehl_space_part(r, i, EHL_PEAK)
                                      : 0;
}

static ff_status output_series(const ehl_results *r)
{
    size_t count = r->series.count;
    for (uint32_t k = 0; k < EHL_SERIES; k++) {
        double *to = wants(r, k) ? ff_put_series(r->host, k, count) : NULL;
        if (wants(r, k) && !to)
            return FF_NOMEM;
        for (size_t i = 0; i < count && to; i++)
            to[i] = r->series.data[i * EHL_SERIES + k] + space_part(r, i, k);
    }
    return FF_OK;
}

static ff_status output_field(const ehl_results *r, uint32_t output, const ehl_rows *table)
{
    size_t shape[2] = {table->count, table->width};
    if (table->width == 0)
        return FF_OK;
    double *to = r->host->output(r->host->ctx, output, 2, shape);
    if (!to)
        return FF_NOMEM;
    memcpy(to, table->data, table->count * table->width * sizeof *to);
    return FF_OK;
}

static ff_status output_x(const ehl_results *r, const ehl_march *m)
{
    const ehl_grid *g = m->solver->grid;
    double *x = ff_put_series(r->host, EHL_X, r->nodes);
    if (!x)
        return FF_NOMEM;
    for (size_t i = 0; i < r->nodes; i++) {
        double at = g->first + (double)i * g->dx;
        x[m->mirrored ? r->nodes - 1 - i : i] = m->mirrored ? -at : at;
    }
    return FF_OK;
}

ff_status ehl_results_finish(const ehl_results *r, const ehl_march *m)
{
    const ehl_counters *counters = &m->solver->counters;
    const struct {
        uint32_t output;
        double value;
    } scalar[] = {
        {EHL_H_MIN_LOWEST, r->lowest},
        {EHL_H_MIN_LOWEST_AT, r->lowest_at},
        {EHL_H_MIN_LOWEST_MEAN, ehl_lowest_mean(&r->engagements)},
        {EHL_H_MIN_LOWEST_SPREAD, ehl_lowest_spread(&r->engagements)},
        {EHL_ENGAGEMENTS_JUDGED, r->engagements.count},
        {EHL_P_MAX_HIGHEST, r->highest},
        {EHL_NEWTON_STEPS, counters->newton},
        {EHL_CONVOLUTIONS, counters->convolutions},
        {EHL_STEPS_CUT, m->steps_cut},
        {EHL_LAMBDA_RATIO_LOWEST, r->least_lambda},
        {EHL_RQ_LEFT_OUT, m->rough ? m->rough->left_out : 0},
    };
    for (size_t k = 0; k < sizeof scalar / sizeof scalar[0]; k++)
        if (wants(r, scalar[k].output) &&
            ff_put_scalar(r->host, scalar[k].output, scalar[k].value) != FF_OK)
            return FF_NOMEM;
    ff_status status = wants(r, EHL_X) ? output_x(r, m) : FF_OK;
    if (status == FF_OK && wants(r, EHL_ALPHA_STAR))
        status =
            ehl_put_alpha_star(r->host, EHL_ALPHA_STAR, ehl_alpha_star(&m->solver->reynolds->laws));
    if (status == FF_OK)
        status = output_series(r);
    for (uint32_t k = 0; status == FF_OK && k < EHL_FIELDS; k++)
        status = output_field(r, EHL_FIRST_FIELD + k, &r->field[k]);
    if (status == FF_OK)
        ehl_results_quality(r, m);
    return status;
}
