/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "run.h"

#include "../equations/deflection.h"

#include <math.h>
#include <stdlib.h>

int ehl_is_statistical(const ehl_model *m)
{
    return m->asperities && m->roughness != EHL_IGNORED;
}

/* tolerance: auto, for the first film and for the solvers with which finite-volume is compared */
static const double FIRST_TOLERANCE = 1e-5;

/* tolerance: auto, between rough flanks, whose error due to the cells is not known. It changes the
   asperities' share by a fifth of what the time steps do. */
static const double ROUGH_TOLERANCE = 1e-4;

double ehl_first_tolerance(const ehl_model *m, const ehl_run *r)
{
    return m->tolerance > 0 ? m->tolerance : r->rough.count > 0 ? ROUGH_TOLERANCE : FIRST_TOLERANCE;
}

void ehl_run_destroy(ehl_run *r)
{
    ehl_results_destroy(&r->results);
    ehl_step_control_destroy(&r->control);
    ehl_transport_destroy(&r->transport);
    ehl_march_destroy(&r->march);
    ehl_heat_destroy(&r->heat);
    ehl_thermal_destroy(&r->thermal);
    if (r->solver.destroy)
        r->solver.destroy(&r->solver);
    free(r->kernel);
    ehl_roughness_destroy(&r->rough);
    ehl_reynolds_destroy(&r->reynolds);
}

/* Reads the rough flanks when a surface is wired. */
static ff_status read_surface(const ehl_model *m, const ff_array *in, ehl_run *r)
{
    const ff_array *row = in + EHL_IN_POSITION;
    if (!row[0].data || m->roughness == EHL_IGNORED)
        return FF_OK;
    if (m->maker != ehl_newton_krylov || m->outside)
        return ff_failf(m->host, FF_UNSUPPORTED, "surface.position",
                        "%s models smooth flanks only; ehl/finite-volume takes rough ones%s",
                        m->outside ? "the discretisation" : "this model",
                        m->outside ? " if no discretisation is wired" : "");
    for (uint32_t k = EHL_IN_POSITION; k <= EHL_IN_ORIGIN; k++)
        if (!in[k].data)
            return ff_failf(m->host, FF_INVALID, ehl_inputs[k].name,
                            "rough flanks need this output of the surface");
    r->rough = (ehl_roughness){
        .count = in[EHL_IN_POSITION].shape[0],
        .height = {in[EHL_IN_HEIGHT_1].data, in[EHL_IN_HEIGHT_2].data},
        .rq = {*in[EHL_IN_RQ_1].data, *in[EHL_IN_RQ_2].data},
        .period = *in[EHL_IN_PERIOD].data,
        .origin = *in[EHL_IN_ORIGIN].data,
        .history = &r->history,
    };
    ff_status status = ehl_history_one_way(&r->history, m->host, "a rough film");
    return status != FF_OK
               ? status
               : ehl_roughness_create(&r->rough, in[EHL_IN_POSITION].data, &r->history, m->host);
}

/* Removes the waves of rough flanks that the cells do not resolve. All engagements share one
   cut-off, since they share a grid. */
static ff_status cut_surface(const ehl_model *m, ehl_run *r)
{
    double cutoff =
        m->roughness_cutoff >= 0 ? m->roughness_cutoff : EHL_CELLS_PER_WAVE * r->grid.dx;
    return r->rough.count > 0 && cutoff > 0 ? ehl_roughness_cut(&r->rough, cutoff, m->host) : FF_OK;
}

/* Reads the hardness of rough flanks: that of the softer gear, or the parameter if no gear gives
   it. */
static ff_status read_hardness(const ehl_model *m, const ff_array *in, ehl_run *r)
{
    const ff_array *row = &in[EHL_IN_HARDNESS];
    r->hardness = m->asperity_hardness;
    r->gears_tell = row->data && (r->rough.count > 0 || ehl_is_statistical(m));
    return r->gears_tell ? ehl_read_hardness(m->host, row, m->asperity_hardness, &r->hardness)
                         : FF_OK;
}

