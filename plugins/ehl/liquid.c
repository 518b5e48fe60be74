/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "liquid.h"

#include <math.h>

static ehl_law_answer answer_of(ff_status status)
{
    return status == FF_OK       ? EHL_LAW_GOOD
           : status == FF_DOMAIN ? EHL_LAW_CONTINUED
                                 : EHL_LAW_FAILED;
}

static ff_status worse(ff_status a, ff_status b)
{
    return answer_of(b) > answer_of(a) ? b : a;
}

void ehl_law_note(ehl_law_answer *worst, ff_status status)
{
    if (answer_of(status) > *worst)
        *worst = answer_of(status);
}

void ehl_law_report(const ff_host *host, ehl_law_answer worst)
{
    if (worst == EHL_LAW_CONTINUED)
        host->quality(host->ctx, "law_range", 1, 0, FF_DOUBTFUL,
                      "an oil law was continued outside its range");
    if (worst == EHL_LAW_FAILED)
        host->quality(host->ctx, "law_range", 1, 0, FF_BAD,
                      "an oil law failed at a point of the film: its numbers there mean nothing");
}

ff_status ehl_laws_at(ehl_isothermal *at, const ff_host *host, const ff_array *oil, ehl_laws *laws)
{
    if (!at->wired.viscosity)
        at->wired = *laws;
    *laws = at->wired;
    if (!oil[0].data)
        return FF_OK;
    double T = *oil[0].data;
    ff_status status = numerics_hold_viscosity(host, laws->viscosity, oil[1].data, T);
    if (status == FF_OK)
        status = numerics_hold_density(host, laws->density, oil[2].data, T);
    laws->viscosity = numerics_viscosity_make(&at->viscosity, laws->viscosity, T);
    laws->density = numerics_density_make(&at->density, laws->density, T);
    laws->temperature = T;
    return status;
}

ff_status ehl_fluid_oil(const ehl_laws *laws, ehl_oil *oil)
{
    double p = 0;
    ff_status a = laws->viscosity->eval(laws->viscosity->self, 1, &p, NULL, &oil->ln_viscosity,
                                        &oil->alpha, NULL);
    ff_status b = laws->density->eval(laws->density->self, 1, &p, NULL, &oil->density, NULL, NULL);
    oil->viscosity = exp(oil->ln_viscosity);
    return worse(a, b);
}

ff_status ehl_fluid_evaluate(const ehl_laws *laws, size_t n, const double *p, const double *h,
                             double sliding, const ehl_liquid *q)
{
    ff_status status = worse(
        laws->viscosity->eval(laws->viscosity->self, n, p, NULL, q->ln_eta, q->ln_eta_p, NULL),
        laws->density->eval(laws->density->self, n, p, NULL, q->rho, q->rho_p, NULL));
    if (laws->rheology)
        return worse(status, laws->rheology->flow(laws->rheology->self, n, q->ln_eta, h, sliding,
                                                  q->psi, q->psi_l, q->psi_h));
    for (size_t i = 0; i < n; i++) { /* underflows to 0 where eta overflows */
        q->psi[i] = exp(-q->ln_eta[i]);
        q->psi_l[i] = -q->psi[i];
        q->psi_h[i] = 0;
    }
    return status;
}

ff_status ehl_fluid_shear(const ehl_laws *laws, size_t n, const double *p, const double *h,
                          double sliding, double *ln_eta, double *tau)
{
    ff_status status = laws->viscosity->eval(laws->viscosity->self, n, p, NULL, ln_eta, NULL, NULL);
    if (laws->rheology)
        return worse(status,
                     laws->rheology->shear(laws->rheology->self, n, p, ln_eta, h, sliding, tau));
    for (size_t i = 0; i < n; i++) /* bounded so that the sum stays finite */
        tau[i] = exp(fmin(ln_eta[i], 230)) * sliding / h[i];
    return status;
}

double ehl_fluidity_integral(double step, double left, double right)
{
    double fall = right - left;
    double mean = fabs(fall) > 1e-6 ? -expm1(-fall) / fall : 1 - fall / 2;
    return step * exp(-left) * mean;
}

/* Rows of a tenth in ln(eta) up to a rise of 40; from there on the tangent. */
double ehl_oil_alpha(const ehl_laws *laws, const ehl_oil *oil)
{
    const ff_viscosity *v = laws->viscosity;
    const double highest = 1e11;
    double p = 0, ln_eta = oil->ln_viscosity, slope = oil->alpha, sum = 0;
    while (p < highest && ln_eta - oil->ln_viscosity < 40) {
        double dp = fmin(fmin(0.05 / fmax(slope, 1e-12), 2e7 + p / 20), highest - p);
        double next = p + dp, ln_next;
        v->eval(v->self, 1, &next, NULL, &ln_next, &slope, NULL);
        sum += ehl_fluidity_integral(dp, ln_eta - oil->ln_viscosity, ln_next - oil->ln_viscosity);
        p = next;
        ln_eta = ln_next;
    }
    return p < highest ? 1 / sum : 0;
}
