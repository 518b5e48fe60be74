/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the film at each instant by a formula for steady contacts. */
#include "formula.h"

#include "estimate.h"
#include "inlet.h"
#include "references.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct power_law {
    double factor, G, U, W;
} power_law;

static double law(power_law c, ehl_contact_numbers n)
{
    return c.factor * pow(n.G, c.G) * pow(n.U, c.U) * pow(n.W, c.W);
}

/* The formulas. Minimum film: Dowson & Higginson 1977, Elasto-hydrodynamic Lubrication, from Dowson
   1968, Proc. IMechE 182 3A. Central film: Dowson & Toyoda 1978, Proc. 5th Leeds-Lyon Symp. Minimum
   and central film: Pan & Hamrock 1989, J. Tribol. 111. */
static const power_law dowson_higginson = {2.65, 0.54, 0.7, -0.13};
static const power_law dowson_toyoda = {3.06, 0.56, 0.69, -0.10};
static const power_law pan_hamrock_least = {1.714, 0.568, 0.694, -0.128};
static const power_law pan_hamrock_central = {2.922, 0.470, 0.692, -0.166};

/* M = W (2U)^-1/2, L = G (2U)^1/4, H = (h/R)(2U)^-1/2 (Moes 2000, Lubrication and beyond). */
static double moes(ehl_contact_numbers n)
{
    double M = n.W / sqrt(2 * n.U), L = fmax(n.G * pow(2 * n.U, 0.25), 1e-6);
    double ri = 3 / M, ei = 2.621 * pow(M, -0.2);
    double rp = 1.287 * pow(L, 2. / 3), ep = 1.311 * pow(M, -0.125) * pow(L, 0.75);
    double s = (7 + 8 * exp(-2 * ei / ri)) / 5;
    double iso = pow(pow(ri, 7. / 3) + pow(ei, 7. / 3), 3 * s / 7);
    double piezo = pow(pow(rp, -3.5) + pow(ep, -3.5), -2 * s / 7);
    return sqrt(2 * n.U) * pow(iso + piezo, 1 / s);
}

ehl_film_numbers ehl_film_formula(int formula, ehl_contact_numbers n)
{
    switch (formula) {
    case EHL_DOWSON_HIGGINSON:
        return (ehl_film_numbers){law(dowson_higginson, n), law(dowson_toyoda, n)};
    case EHL_DOWSON_TOYODA:
        return (ehl_film_numbers){0, law(dowson_toyoda, n)};
    case EHL_PAN_HAMROCK:
        return (ehl_film_numbers){law(pan_hamrock_least, n), law(pan_hamrock_central, n)};
    default:
        return (ehl_film_numbers){0, moes(n)};
    }
}

typedef struct film_formula {
    ehl_estimate e;
    int32_t formula, pressure_coefficient; /* indices of the words */
    double *density;  /* density at p_max of every instant, over that at ambient pressure */
    double h_central; /* central film of the latest instant, m */
    ehl_inlet *inlet; /* heated inlet; NULL: thermal is none */
} film_formula;

/* Range of the full solutions from which the scatter was determined (with Roelands' law and
   compressibility, or with Barus' law without compressibility), and the scatter of h_min and
   h_central. */
typedef struct range {
    double M_low, M_high, L_low, L_high, least, central;
} range;

static const range ranges[] = {
    [EHL_MOES] = {2, 500, 0, 15, 0.10, 0.16},
    [EHL_DOWSON_HIGGINSON] = {5, 200, 5, 15, 0.11, 0.30},
    [EHL_DOWSON_TOYODA] = {5, 200, 5, 15, 0.30, 0.30},
    [EHL_PAN_HAMROCK] = {5, 200, 5, 15, 0.17, 0.40},
};

static int inside(const film_formula *f, const ehl_moment *m)
{
    const range *r = &ranges[f->formula];
    return m->moes_M >= r->M_low && m->moes_M <= r->M_high && m->moes_L >= r->L_low &&
           m->moes_L <= r->L_high;
}

