/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "judge.h"

#include "grid.h"
#include "inlet.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { INSTANTS = 9, POINTS = 32 };

/* Loads below this share of the largest are left out, as by the assessments of the models. */
static const double LIGHT_LOAD = 0.02;

/* Film and friction of the contact at some instants with one set of laws. */
typedef struct effect {
    double central[INSTANTS], least[INSTANTS], traction[INSTANTS];
    double alpha,
        stress;         /* 1/Pa, pressure coefficient of the film; Pa, largest mean shear stress */
    double ln_eta_rise; /* ln(eta/eta0) at the highest pressure */
    double denser;      /* rho/rho0 there */
    int continued;      /* a law was continued out of its range */
} effect;

typedef struct conditions {
    const ehl_history *history;
    size_t count;
    ehl_instant at[INSTANTS];
    double highest; /* Pa */
} conditions;

static void add_instant(conditions *s, ehl_instant at)
{
    if (s->count == INSTANTS || !(at.load >= LIGHT_LOAD * s->history->load_max) || !(at.load > 0) ||
        !(at.entrainment > 0))
        return;
    s->highest = fmax(s->highest, ehl_hertz_pressure(at.load, at.radius, s->history->modulus));
    s->at[s->count++] = at;
}

/* Picks the row of the largest load, and rows at equal distances from the beginning to the end. */
static void pick_instants(conditions *s)
{
    const ehl_history *h = s->history;
    size_t most = 0, equal = INSTANTS - 1;
    for (size_t i = 0; i < h->count; i++)
        most = h->load[i] > h->load[most] ? i : most;
    add_instant(s, ehl_history_row(h, most));
    for (size_t k = 0; k < equal && h->count > 1; k++)
        add_instant(s, ehl_history_row(h, (2 * k + 1) * h->count / (2 * equal)));
}

/* Integrates tau over the Hertzian contact, through which the mass that entered passes unchanged.
   Returns 1 when a law was continued outside its range. */
static int add_friction(const ehl_laws *laws, const conditions *s, size_t k, double mass, effect *e)
{
    const ehl_instant *at = &s->at[k];
    double p[POINTS], rho[POINTS], h[POINTS], ln_eta[POINTS], tau[POINTS], sum = 0;
    double p_max = ehl_hertz_pressure(at->load, at->radius, s->history->modulus);
    for (int i = 0; i < POINTS; i++) {
        double place = (2 * i + 1.) / POINTS - 1;
        p[i] = p_max * sqrt(1 - place * place);
    }
    ff_status a = laws->density->eval(laws->density->self, POINTS, p, NULL, rho, NULL, NULL);
    for (int i = 0; i < POINTS; i++)
        h[i] = mass / rho[i];
    ff_status b = ehl_fluid_shear(laws, POINTS, p, h, at->sliding, ln_eta, tau);
    for (int i = 0; i < POINTS; i++) {
        sum += fabs(tau[i]) / POINTS;
        e->stress = fmax(e->stress, fabs(tau[i]));
    }
    e->traction[k] = sum * 2 * ehl_hertz_half_width(at->load, at->radius, s->history->modulus);
    return a != FF_OK || b != FF_OK;
}

