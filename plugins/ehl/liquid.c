/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "liquid.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdbool.h>

/* Of FF_OK and FF_DOMAIN the latter, of others the first. */
static ff_status worse(ff_status a, ff_status b)
{
    return a == FF_OK || (a == FF_DOMAIN && b != FF_OK) ? b : a;
}

void ehl_law_note(ehl_law_answer *worst, ff_status status)
{
    if (status != FF_OK)
        *worst = EHL_LAW_CONTINUED;
}

void ehl_law_report(const ff_host *host, ehl_law_answer worst)
{
    if (worst == EHL_LAW_CONTINUED)
        host->quality(host->ctx, "law_range", 1, 0, FF_DOUBTFUL,
                      "an oil law was continued outside its range");
}

static int are_numbers(size_t n, const double *ln_eta, const double *h, double u_s)
{
    int good = isfinite(u_s) && numerics_are_finite(n, ln_eta) && numerics_are_finite(n, h);
    for (size_t i = 0; i < n && good; i++)
        good = h[i] > 0;
    return good;
}

static ff_status flow(const void *self, size_t n, const double *ln_eta, const double *h, double u_s,
                      double *psi, double *psi_l, double *psi_h)
{
    const ehl_rheology_at *at = self;
    ff_status status = at->law->flow(at->law->self, n, ln_eta, h, u_s, psi, psi_l, psi_h);
    int finite = numerics_are_finite(n, psi) && (!psi_l || numerics_are_finite(n, psi_l)) &&
                 (!psi_h || numerics_are_finite(n, psi_h));
    if ((status == FF_OK || status == FF_DOMAIN) && finite)
        return status;
    if ((status == FF_OK || status == FF_DOMAIN) && !are_numbers(n, ln_eta, h, u_s))
        return status;
    const double *slopes = psi_l && !numerics_are_finite(n, psi_l) ? psi_l : psi_h;
    return numerics_answer_note(
        at->answers, &(numerics_answer){"rheology", "psi", status, n, NULL, psi, slopes});
}

static ff_status shear(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau)
{
    const ehl_rheology_at *at = self;
    ff_status status = at->law->shear(at->law->self, n, p, ln_eta, h, u_s, tau);
    if ((status == FF_OK || status == FF_DOMAIN) &&
        (numerics_are_finite(n, tau) || !are_numbers(n, ln_eta, h, u_s)))
        return status;
    return numerics_answer_note(at->answers,
                                &(numerics_answer){"rheology", "tau", status, n, p, tau, NULL});
}

const ff_rheology *ehl_rheology_make(ehl_rheology_at *at, const ff_rheology *law,
                                     numerics_answers *answers)
{
    *at = (ehl_rheology_at){
        .service = {sizeof at->service, at, flow, shear}, .law = law, .answers = answers};
    return law ? &at->service : NULL;
}

int ehl_laws_failed(const ehl_laws *laws)
{
    return laws->answers && laws->answers->status != FF_OK;
}

