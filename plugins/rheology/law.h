/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the rheology laws: the limiting shear stress; and bounds that keep the laws finite, far
   outside anything physical. */
#ifndef RHEOLOGY_LAW_H
#define RHEOLOGY_LAW_H

#include <flankfilm/author.h>
#include <flankfilm/laws.h>
#include <flankfilm/simd.h>

#include <math.h>

/* The last parameter of every law, a member of its instance; NaN: no limit. */
#define RHEOLOGY_LIMITING_STRESS_ROW(type)                                                         \
    FF_QUANTITY("limiting_stress_coefficient", "1", type, limiting_stress_coefficient,             \
                FF_MIN_OPEN, NULL, NULL, 0, 10, 0.01, 0.15,                                        \
                "limiting shear stress over pressure; left out: no limit")

/* Literature of the limiting shear stress. */
#define RHEOLOGY_LIMITING_STRESS_REFERENCE                                                         \
    "limiting stress: Bair & Winer 1979, J. Lubrication Technology 101, 258-264"

enum { RHEOLOGY_LN_MAX = 690 };                /* e^690 = 1e299.7 */
static const double RHEOLOGY_FILM_MIN = 1e-30; /* m */

/* Returns the fluidity 1/eta, clamped to e^-690 to e^690 1/(Pa s). */
FF_SIMD_INLINE double rheology_fluidity(double ln_eta)
{
    double x = ln_eta > -RHEOLOGY_LN_MAX ? ln_eta : -RHEOLOGY_LN_MAX;
    return ff_exp(-(x < RHEOLOGY_LN_MAX ? x : RHEOLOGY_LN_MAX));
}

/* Returns the film thickness, at least RHEOLOGY_FILM_MIN. */
FF_SIMD_INLINE double rheology_film(double h)
{
    return h > RHEOLOGY_FILM_MIN ? h : RHEOLOGY_FILM_MIN;
}

/* Minimum of the limiting stress, Pa: the value of a PAO at ambient pressure. A limit proportional
   to p alone would cut off the Newtonian stress in the inlet. */
static const double RHEOLOGY_LIMIT_LEAST = 4e6;

/* Limiting shear stress of Bair & Winer 1979: clips the stress at tau_L = coefficient p, but not
   below `least`. */
FF_SIMD_INLINE double rheology_limited(double tau, double p, double coefficient, double least)
{
    double limit = coefficient * p, most = limit > least ? limit : least;
    double cut = tau < most ? tau : most;
    return coefficient > 0 ? cut : tau;
}

/* Bounds of flankfilm.rheology/2. Inside them stresses and viscosities follow the law, up to the
   rate RHEOLOGY_RATE_MAX; above it the rate continues along its tangent, which stays finite. */
static const double RHEOLOGY_TAU_MAX = 1e100;      /* Pa */
static const double RHEOLOGY_LN_ETA_MIN = -200;    /* lower bound of ln(eta), eta in Pa s */
static const double RHEOLOGY_RATE_MAX = 1e30;      /* 1/s */
static const double RHEOLOGY_STRESS_LEAST = 1e-30; /* lower bound of tau0 and G, Pa */

/* A coefficient of a limiting stress; `on` is 0 if there is none, otherwise 1. */
typedef struct rheology_limit {
    double on, coefficient;
} rheology_limit;

static inline rheology_limit rheology_limit_of(double coefficient)
{
    return coefficient > 0 ? (rheology_limit){1, coefficient} : (rheology_limit){0, 1};
}

/* Returns the slip rate that the limiting stress tau_L adds: 1e7 1/s, typical of films, at 1 %
   above tau_L; it grows with the square of the excess. */
FF_SIMD_INLINE double rheology_slip(double size, double p, rheology_limit limiting, double *slope)
{
    const double least = RHEOLOGY_LIMIT_LEAST, steep = 1e7 / (0.01 * 0.01), far = 1e9;
    double limit = limiting.coefficient * p;
    limit = limit > least ? limit : least;
    double excess = size / limit - 1;
    excess = excess > 0 ? excess : 0;
    double near = excess < far ? excess : far;
    *slope = limiting.on * 2 * steep * near / limit;
    return limiting.on * steep * near * (near + 2 * (excess - near));
}

/* Rates at n points and their derivatives; the arrays do not overlap. Returns whether any was
 * clamped. */
typedef int64_t rheology_rate(const void *law, size_t n, const double *p, const double *ln_eta,
                              const double *tau, double *rate, double *by_tau, double *by_ln_eta);
/* Evaluates rates; derivatives may be NULL. FF_DOMAIN if any rate was clamped. */
ff_status rheology_rates(rheology_rate *curve, const void *law, size_t n, const double *p,
                         const double *ln_eta, const double *tau, double *rate, double *by_tau,
                         double *by_ln_eta);

/* The stress at which shear thinning begins, if it is `auto`: tau_E = 2 Lambda/alpha, where alpha =
   ln(eta/eta0)/p is the secant of the wired viscosity law, and Lambda the ratio of limiting stress
   to pressure. */
typedef struct rheology_eyring {
    const ff_viscosity *viscosity; /* NULL: not wired */
    const ff_liquid *oil;          /* NULL: not wired */
    double coefficient;            /* Lambda; set by rheology_eyring_ready */
} rheology_eyring;

