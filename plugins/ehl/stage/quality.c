/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares the outputs of each instant with the same quantities computed from its fields, and
   writes the quality record of a run. */
#include "../contact/simd-reductions.h"
#include "../contact/surface.h"
#include "../errors/balance.h"
#include "../errors/time-error.h"
#include "../heat/thermal.h"
#include "outputs.h"
#include "stage.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdio.h>

/* Keeps the largest relative error of all outputs so far. */
static void compare_output(ehl_balance *b, double value, double expected, double scale)
{
    ehl_worse(&b->worst.outputs, fabs(value - expected) / (scale + 1e-300));
}

/* Returns the least value of the parabola through node i and its neighbours. */
static double vertex(const double *y, size_t i)
{
    double left = y[i] - y[i - 1], right = y[i + 1] - y[i], bend = right - left;
    return bend > 0 ? y[i] - (left + right) * (left + right) / (8 * bend) : y[i];
}

/* Interpolates y[0] ... y[3] at 0 ... 3 to `place` by Neville's scheme. */
static double through_four(const double *y, double place)
{
    double q[4] = {y[0], y[1], y[2], y[3]};
    for (int order = 1; order < 4; order++)
        for (int k = 0; k + order < 4; k++)
            q[k] += (place - k) / order * (q[k + 1] - q[k]);
    return q[0];
}

static void compare_film_outputs(ehl_balance *b, const ehl_march *m, const double *row)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *h = eq->h, *p = m->state[0].film.p;
    double least = ehl_least(b->nodes, h), highest = ehl_greatest(b->nodes, p, 0);
    size_t low = 0;
    while (h[low] > least)
        low++;
    if (low > 0 && low + 1 < b->nodes && !m->rough && vertex(h, low) > least / 2)
        least = vertex(h, low);
    compare_output(b, row[EHL_H_MIN], least, least);
    compare_output(b, row[EHL_P_MAX], highest, highest + 1);
    double place = -eq->first / eq->dx, node = fmin(fmax(floor(place), 1), (double)b->nodes - 3);
    const double *near = h + (size_t)node;
    double central = m->rough ? near[0] + (place - node) * (near[1] - near[0])
                              : through_four(near - 1, place - node + 1);
    compare_output(b, row[EHL_H_CENTRAL], central, fabs(central));
}

typedef struct force {
    double fluid, asperities, all;
    double end; /* part of `fluid` in the cell where the film ends */
} force;

/* Returns the traction nearest to the given one within an uncertainty: the film may end up to half
   a cell before, or one cell after, the cell of its last node. The position of the end is not
   checked here. */
static double with_end(double given, double sum, double end)
{
    return fmin(fmax(given, sum + fmin(-end / 2, end)), sum + fmax(-end / 2, end));
}

/* Sets b->left to tau, up to the last node with pressure. Returns the friction forces. */
static force friction(ehl_balance *b, const ehl_march *m, double boundary)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const ehl_film *film = &m->state[0].film;
    double slide = m->step.sliding, way = slide > 0 ? 1 : slide < 0 ? -1 : 0;
    const double *fluid = ehl_fluid(eq, film);
    force f = {0, 0, 0, 0};
    size_t n = b->nodes;
    while (n > 1 && !(film->p[n - 1] > 0))
        n--;
    if (m->rough) /* with smooth flanks ln_eta is already set by the balance of mass */
        eq->laws.viscosity->eval(eq->laws.viscosity->self, n, film->p, NULL, b->ln_eta, NULL, NULL);
    if (eq->laws.rheology)
        eq->laws.rheology->shear(eq->laws.rheology->self, n, fluid, NULL, b->ln_eta, eq->h, slide,
                                 b->left);
    for (size_t i = 0; i < n && (m->thermal || !eq->laws.rheology); i++)
        b->left[i] =
            m->thermal ? ehl_thermal_stress(m, i) : slide / eq->h[i] * exp(fmin(b->ln_eta[i], 230));
    for (size_t i = 0; i < n; i++) {
        double tau = b->left[i], p = fluid[i];
        if (film->asperity[i])
            f.asperities += way * boundary * p;
        else if (p > 0)
            f.fluid += tau;
        if (eq->statistical.law)
            f.asperities += way * boundary * (film->p[i] - p);
        if (p > 0 && i + 1 < b->nodes && !(fluid[i + 1] > 0))
            f.end += eq->rough ? 0 : tau;
        f.all += fabs(tau) + boundary * film->p[i];
    }
    return (force){f.fluid * eq->dx, f.asperities * eq->dx, f.all * eq->dx, f.end * eq->dx};
}

