/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "kernel.h"
#include "lambda.h"
#include "march.h"
#include "model-part.h"
#include "pace.h"
#include "results.h"
#include "tune.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

ff_status ff_ehl_create(const ff_host *host, ff_solver_maker *maker, void **self)
{
    ff_ehl_model *m = calloc(1, sizeof *m);
    if (!m)
        return FF_NOMEM;
    m->host = host;
    m->maker = maker;
    *self = m;
    return FF_OK;
}

void ff_ehl_destroy(void *self)
{
    free(self);
}

static int given_by(uint32_t param, const ff_value *value)
{
    static const int marks[FF_EHL_PARAMS] = {[FF_EHL_CELLS] = FF_TUNE_CELLS,
                                             [FF_EHL_STEPS] = FF_TUNE_STEPS,
                                             [FF_EHL_TIME_TOLERANCE] = FF_TUNE_TOLERANCE};
    return value->given ? marks[param] : 0;
}

ff_status ff_ehl_set(void *self, uint32_t param, const ff_value *value)
{
    ff_ehl_model *m = self;
    double number = value->text ? 0 : value->real; /* a word, auto or none, is 0 */
    m->given |= given_by(param, value);
    switch (param) {
    case FF_EHL_CELLS:
        m->cells = (size_t)value->integer;
        break;
    case FF_EHL_INLET:
        m->inlet = number;
        break;
    case FF_EHL_OUTLET:
        m->outlet = number;
        break;
    case FF_EHL_STEPS:
        m->steps = value->text ? 0 : (size_t)value->integer;
        break;
    case FF_EHL_TIME_TOLERANCE:
        m->time_tolerance = value->real;
        break;
    case FF_EHL_TIME_SCHEME:
        m->scheme = (int)value->integer;
        break;
    case FF_EHL_WEDGE:
        m->wedge = (int)value->integer + 1;
        break;
    case FF_EHL_TOLERANCE:
        m->tolerance = value->real;
        break;
    case FF_EHL_LIGHT_LOAD:
        m->light_load = number;
        break;
    case FF_EHL_OIL_CONDUCTIVITY:
        m->heating.conductivity = value->real;
        break;
    case FF_EHL_TEMPERATURE_SLOPE:
        m->heating.slope = number;
        break;
    case FF_EHL_CONTACT_FILM:
        m->contact_film = value->real;
        break;
    case FF_EHL_BOUNDARY_FRICTION:
        m->boundary_friction = value->real;
        break;
    case FF_EHL_ASPERITY_HARDNESS:
        m->hardness = value->real;
        break;
    case FF_EHL_VALLEYS:
        m->ventilated = value->integer == 1;
        break;
    case FF_EHL_VALLEY_LENGTH:
        m->valley_length = value->real;
        break;
    case FF_EHL_CAVITATION:
        m->conserving = value->integer == 1;
        break;
    case FF_EHL_ROUGHNESS:
        m->smooth = value->integer == 1;
        m->roughness_given = value->given;
        break;
    default:
        break;
    }
    return FF_OK;
}

ff_status ff_ehl_wire(void *self, uint32_t input, const void *service)
{
    ff_ehl_model *m = self;
    if (input == FF_EHL_IN_VISCOSITY)
        m->laws.viscosity = service;
    else if (input == FF_EHL_IN_DENSITY)
        m->laws.density = service;
    else if (input == FF_EHL_IN_RHEOLOGY)
        m->laws.rheology = service;
    return FF_OK;
}

/* The parts of one run, in the order of their making. */
typedef struct run {
    ff_history whole, history; /* of all engagements, and of the one at hand */
    ff_rough rough;
    ff_oil oil;
    ff_grid grid;
    ff_reynolds reynolds;
    double *kernel;
    ff_solver solver;
    ff_march march;
    ff_pace pace;
    ff_results results;
} run;