/* Fills the tables of the heated inlet. */
static ff_status begin_heat(film_formula *f)
{
    ehl_estimate *e = &f->e;
    double highest = 0;
    f->inlet = malloc(sizeof *f->inlet);
    if (!f->inlet)
        return FF_NOMEM;
    for (size_t k = 0; k < e->count; k++) {
        const ehl_instant *at = &e->moment[k].at;
        highest = fmax(highest, ehl_hertz_pressure(at->load, at->radius, e->history.modulus));
    }
    ff_status status =
        ehl_inlet_fill(f->inlet, &e->laws, &e->oil, e->alpha, e->conductivity, highest);
    ehl_law_note(&e->answered, status);
    return status < 0 ? ff_failf(e->host, FF_INVALID, NULL, "an oil law fails under pressure")
                      : FF_OK;
}

/* Returns the film with a heated inlet over that without heat, both from the inlet analysis. */
static double heat_factor(const film_formula *f, const ehl_instant *at)
{
    const ehl_estimate *e = &f->e;
    ehl_inlet *n = f->inlet;
    double guess = ehl_estimate_moes(e, at), modulus = e->history.modulus, off;
    if (!(at->entrainment > 0))
        return 1;
    double heated = ehl_inlet_mass(n, at, at->entrainment, modulus, guess, &off);
    n->conductivity = 0;
    double cold = ehl_inlet_mass(n, at, at->entrainment, modulus, guess, &off);
    n->conductivity = e->conductivity;
    return heated / cold;
}

static ff_status begin(ehl_estimate *e)
{
    film_formula *f = (film_formula *)e;
    double alpha = f->pressure_coefficient ? e->oil.alpha : e->alpha;
    if (f->formula != EHL_MOES && !(alpha > 0))
        return ff_failf(e->host, FF_INVALID, "formula",
                        "this formula needs a viscosity that increases with pressure, but this "
                        "one does not: use formula: moes");
    f->density = malloc(2 * e->count * sizeof *f->density);
    if (!f->density)
        return FF_NOMEM;
    double *p = f->density + e->count;
    for (size_t k = 0; k < e->count; k++)
        p[k] = e->moment[k].p_max;
    const ff_density *law = e->laws.density;
    ehl_law_note(&e->answered, law->eval(law->self, e->count, p, NULL, f->density, NULL, NULL));
    for (size_t k = 0; k < e->count; k++)
        f->density[k] /= e->oil.density;
    return e->conductivity > 0 ? begin_heat(f) : FF_OK;
}

static void film(ehl_estimate *e, size_t k, ehl_estimate_film *out)
{
    film_formula *f = (film_formula *)e;
    const ehl_moment *m = &e->moment[k];
    const ehl_instant *at = &m->at;
    double modulus = e->history.modulus, alpha = f->pressure_coefficient ? e->oil.alpha : e->alpha;
    double size = modulus * at->radius;
    ehl_contact_numbers n = {
        .U = fmax(e->oil.viscosity * at->entrainment / size, 1e-30),
        .W = at->load / size,
        .G = alpha * modulus,
    };
    ehl_film_numbers h = ehl_film_formula(f->formula, n);
    if (f->formula == EHL_MOES)
        h.central /= f->density[k];
    if (!(h.least > 0))
        h.least = ehl_exit_ratio(alpha, m->p_max) * h.central * f->density[k];
    double radius = at->radius * (f->inlet ? heat_factor(f, at) : 1);
    f->h_central = radius * h.central + at->gap;
    out->h_central = f->h_central;
    out->h_min = radius * h.least + at->gap;
    out->error = (inside(f, m) ? ranges[f->formula].least : 1) * out->h_min;
}

static void profile(const ehl_estimate *e, size_t k, size_t n, const double *x, double *h)
{
    (void)k;
    (void)x;
    for (size_t i = 0; i < n; i++)
        h[i] = ((const film_formula *)e)->h_central;
}

/* Returns the largest change of ln(load) in one passage 2 a/u. */
static double unsteadiness(const ehl_estimate *e)
{
    double worst = 0;
    for (size_t k = 1; k < e->count; k++) {
        const ehl_moment *m = &e->moment[k], *b = m - 1;
        if (m->begins)
            continue;
        double passage = 2 * m->a / fmax(m->at.entrainment, 1e-300);
        double dt = fmax(m->at.time - b->at.time, passage / 100);
        worst = fmax(worst, fabs(log(m->at.load / b->at.load)) * passage / dt);
    }
    return worst;
}