static void compare_loss_outputs(ehl_balance *b, const ehl_march *m, const double *row, force f)
{
    const ehl_reynolds *eq = m->solver->reynolds;
    const double *p = ehl_fluid(eq, &m->state[0].film);
    double D = 0, u = m->step.entrainment;
    for (size_t i = 0; i + 1 < b->nodes; i++)
        D += b->face[i] * (p[i + 1] - p[i]) * (1 / b->rho[i] + 1 / b->rho[i + 1]) / 2;
    if (m->thermal)
        D = ehl_thermal_pressure_flow(m);
    double scale = eq->dx / m->step.radius;
    /* boundary term of the integration by parts, at the start of the pressure */
    double enters = p[0] * (eq->h[0] + eq->h[1]) / 2;
    double tail = p[1] > 0 ? 24 * eq->oil.viscosity * u * m->step.radius / -eq->first : 0;
    double power = (f.fluid + f.asperities) * m->step.sliding + D + u * tail;
    compare_output(b, row[EHL_ROLLING_LOSS], u * (tail - scale * b->moment - enters),
                   u * (tail + scale * b->arm));
    compare_output(b, row[EHL_POWER_LOSS],
                   with_end(row[EHL_POWER_LOSS], power, f.end * m->step.sliding),
                   fabs(power) + u * tail);
    if (ehl_march_is_loaded(m))
        ehl_worse(&b->worst.dissipation, b->unbalanced / (fabs(power) + 1e-300));
}

void ehl_balance_outputs(ehl_balance *b, const ehl_march *m, const double *row, uint64_t wanted,
                         double boundary)
{
    static const uint64_t of_shear =
        FF_BIT(EHL_TRACTION) | FF_BIT(EHL_FRICTION_COEFFICIENT) | FF_BIT(EHL_POWER_LOSS);
    compare_film_outputs(b, m, row);
    if (!(wanted & of_shear))
        return;
    force f = friction(b, m, boundary);
    double traction = f.fluid + f.asperities, scale = f.all;
    const double given = row[EHL_TRACTION], by_load = row[EHL_FRICTION_COEFFICIENT] * m->step.load;
    compare_output(b, given, with_end(given, traction, f.end), scale);
    if (!m->contact_lost && m->at.load > 0)
        compare_output(b, by_load, with_end(by_load, traction, f.end), scale);
    if ((wanted & FF_BIT(EHL_POWER_LOSS)) && !m->rough)
        compare_loss_outputs(b, m, row, f);
}

static void report_at_most(const ehl_results *r, const char *name, double value, double limit,
                           int32_t beyond, const char *text)
{
    r->host->quality(r->host->ctx, name, value, limit, value <= limit ? FF_GOOD : beyond, text);
}

/* Reports a value that must not be less than its limit. */
static void report_at_least(const ehl_results *r, const char *name, double value, double limit,
                            const char *text)
{
    if (isfinite(value))
        r->host->quality(r->host->ctx, name, value, limit, value >= limit ? FF_GOOD : FF_DOUBTFUL,
                         text);
}

/* Reports the error of an equation that a film must satisfy. Beyond `broken` the film does not
   satisfy it. */
static void report_balance(const ehl_results *r, const char *name, double value, double limit,
                           double broken, const char *text)
{
    report_at_most(r, name, value, limit, value <= broken ? FF_DOUBTFUL : FF_BAD, text);
}

/* Tolerances of the balances: an error beyond `limit` is doubtful, beyond `broken` bad. */
typedef struct tolerances {
    double limit, broken;
} tolerances;

static tolerances tolerances_of(const ehl_results *r, const ehl_march *m)
{
    const double unknown = 0.02; /* used if no instant has a load at which the error due to the
                                    cells is known */
    double most = fmax(20 * fmin(r->tolerance, 2e-5), 5 * r->tolerance);
    double same = fmax(most, 1e-9), cells = r->worst_by_cells;
    if (!m->solver->outside)
        return (tolerances){same, fmax(0.01, 10 * same)};
    double limit = fmax(same, cells > 0 && isfinite(cells) ? cells : unknown);
    return (tolerances){limit, fmax(0.01, 2 * limit)};
}

