/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "stage.h"

#include "../contact/parted.h"
#include "../estimates/inlet-heat.h"
#include "../time/start.h"
#include "landings.h"
#include "run.h"
#include "twin.h"

#include <flankfilm/author.h>
#include <flankfilm/estimates.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

ff_status ehl_create(const ff_host *host, const ff_model *model, ehl_solver_maker *maker,
                     void **self)
{
    ehl_model *m = calloc(1, sizeof *m);
    if (!m)
        return FF_NOMEM;
    m->host = host;
    m->model = model;
    m->maker = maker;
    *self = m;
    return FF_OK;
}

void ehl_destroy(void *self)
{
    free(self);
}

ff_status ehl_wire(void *self, uint32_t input, const void *service)
{
    ehl_model *m = self;
    if (input == EHL_IN_DISCRETISATION)
        m->outside = service;
    else if (input == EHL_IN_LIQUID)
        m->liquid = service;
    else if (input == EHL_IN_SHEAR_RATE)
        m->shear_rate = service;
    else if (input == EHL_IN_ASPERITIES)
        m->asperities = service;
    else
        ehl_wire_law(&m->laws, input, service);
    m->rough = m->rough || input == EHL_IN_POSITION;
    return FF_OK;
}

ff_status ehl_ready(void *self)
{
    static const char smooth[] = "the flanks are smooth: no surface is wired",
                      ignored[] = "roughness is ignored",
                      statistical[] = "the asperities are given by their statistics alone";
    const ehl_model *m = self;
    const int any = m->rough || m->asperities;
    const int flat = !m->rough || m->roughness == EHL_IGNORED;
    const int bare = !any || m->roughness == EHL_IGNORED;
    const char *why = any && !bare ? statistical
                      : any        ? ignored
                                   : smooth,
               *cold = "thermal is not full";
    const int full = m->thermal == EHL_THERMAL_FULL;
    const ff_serving rows[] = {
        {m->steps > 0, "time_tolerance", "", NULL, "the time steps are given and equal"},
        {!any, "roughness", "", NULL, smooth},
        {flat, "contact_film", "", NULL, why},
        {bare, "boundary_friction", "", NULL, why},
        {bare, "asperity_hardness", "", NULL, why},
        {flat, "roughness_cutoff", "", NULL, why},
        {flat, "valleys", "", NULL, why},
        {flat || m->valleys != EHL_VENTILATED, "valley_length", "", NULL,
         flat ? why : "valleys is sealed"},
        {!flat && m->cavitation != EHL_CONSERVING, "cavitation", "", NULL,
         "with rough flanks mass-conserving is used"},
        {!flat && m->wedge > 0, "wedge", "", NULL, "with rough flanks the first order is used"},
        {any, "gear.roughness", "", "surface", "the surface has a roughness of its own"},
        {!full, "thermal_nodes", "", NULL, cold},
        {bare, "gear.hardness", "", NULL, why},
        {!full, "gear.thermal_conductivity", "", NULL, cold},
        {!full, "gear.density", "", NULL, cold},
        {!full, "gear.specific_heat", "", NULL, cold},
        {!full, "flank_conductivity", "", NULL, cold},
        {!full, "flank_density", "", NULL, cold},
        {!full, "flank_heat_capacity", "", NULL, cold},
        {!full, "bulk_temperature", "", NULL, cold},
    };
    ff_serve(m->host, rows, sizeof rows / sizeof rows[0]);
    if (bare || !m->asperities)
        return FF_OK;
    if (m->maker != ehl_newton_krylov || m->outside)
        return ff_failf(m->host, FF_UNSUPPORTED, "surface.asperities",
                        "%s models smooth flanks only; ehl/finite-volume takes statistical ones%s",
                        m->outside ? "the discretisation" : "this model",
                        m->outside ? " if no discretisation is wired" : "");
    if (m->cavitation == EHL_CONSERVING)
        return ff_failf(m->host, FF_UNSUPPORTED, "cavitation",
                        "between statistical flanks a cavitated film has no definite gap that "
                        "oil could fill: cavitation must be clip");
    return FF_OK;
}

/* The tolerance of Newton's method is TOLERANCE_SHARE times the error due to the cells and the
   steps, between the two bounds. Beyond these bounds the number of Newton steps does not change. */