/* The inputs of laws with this stress, and their `wire` function. */
enum { RHEOLOGY_IN_VISCOSITY, RHEOLOGY_IN_OIL, RHEOLOGY_INPUTS };
extern const ff_port rheology_inputs[RHEOLOGY_INPUTS];
ff_status rheology_eyring_wire(rheology_eyring *e, uint32_t input, const void *service);

/* Refuses `name: auto` without a viscosity law, or without Lambda, which is `given` or follows
 * from the base of the oil. Stores Lambda in e->coefficient. */
ff_status rheology_eyring_ready(const ff_host *host, rheology_eyring *e, const char *name,
                                double given);

/* Evaluates tau_E at n <= RHEOLOGY_BLOCK points, and its slope over p. */
enum { RHEOLOGY_BLOCK = 256 };
ff_status rheology_eyring_stress(const rheology_eyring *e, size_t n, const double *p,
                                 const double *T, double *stress, double *by_p);

/* `flow` of rheology/3, in blocks. `stresses` gives the stress of the law at each point and its
   slope over p. `some` replaces that slope by the slope of psi, and returns whether any point was
   clamped; its by_ln_eta and by_h are never NULL. */
typedef ff_status rheology_stresses(const void *law, size_t n, const double *p, const double *T,
                                    double *stress, double *by_p);
typedef int64_t rheology_some(const void *law, double u_s, size_t n, const double *stress,
                              const double *ln_eta, const double *h, double *psi, double *by_p,
                              double *by_ln_eta, double *by_h);
ff_status rheology_flow_at(rheology_stresses *stresses, rheology_some *some, const void *law,
                           size_t n, const double *p, const double *T, const double *ln_eta,
                           const double *h, double u_s, double *psi, double *dpsi_dp,
                           double *dpsi_dln_eta, double *dpsi_dh);

/* Implements `flow` of rheology/1 by the `flow` of rheology/3. The caller gives no pressure, so the
   stress at ambient pressure is used; the result is FF_DOMAIN if the stress varies with pressure
   (`moves`). */
typedef ff_status rheology_flow_3(const void *self, size_t n, const double *p, const double *T,
                                  const double *ln_eta, const double *h, double u_s, double *psi,
                                  double *by_p, double *by_ln_eta, double *by_h);
ff_status rheology_ambient_flow(const void *self, rheology_flow_3 *flow, int moves, size_t n,
                                const double *ln_eta, const double *h, double u_s, double *psi,
                                double *by_ln_eta, double *by_h);

/* Outputs and functions of laws that offer all three services. The instance has the members
   `service`, `service_2`, `service_3` and `host`. */
enum { RHEOLOGY_OUTPUTS = 3 };
extern const ff_port rheology_outputs[RHEOLOGY_OUTPUTS];
#define RHEOLOGY_3_LAW(law, type, flow, shear, rate, flow_3, shear_3, ...)                         \
    static ff_status law##_create(const ff_host *host, void **self)                                \
    {                                                                                              \
        type *ff_self = calloc(1, sizeof *ff_self);                                                \
        if (!ff_self)                                                                              \
            return FF_NOMEM;                                                                       \
        ff_self->host = host;                                                                      \
        ff_self->service = (ff_rheology){sizeof(ff_rheology), ff_self, flow, shear};               \
        ff_self->service_2 = (ff_rheology_2){sizeof(ff_rheology_2), ff_self, rate};                \
        ff_self->service_3 = (ff_rheology_3){sizeof(ff_rheology_3), ff_self, flow_3, shear_3};     \
        *self = ff_self;                                                                           \
        return FF_OK;                                                                              \
    }                                                                                              \
    static const void *law##_service(void *self, uint32_t row)                                     \
    {                                                                                              \
        type *ff_self = self;                                                                      \
        const void *const tables[] = {&ff_self->service, &ff_self->service_2,                      \
                                      &ff_self->service_3};                                        \
        return row < RHEOLOGY_OUTPUTS ? tables[row] : NULL;                                        \
    }                                                                                              \
    static ff_status law##_wire(void *self, uint32_t input, const void *service)                   \
    {                                                                                              \
        return rheology_eyring_wire(&((type *)self)->eyring, input, service);                      \
    }                                                                                              \
    const ff_model law = {FF_HEAD(type, law##_create),                                             \
                          .inputs = FF_TABLE(rheology_inputs),                                     \
                          .outputs = FF_TABLE(rheology_outputs),                                   \
                          .wire = law##_wire,                                                      \
                          .service = law##_service,                                                \
                          .destroy = free,                                                         \
                          __VA_ARGS__}

/* psi at n points and its derivatives; the arrays do not overlap. Returns whether any point was
 * clamped. */
typedef int64_t rheology_curve(const void *law, size_t n, const double *ln_eta, const double *h,
                               double slip, double *psi, double *by_ln_eta, double *by_h);
/* Evaluates a curve; derivatives may be NULL. */
int64_t rheology_points(rheology_curve *curve, const void *law, size_t n, const double *ln_eta,
                        const double *h, double slip, double *psi, double *by_ln_eta, double *by_h);

#endif
