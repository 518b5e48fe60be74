/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "inlet-heating.h"

#include <math.h>
#include <stdio.h>

static const double usual_slope = 0.03; /* 1/K: gear oils 0.045 at 40 C, 0.02 at 100 C */
static const double most_lost = 0.1;

/* Gupta, Cheng, Zhu, Forster and Schrand 1992, a fit to thermal solutions. */
double ehl_gupta_factor(double p_hertz, double modulus, double Q, double S)
{
    double q = fmin(Q, 1e30), s = fmin(S, 1e30);
    double factor = (1 - 13.2 * p_hertz / modulus * pow(q, 0.42)) /
                    (1 + 0.213 * (1 + 2.23 * pow(s, 0.83)) * pow(q, 0.64));
    return fmax(factor, 0);
}

/* -d ln eta/dT at p = 0. */
static double slope_of(const ehl_inlet_heating *heating, const ehl_laws *laws)
{
    double p = 0, ln_eta = 0, ln_eta_T = 0;
    if (heating->slope > 0)
        return heating->slope;
    if (laws->viscosity->eval(laws->viscosity->self, 1, &p, NULL, &ln_eta, NULL, &ln_eta_T) < 0 ||
        !(ln_eta_T < 0))
        return usual_slope;
    return -ln_eta_T;
}

void ehl_inlet_heating_report(const ff_host *host, const ehl_inlet_heating *heating,
                              const ehl_history *h, const ehl_laws *laws, const ehl_oil *oil)
{
    const double slope = slope_of(heating, laws);
    double lost = 0;
    char text[256];
    for (size_t i = 0; i < h->count; i++) {
        ehl_instant at = ehl_history_row(h, i);
        if (ehl_is_lost(h, at.load) || !(at.entrainment > 0))
            continue;
        double p_hertz = sqrt(at.load * h->modulus / (2 * M_PI * at.radius));
        double Q = oil->viscosity * slope * at.entrainment * at.entrainment / heating->conductivity;
        double factor = ehl_gupta_factor(p_hertz, h->modulus, Q, fabs(at.sliding) / at.entrainment);
        lost = fmax(lost, 1 - factor);
    }
    snprintf(
        text, sizeof text,
        "largest share of the film that shear heating in the inlet would take off, which is not in "
        "the results (Gupta's factor; -d ln eta/dT %.3g 1/K, oil %.3g W/(m K))",
        slope, heating->conductivity);
    host->quality(host->ctx, "inlet_heating", lost, most_lost,
                  lost <= most_lost ? FF_GOOD : FF_DOUBTFUL, text);
}