static const double TOLERANCE_SHARE = 1. / 20, LEAST_TOLERANCE = 2e-5, MOST_TOLERANCE = 2e-4;

/* Records the newest film, and adapts the tolerance to its error. */
static ff_status record(const ehl_model *m, ehl_run *r, int last)
{
    ff_status status = ehl_results_record(&r->results, &r->march, last);
    double error = r->results.by_cells;
    if (m->tolerance > 0 || r->rough.count > 0 || r->reynolds.touching || !(error > 0) ||
        r->solver.maker != ehl_newton_krylov)
        return status;
    error = m->steps > 0 ? error : fmin(error, m->time_tolerance);
    r->solver.tolerance =
        r->march.exactness * fmin(fmax(TOLERANCE_SHARE * error, LEAST_TOLERANCE), MOST_TOLERANCE);
    return status;
}

static ff_status explain(const ehl_model *m, const ehl_run *r, ff_status status, double time)
{
    ehl_instant at = ehl_history_at(&r->history, time);
    char roll[64] = "", good[128] = "", advice[160];
    const double molecule = 0.5e-9; /* Israelachvili 2011 */
    if (r->solver.gave_up)
        return ff_failf(m->host, FF_NOCONV, "discretisation",
                        "at time %.6g s the discretisation had failed at more than a fifth of "
                        "the instants, also with the shortest steps: more cells, or another "
                        "discretisation, may help",
                        time);
    if (status != FF_NOCONV)
        return status;
    const double hertz = ehl_hertz_pressure(at.load, at.radius, r->history.modulus);
    ehl_laws_hold_slopes(&m->laws, fmax(1.5 * hertz, 1e8));
    if (ehl_laws_failed(&m->laws))
        return FF_BUG;
    if (r->solver.no_film)
        return ff_failf(m->host, status, "discretisation",
                        "at time %.6g s the discretisation returned an invalid film: values that "
                        "are not finite, or a pressure at the ends of the domain",
                        time);
    if (r->history.roll)
        snprintf(roll, sizeof roll, ", roll angle %.6g rad", at.roll);
    if (r->march.known > 0)
        snprintf(good, sizeof good, "; the last valid film is that at %.6g s",
                 r->march.state[0].time);
    int gone = r->march.known > 0 && r->march.state[0].thinnest < molecule;
    snprintf(
        advice, sizeof advice,
        "If its Hertz pressure of %.3g GPa is intended, more cells, more steps or a wider domain "
        "may help",
        1e-9 * hertz);
    if (m->thermal == EHL_THERMAL_FULL && !gone && !r->thermal.cold_fails)
        snprintf(advice, sizeof advice,
                 "Heat %s the reason: with much heat thermal: full may find no film where "
                 "thermal: inlet or none does; more cells, less speed or less sliding may help",
                 r->march.known > 0 ? "may be" : "is");
    return ff_failf(m->host, status, NULL, "at time %.6g s%s (load %.4g N/m): %s%s. %s", time, roll,
                    at.load, r->march.why, good,
                    gone ? "The film is thinner than a molecule at one place, by squeezing or "
                           "starvation: from there on smooth flanks have no film, or more cells "
                           "are needed to decide it"
                         : advice);
}

static int stopped(const ehl_model *m, const ehl_run *r, size_t k)
{
    enum { BETWEEN = 16 };
    const ehl_history *h = &r->whole;
    double begin = h->time[0], span = h->time[h->count - 1] - begin;
    return k % BETWEEN == 0 &&
           m->host->progress(m->host->ctx, (r->march.state[0].time - begin) / span);
}

static ff_status march_equal_steps(const ehl_model *m, ehl_run *r)
{
    const ehl_history *h = &r->history;
    double begin = h->time[0], end = h->time[h->count - 1];
    const size_t steps = (size_t)m->steps;
    ff_status status = FF_OK;
    for (size_t k = 1; status == FF_OK && k <= steps; k++) {
        if (stopped(m, r, k))
            return FF_STOPPED;
        double time = k == steps ? end : begin + (end - begin) * (double)k / (double)steps;
        status = ehl_step_control_to(&r->control, &r->march, time);
        if (status != FF_OK)
            return explain(m, r, status, time);
        status = record(m, r, k == steps);
    }
    return status;
}

