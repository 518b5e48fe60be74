/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Evaluates laws at the temperature of a wired oil, for stages with a single temperature. */
#ifndef NUMERICS_ISOTHERMAL_H
#define NUMERICS_ISOTHERMAL_H

#include "answers.h"
#include "liquid.h"

#include <flankfilm/author.h>

/* The input rows oil.temperature, oil.eta0 and oil.rho0, in this order, for a stage that calls laws
   and compares them with the oil. A stage that calls no density law omits the last row. */
#define NUMERICS_OIL_ROWS                                                                          \
    {.name = "oil.temperature",                                                                    \
     .unit = "K",                                                                                  \
     .doc = "temperature of the oil, at which the laws are evaluated",                             \
     .dims = "",                                                                                   \
     .flags = FF_OPTIONAL,                                                                         \
     .from = "lubricant"},                                                                         \
    {                                                                                              \
        .name = "oil.eta0", .unit = "Pa s",                                                        \
        .doc = "viscosity of the oil, with which the viscosity law is compared", .dims = "",       \
        .flags = FF_OPTIONAL, .from = "lubricant"                                                  \
    }
#define NUMERICS_OIL_DENSITY_ROW                                                                   \
    {                                                                                              \
        .name = "oil.rho0", .unit = "kg/m3",                                                       \
        .doc = "density of the oil, with which the density law is compared", .dims = "",           \
        .flags = FF_OPTIONAL, .from = "lubricant"                                                  \
    }

/* A viscosity law that is evaluated at T if its caller passes no temperature. Wrong results of the
   law are stored in `answers`. */
typedef struct numerics_viscosity_at {
    ff_viscosity service;
    const ff_viscosity *law;
    double T[NUMERICS_POINTS]; /* all equal; NaN: the reference temperature of the law */
    numerics_answers *answers;
} numerics_viscosity_at;

typedef struct numerics_density_at {
    ff_density service;
    const ff_density *law;
    double T[NUMERICS_POINTS];
    numerics_answers *answers;
} numerics_density_at;

/* Calls eval in blocks, with one temperature for all points. */
static inline ff_status
numerics_eval_at(ff_status (*eval)(const void *, size_t, const double *, const double *, double *,
                                   double *, double *),
                 const void *self, const double T[NUMERICS_POINTS], size_t n, const double *p,
                 double *value, double *by_p, double *by_T)
{
    ff_status worst = FF_OK;
    if (isnan(T[0]))
        return eval(self, n, p, NULL, value, by_p, by_T);
    for (size_t from = 0; from < n && worst >= 0; from += NUMERICS_POINTS) {
        size_t count = n - from < NUMERICS_POINTS ? n - from : NUMERICS_POINTS;
        ff_status status = eval(self, count, p + from, T, value + from, by_p ? by_p + from : NULL,
                                by_T ? by_T + from : NULL);
        worst = status != FF_OK ? status : worst;
    }
    return worst;
}

static inline ff_status numerics_viscosity_eval_at(const void *self, size_t n, const double *p,
                                                   const double *T, double *ln_eta, double *dln_dp,
                                                   double *dln_dT)
{
    const numerics_viscosity_at *at = self;
    const ff_viscosity *law = at->law;
    ff_status status =
        T ? law->eval(law->self, n, p, T, ln_eta, dln_dp, dln_dT)
          : numerics_eval_at(law->eval, law->self, at->T, n, p, ln_eta, dln_dp, dln_dT);
    return numerics_answer_note(
        at->answers, &(numerics_answer){"viscosity", "ln_eta", status, n, p, ln_eta, dln_dp});
}

static inline ff_status numerics_density_eval_at(const void *self, size_t n, const double *p,
                                                 const double *T, double *rho, double *drho_dp,
                                                 double *drho_dT)
{
    const numerics_density_at *at = self;
    const ff_density *law = at->law;
    ff_status status =
        T ? law->eval(law->self, n, p, T, rho, drho_dp, drho_dT)
          : numerics_eval_at(law->eval, law->self, at->T, n, p, rho, drho_dp, drho_dT);
    return numerics_answer_note(at->answers,
                                &(numerics_answer){"density", "rho", status, n, p, rho, drho_dp});
}

/* Returns the law for the temperature T; if T is NaN, for the reference temperature of the law. The
   result is valid as long as *at. */
static inline const ff_viscosity *numerics_viscosity_make(numerics_viscosity_at *at,
                                                          const ff_viscosity *law, double T,
                                                          numerics_answers *answers)
{
    at->service = (ff_viscosity){sizeof at->service, at, numerics_viscosity_eval_at};
    at->law = law;
    at->answers = answers;
    for (size_t i = 0; i < NUMERICS_POINTS; i++)
        at->T[i] = T;
    return &at->service;
}

static inline const ff_density *numerics_density_make(numerics_density_at *at,
                                                      const ff_density *law, double T,
                                                      numerics_answers *answers)
{
    at->service = (ff_density){sizeof at->service, at, numerics_density_eval_at};
    at->law = law;
    at->answers = answers;
    for (size_t i = 0; i < NUMERICS_POINTS; i++)
        at->T[i] = T;
    return &at->service;
}

/* Refuses a law whose value at ambient pressure differs from that of the oil by more than 1 %. */
static inline ff_status numerics_hold_against(const ff_host *host, const char *wire,
                                              const char *name, const char *unit, double by_law,
                                              double by_oil, double T)
{
    if (fabs(by_law - by_oil) <= 0.01 * fabs(by_oil))
        return FF_OK;
    return ff_failf(host, FF_INVALID, wire,
                    "the law and the oil contradict each other: at %g degC %s is %.4g %s in the "
                    "law and %.4g %s in the oil; connect the oil to the law, or disconnect it here "
                    "(oil: none)",
                    T - 273.15, name, by_law, unit, by_oil, unit);
}

static inline ff_status numerics_hold_viscosity(const ff_host *host, const ff_viscosity *law,
                                                const double *eta0, double T)
{
    double p = 0, ln_eta = NAN;
    if (!eta0)
        return FF_OK;
    ff_status status = law->eval(law->self, 1, &p, &T, &ln_eta, NULL, NULL);
    if (status != FF_OK && status != FF_DOMAIN)
        return status;
    return numerics_hold_against(host, "viscosity", "eta0", "Pa s", exp(ln_eta), *eta0, T);
}

static inline ff_status numerics_hold_density(const ff_host *host, const ff_density *law,
                                              const double *rho0, double T)
{
    double p = 0, rho = NAN;
    if (!rho0)
        return FF_OK;
    ff_status status = law->eval(law->self, 1, &p, &T, &rho, NULL, NULL);
    if (status != FF_OK && status != FF_DOMAIN)
        return status;
    return numerics_hold_against(host, "density", "rho0", "kg/m3", rho, *rho0, T);
}

#endif
