/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "liquid.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdbool.h>

/* Combines two statuses: FF_DOMAIN wins over FF_OK, and any other status wins over both. */
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
        host->quality(host->ctx, "law_range", 1, 0, FF_RANGE,
                      "1 if an oil law was extrapolated outside its range");
}

static int are_numbers(size_t n, const double *ln_eta, const double *h, double u_s)
{
    int good = isfinite(u_s) && numerics_are_finite(n, ln_eta) && numerics_are_finite(n, h);
    for (size_t i = 0; i < n && good; i++)
        good = h[i] > 0;
    return good;
}

/* Records a result that is not finite although the arguments were. */
static ff_status hold_flow(const ehl_rheology_at *at, ff_status status, size_t n,
                           const double *ln_eta, const double *h, double u_s,
                           const double *const value[4])
{
    int worst = 0;
    for (int k = 3; k >= 0; k--)
        worst = value[k] && !numerics_are_finite(n, value[k]) ? k + 1 : worst;
    if ((status == FF_OK || status == FF_DOMAIN) && (!worst || !are_numbers(n, ln_eta, h, u_s)))
        return status;
    return numerics_answer_note(at->answers,
                                &(numerics_answer){"rheology", "psi", status, n, NULL, value[0],
                                                   worst > 1 ? value[worst - 1] : NULL});
}

static ff_status ambient_flow(const void *self, size_t n, const double *ln_eta, const double *h,
                              double u_s, double *psi, double *psi_l, double *psi_h)
{
    const ehl_rheology_at *at = self;
    ff_status status = at->law->flow(at->law->self, n, ln_eta, h, u_s, psi, psi_l, psi_h);
    return hold_flow(at, status, n, ln_eta, h, u_s,
                     (const double *const[]){psi, psi_l, psi_h, NULL});
}

static ff_status ambient_shear(const void *self, size_t n, const double *p, const double *ln_eta,
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

static double *from(double *values, size_t i)
{
    return values ? values + i : NULL;
}

static ff_status flow(const void *self, size_t n, const double *p, const double *T,
                      const double *ln_eta, const double *h, double u_s, double *psi, double *psi_p,
                      double *psi_l, double *psi_h)
{
    const ehl_rheology_at *at = self;
    const ff_rheology_3 *law = at->at_pressure;
    if (!law) {
        for (size_t i = 0; psi_p && i < n; i++)
            psi_p[i] = 0;
        return ambient_flow(self, n, ln_eta, h, u_s, psi, psi_l, psi_h);
    }
    ff_status worst = FF_OK;
    for (size_t i = 0; i < n && worst >= 0; i += NUMERICS_POINTS) {
        size_t count = n - i < NUMERICS_POINTS ? n - i : NUMERICS_POINTS;
        worst =
            worse(worst, law->flow(law->self, count, p + i, T ? T + i : at->T, ln_eta + i, h + i,
                                   u_s, psi + i, from(psi_p, i), from(psi_l, i), from(psi_h, i)));
    }
    return hold_flow(at, worst, n, ln_eta, h, u_s,
                     (const double *const[]){psi, psi_l, psi_h, psi_p});
}

static ff_status shear(const void *self, size_t n, const double *p, const double *T,
                       const double *ln_eta, const double *h, double u_s, double *tau)
{
    const ehl_rheology_at *at = self;
    const ff_rheology_3 *law = at->at_pressure;
    if (!law)
        return ambient_shear(self, n, p, ln_eta, h, u_s, tau);
    ff_status worst = FF_OK;
    for (size_t i = 0; i < n && worst >= 0; i += NUMERICS_POINTS) {
        size_t count = n - i < NUMERICS_POINTS ? n - i : NUMERICS_POINTS;
        worst = worse(worst, law->shear(law->self, count, p + i, T ? T + i : at->T, ln_eta + i,
                                        h + i, u_s, tau + i));
    }
    if ((worst == FF_OK || worst == FF_DOMAIN) &&
        (numerics_are_finite(n, tau) || !are_numbers(n, ln_eta, h, u_s)))
        return worst;
    return numerics_answer_note(at->answers,
                                &(numerics_answer){"rheology", "tau", worst, n, p, tau, NULL});
}

void ehl_rheology_make(ehl_rheology_at *at, const ehl_laws *wired, const double *T, ehl_laws *to)
{
    *at = (ehl_rheology_at){.service = {sizeof at->service, at, flow, shear},
                            .ambient = {sizeof at->ambient, at, ambient_flow, ambient_shear},
                            .law = wired->rheology_ambient,
                            .at_pressure = wired->rheology,
                            .T = T,
                            .answers = to->answers};
    to->rheology = at->law || at->at_pressure ? &at->service : NULL;
    to->rheology_ambient = at->law ? &at->ambient : NULL;
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
        .answers = &at->answers,
    };
    ehl_rheology_make(&at->rheology, &at->wired, isnan(T) ? NULL : at->viscosity.T, laws);
    if (!oil[0].data)
        return FF_OK;
    laws->temperature = T;
    ff_status status = numerics_hold_viscosity(host, laws->viscosity, oil[1].data, T);
    if (status == FF_OK)
        status = numerics_hold_density(host, laws->density, oil[2].data, T);
    return numerics_answers_end(&at->answers, host, status);
}