static ff_status march_own_steps(const ehl_model *m, ehl_run *r)
{
    ff_status status = FF_OK;
    for (size_t k = 1; status == FF_OK && !ehl_step_control_done(&r->control); k++) {
        if (stopped(m, r, k))
            return FF_STOPPED;
        status = ehl_step_control_next(&r->control, &r->march);
        if (status != FF_OK)
            return explain(m, r, status, r->march.state[0].time);
        status = record(m, r, ehl_step_control_done(&r->control));
    }
    return status;
}

static ff_status march_engagement(const ehl_model *m, ehl_run *r)
{
    const ehl_history *h = &r->history;
    r->solver.tolerance = ehl_first_tolerance(m, r);
    ff_status status = ehl_march_start(&r->march);
    if (status != FF_OK)
        return explain(m, r, status, h->time[0]);
    status = record(m, r, h->count == 1);
    if (status != FF_OK || h->count == 1)
        return status;
    status = ehl_step_control_create(&r->control, &r->march, m->time_tolerance, m->steps > 0);
    if (status == FF_OK)
        status = m->steps > 0 ? march_equal_steps(m, r) : march_own_steps(m, r);
    ehl_step_control_destroy(&r->control);
    return status;
}

/* Computes each engagement from its own steady film, on a grid that fits all engagements. */
static ff_status march(const ehl_model *m, const ff_array *in, ehl_run *r)
{
    ff_status status = FF_OK;
    r->whole = r->history;
    for (size_t row = 0; row < r->whole.count && status == FF_OK;) {
        ehl_march_restart(&r->march);
        if (r->march.thermal)
            ehl_thermal_restart(&r->march);
        row = ehl_history_engagement(&r->whole, row, &r->history);
        if (r->rough.count > 0 && r->history.count < r->whole.count)
            status = ehl_run_surface(m, in, r);
        if (status == FF_OK)
            status = march_engagement(m, r);
    }
    return status;
}

static ff_status read_roughness(const ehl_model *m, uint64_t wanted, const ff_array *in, double *rq)
{
    ff_status status = ehl_combined_roughness(m->host, &in[EHL_IN_ROUGHNESS], &in[EHL_IN_RQ_1],
                                              &in[EHL_IN_RQ_2], rq);
    if (status == FF_OK)
        status = ehl_lambda_check(m->host, wanted, EHL_LAMBDA_RATIO, "lambda_ratio", *rq);
    if (status == FF_OK)
        status =
            ehl_lambda_check(m->host, wanted, EHL_LAMBDA_RATIO_LOWEST, "lambda_ratio_lowest", *rq);
    return status;
}

static int is_of_heat(uint32_t output)
{
    return output == EHL_TEMPERATURE || output == EHL_TEMPERATURE_MAX ||
           output == EHL_FLASH_TEMPERATURE;
}

/* Returns 1 for an output of places where asperities touch or yield. */
static int is_of_places(uint32_t output)
{
    return output == EHL_CONTACT_RATIO || output == EHL_TRAPPED_SHARE ||
           output == EHL_YIELD_SHARE || output == EHL_PLASTIC_DEPTH_MAX ||
           output == EHL_PLASTIC_DEPTH || output == EHL_ROUGHNESS;
}

/* Whether anybody reads the errors that take time: those by transport, half the cells and passages.
 */
static int is_judged(const ehl_model *m, uint64_t wanted)
{
    static const uint64_t errors = FF_BIT(EHL_H_MIN_ERROR) | FF_BIT(EHL_H_CENTRAL_ERROR) |
                                   FF_BIT(EHL_P_MAX_ERROR) | FF_BIT(EHL_FILM_AT_LANDING_ERROR) |
                                   FF_BIT(EHL_P_MAX_AT_LANDING_ERROR);
    return (wanted & errors) || ff_estimates_are_read(m->host);
}

/* Whether no transport of errors tells those of a film that is wanted. */
static int needs_twin(const ehl_run *r)
{
    const uint64_t wanted = r->results.wanted;
    return r->results.judged && !r->march.transport && !r->march.rough &&
           (ehl_wants_h_min(wanted) || ehl_wants_h_central(wanted));
}