static ff_status find_effect(const conditions *s, const ehl_laws *laws, effect *e)
{
    ehl_inlet inlet;
    ehl_oil oil;
    *e = (effect){.continued = 0};
    if (ehl_fluid_oil(laws, &oil) < 0)
        return FF_INVALID;
    e->alpha = ehl_alpha_star(laws).value;
    e->continued = ehl_inlet_fill(&inlet, laws, &oil, e->alpha, s->highest) != FF_OK;
    double rho, p = s->highest, ln_eta;
    laws->density->eval(laws->density->self, 1, &p, NULL, &rho, NULL, NULL);
    laws->viscosity->eval(laws->viscosity->self, 1, &p, NULL, &ln_eta, NULL, NULL);
    e->denser = rho / oil.density;
    e->ln_eta_rise = ln_eta - oil.ln_viscosity;
    oil.alpha = e->alpha;
    for (size_t k = 0; k < s->count; k++) {
        const ehl_instant *at = &s->at[k];
        double off, p_max = ehl_hertz_pressure(at->load, at->radius, s->history->modulus);
        double guess = ehl_moes_film(at, s->history->modulus, &oil);
        double mass = ehl_inlet_mass(&inlet, at, at->entrainment, s->history->modulus, guess, &off);
        laws->density->eval(laws->density->self, 1, &p_max, NULL, &rho, NULL, NULL);
        e->central[k] = mass / rho;
        e->least[k] = fmin(ehl_exit_ratio(e->alpha, p_max) * mass / oil.density, mass / rho);
        e->continued |= add_friction(laws, s, k, mass, e);
        if (!isfinite(mass) || !isfinite(e->traction[k]))
            return FF_INVALID;
    }
    return FF_OK;
}

/* Differences of the candidate from the reference, relative to the reference. */
typedef struct difference {
    double film;                       /* larger of those of h_min and h_central, on the mean */
    double lowest;                     /* of the lowest h_min */
    double friction;                   /* of |traction|, on the mean */
    double film_moves, friction_moves; /* with the sign, on the mean */
} difference;

static double lowest_of(const double *h, size_t count)
{
    double least = HUGE_VAL;
    for (size_t k = 0; k < count; k++)
        least = fmin(least, h[k]);
    return least;
}

static difference compare(const effect *e, const effect *than, size_t count)
{
    difference d = {0};
    double least = 0, central = 0, off = 0, moved = 0, all = 0;
    for (size_t k = 0; k < count; k++) {
        double change = e->central[k] / than->central[k] - 1;
        double dragged = e->traction[k] - than->traction[k];
        least += fabs(e->least[k] / than->least[k] - 1) / (double)count;
        central += fabs(change) / (double)count;
        d.film_moves += change / (double)count;
        off += fabs(dragged);
        moved += dragged;
        all += than->traction[k];
    }
    d.film = fmax(least, central);
    d.lowest = fabs(lowest_of(e->least, count) / lowest_of(than->least, count) - 1);
    d.friction = all > 0 ? off / all : 0;
    d.friction_moves = all > 0 ? moved / all : 0;
    return d;
}

/*
 * Estimates the error of the candidate law from the differences found here. The factors were fitted
 * to finite-volume solutions of random contacts, from rigid to M = 70, and of soft ones
 * (tests/plugins/ehl/laws.py draws others). Film: differences of viscosity and density are
 * predicted within a third, except under light loads, where compression changes the film less than
 * predicted. Shear also thins the film where it leaves the contact, up to 50 times as much as
 * predicted, and 200 times where it has a trough after a falling load. The highest pressure is that
 * of a spike, which viscosity and shear shape. Friction follows the viscosity at pressures that
 * change about as much as the film, which multiplies the error of the film by ln(eta/eta0).
 */
static double estimate_error(const conditions *s, ehl_law_kind kind, const difference *d,
                             double ln_eta_rise, ehl_error_targets w)
{
    const int steady = s->history->count == 1;
    const double factor[] = {[EHL_LAW_VISCOSITY] = 1.4,
                             [EHL_LAW_DENSITY] = 1.15,
                             [EHL_LAW_RHEOLOGY] = steady ? 60 : 250};
    const double spike[] = {
        [EHL_LAW_VISCOSITY] = 0.15, [EHL_LAW_DENSITY] = 0, [EHL_LAW_RHEOLOGY] = 1};
    const double floor = kind == EHL_LAW_VISCOSITY           ? 3e-3
                         : kind == EHL_LAW_DENSITY || steady ? 1e-3
                                                             : 2e-3;
    double lowest = factor[kind] * d->lowest + floor;
    double film = factor[kind] * fmax(d->film, d->lowest) + floor;
    double error = w.film ? film : w.lowest ? lowest : 0;
    if (w.pressure)
        error = fmax(error, 1.5 * film + spike[kind] * fmin(d->friction, 0.3) + 5e-3);
    if (w.friction)
        error = fmax(error, 1.5 * d->friction + film + 2e-3 +
                                ln_eta_rise * (kind == EHL_LAW_RHEOLOGY ? floor : film));
    return error;
}