/*
 * Reports the balances. The limits follow from Newton's method. With a tolerance up to 2e-5, the
 * last Newton step of a film changed its pressure by less than the tolerance times p_max, and its
 * gap by less than ten times that share. The error of the equations between two places may be twice
 * as large. With a larger tolerance that much error may remain after all steps of a passage. A
 * larger error means that the equations were not solved, or that they are not those of the film. An
 * error above 0.01 is of that size in the film too. For the discretisation of another stage the
 * balances use the same equations, but not its division into cells. Their error is then as large as
 * that of h_min due to the cells.
 */
static void report_conservation(const ehl_results *r, const ehl_march *m)
{
    const ehl_imbalance *w = &r->balance.worst;
    const int wants_loss = (r->wanted & FF_BIT(EHL_POWER_LOSS)) != 0;
    const tolerances of = tolerances_of(r, m);
    const double limit = of.limit, broken = of.broken;
    report_balance(r, "contact_conditions", w->conditions, 1e-9, 1e-6,
                   "largest relative difference between the radius, speeds and load of the films "
                   "and those of the contact at the same times");
    report_balance(
        r, "load_balance", fmax(w->load, r->worst_load), 1e-8, 1e-8,
        "integral of p minus the load of the contact, over the largest load; at loaded instants "
        "except during landing, where load_error may reach 1 %");
    report_balance(r, "load_rescaling", w->rescaling, limit, broken,
                   "factor by which the pressure is scaled to the load at the end of a solution, "
                   "minus 1");
    report_balance(
        r, "film_shape", w->gap, limit, broken,
        m->rough ? "difference of h, at places of the contact, from the shape of the flanks, "
                   "their roughness as it has moved, and a deflection by direct summation, over h"
                 : "difference of h, at places of the contact, from the shape of the flanks and "
                   "a deflection by direct summation, over h");
    report_balance(
        r, "mass_balance", fmax(w->mass, r->worst_mass), limit, broken,
        "inflow - outflow - storage between the place of the highest pressure and any other "
        "place, over the flow");
    report_balance(
        r, "complementarity", fmax(w->cavitated, r->worst_complement), limit, broken,
        m->solver->reynolds->conserving
            ? "oil in a cell with p = 0 beyond what its gap can hold, over the gap"
            : "pressure that would remove the oil which a cell with p = 0 gains, over the "
              "highest pressure");
    /* the mobility in the losses is that of the last Newton step. It varies like exp(alpha p), with
       alpha p about 20, so its error is larger */
    report_balance(r, "outputs", w->outputs, 2.5 * limit, broken,
                   "difference of the outputs of film, pressure, friction and losses from the same "
                   "quantities computed from the fields");
    report_balance(r, "rolling_moment", w->moment, limit, broken,
                   "work of the entrainment minus its value from the moment of the pressure, "
                   "relative");
    if (m->rough)
        return;
    /* the terms of this balance are a few hundredths of flow times pressure, in which the tolerance
       of the cells is expressed */
    report_balance(
        r, "energy_balance", w->energy, 2 * limit, 2 * broken,
        "work of entrainment and squeeze minus the dissipation of the pressure flow, relative to "
        "them");
    if (wants_loss)
        report_at_most(
            r, "power_loss_space_error", w->dissipation, 0.05, FF_DOUBTFUL,
            "estimated relative error of power_loss due to the cells: dissipation of the "
            "pressure flow minus the work of the flanks; for loads above 2 % of the largest");
}

static double largest_loss(const ehl_results *r)
{
    double most = 0;
    for (size_t k = 0; k < r->series.count; k++)
        most = fmax(most, r->series.data[k * EHL_SERIES + EHL_POWER_LOSS]);
    return fmax(most, 1e-300);
}

