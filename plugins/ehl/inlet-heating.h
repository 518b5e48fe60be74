/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film that is lost as shear heats the oil in the inlet; the models are isothermal. */
#ifndef EHL_INLET_HEATING_H
#define EHL_INLET_HEATING_H

#include "fluid.h"
#include "history.h"

typedef struct ehl_inlet_heating {
    double conductivity; /* of the oil, W/(m K) */
    double slope;        /* -d ln eta/dT, 1/K; 0: that of the law, or 0.03 where it has none */
} ehl_inlet_heating;

/* Film with over film without heating: Q = eta0 beta u^2/k, S = |u1 - u2|/u. 0 where the fit has
   left its range so far that it turns negative. */
double ehl_gupta_factor(double p_hertz, double modulus, double Q, double S);

/* The quality line: the greatest share of the film that is lost at any loaded instant. */
void ehl_inlet_heating_report(const ff_host *host, const ehl_inlet_heating *heating,
                              const ehl_history *h, const ehl_laws *laws, const ehl_oil *oil);

#endif
