/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "estimate.h"

#include "../contact/parted.h"
#include "../contact/surface.h"
#include "inlet-heat.h"
#include "inlet.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

/* For the film, loads below this share of the largest load are replaced by this share
   (estimate.h). */
static const double light = 0.01;

static const uint64_t fields =
    FF_BIT(EHL_ESTIMATE_X) | FF_BIT(EHL_ESTIMATE_FILM) | FF_BIT(EHL_ESTIMATE_PRESSURE);

double ehl_hertz_gap(double s)
{
    if (!(s > 1))
        return 0;
    double y = sqrt((s - 1) * (s + 1));
    return s * y - asinh(y);
}

double ehl_estimate_moes(const ehl_estimate *e, const ehl_instant *at)
{
    ehl_oil oil = e->oil;
    oil.alpha = e->alpha;
    return ehl_moes_film(at, e->history.modulus, &oil);
}

ff_status ehl_estimate_ready(void *self)
{
    static const char field_rows[] = "x|film|pressure";
    const ehl_estimate *e = self;
    const int bare = !e->asperities, cold = e->thermal != EHL_THERMAL_LOCAL;
    static const char smooth[] = "no surface of statistical flanks is wired",
                      unheated[] = "thermal is not local";
    const ff_serving rows[] = {
        {bare, "share", "", NULL, smooth},
        {bare, "boundary_friction", "", NULL, smooth},
        {bare, "asperity_hardness", "", NULL, smooth},
        {bare, "gear.hardness", "", NULL, smooth},
        {cold, "bulk_temperature", "", NULL, unheated},
        {cold, "flank_conductivity", "", NULL, unheated},
        {cold, "flank_density", "", NULL, unheated},
        {cold, "flank_heat_capacity", "", NULL, unheated},
        {cold, "gear.thermal_conductivity", "", NULL, unheated},
        {cold, "gear.density", "", NULL, unheated},
        {cold, "gear.specific_heat", "", NULL, unheated},
        {1, "cells", field_rows, NULL, NULL},
        {1, "inlet", field_rows, NULL, NULL},
        {1, "outlet", field_rows, NULL, NULL},
        {e->rough, "gear.roughness", "", "surface", "the surface has its own roughness"},
    };
    ff_serve(e->host, rows, sizeof rows / sizeof rows[0]);
    return FF_OK;
}

ff_status ehl_estimate_wire(void *self, uint32_t input, const void *service)
{
    ehl_estimate *e = self;
    if (input == EHL_IN_LIQUID)
        e->liquid = service;
    else if (input == EHL_ESTIMATE_IN_ASPERITIES)
        e->asperities = service;
    else
        ehl_wire_law(&e->laws, input, service);
    e->rough = e->rough || input == EHL_ESTIMATE_IN_RQ_1;
    return FF_OK;
}

static ehl_moment moment(const ehl_estimate *e, ehl_instant at)
{
    double modulus = e->history.modulus;
    ehl_moment m = {.at = at, .load = at.load};
    m.at.load = fmax(at.load, light * e->history.load_max);
    m.a = ehl_hertz_half_width(m.at.load, at.radius, modulus);
    m.p_max = ehl_hertz_pressure(m.load, at.radius, modulus);
    double two_u = 2 * e->oil.viscosity * at.entrainment / (modulus * at.radius);
    m.moes_M = m.at.load / (modulus * at.radius * sqrt(fmax(two_u, 1e-300)));
    m.moes_L = e->alpha * modulus * sqrt(sqrt(two_u));
    return m;
}

static int own_times(const ehl_estimate *e, const ehl_history *one)
{
    return e->steps < 0 || one->count == 1;
}

/* Lists the instants of one engagement and returns their number. If `to` is NULL it only counts
   them. */
static size_t list_moments(const ehl_estimate *e, const ehl_history *one, ehl_moment *to)
{
    const int own = own_times(e, one);
    const size_t count = own ? one->count : (size_t)e->steps + 1;
    const double begin = one->time[0], end = one->time[one->count - 1];
    for (size_t k = 0; to && k < count; k++) {
        double share = (double)k / (double)e->steps;
        double time = k + 1 == count ? end : begin + (end - begin) * share;
        to[k] = moment(e, own ? ehl_history_row(one, k) : ehl_history_at(one, time));
        to[k].engagement = one->engagement ? one->engagement[0] : 0;
        to[k].begins = k == 0;
    }
    return count;
}

static size_t list_all_moments(const ehl_estimate *e, ehl_moment *to)
{
    ehl_history one;
    size_t count = 0;
    for (size_t row = 0; row < e->history.count;) {
        row = ehl_history_engagement(&e->history, row, &one);
        count += list_moments(e, &one, to ? to + count : NULL);
    }
    return count;
}