static void run_destroy(run *r)
{
    ff_results_destroy(&r->results);
    ff_pace_destroy(&r->pace);
    ff_march_destroy(&r->march);
    if (r->solver.destroy)
        r->solver.destroy(&r->solver);
    free(r->kernel);
    ff_rough_destroy(&r->rough);
    ff_reynolds_destroy(&r->reynolds);
}

ff_status ff_ehl_history(const ff_ehl_model *m, const ff_array *in, ff_history *h)
{
    *h = (ff_history){
        .count = in[FF_EHL_IN_TIME].shape[0],
        .time = in[FF_EHL_IN_TIME].data,
        .radius = in[FF_EHL_IN_RADIUS].data,
        .speed_1 = in[FF_EHL_IN_SPEED_1].data,
        .speed_2 = in[FF_EHL_IN_SPEED_2].data,
        .load = in[FF_EHL_IN_LOAD].data,
        .roll = in[FF_EHL_IN_ROLL].data,
        .gap = in[FF_EHL_IN_GAP].data,
        .engagement = in[FF_EHL_IN_ENGAGEMENT].data,
        .modulus = *in[FF_EHL_IN_MODULUS].data,
        .load_floor = m->light_load,
    };
    return ff_history_check(h, m->host);
}

/* The flanks, when a surface is wired. */
static ff_status read_surface(const ff_ehl_model *m, const ff_array *in, run *r)
{
    const ff_array *row = in + FF_EHL_IN_POSITION;
    if (!row[0].data || m->smooth)
        return FF_OK;
    if (m->maker != ff_newton_krylov)
        return ff_failf(m->host, FF_UNSUPPORTED, "surface.position",
                        "this model knows smooth flanks only; ehl/finite-volume takes rough "
                        "ones");
    for (uint32_t k = FF_EHL_IN_POSITION; k <= FF_EHL_IN_ORIGIN; k++)
        if (!in[k].data)
            return ff_failf(m->host, FF_INVALID, ff_ehl_inputs[k].name,
                            "rough flanks need this output of the surface");
    r->rough = (ff_rough){
        .count = in[FF_EHL_IN_POSITION].shape[0],
        .height = {in[FF_EHL_IN_HEIGHT_1].data, in[FF_EHL_IN_HEIGHT_2].data},
        .rq = {*in[FF_EHL_IN_RQ_1].data, *in[FF_EHL_IN_RQ_2].data},
        .period = *in[FF_EHL_IN_PERIOD].data,
        .origin = *in[FF_EHL_IN_ORIGIN].data,
        .history = &r->history,
    };
    ff_status status = ff_history_one_way(&r->history, m->host, "a rough film");
    return status != FF_OK
               ? status
               : ff_rough_create(&r->rough, in[FF_EHL_IN_POSITION].data, &r->history, m->host);
}

/* Metal that yields all over carries its hardness times a length, which would be longer than that
   of the elastic contact. */
static ff_status check_hardness(const ff_ehl_model *m, const run *r)
{
    const double mean = 3.14159265358979323846 / 4 * r->grid.pressure;
    if (!(r->rough.count > 0 && m->hardness > 0) || m->hardness > mean)
        return FF_OK;
    return ff_failf(m->host, FF_INVALID, "asperity_hardness",
                    "flanks of %.4g GPa would yield all over the contact, whose mean pressure is "
                    "%.4g GPa under the largest load: asperity_hardness must be above that, or 0 "
                    "for flanks that stay elastic",
                    1e-9 * m->hardness, 1e-9 * mean);
}