void ehl_laws_move(ehl_isothermal *at, ehl_laws *laws, double T)
{
    laws->temperature = T;
    for (size_t i = 0; i < NUMERICS_POINTS; i++)
        at->viscosity.T[i] = at->density.T[i] = T;
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
        return worse(status, laws->rheology->flow(laws->rheology->self, n, p, NULL, q->ln_eta, h,
                                                  sliding, q->psi, q->psi_p, q->psi_l, q->psi_h));
    for (size_t i = 0; i < n; i++) { /* psi becomes 0 where eta overflows */
        q->psi[i] = exp(-q->ln_eta[i]);
        q->psi_l[i] = -q->psi[i];
        q->psi_h[i] = q->psi_p[i] = 0;
    }
    return status;
}

ff_status ehl_fluid_shear(const ehl_laws *laws, size_t n, const double *p, const double *T,
                          const double *h, double sliding, double *ln_eta, double *tau)
{
    ff_status status = laws->viscosity->eval(laws->viscosity->self, n, p, T, ln_eta, NULL, NULL);
    if (laws->rheology)
        return worse(status,
                     laws->rheology->shear(laws->rheology->self, n, p, T, ln_eta, h, sliding, tau));
    for (size_t i = 0; i < n; i++) /* tau is bounded, so that the sum stays finite */
        tau[i] = exp(fmin(ln_eta[i], 230)) * sliding / h[i];
    return status;
}

double ehl_fluidity_integral(double step, double left, double right)
{
    double fall = right - left;
    double mean = fabs(fall) > 1e-6 ? -expm1(-fall) / fall : 1 - fall / 2;
    return step * exp(-left) * mean;
}

/* Bound on the number of integration steps. In each step ln(eta) rises by a twentieth, up to a
   total of 40. For a law whose slopes do not agree with its values, the integration would otherwise
   never end. */
enum { MOST_STEPS = 100000 };

static void blame_slope(numerics_answers *answers, const char *wire, const char *value,
                        double slope, const char *unit, double p)
{
    if (!answers || answers->status != FF_OK)
        return;
    answers->status = FF_BUG;
    answers->wire = wire;
    snprintf(answers->text, sizeof answers->text,
             "%s does not agree with its slope, which is %.4g %s/GPa at %.4g GPa", value,
             1e9 * slope, unit, 1e-9 * p);
}

/* Returns false after too many steps, and records a fault of the law. */
static bool is_bounded(const ehl_laws *laws, size_t steps, double p, double slope)
{
    if (steps < MOST_STEPS)
        return true;
    blame_slope(laws->answers, "viscosity", "ln_eta", slope, "1", p);
    return false;
}

/* Signature of a law: ln_eta or rho over pressure. */
typedef ff_status over_pressure(const void *self, size_t n, const double *p, const double *T,
                                double *value, double *by_p, double *by_T);

/* Returns a pressure up to `highest` at which the slope given by the law differs by a factor of ten
   or more from the slope of its values, and sets *slope to the given slope. Returns 0 if there is
   none. Differences too small to affect a film are ignored. */