static ff_status fill_moments(ehl_estimate *e)
{
    e->count = list_all_moments(e, NULL);
    e->moment = malloc(e->count * sizeof *e->moment);
    if (!e->moment)
        return FF_NOMEM;
    list_all_moments(e, e->moment);
    for (size_t k = 0; k < e->count; k++)
        if (!(e->moment[k].a > 0 && isfinite(e->moment[k].a) && isfinite(e->moment[k].p_max)))
            return ff_failf(e->host, FF_INVALID, "contact.load_per_width",
                            "the contact at time %g s has no finite Hertz width and pressure",
                            e->moment[k].at.time);
    return FF_OK;
}

/* Sets the heat of the film, and sets its laws to the temperature of the teeth. */
static ff_status read_heat(ehl_estimate *e, const ff_array *in)
{
    const double said[] = {e->flank_conductivity, e->flank_density, e->flank_heat_capacity};
    const ff_array *bulk = &in[EHL_ESTIMATE_IN_BULK];
    numerics_heat flank = {0};
    e->conductivity = 0;
    e->local = (ehl_local){.laws = &e->laws};
    if (bulk->data && e->thermal != EHL_THERMAL_LOCAL)
        return ff_failf(e->host, FF_INVALID, "bulk",
                        "the teeth are warmer than the oil, which this film model includes only "
                        "with thermal: local: set thermal: local, or leave bulk out");
    if (e->thermal == EHL_THERMAL_NONE)
        return FF_OK;
    if (e->thermal == EHL_THERMAL_LOCAL && in[EHL_IN_OIL].data) {
        double T = bulk->data ? *bulk->data : e->bulk_temperature;
        e->local.bulk = isnan(T) ? e->laws.temperature : T;
        ehl_laws_move(&e->isothermal, &e->laws, e->local.bulk);
    }
    ff_status status = ehl_heat_conductivity(e->host, e->liquid, &e->laws, &e->conductivity);
    if (status == FF_OK)
        e->local.conducts = ehl_heat_conductivity_rise(e->liquid, e->laws.temperature);
    for (int g = 0; g < 2 && status == FF_OK && e->local.bulk > 0; g++) {
        status = numerics_heat_of(e->host, &in[EHL_ESTIMATE_IN_HEAT], said, g, &flank);
        e->local.contact[g] = numerics_heat_contact(&flank);
    }
    return status;
}

static ff_status read_scene(ehl_estimate *e, const ff_array *in)
{
    ff_status status = ehl_laws_at(&e->isothermal, e->host, &in[EHL_IN_OIL], &e->laws);
    if (status == FF_OK)
        status = ehl_read_history(e->host, in, e->light_load, &e->history);
    if (status == FF_OK)
        status = ehl_history_one_way(&e->history, e->host, "a film without a squeeze term");
    if (status == FF_OK)
        status = read_heat(e, in);
    if (status != FF_OK)
        return status;
    if (ehl_fluid_oil(&e->laws, &e->oil) < 0)
        return ff_failf(e->host, FF_INVALID, NULL, "an oil law fails at ambient pressure");
    return FF_OK;
}

static ff_status read_roughness(ehl_estimate *e, uint64_t wanted, const ff_array *in)
{
    ff_status status =
        ehl_combined_roughness(e->host, &in[EHL_ESTIMATE_IN_ROUGHNESS], &in[EHL_ESTIMATE_IN_RQ_1],
                               &in[EHL_ESTIMATE_IN_RQ_2], &e->roughness);
    if (status == FF_OK)
        status = ehl_lambda_check(e->host, wanted, EHL_ESTIMATE_LAMBDA_RATIO, "lambda_ratio",
                                  e->roughness);
    if (status == FF_OK)
        status = ehl_lambda_check(e->host, wanted, EHL_ESTIMATE_LAMBDA_RATIO_LOWEST,
                                  "lambda_ratio_lowest", e->roughness);
    return status;
}

/* Computes the load that the asperities of statistical flanks carry. */
static ff_status read_asperities(ehl_estimate *e, const ff_array *in)
{
    ehl_local *l = &e->local;
    l->conductivity = e->conductivity;
    l->share = e->share;
    l->asperities = e->asperities;
    l->boundary_friction = e->boundary_friction;
    l->modulus = e->history.modulus;
    l->viscosity = e->oil.viscosity;
    l->alpha = e->alpha;
    return e->asperities ? ehl_read_hardness(e->host, &in[EHL_ESTIMATE_IN_HARDNESS],
                                             e->asperity_hardness, &l->hardness)
                         : FF_OK;
}