/* Refuses a hardness below the mean pressure pi/4 p_H (Johnson 1985, ch. 4). If all metal yields,
   the load is its hardness times a length, and this length would exceed that of the elastic
   contact. */
static ff_status check_hardness(const ehl_model *m, const ehl_run *r)
{
    const double mean = 3.14159265358979323846 / 4 * r->grid.pressure;
    if (!(r->rough.count > 0 && r->hardness > 0) || r->hardness > mean)
        return FF_OK;
    return ff_failf(m->host, FF_INVALID, r->gears_tell ? "gear.hardness" : "asperity_hardness",
                    "flanks of %.4g GPa hardness would yield over the whole contact, whose mean "
                    "pressure is %.4g GPa under the largest load: asperity_hardness, or the "
                    "hardness of the gears, must be above that, or 0 for flanks that stay elastic",
                    1e-9 * r->hardness, 1e-9 * mean);
}

/* An inlet shorter than this share of the full length begins with the pressure of the full
   inlet. */
static const double SHORT = 0.9;

/* Fits the domain and its nodes to the contact, the oil and the roughness. */
static void fit_domain(const ehl_model *m, ehl_run *r)
{
    if (r->like) {
        r->grid = *r->like;
        r->grid.nodes = (size_t)m->cells + 1;
        r->grid.dx = (r->grid.inlet + r->grid.outlet) / (double)m->cells;
        return;
    }
    double rq = r->rough.count > 0 ? ehl_roughness_rq(&r->rough) : 0;
    double supplied = ehl_inlet_supplied(&r->history, &r->oil);
    ehl_grid_fit(&r->grid, (size_t)m->cells, m->inlet, m->outlet, &r->history, &r->oil, rq,
                 supplied);
    if (!(m->inlet > 0 || rq > 0 || r->history.turns)) {
        double longest = r->grid.inlet;
        ehl_grid_fit(&r->grid, (size_t)m->cells,
                     ehl_inlet_balanced(&r->history, &r->oil, (size_t)m->cells, r->grid.outlet,
                                        r->grid.inlet) /
                         r->grid.half_width,
                     m->outlet, &r->history, &r->oil, rq, supplied);
        r->grid.fed = !m->outside && r->grid.inlet < SHORT * longest;
    }
}

static ff_status fit_grid(const ehl_model *m, ehl_run *r)
{
    if (ehl_fluid_oil(&m->laws, &r->oil) < 0)
        return ff_failf(m->host, FF_INVALID, NULL, "an oil law fails at ambient pressure");
    double *film = malloc(r->history.count * sizeof *film); /* each row is used many times */
    if (!film)
        return FF_NOMEM;
    for (size_t i = 0; i < r->history.count; i++)
        film[i] = ehl_row_film(&r->history, i, &r->oil);
    r->history.film = film;
    fit_domain(m, r);
    r->history.film = NULL;
    free(film);
    if (!(r->grid.dx > 0 && isfinite(r->grid.dx)))
        return ff_failf(m->host, FF_INVALID, "contact.load_per_width",
                        "the contact and the oil give no finite length of the domain");
    return check_hardness(m, r);
}

static ff_status equations_create(const ehl_model *m, ehl_run *r)
{
    ehl_reynolds *eq = &r->reynolds;
    size_t nodes = r->grid.nodes;
    if (ehl_reynolds_create(eq, &r->grid, &m->laws, &r->oil, m->wedge + 1) != FF_OK)
        return FF_NOMEM;
    r->kernel = malloc(nodes * sizeof *r->kernel);
    if (!r->kernel)
        return FF_NOMEM;
    ehl_kernel_fill(nodes, r->grid.dx, r->history.modulus, r->grid.half_width, r->kernel);
    eq->conserving = m->cavitation == EHL_CONSERVING;
    eq->unit = r->oil.density * (r->kernel[0] - r->kernel[nodes - 1]);
    if (ehl_is_statistical(m))
        eq->statistical = (ehl_statistical){.law = m->asperities,
                                            .scale = r->history.modulus / m->asperities->modulus,
                                            .share = 1,
                                            .hardness = r->hardness};
    if (r->rough.count > 0) {
        /* Mass-conserving cavitation: a void in a valley must be able to close. First-order wedge:
           no spurious waves at the film boundary. */
        eq->conserving = 1;
        eq->wedge = 1;
        eq->contact = eq->floor = m->contact_film;
        eq->leak = m->valleys == EHL_VENTILATED ? 12 / (m->valley_length * m->valley_length) : 0;
        eq->hardness = r->hardness;
        eq->give = r->kernel[0] - r->kernel[nodes - 1];
    }
    return FF_OK;
}