ff_status ehl_laws_at(ehl_isothermal *at, const ff_host *host, const ff_array *oil, ehl_laws *laws)
{
    if (!at->wired.viscosity)
        at->wired = *laws;
    double T = oil[0].data ? *oil[0].data : NAN;
    at->answers.status = FF_OK;
    *laws = (ehl_laws){
        .viscosity = numerics_viscosity_make(&at->viscosity, at->wired.viscosity, T, &at->answers),
        .density = numerics_density_make(&at->density, at->wired.density, T, &at->answers),
        .rheology = ehl_rheology_make(&at->rheology, at->wired.rheology, &at->answers),
        .answers = &at->answers,
    };
    if (!oil[0].data)
        return FF_OK;
    laws->temperature = T;
    ff_status status = numerics_hold_viscosity(host, laws->viscosity, oil[1].data, T);
    if (status == FF_OK)
        status = numerics_hold_density(host, laws->density, oil[2].data, T);
    return numerics_answers_end(&at->answers, host, status);
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

/* Of an integration by steps of a twentieth in ln(eta) up to a rise of 40, which would go on for
   ever where the values of a law do not follow its slopes. */
enum { MOST_STEPS = 100000 };

/* False when there were too many steps, which is noted as a fault of the law. */
static bool is_bounded(const ehl_laws *laws, size_t steps, double p, double slope)
{
    numerics_answers *answers = laws->answers;
    if (steps < MOST_STEPS)
        return true;
    if (answers && answers->status == FF_OK) {
        answers->status = FF_BUG;
        answers->wire = "viscosity";
        snprintf(answers->text, sizeof answers->text,
                 "ln_eta does not follow its slope, which is %.4g 1/GPa at %.4g GPa", 1e9 * slope,
                 1e-9 * p);
    }
    return false;
}

/* Steps of a twentieth in ln(eta) up to a rise of 40; from there on the tangent. */
double ehl_oil_alpha(const ehl_laws *laws, const ehl_oil *oil)
{
    const ff_viscosity *v = laws->viscosity;
    const double highest = 1e11;
    double p = 0, ln_eta = oil->ln_viscosity, slope = oil->alpha, sum = 0;
    size_t steps = 0;
    while (p < highest && ln_eta - oil->ln_viscosity < 40 && is_bounded(laws, steps++, p, slope)) {
        double dp = fmin(fmin(0.05 / fmax(slope, 1e-12), 2e7 + p / 20), highest - p);
        double next = p + dp, ln_next;
        v->eval(v->self, 1, &next, NULL, &ln_next, &slope, NULL);
        sum += ehl_fluidity_integral(dp, ln_eta - oil->ln_viscosity, ln_next - oil->ln_viscosity);
        p = next;
        ln_eta = ln_next;
    }
    return p < highest ? 1 / sum : 0;
}

static double ln_eta_at(const ff_viscosity *law, double p, double *slope)
{
    double ln_eta = NAN;
    law->eval(law->self, 1, &p, NULL, &ln_eta, slope, NULL);
    return ln_eta;
}

/* An integral by whole steps and by halves, both exact where ln(eta) is linear. */
typedef struct integral {
    double coarse, fine, rise; /* rise: ln(eta/eta0) that it got to */
} integral;

/* Steps of a twentieth in ln(eta) up to a rise of 40, beyond which less than 1e-17 is left. */
static integral integrate_fluidity(const ehl_laws *laws)
{
    const ff_viscosity *law = laws->viscosity;
    const double highest = 1e11;
    size_t steps = 0;
    double p = 0, slope = 0, before = ln_eta_at(law, 0, &slope), ln_eta0 = before;
    integral sum = {0, 0, 0};
    while (p < highest && sum.rise < 40 && isfinite(before) &&
           is_bounded(laws, steps++, p, slope)) {
        double dp = fmin(fmin(0.05 / fmax(slope, 1e-12), 2e6 + p / 20), highest - p);
        double middle = ln_eta_at(law, p + dp / 2, NULL), after = ln_eta_at(law, p + dp, &slope);
        sum.coarse += ehl_fluidity_integral(dp, before - ln_eta0, after - ln_eta0);
        sum.fine += ehl_fluidity_integral(dp / 2, before - ln_eta0, middle - ln_eta0) +
                    ehl_fluidity_integral(dp / 2, middle - ln_eta0, after - ln_eta0);
        p += dp;
        before = after;
        sum.rise = after - ln_eta0;
    }
    return sum;
}

ff_status ehl_put_alpha_star(const ff_host *host, uint32_t output, const ehl_laws *laws)
{
    const integral sum = integrate_fluidity(laws);
    bool rises = sum.rise >= 40;
    /* the error of halves is a third of their difference from the whole, which is taken off */
    double error = fabs(sum.fine - sum.coarse) / 3, whole = sum.fine + (sum.fine - sum.coarse) / 3;
    host->quality(host->ctx, "alpha_star_error", rises ? error / whole : 0, 1e-3,
                  !rises || error <= 1e-3 * whole ? FF_GOOD : FF_DOUBTFUL,
                  "of alpha_star, relative: quadrature by whole steps against halves");
    return ff_put_scalar(host, output, rises ? 1 / whole : 0);
}