static ff_status begin(ehl_estimate *e, uint64_t wanted, const ff_array *in)
{
    ff_status status = read_scene(e, in);
    if (status == FF_OK)
        status = read_roughness(e, wanted, in);
    if (status != FF_OK || ehl_is_parted(&e->history))
        return status;
    e->alpha_star = ehl_alpha_star(&e->laws);
    e->alpha = e->alpha_star.value;
    e->answered = EHL_LAW_GOOD;
    e->worst_rise = e->outside = 0;
    status = read_asperities(e, in);
    if (status != FF_OK)
        return status;
    if (wanted & fields)
        ehl_grid_fit(&e->grid, (size_t)e->cells, e->inlet, e->outlet, &e->history, &e->oil, 0, 0);
    return fill_moments(e);
}

typedef struct results {
    const ff_host *host;
    uint64_t wanted;
    double *series[EHL_ESTIMATE_SERIES]; /* NULL: not requested */
    double *film, *pressure, *x;
    double lowest, lowest_at, highest, least_lambda;
    ehl_lowest engagements;
} results;

static int wants(const results *r, uint32_t output)
{
    return (r->wanted & FF_BIT(output)) != 0;
}

static ff_status claim(results *r, const ehl_estimate *e)
{
    const ff_host *host = e->host;
    const size_t shape[2] = {e->count, e->grid.nodes};
    for (uint32_t k = 0; k < EHL_ESTIMATE_SERIES; k++)
        if (wants(r, k) && !(r->series[k] = ff_put_series(host, k, e->count)))
            return FF_NOMEM;
    if (wants(r, EHL_ESTIMATE_FILM) &&
        !(r->film = host->output(host->ctx, EHL_ESTIMATE_FILM, 2, shape)))
        return FF_NOMEM;
    if (wants(r, EHL_ESTIMATE_PRESSURE) &&
        !(r->pressure = host->output(host->ctx, EHL_ESTIMATE_PRESSURE, 2, shape)))
        return FF_NOMEM;
    if (wants(r, EHL_ESTIMATE_X) && !(r->x = ff_put_series(host, EHL_ESTIMATE_X, shape[1])))
        return FF_NOMEM;
    return FF_OK;
}

static void set_series(const results *r, uint32_t output, size_t k, double value)
{
    if (r->series[output])
        r->series[output][k] = value;
}

/* Returns the outputs that set_friction fills. */
static uint64_t of_friction(void)
{
    uint64_t outputs = FF_BIT(EHL_ESTIMATE_ASPERITY_LOAD_SHARE);
    for (uint32_t k = EHL_ESTIMATE_FRICTION_COEFFICIENT; k <= EHL_ESTIMATE_ASPERITY_LOSS; k++)
        outputs |= FF_BIT(k);
    return outputs;
}

/* Returns u_r int h dp/dx dx, which is 2 u_r times the rolling force. The force over E' R is 1.4 (U
   W)^(1/2) under light loads and 1.45 U^(3/4) under heavy loads, with U = 2 eta0 u_r/(E' R), W =
   w/(E' R), M = W U^-1/2. Both are joined as in Biboulet & Houpert (2010, Proc. IMechE J 224),
   (7.15). */
static double rolling_loss(const ehl_estimate *e, size_t k)
{
    const ehl_moment *m = &e->moment[k];
    double u = m->at.entrainment, scale = e->history.modulus * m->at.radius;
    double U = 2 * e->oil.viscosity * u / scale;
    if (!(U > 0 && m->load > 0))
        return 0;
    double rigid = 1.4 * sqrt(m->load / (scale * sqrt(U)));
    return 2 * u * scale * pow(U, 0.75) * rigid / pow(1 + pow(rigid / 1.45, 10), 0.1);
}