static ff_status solver_create(const ehl_model *m, ehl_run *r)
{
    r->solver = (ehl_solver){
        .grid = &r->grid,
        .reynolds = &r->reynolds,
        .kernel = r->kernel,
        .modulus = r->history.modulus,
        .tolerance = ehl_first_tolerance(m, r),
        .outside = m->outside,
        .maker = m->outside ? ehl_outside : m->maker,
    };
    ff_status status = r->solver.maker(&r->solver);
    if (status == FF_UNSUPPORTED && m->outside)
        return ff_failf(
            m->host, status, "discretisation",
            "the discretisation does not support a film with cavitation %s and %s wedge",
            r->reynolds.conserving ? "mass-conserving" : "clip",
            r->reynolds.wedge == 2 ? "second-order" : "first-order");
    if (status == FF_UNSUPPORTED)
        return ff_failf(m->host, status, NULL, "LAPACK, which this model needs, cannot be loaded");
    return status;
}

/* Returns 1 if the oil nearly comes to rest. The flanks squeeze a dip into the film then, whose
   error the linear equation states a tenth too small (test `bars`). */
static int nearly_rests(const ehl_history *h)
{
    const double hardly = 0.1;
    int rests = 0;
    for (size_t k = 0; k < h->count; k++) {
        const double speed = h->speed_1[k] + h->speed_2[k],
                     before = k > 0 ? h->speed_1[k - 1] + h->speed_2[k - 1] : speed;
        rests |= fabs(speed) < 2 * hardly * h->speed_max || speed * before < 0;
    }
    return rests;
}

/* Whether the errors of such films are found by their transport. A matrix that knows no temperature
   does not tell those of a heated film, and GMRES seldom solves that of touching asperities to the
   accuracy that errors need (docs/theory.md, 12). */
static int has_transport(const ehl_model *m, const ehl_run *r)
{
    return r->solver.maker == ehl_newton_krylov && m->thermal == 0 && r->rough.count == 0 &&
           !ehl_is_statistical(m) && !nearly_rests(&r->history);
}

static ff_status transport_create(const ehl_model *m, uint64_t judged, ehl_run *r)
{
    if (!has_transport(m, r) || !(ehl_wants_h_min(judged) || ehl_wants_h_central(judged)))
        return FF_OK;
    r->march.transport = &r->transport;
    return ehl_transport_create(&r->transport, r->grid.nodes);
}

ff_status ehl_run_surface(const ehl_model *m, const ff_array *in, ehl_run *r)
{
    ehl_roughness_destroy(&r->rough);
    ff_status status = read_surface(m, in, r);
    return status == FF_OK ? cut_surface(m, r) : status;
}

ff_status ehl_run_create(const ehl_model *m, uint64_t judged, const ff_array *in, ehl_run *r)
{
    ff_status status = read_surface(m, in, r);
    if (status == FF_OK)
        status = read_hardness(m, in, r);
    if (status == FF_OK)
        status = fit_grid(m, r);
    if (status == FF_OK)
        status = cut_surface(m, r);
    if (status == FF_OK)
        status = equations_create(m, r);
    if (status == FF_OK)
        status = solver_create(m, r);
    if (status != FF_OK)
        return status;
    status = ehl_march_create(&r->march, &r->history, &r->solver, m->time_scheme);
    r->march.rough = r->rough.count > 0 ? &r->rough : NULL;
    return status == FF_OK ? transport_create(m, judged, r) : status;
}
