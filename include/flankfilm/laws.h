/* SPDX-License-Identifier: MIT */
/*
 * Services of liquids and surfaces: the properties of a liquid as functions of temperature, its
 * laws of viscosity, density and flow, and the asperity pressure of rough flanks. All functions
 * take n points at once and are pure: any thread may call them. Arrays never overlap. All results
 * are finite for all finite arguments, unless stated otherwise. A function returns FF_OK, or
 * FF_DOMAIN if a point lies outside the range of the law and the law was extrapolated.
 */
#ifndef FLANKFILM_LAWS_H
#define FLANKFILM_LAWS_H

#include "plugin.h"

/*
 * Service "flankfilm.liquid/1": properties of a liquid at ambient pressure as functions of
 * temperature. It does not depend on any law.
 */
#define FF_LIQUID_ID "flankfilm.liquid/1"

/* Properties of a liquid; later versions may add more. */
enum {
    FF_LIQUID_LN_ETA0 = 0,              /* ln(viscosity / 1 Pa s) */
    FF_LIQUID_RHO0 = 1,                 /* density, kg/m3 */
    FF_LIQUID_CONDUCTIVITY = 2,         /* W/(m K) */
    FF_LIQUID_HEAT_CAPACITY = 3,        /* J/(kg K) */
    FF_LIQUID_PRESSURE_COEFFICIENT = 4, /* dln(eta)/dp at ambient pressure, 1/Pa */
    FF_LIQUID_REFERENCE_TEMPERATURE =
        5, /* K, the same for every T: a temperature at which the properties are given */
    FF_LIQUID_BASE = 6, /* since 1.3: FF_BASE_..., the same at every T */
    FF_LIQUID_BASE_COEFFICIENT =
        7, /* since 1.3: pressure coefficient of an ISO VG 100 oil with this base, 1/Pa */
    /* Since 1.3: the conductivity at gauge pressure p is (1 + c1 p/(1 + c2 p)) times its ambient
       value. RISE is c1, BEND is c2, both in 1/Pa. */
    FF_LIQUID_CONDUCTIVITY_RISE = 8,
    FF_LIQUID_CONDUCTIVITY_BEND = 9
};

/* Base oils, which have different correlations and laws; later versions may add more. */
enum { FF_BASE_MINERAL = 0, FF_BASE_PAO = 1, FF_BASE_ESTER = 2, FF_BASE_PAG = 3 };

typedef struct ff_liquid {
    size_t size;
    const void *self;
    /*
     * property  FF_LIQUID_...; FF_UNSUPPORTED if this liquid does not have it
     * n         number of points
     * T         temperature, K, n
     * value     n; NaN: the data of this liquid do not give the property
     * slope     d(value)/dT, n, may be NULL
     */
    ff_status (*eval)(const void *self, int32_t property, size_t n, const double *T, double *value,
                      double *slope);
} ff_liquid;

/*
 * Service "flankfilm.viscosity/1": dynamic viscosity of a liquid.
 *
 * The law gives ln(eta / 1 Pa s), which cannot overflow or underflow when eta would.
 */
#define FF_VISCOSITY_ID "flankfilm.viscosity/1"

typedef struct ff_viscosity {
    size_t size;
    const void *self;
    /*
     * n        number of points
     * p        gauge pressure, Pa, n; below 0 the law continues along its tangent at 0
     * T        temperature, K, n; NULL: the reference temperature of the law
     * ln_eta   n;  dln_dp  1/Pa, n, may be NULL;  dln_dT  1/K, n, may be NULL
     */
    ff_status (*eval)(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT);
} ff_viscosity;

/* Service "flankfilm.density/1": mass density of a liquid. */
#define FF_DENSITY_ID "flankfilm.density/1"

typedef struct ff_density {
    size_t size;
    const void *self;
    /*
     * n        number of points
     * p        gauge pressure, Pa, n; below 0 the law continues along its tangent at 0
     * T        temperature, K, n; NULL: the reference temperature of the law
     * rho      kg/m3, n, > 0;  drho_dp  kg/(m3 Pa), n, may be NULL
     * drho_dT  kg/(m3 K), n, may be NULL
     */
    ff_status (*eval)(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT);
} ff_density;