/* At the temperature of the others. */
static ehl_laws replace_law(const ehl_laws *laws, ehl_law_kind kind, const void *service,
                            ehl_isothermal *at)
{
    ehl_laws other = *laws;
    double T = laws->temperature > 0 ? laws->temperature : NAN;
    other.answers = &at->answers;
    if (kind == EHL_LAW_VISCOSITY)
        other.viscosity = numerics_viscosity_make(&at->viscosity, service, T, &at->answers);
    else if (kind == EHL_LAW_DENSITY)
        other.density = numerics_density_make(&at->density, service, T, &at->answers);
    else
        other.rheology = ehl_rheology_make(&at->rheology, service, &at->answers);
    return other;
}

static void print_reason(const ehl_conditions *s, ehl_law_kind kind, const conditions *at,
                         const effect *e, const effect *than, const difference *d, char *out,
                         size_t size)
{
    char what[160];
    if (kind == EHL_LAW_VISCOSITY)
        snprintf(what, sizeof what,
                 "Moes M %.2g to %.2g, L %.2g: %s; eta up to exp(%.2g) of eta0, by the reference "
                 "exp(%.2g)",
                 s->M_low, s->M_high, s->L_high, s->regime, e->ln_eta_rise, than->ln_eta_rise);
    else if (kind == EHL_LAW_DENSITY)
        snprintf(what, sizeof what, "denser by %.2g %% at %.2g GPa, by the reference %.2g %%",
                 100 * (e->denser - 1), 1e-9 * at->highest, 100 * (than->denser - 1));
    else
        snprintf(what, sizeof what, "shear stress up to %.3g MPa, by the reference %.3g MPa",
                 1e-6 * e->stress, 1e-6 * than->stress);
    snprintf(out, size, "%s; moves the film by %+.2g %%, the friction by %+.2g %%", what,
             100 * d->film_moves, 100 * d->friction_moves);
}

ff_status ehl_judge_law(const ff_host *host, const ehl_history *h, const ehl_laws *laws,
                        ehl_law_kind kind, const void *service, ehl_error_targets w, char *reason,
                        size_t size, ff_assessment *a)
{
    ehl_isothermal at = {.answers = {.status = FF_OK}};
    const ehl_laws other = replace_law(laws, kind, service, &at);
    conditions s = {.history = h};
    ehl_conditions all;
    ehl_oil oil;
    effect e, than;
    pick_instants(&s);
    ff_status status = ehl_fluid_oil(laws, &oil) < 0 ? FF_INVALID : FF_OK;
    if (status == FF_OK)
        status = ehl_conditions_read(h, laws, &oil, NULL, NULL, &all);
    if (status == FF_OK && s.count > 0)
        status = find_effect(&s, laws, &than);
    if (status == FF_OK && s.count > 0)
        status = find_effect(&s, &other, &e);
    if (at.answers.status != FF_OK)
        return ff_failf(host, FF_UNSUPPORTED, NULL, "%s", at.answers.text);
    if (status != FF_OK || s.count == 0)
        return ff_failf(host, status == FF_OK ? FF_UNSUPPORTED : status, NULL,
                        "the inlet of the contact has no film to compare the laws by");
    difference d = compare(&e, &than, s.count);
    print_reason(&all, kind, &s, &e, &than, &d, reason, size);
    a->applies = e.continued && !than.continued ? FF_APPLIES_NOT : FF_APPLIES;
    a->error = estimate_error(&s, kind, &d, than.ln_eta_rise, w);
    a->reason = reason;
    return FF_OK;
}

ff_status ehl_judge_rough(const ff_host *host)
{
    return ff_failf(host, FF_UNSUPPORTED, NULL,
                    "rough flanks: nothing is known beforehand of the pressures at the asperities, "
                    "by which the laws would have to be compared");
}