static void report_end_of_inlet(const ehl_results *r)
{
    int flooded = r->tail_share > 0; /* flooded at some instant; a starved inlet is not checked */
    if (!r->rough && flooded && (r->wanted & FF_BIT(EHL_POWER_LOSS)))
        report_at_most(
            r, "power_loss_inlet_error", r->worst_squeezed / largest_loss(r), 0.05, FF_DOUBTFUL,
            "estimated error of power_loss due to the start of the domain, over the largest "
            "power_loss: the squeeze loss of the outer half of the inlet, since about as much is "
            "lost in front of the domain");
}

/* The error of the loss that is added upstream of the domain is about a sixth of that loss. */
static void report_inlet_tail(const ehl_results *r)
{
    if (!ehl_loss_of_flow(r->wanted) || !(r->tail_share > 0 || r->starved > 0))
        return;
    report_at_most(
        r, "inlet_tail", r->tail_share, 0.5, FF_DOUBTFUL,
        !r->starved ? "the inlet is flooded: share of the pressure flow's loss that arises in "
                      "front of the domain and is added by a closed formula"
        : r->tail_share > 0
            ? "share of the pressure flow's loss that arises in front of the domain and is added "
              "by a closed formula where the inlet is flooded; at some instants it is starved, "
              "and nothing is added"
            : "the inlet is starved: no loss in front of the domain is added");
}

/* With asymmetric volumes the film does not always have a definite boundary (relaxation.c). */
static void report_end_of_film(const ehl_results *r, const ehl_march *m)
{
    if (m->solver->reynolds->asymmetric)
        report_at_most(
            r, "film_end", r->undecided, 0.01 * (double)r->series.count, FF_DOUBTFUL,
            "number of films whose end is not definite between two nodes; the oil that the "
            "second node gains is reported in complementarity");
}

static void report_ends(const ehl_results *r, const ehl_grid *g)
{
    report_at_least(r, "inlet_length", r->least_inlet, r->fed ? EHL_FED_LENGTHS : 4,
                    r->fed
                        ? "shortest domain in front of the contact over sqrt(2 R h); at 2 or "
                          "more, its inlet pressure is that of a longer domain"
                        : "shortest domain in front of the contact over sqrt(2 R h); below 4 the "
                          "film is starved by about 1 % or more: move the inlet out");
    if (isfinite(r->least_inlet))
        report_at_most(
            r, "starvation", r->worst_starvation, EHL_STARVED_LIMIT, FF_DOUBTFUL,
            r->fed ? "film that is missing because the domain ends, mean over a passage, "
                     "although its inlet pressure is that of a longer domain: error of that "
                     "pressure due to the film of the run, and due to squeeze in front of the "
                     "domain"
                   : "film that is missing because the domain ends, mean over a passage, if the "
                     "inlet is flooded there; move the inlet out");
    report_at_most(
        r, "outlet_load", r->worst_outlet, 2.5e-3, FF_DOUBTFUL,
        "share of the load within a quarter of sqrt(2 R h) of the outlet's end, where the film "
        "reaches it, mean over a passage; above 0.0025 the exit of the film is cut off and h_min "
        "is too low: move the outlet out");
    if (g->drawn > 0)
        report_at_least(r, "outlet_length", g->outlet / g->drawn, 0.99,
                        "length of the outlet over the length needed where the contact grows "
                        "faster than the oil leaves, so that oil is drawn in at the outlet; "
                        "below 1 too little oil is drawn in, and p_max is too low: move the "
                        "outlet out");
}

/* Reports the resolution if the error of a film due to the cells is not estimated. */
static void report_resolution(const ehl_results *r)
{
    if (!ehl_results_estimate_cells(r))
        report_at_least(
            r, "film_resolution", r->least_resolution, 4,
            "smallest number of cells over the pressure rise of the inlet; below 3 to 4 the film "
            "depends on the grid by more than 2 %: use more cells");
}