/*
 * Service "flankfilm.rheology/1": the effect of shear on the flow in a thin film.
 *
 * `flow` gives the fluidity psi, 1/(Pa s), for the pressure flow: the flow factor of the Reynolds
 * equation is f = rho h^3 psi / 12. A Newtonian liquid has psi = 1/eta. Ree-Eyring has psi =
 * sqrt(1/eta^2 + (u_s/(tau0 h))^2), which equals cosh(asinh(eta u_s/(tau0 h)))/eta but cannot
 * overflow. `shear` gives the mean shear stress of the film, with the sign of u_s.
 */
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
     */
    ff_status (*shear)(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau);
} ff_rheology;

/*
 * Service "flankfilm.rheology/2": the shear rate at a point of the film as a function of the shear
 * stress there. A solver that resolves the flow across the film integrates this rate. A law offers
 * it in addition to /1.
 */
#define FF_RHEOLOGY_2_ID "flankfilm.rheology/2"

typedef struct ff_rheology_2 {
    size_t size;
    const void *self;
    /*
     * n               number of points
     * p               Pa, n;  T  K, n, or NULL: the reference temperature of the law
     * ln_eta          ln(eta / 1 Pa s) of the liquid without shear, n
     * tau             shear stress, Pa, n, of any sign
     * rate            1/s, n, with the sign of tau, increasing with tau
     * drate_dtau      1/(Pa s), n, may be NULL;  drate_dln_eta  1/s, n, may be NULL
     *
     * A rate that would overflow is continued along its tangent, with FF_DOMAIN.
     */
    ff_status (*rate)(const void *self, size_t n, const double *p, const double *T,
                      const double *ln_eta, const double *tau, double *rate, double *drate_dtau,
                      double *drate_dln_eta);
} ff_rheology_2;

/*
 * Service "flankfilm.rheology/3": like /1, for laws whose characteristic stresses depend on
 * pressure and temperature, such as an Eyring stress 2 Lambda/alpha(p, T). A film solver uses /3 if
 * the law offers it, otherwise /1. A law offers it in addition to /1.
 */
#define FF_RHEOLOGY_3_ID "flankfilm.rheology/3"

/* Since 1.3. */
typedef struct ff_rheology_3 {
    size_t size;
    const void *self;
    /*
     * n        number of points
     * p        Pa, n;  T  K, n, or NULL: the reference temperature of the law
     * ln_eta   ln(eta / 1 Pa s), n;  h  film thickness, m, n, > 0;  u_s  sliding speed u1-u2, m/s
     * psi      fluidity for the pressure flow, 1/(Pa s), n
     * dpsi_dp  1/(Pa2 s), n, at fixed ln_eta, may be NULL
     * dpsi_dln_eta  1/(Pa s), n, may be NULL;  dpsi_dh  1/(Pa s m), n, may be NULL
     */
    ff_status (*flow)(const void *self, size_t n, const double *p, const double *T,
                      const double *ln_eta, const double *h, double u_s, double *psi,
                      double *dpsi_dp, double *dpsi_dln_eta, double *dpsi_dh);
    /* Mean shear stress of the film, Pa, n, with the sign of u_s; arguments as for `flow`. */
    ff_status (*shear)(const void *self, size_t n, const double *p, const double *T,
                       const double *ln_eta, const double *h, double u_s, double *tau);
} ff_rheology_3;

/*
 * Service "flankfilm.asperity/1": the mean asperity pressure of two rough flanks as a function of
 * the distance between the mean planes of their heights.
 */
#define FF_ASPERITY_ID "flankfilm.asperity/1"

/* Since 1.3. */
typedef struct ff_asperity {
    size_t size;
    const void *self;
    double sigma; /* rms of the combined heights of both flanks, m, > 0 */
    /*
     * n        number of points
     * h        distance of the mean planes, m, n, of any sign
     * p_a      Pa, n, >= 0, decreases with h;  dp_a_dh  Pa/m, n, <= 0, may be NULL
     */
    ff_status (*pressure)(const void *self, size_t n, const double *h, double *p_a,
                          double *dp_a_dh);
    /* Reduced modulus E' of the flanks for which p_a is given, Pa, > 0; p_a is purely elastic. A
       caller with another reduced modulus scales p_a in proportion to it, and limits it by the
       hardness. */
    double modulus;
} ff_asperity;

#endif
