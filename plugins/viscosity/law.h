/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the viscosity laws of this folder: the wired oil, or the viscosity eta0 at ambient
   pressure; and the pressure cap. Each law adds ln(eta/eta0) as a function of pressure. */
#ifndef VISCOSITY_LAW_H
#define VISCOSITY_LAW_H

#include <flankfilm/author.h>
#include <flankfilm/laws.h>
#include <flankfilm/simd.h>

/* The viscosity at ambient pressure, and the pressure cap. */
typedef struct viscosity_oil {
    double eta0;             /* Pa s; NaN: not given */
    double pressure_cap;     /* Pa; NaN: auto, until viscosity_oil_ready sets it */
    const ff_liquid *liquid; /* NULL: not wired, and eta0 is given */
    double ln_eta0;          /* set by viscosity_oil_ready; 0 if a liquid gives ln(eta0) as a
                                function of T */
} viscosity_oil;

/* First members of every law's instance. */
typedef struct viscosity_law {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
} viscosity_law;

/* The only input of every law, and its `wire` function. */
extern const ff_port viscosity_inputs[1];
ff_status viscosity_wire(void *self, uint32_t input, const void *service);

/* The first parameters of every law. */
#define VISCOSITY_OIL_ROWS(type)                                                                   \
    FF_QUANTITY_UNLESS("oil", "eta0", "Pa s", type, oil.eta0, FF_REQUIRED | FF_MIN_OPEN, NULL,     \
                       NULL, 0, 1e6, 1e-4, 100,                                                    \
                       "dynamic viscosity at ambient pressure, for a contact without an oil"),     \
        FF_QUANTITY_OR("auto", "pressure_cap", "GPa", type, oil.pressure_cap, 0, "auto", NULL,     \
                       1e-3, 100, 0, 0,                                                            \
                       "pressure above which ln(eta) continues linearly; auto: 10 GPa, or less "   \
                       "if the law requires it")

/* The cap of a law that does not require a lower one, Pa. */
static const double viscosity_highest_cap = 10e9;
/* Sets ln_eta0, and the cap if it is auto. */
void viscosity_oil_ready(viscosity_oil *oil, double auto_cap);

/* For a law without its own pressure coefficient: refuses the law unless a wired liquid gives this
   coefficient. `other` names an alternative in the message, " or z", or is "". */
ff_status viscosity_alpha_ready(const ff_host *host, const viscosity_oil *oil, const char *other);

/* Returns the pressure at which the law is evaluated. Above the cap, ln(eta) continues along its
   tangent. */
FF_SIMD_INLINE double viscosity_clip(double p, double cap)
{
    p = p > 0 ? p : 0;
    return p < cap ? p : cap;
}

/* ln(eta) at n points with one ln(eta0), and its slope over p; the arrays do not overlap. */
typedef void viscosity_curve(const void *law, double ln_eta0, size_t n, const double *p,
                             double *ln_eta, double *dln_dp);
/* Evaluates a curve; dln_dp may be NULL. */
void viscosity_points(viscosity_curve *curve, const void *law, double ln_eta0, size_t n,
                      const double *p, double *ln_eta, double *dln_dp);
/* `eval` for a law whose ln(eta/eta0) depends on pressure only. */
ff_status viscosity_eval(const viscosity_law *law, viscosity_curve *curve, size_t n,
                         const double *p, const double *T, double *ln_eta, double *dln_dp,
                         double *dln_dT);

/* ln(eta0) at ambient pressure for the points of one eval. */
typedef struct viscosity_ambient {
    double ln_eta0, slope; /* ln(eta0) and its slope over T; both 0 if T differs between points */
    int varies;            /* T differs between points; viscosity_oil_end then adds ln_eta0 */
    ff_status status;
} viscosity_ambient;

viscosity_ambient viscosity_oil_begin(const viscosity_oil *oil, size_t n, const double *T);

/* Ends an eval in which ln(eta/eta0) did not depend on temperature, or all points had the same
   temperature. Adds ln_eta0 if it varies between points, and fills in dln_dT, which may be NULL.
   Returns FF_DOMAIN if a pressure was above the cap or the liquid was extrapolated. */
ff_status viscosity_oil_end(const viscosity_oil *oil, const viscosity_ambient *ambient, size_t n,
                            const double *p, const double *T, double *ln_eta, double *dln_dT);

/* The temperature range of laws whose ln(eta/eta0) depends on temperature. Outside it, ln(eta/eta0)
   is constant. */
static const double viscosity_coldest = 150, viscosity_hottest = 700; /* K */

FF_SIMD_INLINE double viscosity_temperature(double T)
{
    T = T > viscosity_coldest ? T : viscosity_coldest;
    return T < viscosity_hottest ? T : viscosity_hottest;
}

/* Parameter row of these laws: the temperature for which the constants are given; NaN: not
   given. */
#define VISCOSITY_AT_ROW(type, member)                                                             \
    FF_QUANTITY_OR("auto", "at", "degC", type, member, 0, "auto", NULL, -150, 500, -20, 150,       \
                   "temperature for which the constants of the law are given; auto: they hold at " \
                   "every temperature; required if the law has slopes over temperature")
/* Refuses the temperature slope `slope` of the row `name` if `at` is not given. Replaces an unset
   `at` by a number. */
ff_status viscosity_at_ready(const ff_host *host, double *at, double slope, const char *name);

/* ln(eta/eta0) at n points, and its slopes over p and T; the arrays do not overlap. Returns
 * whether any point was outside the range of the law. */
typedef int64_t viscosity_rise(const void *law, size_t n, const double *p, const double *T,
                               double *rise, double *by_p, double *by_T);
/* `eval` for a law whose ln(eta/eta0) depends on temperature. It handles differing temperatures and
   dln_dT. If T is NULL, it uses the temperature of the liquid, or `at`. */
ff_status viscosity_eval_rise(const viscosity_law *law, viscosity_rise *rise, double at, size_t n,
                              const double *p, const double *T, double *ln_eta, double *dln_dp,
                              double *dln_dT);
/* Returns the one temperature that viscosity_eval_rise uses for all points. */
double viscosity_one_temperature(const viscosity_law *law, double at, const double *T);

/* A pressure coefficient given as a parameter; if alpha is NaN, that of the liquid is used. */
typedef struct viscosity_alpha {
    double alpha, slope, at; /* alpha in 1/Pa; slope of ln(alpha) over T, 1/K; `at` in K */
} viscosity_alpha;

#define VISCOSITY_ALPHA_SLOPE_ROW(type, member)                                                    \
    FF_QUANTITY("alpha_slope", "1/K", type, member, 0, "0 1/K", NULL, -0.1, 0.1, -0.015, 0,        \
                "change of ln(alpha) per kelvin above the temperature `at`")

/* Evaluates alpha at n <= NUMERICS_POINTS points, and its slope over T. */
ff_status viscosity_alpha_values(const viscosity_alpha *own, const ff_liquid *liquid, size_t n,
                                 const double *T, double *alpha, double *slope);

#endif