static void report_time_errors(const ehl_results *r, const ehl_march *m)
{
    char text[192];
    if (r->series.count < 2)
        return;
    report_at_most(r, "instants", ehl_sampling_missed(&r->sampling), 0.02, FF_DOUBTFUL,
                   "largest error of linear interpolation of the load between the instants of "
                   "the film, or of the highest Hertz pressure, which no instant may hit; above "
                   "0.02 means and extremes miss what happens between the instants: use more "
                   "steps");
    if (m->rough) { /* the film on a single asperity is not a smooth function of time */
        report_at_most(r, "steps_cut", m->steps_cut, (double)r->series.count, FF_DOUBTFUL,
                       "number of time steps that were cut because asperity contacts formed or "
                       "opened");
        return;
    }
    if (ehl_wants_h_min(r->wanted))
        report_at_most(r, "h_min_time_error",
                       ehl_beyond_instants(r, EHL_H_MIN, -1) +
                           (r->lowest_alone ? fmax(0, 1 - r->least_in_time / r->lowest)
                                            : r->worst_in_time[EHL_LEAST]),
                       0.05, FF_DOUBTFUL,
                       r->lowest_alone
                           ? "estimated relative error of h_min_lowest due to the time steps; "
                             "for loads above 2 % of the largest"
                           : "estimated relative error of h_min due to the time steps; for loads "
                             "above 2 % of the largest");
    if (ehl_wants_h_central(r->wanted))
        report_at_most(
            r, "h_central_time_error", r->worst_in_time[EHL_CENTRAL], 0.05, FF_DOUBTFUL,
            "estimated relative error of h_central due to the time steps; for loads above 2 % of "
            "the largest");
    report_balance(
        r, "mass_history", r->balance.worst.history, 0.05,
        m->solver->outside ? fmax(0.1, 4 * r->worst_in_time[EHL_LEAST])
                           : fmax(0.5, 10 * r->worst_in_time[EHL_LEAST]),
        "oil that entered the contact minus oil that left it, minus the change of the oil in it, "
        "relative");
    if (r->peaks)
        report_at_most(r, "p_max_time_error",
                       ehl_beyond_instants(r, EHL_P_MAX, 1) +
                           (r->highest_alone ? fmax(0, r->highest_in_time / r->highest - 1)
                                             : r->worst_peak_in_time),
                       0.05, FF_DOUBTFUL,
                       r->highest_alone
                           ? "estimated relative error of p_max_highest due to the time steps"
                           : "estimated relative error of p_max due to the time steps");
    double loss = r->wanted & FF_BIT(EHL_POWER_LOSS) ? ehl_results_loss_in_time(r, m) : -1;
    if (loss >= 0)
        report_at_most(
            r, "power_loss_time_error", loss / largest_loss(r), 0.05, FF_DOUBTFUL,
            "estimated error due to the time steps of the rolling and squeeze loss in "
            "power_loss, over the largest power_loss; for loads above 2 % of the largest");
    r->host->quality(r->host->ctx, "steps_cut", m->steps_cut, 0, FF_GOOD,
                     "number of time steps that failed and were repeated with shorter ones");
    snprintf(text, sizeof text,
             "largest truncation error of the film in one step, relative, at %.6g s; %g steps "
             "were repeated because of it",
             m->worst_truncation_at, m->steps_refused);
    r->host->quality(r->host->ctx, "worst_step", m->worst_truncation, 0, FF_GOOD, text);
}

static void report_contact_loss(const ehl_results *r, const ehl_march *m)
{
    if (m->pressureless_steps > 0)
        r->host->quality(r->host->ctx, "bare_steps", m->pressureless_steps, 0, FF_DOUBTFUL,
                         "number of steps without load that continued without pressure because "
                         "Newton's method failed");
    if (r->lost_force > 0)
        r->host->quality(r->host->ctx, "unloaded_force", r->lost_force, 1, FF_GOOD,
                         "largest force of the film while the flanks are separated, over the "
                         "largest load");
    if (r->worst_gap_excess > 0 && r->widest_gap > 0)
        report_at_most(
            r, "one_way_gap_error", r->worst_gap_excess / r->widest_gap, 1, FF_DOUBTFUL,
            "largest distance by which the film keeps the flanks further apart than the dynamics "
            "computed, over the largest gap; above 1 the film determines the flight, not the "
            "dynamics");
}

/*
 * Reports the resolution of asperities. The film on an asperity forms over its inlet, which is
 * shorter for a thinner film. If there is at least one cell over this inlet when the film is the
 * contact film, doubling the cells changes the asperities' share by less than 5 %:
 * docs/validation/mixed.md.
 */