static ff_status run_create(const ff_ehl_model *m, const ff_array *in, run *r)
{
    ff_status status = ff_ehl_history(m, in, &r->history);
    if (status != FF_OK)
        return status;
    status = read_surface(m, in, r);
    if (status != FF_OK)
        return status;
    if (ff_fluid_oil(&m->laws, &r->oil) < 0)
        return ff_failf(m->host, FF_INVALID, NULL, "an oil law fails at ambient pressure");
    double rq = r->rough.count > 0 ? ff_rough_rq(&r->rough) : 0;
    ff_grid_fit(&r->grid, m->cells, m->inlet, m->outlet, &r->history, &r->oil, rq);
    if (!(r->grid.dx > 0 && isfinite(r->grid.dx)))
        return ff_failf(m->host, FF_INVALID, "contact.load_per_width",
                        "the contact and the oil give no finite length of the domain");
    status = check_hardness(m, r);
    if (status != FF_OK)
        return status;
    if (ff_reynolds_create(&r->reynolds, &r->grid, &m->laws, &r->oil, m->wedge) != FF_OK)
        return FF_NOMEM;
    r->kernel = malloc(r->grid.nodes * sizeof *r->kernel);
    if (!r->kernel)
        return FF_NOMEM;
    ff_kernel_fill(r->grid.nodes, r->grid.dx, r->history.modulus, r->grid.half_width, r->kernel);
    r->reynolds.conserving = m->conserving;
    r->reynolds.unit = r->oil.density * (r->kernel[0] - r->kernel[r->grid.nodes - 1]);
    if (r->rough.count > 0) {
        /* a valley with a bubble is not stiff, and a front of oil makes no waves */
        r->reynolds.conserving = 1;
        r->reynolds.wedge = 1;
        r->reynolds.contact = r->reynolds.floor = m->contact_film;
        r->reynolds.leak = m->ventilated ? 12 / (m->valley_length * m->valley_length) : 0;
        r->reynolds.hardness = m->hardness;
        r->reynolds.give = r->kernel[0] - r->kernel[r->grid.nodes - 1];
    }
    r->solver = (ff_solver){
        .grid = &r->grid,
        .reynolds = &r->reynolds,
        .kernel = r->kernel,
        .tolerance = m->tolerance,
        .maker = m->maker,
    };
    status = m->maker(&r->solver);
    if (status != FF_OK)
        return status;
    status = ff_march_create(&r->march, &r->history, &r->solver, m->scheme);
    r->march.rough = r->rough.count > 0 ? &r->rough : NULL;
    return status;
}

static ff_status explain(const ff_ehl_model *m, const run *r, ff_status status, double time)
{
    ff_instant at = ff_history_at(&r->history, time);
    char roll[64] = "", good[128] = "";
    const double molecule = 0.5e-9; /* Israelachvili 2011 */
    if (status != FF_NOCONV)
        return status;
    if (r->history.roll)
        snprintf(roll, sizeof roll, ", roll angle %.6g rad", at.roll);
    if (r->march.known > 0)
        snprintf(good, sizeof good, "; the last good film is that of %.6g s",
                 r->march.state[0].time);
    int gone = r->march.known > 0 && r->march.state[0].thinnest < molecule;
    return ff_failf(m->host, status, NULL, "at time %.6g s%s (load %.4g N/m): %s%s. %s", time, roll,
                    at.load, r->march.why, good,
                    gone ? "It has been squeezed or starved to less than a molecule at one place: "
                           "smooth flanks have no film from there on, or need more cells to tell"
                         : "More cells, more steps or a wider domain may help");
}

static int stopped(const ff_ehl_model *m, const run *r, size_t k)
{
    enum { BETWEEN = 16 };
    const ff_history *h = &r->whole;
    double begin = h->time[0], span = h->time[h->count - 1] - begin;
    return k % BETWEEN == 0 &&
           m->host->progress(m->host->ctx, (r->march.state[0].time - begin) / span);
}

static ff_status march_equal_steps(const ff_ehl_model *m, run *r)
{
    const ff_history *h = &r->history;
    double begin = h->time[0], end = h->time[h->count - 1];
    for (size_t k = 1; k <= m->steps; k++) {
        if (stopped(m, r, k))
            return FF_STOPPED;
        double time = k == m->steps ? end : begin + (end - begin) * (double)k / (double)m->steps;
        ff_status status = ff_march_to(&r->march, time);
        if (status != FF_OK)
            return explain(m, r, status, time);
        status = ff_results_record(&r->results, &r->march, k == m->steps);
        if (status != FF_OK)
            return status;
    }
    return FF_OK;
}