/* Computes the friction in the contact for the actual load; 0 without load. */
static void set_friction(const results *r, ehl_estimate *e, size_t k, double h_central)
{
    const ehl_moment *m = &e->moment[k];
    double x[EHL_LOCAL_POINTS], h[EHL_LOCAL_POINTS];
    double a = ehl_hertz_half_width(m->load, m->at.radius, e->history.modulus);
    for (int i = 0; i < EHL_LOCAL_POINTS; i++)
        x[i] = ehl_local_place(i) * a;
    e->profile(e, k, EHL_LOCAL_POINTS, x, h);
    const ehl_local_contact c = {m->load,           m->at.radius, a, m->p_max, h_central,
                                 m->at.entrainment, m->at.sliding};
    const ehl_local_friction f =
        m->load > 0 ? ehl_local_evaluate(&e->local, &c, h) : (ehl_local_friction){.oil = 0};
    ehl_law_note(&e->answered, f.laws);
    e->outside += f.closure != FF_OK;
    e->worst_rise = fmax(e->worst_rise, f.rise);
    double traction = f.oil + f.asperities;
    double sliding = f.oil * m->at.sliding, rolling = rolling_loss(e, k);
    double asperity = f.asperities * m->at.sliding;
    set_series(r, EHL_ESTIMATE_TRACTION, k, traction);
    set_series(r, EHL_ESTIMATE_POWER_LOSS, k, sliding + rolling + asperity);
    set_series(r, EHL_ESTIMATE_SLIDING_LOSS, k, sliding);
    set_series(r, EHL_ESTIMATE_ROLLING_LOSS, k, rolling);
    set_series(r, EHL_ESTIMATE_SQUEEZE_LOSS, k, 0);
    set_series(r, EHL_ESTIMATE_ASPERITY_LOSS, k, asperity);
    set_series(r, EHL_ESTIMATE_ASPERITY_LOAD_SHARE, k, f.share);
    set_series(r, EHL_ESTIMATE_FRICTION_COEFFICIENT, k, m->load > 0 ? traction / m->load : 0);
}

static void set_fields(const results *r, const ehl_estimate *e, size_t k)
{
    const ehl_moment *m = &e->moment[k];
    const ehl_grid *g = &e->grid;
    double loaded = ehl_hertz_half_width(m->load, m->at.radius, e->history.modulus);
    for (size_t i = 0; i < g->nodes; i++) {
        double x = g->first + (double)i * g->dx, inside = fmin(fmax(x, -m->a), m->a);
        size_t to = k * g->nodes + (e->history.mirrored ? g->nodes - 1 - i : i);
        if (r->film) {
            e->profile(e, k, 1, &inside, &r->film[to]);
            r->film[to] += m->a * m->a / (2 * m->at.radius) * ehl_hertz_gap(fabs(x) / m->a);
        }
        if (r->pressure)
            r->pressure[to] = fabs(x) < loaded ? m->p_max * sqrt(1 - x * x / (loaded * loaded)) : 0;
    }
}

static void set_moment(results *r, ehl_estimate *e, size_t k)
{
    const ehl_moment *m = &e->moment[k];
    ehl_estimate_film film;
    e->film(e, k, &film);
    set_series(r, EHL_ESTIMATE_TIME, k, m->at.time);
    set_series(r, EHL_ESTIMATE_ROLL_ANGLE, k, m->at.roll);
    set_series(r, EHL_ESTIMATE_ENGAGEMENT, k, m->engagement);
    set_series(r, EHL_ESTIMATE_H_MIN, k, film.h_min);
    set_series(r, EHL_ESTIMATE_H_CENTRAL, k, film.h_central);
    set_series(r, EHL_ESTIMATE_H_MIN_ERROR, k, film.error);
    set_series(r, EHL_ESTIMATE_P_MAX, k, m->p_max);
    set_series(r, EHL_ESTIMATE_LOAD_PER_WIDTH, k, m->load);
    ehl_lowest_add(&r->engagements, m->engagement, film.h_min);
    if (film.h_min < r->lowest) {
        r->lowest = film.h_min;
        r->lowest_at = m->at.roll;
    }
    r->highest = fmax(r->highest, m->p_max);
    if (e->roughness > 0) {
        set_series(r, EHL_ESTIMATE_LAMBDA_RATIO, k, film.h_central / e->roughness);
        r->least_lambda = fmin(r->least_lambda, film.h_central / e->roughness);
    }
    if (r->wanted & of_friction())
        set_friction(r, e, k, film.h_central);
    if (r->film || r->pressure)
        set_fields(r, e, k);
}

static ff_status set_scalars(const results *r, const ehl_estimate *e)
{
    const double value[] = {r->lowest,
                            r->lowest_at,
                            r->highest,
                            r->least_lambda,
                            ehl_lowest_mean(&r->engagements),
                            ehl_lowest_spread(&r->engagements),
                            r->engagements.count};
    for (uint32_t k = EHL_ESTIMATE_H_MIN_LOWEST; k <= EHL_ESTIMATE_ENGAGEMENTS_JUDGED; k++)
        if (wants(r, k) && ff_put_scalar(r->host, k, value[k - EHL_ESTIMATE_H_MIN_LOWEST]) != FF_OK)
            return FF_NOMEM;
    if (wants(r, EHL_ESTIMATE_BULK_TEMPERATURE) &&
        ff_put_scalar(r->host, EHL_ESTIMATE_BULK_TEMPERATURE, e->laws.temperature) != FF_OK)
        return FF_NOMEM;
    if (wants(r, EHL_ESTIMATE_ALPHA_STAR) &&
        ehl_put_alpha_star(r->host, EHL_ESTIMATE_ALPHA_STAR, e->alpha_star) != FF_OK)
        return FF_NOMEM;
    for (size_t i = 0; r->x && i < e->grid.nodes; i++) {
        double x = e->grid.first + (double)i * e->grid.dx;
        r->x[e->history.mirrored ? e->grid.nodes - 1 - i : i] = e->history.mirrored ? -x : x;
    }
    return FF_OK;
}

