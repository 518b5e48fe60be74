/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.rheology/1": how shear changes the flow in a thin film.
 *
 * `flow` gives the fluidity psi (1/(Pa s)) that the pressure flow sees: the flow factor of the
 * Reynolds equation is f = rho h^3 psi / 12. A Newtonian liquid has psi = 1/eta; Ree-Eyring has
 * psi = sqrt(1/eta^2 + (u_s/(tau0 h))^2), which equals cosh(asinh(eta u_s/(tau0 h)))/eta and
 * cannot overflow. `shear` gives the mean shear stress of the film, with the sign of u_s.
 */
#ifndef FLANKFILM_RHEOLOGY_H
#define FLANKFILM_RHEOLOGY_H

#include "plugin.h"

#define FF_RHEOLOGY_ID "flankfilm.rheology/1"

typedef struct ff_rheology {
    size_t size;
    const void *self;
    /*
     * n        number of points
     * ln_eta   ln(eta / 1 Pa s), n;  h  film thickness, m, n, > 0;  u_s  sliding speed u1-u2, m/s
     * psi      1/(Pa s), n;  dpsi_dln_eta  n, may be NULL;  dpsi_dh  1/(Pa s m), n, may be NULL
     */
    ff_status (*flow)(const void *self, size_t n, const double *ln_eta, const double *h, double u_s,
                      double *psi, double *dpsi_dln_eta, double *dpsi_dh);
    /*
     * p        Pa, n (for laws with a limiting stress); ln_eta, h, u_s as above
     * tau      Pa, n
     *
     * Both: results are finite for every legal argument. FF_OK, or FF_DOMAIN when a point lies
     * outside the law's range and was continued. Pure; any thread. Arrays never overlap.
     */
    ff_status (*shear)(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau);
} ff_rheology;

#endif