static void report(const ehl_estimate *e)
{
    const film_formula *f = (const film_formula *)e;
    const ff_host *host = e->host;
    double outside = 0;
    for (size_t k = 0; k < e->count; k++)
        outside += !inside(f, &e->moment[k]);
    outside /= (double)e->count;
    host->quality(host->ctx, "outside_range", outside, 0, outside > 0 ? FF_RANGE : FF_GOOD,
                  f->formula == EHL_MOES
                      ? "share of the instants outside M 2 to 500, L 0 to 15"
                      : "share of the instants outside M 5 to 200, L 5 to 15, where the formula "
                        "is valid");
    const range *r = &ranges[f->formula];
    host->quality(host->ctx, "h_min_scatter", r->least, 0, FF_GOOD,
                  "largest relative difference of h_min from full solutions within this range");
    host->quality(host->ctx, "h_central_scatter", r->central, 0, FF_GOOD,
                  f->formula == EHL_MOES
                      ? "largest relative difference of h_central from full solutions within this "
                        "range: 0.08 with L > 0, 0.16 if the viscosity does not increase with "
                        "pressure and M is below 10"
                      : "largest relative difference of h_central from full solutions within this "
                        "range");
    double change = unsteadiness(e);
    host->quality(host->ctx, "unsteadiness", change, 0.2, change > 0.2 ? FF_RANGE : FF_GOOD,
                  "largest change of ln(load) in one passage 2 a/u; above 0.2 the real film lags "
                  "behind the formula: use ehl/inlet-analysis or ehl/finite-volume");
    host->quality(host->ctx, "status", 0, 0, FF_GOOD,
                  "the formula for a steady film is used at every instant; no equation is solved");
}

static void end(ehl_estimate *e)
{
    film_formula *f = (film_formula *)e;
    free(f->density);
    free(f->inlet);
    f->density = NULL;
    f->inlet = NULL;
}

static ff_status create(const ff_host *host, void **self)
{
    film_formula *f = calloc(1, sizeof *f);
    if (!f)
        return FF_NOMEM;
    f->e.host = host;
    f->e.begin = begin;
    f->e.film = film;
    f->e.profile = profile;
    f->e.report = report;
    f->e.end = end;
    *self = f;
    return FF_OK;
}

static const ff_param params[] = {
    EHL_ESTIMATE_PARAMS,
    FF_ONE_OF(
        "moes|dowson-higginson|dowson-toyoda|pan-hamrock", "formula", film_formula, formula, 0,
        "moes",
        "film formula. moes: all regimes; the other formulas: heavily loaded contacts, elastic and "
        "piezoviscous. If a formula gives only one of h_min and h_central, the other follows from "
        "another formula of its authors or from a ratio"),
    FF_ONE_OF("asymptotic|ambient", "pressure_coefficient", film_formula, pressure_coefficient, 0,
              "asymptotic",
              "pressure coefficient in the formula. asymptotic: alpha* = 1/int eta0/eta dp, for "
              "which different laws agree best; ambient: slope of ln(eta) at p = 0"),
};

const ff_model ehl_film_formula_model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 3,
    .id = "ehl/film-formula",
    .version = "1.0.0",
    .summary = "film thickness of a smooth line contact from a formula for steady films, at every "
               "instant; very fast, but neglects transients",
    .reference = "Moes 2000, Lubrication and Beyond, University of Twente; Dowson & Higginson "
                 "1977, Elasto-hydrodynamic Lubrication; Dowson & Toyoda 1978, Proc. 5th "
                 "Leeds-Lyon Symp., 60-65; Pan & Hamrock 1989, J. Tribol. 111, 246-251",
    .bibtex = BIB_moes2000 "\n" BIB_dowson1977 "\n" BIB_dowson1978 "\n" BIB_pan1989 "\n",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .self_size = sizeof(film_formula),
    .inputs = ehl_estimate_inputs,
    .input_count = EHL_ESTIMATE_INPUTS,
    .input_stride = sizeof ehl_estimate_inputs[0],
    .outputs = ehl_estimate_outputs,
    .output_count = EHL_ESTIMATE_OUTPUTS,
    .output_stride = sizeof ehl_estimate_outputs[0],
    .create = create,
    .wire = ehl_estimate_wire,
    .ready = ehl_estimate_ready,
    .evaluate = ehl_estimate_evaluate,
    .destroy = free,
    .cost = 4e-4,
};