static void report(const ehl_estimate *e, double lowest, double least_lambda)
{
    const ff_host *host = e->host;
    double light_count = 0;
    for (size_t k = 0; k < e->count; k++)
        light_count += e->moment[k].load < light * e->history.load_max;
    e->report(e);
    ehl_inlet_heating_report(host, &e->heating, e->conductivity > 0, &e->history, &e->laws,
                             &e->oil);
    if (light_count > 0)
        host->quality(host->ctx, "light_instants", light_count, 0, FF_RANGE,
                      "number of instants with less than 1 % of the largest load: their film is "
                      "that of 1 %, plus the gap while contact is lost");
    if (e->local.bulk > 0)
        host->quality(host->ctx, "contact_heating", e->worst_rise, 0, FF_GOOD,
                      "largest temperature rise of the oil in the contact over the teeth due to "
                      "friction, K; 0: friction was not requested");
    if (e->outside > 0)
        host->quality(host->ctx, "asperity_range", e->outside, 0, FF_RANGE,
                      e->share == EHL_MASJEDI_KHONSARI
                          ? "number of instants with sigma/R above 5e-5, outside the range of the "
                            "films to which the share was fitted"
                          : "number of instants at which the mean planes cross, or are closer than "
                            "the table of the asperity pressure: the load on asperities is "
                            "extrapolated");
    if (e->roughness > 0 && e->asperities)
        ehl_lambda_carried(host, least_lambda);
    else if (e->roughness > 0)
        ehl_lambda_report(host, least_lambda);
    if (lowest < 1e-9)
        host->quality(host->ctx, "continuum", lowest, 1e-9, FF_RANGE,
                      "the film is thinner than 1 nm, a few molecules, so continuum mechanics does "
                      "not hold");
    ehl_law_report(host, e->answered);
}

static ff_status evaluate(ehl_estimate *e, uint64_t wanted, const ff_array *in)
{
    enum { BETWEEN = 1024 };
    results r = {.host = e->host, .wanted = wanted, .lowest = HUGE_VAL, .least_lambda = HUGE_VAL};
    uint64_t rolling = FF_BIT(EHL_ESTIMATE_ROLL_ANGLE) | FF_BIT(EHL_ESTIMATE_H_MIN_LOWEST_AT);
    if ((wanted & rolling) && !in[EHL_IN_ROLL].data)
        return ff_failf(
            e->host, FF_UNSUPPORTED,
            wanted & FF_BIT(EHL_ESTIMATE_ROLL_ANGLE) ? "roll_angle" : "h_min_lowest_at",
            "this output needs a contact with a roll angle, such as contact/tooth-pair");
    ff_status status = begin(e, wanted, in);
    if (status == FF_OK && wants(&r, EHL_ESTIMATE_BULK_TEMPERATURE) && !(e->laws.temperature > 0))
        status = ff_failf(e->host, FF_UNSUPPORTED,
                          ehl_estimate_outputs[EHL_ESTIMATE_BULK_TEMPERATURE].name,
                          "this output needs an oil stage, which gives the temperature");
    if (status == FF_OK && ehl_is_parted(&e->history))
        return ehl_put_parted(e->host, 1, wanted, &e->history, e->roughness, e->laws.temperature);
    if (status == FF_OK)
        status = claim(&r, e);
    if (status == FF_OK)
        status = e->begin(e);
    for (size_t k = 0; status == FF_OK && k < e->count; k++) {
        set_moment(&r, e, k);
        if (k % BETWEEN == BETWEEN - 1 &&
            e->host->progress(e->host->ctx, (double)k / (double)e->count))
            status = FF_STOPPED;
    }
    if (status == FF_OK)
        status = set_scalars(&r, e);
    if (status == FF_OK)
        report(e, r.lowest, r.least_lambda);
    e->end(e);
    free(e->moment);
    e->moment = NULL;
    return status;
}

ff_status ehl_estimate_evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    ehl_estimate *e = self;
    return numerics_answers_end(&e->isothermal.answers, e->host, evaluate(e, wanted, in));
}