static ff_status evaluate(ehl_model *m, uint64_t wanted, const ff_array *in)
{
    ehl_run r = {0};
    ff_status status = ehl_laws_at(&m->isothermal, m->host, &in[EHL_IN_OIL], &m->laws);
    if (status == FF_OK)
        status = ehl_read_history(m->host, in, m->light_load, &r.history);
    if (status != FF_OK)
        return status;
    if ((wanted & (FF_BIT(EHL_ROLL_ANGLE) | FF_BIT(EHL_H_MIN_LOWEST_AT))) && !in[EHL_IN_ROLL].data)
        return ff_failf(
            m->host, FF_UNSUPPORTED,
            wanted & FF_BIT(EHL_ROLL_ANGLE) ? "roll_angle" : "h_min_lowest_at",
            "this output needs a contact with a roll angle, such as contact/tooth-pair");
    for (uint32_t k = 0; k < EHL_OUTPUTS; k++)
        if ((wanted & FF_BIT(k)) && m->thermal != EHL_THERMAL_FULL && is_of_heat(k))
            return ff_failf(m->host, FF_UNSUPPORTED, ehl_outputs[k].name,
                            "this output needs thermal: full");
    for (uint32_t k = 0; k < EHL_OUTPUTS; k++)
        if ((wanted & FF_BIT(k)) && ehl_is_statistical(m) && is_of_places(k))
            return ff_failf(m->host, FF_UNSUPPORTED, ehl_outputs[k].name,
                            "this output needs flanks with given heights: asperities that are "
                            "given by their statistics have no place of contact");
    const double bulk = ehl_stage_bulk(m, in);
    if ((wanted & FF_BIT(EHL_BULK_TEMPERATURE)) && !(bulk > 0))
        return ff_failf(m->host, FF_UNSUPPORTED, ehl_outputs[EHL_BULK_TEMPERATURE].name,
                        "this output needs a stage of the oil, which has a temperature");
    double roughness;
    status = read_roughness(m, wanted, in, &roughness);
    if (status == FF_OK && ehl_is_parted(&r.history))
        return ehl_put_parted(m->host, 0, wanted, &r.history, roughness, bulk);
    if (status != FF_OK)
        return status;
    const int judged = is_judged(m, wanted);
    status = ehl_run_create(m, judged ? wanted : 0, in, &r);
    if (status == FF_OK)
        status = ehl_stage_heat(m, in, &r.march, &r.heat, &r.thermal);
    if (status == FF_OK)
        status = ehl_results_create(&r.results, m->host, wanted, judged, &r.march);
    r.results.boundary_friction = m->boundary_friction;
    r.results.roughness = roughness;
    r.results.cutoff = in[EHL_IN_CUTOFF].data ? *in[EHL_IN_CUTOFF].data : 0;
    if (status == FF_OK)
        status = march(m, in, &r);
    if (status == FF_OK && needs_twin(&r))
        status = ehl_twin_errors(m, in, &r);
    if (status == FF_OK)
        status = ehl_results_measure(&r.results, &r.march, &r.whole, m->steps > 0);
    if (status == FF_OK)
        status = ehl_results_finish(&r.results, &r.march);
    if (status == FF_OK)
        status = ehl_landings_put(&r.results, &r.whole);
    if (status == FF_OK && (wanted & FF_BIT(EHL_BULK_TEMPERATURE)))
        status = ff_put_scalar(m->host, EHL_BULK_TEMPERATURE, bulk);
    if (status == FF_OK)
        ehl_inlet_heating_report(m->host, &m->heating, m->thermal != EHL_THERMAL_NONE, &r.whole,
                                 &m->laws, &r.oil);
    if (status == FF_OK && r.march.heat)
        ehl_heat_report(&r.heat, m->host);
    if (status == FF_OK && r.march.thermal)
        ehl_thermal_report(&r.thermal, m->host, &r.march);
    ehl_run_destroy(&r);
    return status;
}

ff_status ehl_evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    ehl_model *m = self;
    return numerics_answers_end(&m->isothermal.answers, m->host, evaluate(m, wanted, in));
}