static void asperity_cells(const ehl_results *r, const ehl_march *m, double share)
{
    const double enough = 1, little = 0.01;
    double length = ehl_roughness_inlet(m->rough, m->solver->reynolds->contact);
    double dx = m->solver->grid->dx, shortest = ehl_roughness_wavelength(m->rough);
    if (!isfinite(length))
        return;
    int resolved = length >= enough * dx || share < little;
    char text[192];
    snprintf(text, sizeof text,
             "%scells over the inlet of an asperity, %.2g um for the rms curvature of the "
             "flanks; %.3g cells between two peaks",
             resolved ? "" : "not resolved, share of the time ", 1e6 * length, shortest / dx);
    r->host->quality(r->host->ctx, "asperity_resolution", length / dx, enough,
                     resolved ? FF_GOOD : FF_DOUBTFUL, text);
}

static void report_yield(const ehl_results *r, const ehl_march *m, double count)
{
    double hardness = m->solver->reynolds->hardness;
    char text[192];
    if (!(hardness > 0))
        return;
    snprintf(text, sizeof text,
             "mean share of the load where the metal yields, at %.4g GPa; the plastic part of "
             "the gap is at most %.3g um. It is that of each instant: no dent remains on a flank",
             1e-9 * hardness, 1e6 * r->deepest_yield);
    r->host->quality(r->host->ctx, "yield", r->yield_sum / count, 1, FF_GOOD, text);
    /* round-off of the sum that gives h, whose terms are up to 1e5 times as large as h */
    report_at_most(r, "yield_complementarity", r->worst_yield, 1e-9, FF_BAD,
                   "error of the yield condition: plastic part of the gap where p is below "
                   "asperity_hardness, over h, or p above asperity_hardness");
}

/* The model has flanks that are rough only along the motion. They let oil into valleys that are
   closed in reality, and they ride over waves that are longer than the contact. */
static void report_rough_lambda(const ehl_results *r)
{
    const double least = 1;
    if (!(r->roughness > 0))
        return;
    r->host->quality(
        r->host->ctx, "lambda", r->least_lambda, least,
        r->least_lambda < least ? FF_RANGE : FF_GOOD,
        "lowest mean film over the roughness of the record; below 1 asperities carry a share of "
        "the load that a model with roughness along the motion alone cannot give, so that "
        "friction and loss may be larger");
}

/* Flanks ride over waves that are longer than the contact. */
static void report_long_waves(const ehl_results *r, const ehl_march *m)
{
    const double most = 1. / 3;
    double share = ehl_roughness_longer(m->rough, 2 * m->solver->grid->half_width);
    r->host->quality(r->host->ctx, "waves_longer_than_contact", share, most,
                     share <= most ? FF_GOOD : FF_RANGE,
                     "share of the flanks' variance in waves longer than the largest contact, "
                     "which rides over them: the friction is that of a film on waves, and "
                     "excludes what asperities carry in three dimensions (surface/statistical)");
}

/* Reports if a record that does not repeat is shorter than the travel of its flank. */
static void report_record(const ehl_results *r, const ehl_march *m)
{
    double beyond = ehl_roughness_beyond(m->rough);
    if (beyond > 0)
        report_at_most(r, "surface_record", beyond, 0.01, FF_RANGE,
                       "share of the flanks' travel beyond the end of their record, where they "
                       "are taken as flat: use a longer record, or let it repeat (extend)");
}

/* Reports the part of the roughness that the film does not resolve. */
static void report_left_out(const ehl_results *r, const ehl_march *m)
{
    const ehl_roughness *f = m->rough;
    const double most = 0.05;
    char text[256];
    if (!(f->given > 0))
        return;
    snprintf(text, sizeof text,
             "rq_left_out over the Rq of the flanks, %.3g of %.3g um: waves below %.4g um, %.3g "
             "cells, are removed (roughness_cutoff); with more cells less is removed",
             1e6 * f->left_out, 1e6 * f->given, 1e6 * f->cutoff, f->cutoff / m->solver->grid->dx);
    report_at_most(r, "roughness_left_out", f->left_out / f->given, most, FF_RANGE, text);
}

