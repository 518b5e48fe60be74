/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fluid.h"

#include <math.h>

static ff_status worse(ff_status a, ff_status b)
{
    return a < 0 ? a : b < 0 ? b : a != FF_OK ? a : b;
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