static ff_status march_own_steps(const ff_ehl_model *m, run *r)
{
    ff_status status = ff_pace_create(&r->pace, &r->march, m->time_tolerance);
    for (size_t k = 1; status == FF_OK && !ff_pace_done(&r->pace); k++) {
        if (stopped(m, r, k))
            return FF_STOPPED;
        status = ff_pace_next(&r->pace, &r->march);
        if (status != FF_OK)
            return explain(m, r, status, r->march.state[0].time);
        status = ff_results_record(&r->results, &r->march, ff_pace_done(&r->pace));
    }
    ff_pace_destroy(&r->pace);
    return status;
}

static ff_status march_engagement(const ff_ehl_model *m, run *r)
{
    const ff_history *h = &r->history;
    ff_status status = ff_march_start(&r->march);
    if (status != FF_OK)
        return explain(m, r, status, h->time[0]);
    status = ff_results_record(&r->results, &r->march, h->count == 1);
    if (status != FF_OK || h->count == 1)
        return status;
    return m->steps > 0 ? march_equal_steps(m, r) : march_own_steps(m, r);
}

/* Each engagement from its own steady film, on the grid of all. */
static ff_status march(const ff_ehl_model *m, const ff_array *in, run *r)
{
    ff_status status = FF_OK;
    r->whole = r->history;
    for (size_t row = 0; row < r->whole.count && status == FF_OK;) {
        ff_march_renew(&r->march);
        row = ff_history_engagement(&r->whole, row, &r->history);
        if (r->rough.count > 0 && r->history.count < r->whole.count) {
            ff_rough_destroy(&r->rough);
            status = read_surface(m, in, r);
        }
        if (status == FF_OK)
            status = march_engagement(m, r);
    }
    return status;
}

static ff_status read_roughness(const ff_ehl_model *m, uint64_t wanted, const ff_array *in,
                                double *rq)
{
    ff_status status = ff_combined_roughness(m->host, &in[FF_EHL_IN_ROUGHNESS], &in[FF_EHL_IN_RQ_1],
                                             &in[FF_EHL_IN_RQ_2], rq);
    if (status == FF_OK)
        status = ff_lambda_check(m->host, wanted, FF_EHL_LAMBDA_RATIO, "lambda_ratio", *rq);
    if (status == FF_OK)
        status = ff_lambda_check(m->host, wanted, FF_EHL_LAMBDA_RATIO_LOWEST, "lambda_ratio_lowest",
                                 *rq);
    return status;
}

ff_status ff_ehl_evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    ff_ehl_model *m = self;
    run r = {0};
    ff_status status = ff_ehl_history(m, in, &r.history);
    if (status != FF_OK)
        return status;
    if ((wanted & (FF_BIT(FF_EHL_ROLL_ANGLE) | FF_BIT(FF_EHL_H_MIN_LOWEST_AT))) &&
        !in[FF_EHL_IN_ROLL].data)
        return ff_failf(
            m->host, FF_UNSUPPORTED,
            wanted & FF_BIT(FF_EHL_ROLL_ANGLE) ? "roll_angle" : "h_min_lowest_at",
            "this output needs a contact with a roll angle, such as contact/tooth-pair");
    double roughness;
    status = read_roughness(m, wanted, in, &roughness);
    if (status != FF_OK)
        return status;
    status = run_create(m, in, &r);
    if (status == FF_OK)
        status = ff_results_create(&r.results, m->host, wanted, &r.march);
    r.results.boundary_friction = m->boundary_friction;
    r.results.roughness = roughness;
    if (status == FF_OK)
        status = march(m, in, &r);
    if (status == FF_OK)
        status = ff_results_finish(&r.results, &r.march);
    if (status == FF_OK)
        ff_inlet_heating_report(m->host, &m->heating, &r.whole, &m->laws, &r.oil);
    run_destroy(&r);
    return status;
}