static double find_false_slope(over_pressure *eval, const void *self, double highest, double *slope)
{
    enum { PLACES = 64 };
    const double beside = 1e-6 * highest, felt = 1e-12, far = 10;
    for (int k = 1; k <= PLACES; k++) {
        double p = highest * k / PLACES, at[] = {p - beside, p, p + beside}, value[3], slopes[3];
        if (eval(self, 3, at, NULL, value, slopes, NULL) < 0)
            return 0;
        double rise = (value[2] - value[0]) / (2 * beside), said = slopes[1];
        double least = felt * fmax(1, fabs(value[1]));
        if (fabs(said - rise) > (far - 1) * fmin(fabs(said), fabs(rise)) + least) {
            *slope = said;
            return p;
        }
    }
    return 0;
}

void ehl_laws_hold_slopes(const ehl_laws *laws, double highest)
{
    const ff_viscosity *v = laws->viscosity;
    const ff_density *d = laws->density;
    double slope, p = find_false_slope(v->eval, v->self, highest, &slope);
    if (p > 0)
        blame_slope(laws->answers, "viscosity", "ln_eta", slope, "1", p);
    p = d ? find_false_slope(d->eval, d->self, highest, &slope) : 0;
    if (p > 0)
        blame_slope(laws->answers, "density", "rho", slope, "kg/m3", p);
}

/* The integral of eta0/eta, with whole steps (coarse) and with half steps (fine). */
typedef struct fluidity {
    double p, slope; /* end of the integration so far, Pa, and the slope of ln(eta) there, 1/Pa */
    double rise;     /* rise of ln(eta) up to there */
    double coarse, fine;
} fluidity;

enum { BLOCK = 8 }; /* steps per evaluation of the law */

/* Adds a block of equal steps. A step is a rise of ln(eta) by a twentieth, estimated from the slope
   at the start of the block. */
static void integrate_block(fluidity *sum, const ff_viscosity *v, double ln_eta0, double highest)
{
    double at[2 * BLOCK], ln_eta[2 * BLOCK], slopes[2 * BLOCK];
    double step =
        fmin(fmin(0.05 / fmax(sum->slope, 1e-12), 2e6 + sum->p / 20), (highest - sum->p) / BLOCK);
    for (size_t i = 0; i < 2 * BLOCK; i++) {
        at[i] = sum->p + (double)(i + 1) * step / 2;
        ln_eta[i] = NAN;
    }
    v->eval(v->self, 2 * BLOCK, at, NULL, ln_eta, slopes, NULL);
    for (size_t i = 0; i < 2 * BLOCK; i += 2) {
        double middle = ln_eta[i] - ln_eta0, end = ln_eta[i + 1] - ln_eta0;
        sum->coarse += ehl_fluidity_integral(step, sum->rise, end);
        sum->fine += ehl_fluidity_integral(step / 2, sum->rise, middle) +
                     ehl_fluidity_integral(step / 2, middle, end);
        sum->rise = end;
    }
    sum->p = at[2 * BLOCK - 1];
    sum->slope = slopes[2 * BLOCK - 1];
}

/* Integrates eta0/eta for alpha*. A step is exact where ln(eta) is linear. The error of the half
   steps, a third of the difference between whole and half steps, is subtracted. After a rise of
   ln(eta) by 40, less than 1e-17 of the integral remains. */
ehl_film_coefficient ehl_alpha_star(const ehl_laws *laws)
{
    const ff_viscosity *v = laws->viscosity;
    const double highest = 1e11;
    double ln_eta0 = NAN;
    fluidity sum = {.p = 0};
    v->eval(v->self, 1, &sum.p, NULL, &ln_eta0, &sum.slope, NULL);
    for (size_t steps = 0; sum.p < highest * (1 - 1e-12) && sum.rise < 40 && isfinite(sum.rise) &&
                           is_bounded(laws, steps, sum.p, sum.slope);
         steps += BLOCK)
        integrate_block(&sum, v, ln_eta0, highest);
    if (!(sum.rise >= 40))
        return (ehl_film_coefficient){0, 0};
    double whole = sum.fine + (sum.fine - sum.coarse) / 3;
    return (ehl_film_coefficient){1 / whole, fabs(sum.fine - sum.coarse) / 3 / whole};
}

ff_status ehl_put_alpha_star(const ff_host *host, uint32_t output, ehl_film_coefficient alpha)
{
    const double limit = 1e-3;
    host->quality(host->ctx, "alpha_star_error", alpha.error, limit,
                  alpha.error <= limit ? FF_GOOD : FF_DOUBTFUL,
                  "relative error of alpha_star: quadrature with whole steps compared with half "
                  "steps");
    return ff_put_scalar(host, output, alpha.value);
}