static void report_asperities(const ehl_results *r, const ehl_march *m)
{
    double count = fmax(1, (double)r->loaded);
    char text[192];
    snprintf(text, sizeof text,
             "mean share of the load on asperities; %.3g of the contact's length touches, and "
             "oil in sealed valleys carries %.3g of the load",
             r->ratio_sum / count, r->trapped_sum / count);
    r->host->quality(r->host->ctx, "asperity_load", r->share_sum / count, 1, FF_GOOD, text);
    report_left_out(r, m);
    report_record(r, m);
    asperity_cells(r, m, r->share_sum / count);
    report_long_waves(r, m);
    report_yield(r, m, count);
    report_at_most(
        r, "contact_supply", r->worst_supply, 0.01, FF_DOUBTFUL,
        "oil that asperities in contact press out beyond the oil between them, over the flow");
    report_at_least(
        r, "cells_per_wavelength", ehl_roughness_wavelength(m->rough) / m->solver->grid->dx, 8,
        "cells over the mean distance of the peaks; below 8 the finest asperities are not "
        "resolved");
}

/* The load on statistical asperities is known only to a factor of 3, since their parameter K is. */
static void report_statistical(const ehl_results *r, const ehl_march *m)
{
    const double longest = 1.5, length = 2 * m->solver->grid->half_width;
    char text[224];
    snprintf(text, sizeof text,
             "mean share of the load on asperities, from their statistics, whose K is known to a "
             "factor of 3; smallest distance of the mean planes: %.3g sigma",
             r->least_gap);
    r->host->quality(r->host->ctx, "asperity_load", r->share_sum / fmax(1, (double)r->loaded), 1,
                     FF_GOOD, text);
    if (r->cutoff > 0)
        report_at_most(r, "roughness_cutoff", r->cutoff / length, longest, FF_RANGE,
                       "longest waves of the roughness over the length of the largest contact; "
                       "the flanks ride over longer ones, so that rq is too large by these waves");
    if (r->roughness > 0)
        ehl_lambda_carried(r->host, r->least_lambda);
}

/* The film at rest is not known, nor is the film before the creep that replaces the state of
   rest. */
static void report_start(const ehl_results *r, const ehl_march *m)
{
    const ehl_history *h = m->history;
    char text[192];
    if (!h->at_rest)
        return;
    snprintf(text, sizeof text,
             "the history begins at rest: up to %.3g s, when the initial film has left the "
             "contact, the smallest films are those of %g %% of the largest speed, or remain "
             "from them",
             m->renewed > 0 ? m->renewed : h->time[h->count - 1], 100 * EHL_CREEP);
    r->host->quality(r->host->ctx, "start_at_rest", 1, 0, FF_RANGE, text);
}

void ehl_results_quality(const ehl_results *r, const ehl_march *m)
{
    const ehl_counters *counters = &m->solver->counters;
    double count = (double)r->series.count;
    char text[256];
    report_conservation(r, m);
    report_end_of_film(r, m);
    report_inlet_tail(r);
    report_end_of_inlet(r);
    report_ends(r, m->solver->grid);
    report_resolution(r);
    ehl_results_report_cells(r, m);
    report_time_errors(r, m);
    report_contact_loss(r, m);
    if (m->rough) {
        report_asperities(r, m);
        report_rough_lambda(r);
    } else if (m->solver->reynolds->statistical.law) {
        report_statistical(r, m);
    } else if (r->roughness > 0) {
        ehl_lambda_report(r->host, r->least_lambda);
    }
    if (r->lowest < (m->rough ? 0.99e-9 : 0.999e-9)) /* asperities keep 1 nm within the tolerance */
        r->host->quality(r->host->ctx, "continuum", r->lowest, 1e-9, FF_RANGE,
                         "outside continuum: the film is thinner than 1 nm, a few molecules");
    ehl_law_report(r->host, r->laws);
    report_start(r, m);
    if (m->solver->outside)
        r->host->quality(r->host->ctx, "discretisation", 1, 0, FF_GOOD,
                         "each film is computed by the discretisation of another stage; its "
                         "errors due to the cells are estimated as if it were that of this model");
    snprintf(text, sizeof text, "%s%s; %.3g Newton steps and %.3g convolutions per instant",
             count > 1 ? "converged at every instant" : "converged",
             m->start_unloaded ? "; starts without load, from the film of 1 % of the largest load"
                               : "",
             counters->newton / count, counters->convolutions / count);
    r->host->quality(r->host->ctx, "status", 0, 0, FF_GOOD, text);
}
