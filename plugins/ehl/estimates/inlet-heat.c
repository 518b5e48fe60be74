/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "inlet-heat.h"

#include "channel-table.h"

#include <flankfilm/author.h>

#include <math.h>

/* Computes Lagrange's factors of four equidistant points, the second of which is at t = 0. */
static void cubic(double t, double c[4])
{
    double a = t + 1, b = t - 1, d = t - 2;
    c[0] = -t * b * d / 6;
    c[1] = a * b * d / 2;
    c[2] = -a * t * d / 2;
    c[3] = a * t * b / 6;
}

/* Returns the index of the first of the four points around `place`, and sets t to the distance of
   `place` from the second. */
static int first_of_four(double place, double *t)
{
    double inside = fmin(place, EHL_HEAT_TABLE - 1);
    int i = (int)inside - 1;
    i = i < 0 ? 0 : i > EHL_HEAT_TABLE - 4 ? EHL_HEAT_TABLE - 4 : i;
    *t = inside - (i + 1);
    return i;
}

double ehl_heat_ratio(double F, double S)
{
    double across[4], along[4], t, s, sum = 0;
    int i = first_of_four(log1p(F) / EHL_HEAT_STEP, &t);
    int j = first_of_four(log1p(S) / EHL_HEAT_STEP, &s);
    cubic(t, across);
    cubic(s, along);
    for (int k = 0; k < 4; k++) {
        const double *row = &ln_R[i + k][j];
        sum += across[k] *
               (along[0] * row[0] + along[1] * row[1] + along[2] * row[2] + along[3] * row[3]);
    }
    return exp(sum);
}

/* Returns whether the oil is Newtonian within 1 % at all n points, so that tau = eta u_s/h. */
static int is_newtonian(size_t n, const double *ln_eta, const double *psi)
{
    const double thinned = 1.01;
    int plain = 1;
    for (size_t i = 0; i < n; i++)
        plain &= psi[i] * exp(ln_eta[i]) < thinned;
    return plain;
}

/* Checks that the laws depend on temperature. With a law that gives the same viscosity at T and T +
   10 K, heat would have no effect on the film. */
static void hold_temperature(const ff_host *host, const ehl_laws *laws)
{
    const double T[] = {laws->temperature, laws->temperature + 10}, p[] = {0, 0};
    double ln_eta[2];
    if (laws->viscosity->eval(laws->viscosity->self, 2, p, T, ln_eta, NULL, NULL) >= 0 &&
        !(fabs(ln_eta[1] - ln_eta[0]) > 0))
        host->quality(host->ctx, "isothermal_law", 1, 0, FF_RANGE,
                      "the viscosity law gives the same value at every temperature: heat has no "
                      "effect");
}

ff_status ehl_heat_conductivity(const ff_host *host, const ff_liquid *liquid, const ehl_laws *laws,
                                double *conductivity)
{
    double T = laws->temperature, ln_eta = NAN, slope = NAN;
    *conductivity = NAN;
    if (!liquid || !(T > 0))
        return ff_failf(host, FF_INVALID, "thermal",
                        "a heated film needs the oil as a function of temperature: add a stage "
                        "with lubricant/grade or lubricant/measured, and wire it as oil");
    liquid->eval(liquid->self, FF_LIQUID_LN_ETA0, 1, &T, &ln_eta, &slope);
    if (!isfinite(slope))
        return ff_failf(host, FF_INVALID, "thermal",
                        "the viscosity of the oil is known at one temperature only: give it at two "
                        "temperatures or more in the oil stage, or use thermal: none");
    ff_status status =
        liquid->eval(liquid->self, FF_LIQUID_CONDUCTIVITY, 1, &T, conductivity, NULL);
    if (status < 0 || !(*conductivity > 0 && isfinite(*conductivity)))
        return ff_failf(host, FF_INVALID, "thermal",
                        "the conductivity of the oil is not known at %g degC: give conductivity or "
                        "base to the oil stage",
                        T - 273.15);
    hold_temperature(host, laws);
    return FF_OK;
}

ehl_conductivity_rise ehl_heat_conductivity_rise(const ff_liquid *liquid, double T)
{
    double c[2] = {NAN, NAN};
    for (int32_t k = 0; k < 2; k++)
        if (liquid->eval(liquid->self, FF_LIQUID_CONDUCTIVITY_RISE + k, 1, &T, &c[k], NULL) < 0 ||
            !(c[k] >= 0 && isfinite(c[k])))
            return (ehl_conductivity_rise){0, 0};
    return (ehl_conductivity_rise){c[0], c[1]};
}

ff_status ehl_inlet_ratio(const ehl_laws *laws, const ehl_heated *film, size_t n, const double *p,
                          const double *h, const double *mass, double *room, double *ratio,
                          double *most)
{
    const ff_viscosity *v = laws->viscosity;
    double *ln_eta = room, *slope = room + n, *psi = room + 2 * n, *tau = room + 3 * n,
           *unused = room + 4 * n;
    ff_status worst = v->eval(v->self, n, p, NULL, ln_eta, unused, slope), status;
    for (size_t i = 0; !laws->rheology && i < n; i++)
        psi[i] = exp(-ln_eta[i]);
    if (laws->rheology) {
        status = laws->rheology->flow(laws->rheology->self, n, p, NULL, ln_eta, h, film->sliding,
                                      psi, NULL, unused, tau);
        worst = numerics_worse(worst, status);
    }
    if (laws->rheology && !is_newtonian(n, ln_eta, psi)) {
        status =
            laws->rheology->shear(laws->rheology->self, n, p, NULL, ln_eta, h, film->sliding, tau);
        worst = numerics_worse(worst, status);
    } else {
        for (size_t i = 0; i < n; i++)
            tau[i] = film->sliding / (psi[i] * h[i]);
    }
    for (size_t i = 0; i < n; i++) {
        double per = fmax(-slope[i], 0) / film->conductivity;
        double speed = film->entrainment * (1 - film->middle / mass[i]);
        double F = per * speed * speed / psi[i], S = per * tau[i] * film->sliding * h[i];
        *most = fmax(*most, fmax(F, S));
        ratio[i] = ehl_heat_ratio(F, S);
    }
    return worst;
}
