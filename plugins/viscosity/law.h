/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the isothermal viscosity laws of this folder share: the parameters that say which oil it
 * is, the viscosity eta0 at ambient pressure that follows from them, and the pressure cap. A law
 * adds ln(eta/eta0) as a function of pressure.
 */
#ifndef VISCOSITY_LAW_H
#define VISCOSITY_LAW_H

#include "grade.h"

#include <flankfilm/author.h>
#include <flankfilm/viscosity.h>

/* First member of every law's instance. */
typedef struct viscosity_law {
    ff_viscosity service;
    const ff_host *host;
    double cost;                                         /* s for a million points */
    double eta0, nu_40, nu_100, density_15, temperature; /* 0: not given */
    int64_t grade, base;                                 /* grade -1: not given */
    double pressure_cap; /* Pa; 0: auto, until viscosity_law_ready */
    double ln_eta0;      /* set by viscosity_law_ready */
} viscosity_law;

/* The parameters of every law: VISCOSITY_LAW_ROWS stands first in its table. */
enum {
    VISCOSITY_LAW_ETA0,
    VISCOSITY_LAW_GRADE,
    VISCOSITY_LAW_NU_40,
    VISCOSITY_LAW_NU_100,
    VISCOSITY_LAW_DENSITY_15,
    VISCOSITY_LAW_BASE,
    VISCOSITY_LAW_TEMPERATURE,
    VISCOSITY_LAW_PRESSURE_CAP,
    VISCOSITY_LAW_PARAMS
};
#define VISCOSITY_LAW_ROWS                                                                         \
    {.name = "eta0",                                                                               \
     .unit = "Pa s",                                                                               \
     .type = FF_REAL,                                                                              \
     .doc = "dynamic viscosity at ambient pressure and running temperature",                       \
     .flags = FF_REQUIRED | FF_MIN_OPEN,                                                           \
     .group = "viscosity",                                                                         \
     .max = 1e6,                                                                                   \
     .low = 1e-4,                                                                                  \
     .high = 100},                                                                                 \
        {.name = "grade",                                                                          \
         .unit = "",                                                                               \
         .type = FF_TEXT,                                                                          \
         .doc = "ISO 3448 grade, as ISO VG 220; gives eta0 at `temperature` by ASTM D341",         \
         .flags = FF_REQUIRED,                                                                     \
         .group = "viscosity"},                                                                    \
        {.name = "nu_40",                                                                          \
         .unit = "cSt",                                                                            \
         .type = FF_REAL,                                                                          \
         .doc = "kinematic viscosity at 40 degC; with nu_100 gives eta0 as a grade does",          \
         .flags = FF_REQUIRED,                                                                     \
         .group = "viscosity",                                                                     \
         .min = 0.5,                                                                               \
         .max = 1e5,                                                                               \
         .low = 2,                                                                                 \
         .high = 5000},                                                                            \
        {.name = "nu_100",                                                                         \
         .unit = "cSt",                                                                            \
         .type = FF_REAL,                                                                          \
         .doc = "kinematic viscosity at 100 degC; for a grade it replaces that of its base",       \
         .min = 0.5,                                                                               \
         .max = 1e4,                                                                               \
         .low = 1,                                                                                 \
         .high = 500},                                                                             \
        {.name = "density_15",                                                                     \
         .unit = "kg/m3",                                                                          \
         .type = FF_REAL,                                                                          \
         .doc = "density at 15 degC, to find eta0; without it 890 for mineral, 850 for PAO",       \
         .min = 500,                                                                               \
         .max = 2500,                                                                              \
         .low = 800,                                                                               \
         .high = 1164},                                                                            \
        {.name = "base",                                                                           \
         .unit = "",                                                                               \
         .type = FF_CHOICE,                                                                        \
         .doc = "base oil of the grade: viscosity index 95 (mineral) or 150 (PAO)",                \
         .preset = "mineral",                                                                      \
         .choices = VISCOSITY_BASES},                                                              \
        {.name = "temperature",                                                                    \
         .unit = "degC",                                                                           \
         .type = FF_REAL,                                                                          \
         .doc = "oil temperature; a grade and nu_40 need it, eta0 holds without",                  \
         .min = -40,                                                                               \
         .max = 250,                                                                               \
         .low = 0,                                                                                 \
         .high = 150},                                                                             \
    {                                                                                              \
        .name = "pressure_cap", .unit = "GPa", .type = FF_REAL,                                    \
        .doc = "ln(eta) goes on linearly above it; auto: 10 GPa, or less if the law needs it",     \
        .preset = "auto", .choices = "auto", .min = 1e-3, .max = 100                               \
    }

/* The one output of every law: row 0, the service. */
extern const ff_port viscosity_law_outputs[1];

/* The function of ff_viscosity. */
typedef ff_status viscosity_eval(const void *self, size_t n, const double *p, const double *T,
                                 double *ln_eta, double *dln_dp, double *dln_dT);

/* `size`: of the instance, which begins with a viscosity_law and is zeroed; `cost` as above. */
ff_status viscosity_law_create(const ff_host *host, size_t size, double cost, viscosity_eval *eval,
                               void **self);
ff_status viscosity_law_set(viscosity_law *law, uint32_t param, const ff_value *value);
/* The cap of a law that needs no less, Pa. */
static const double viscosity_highest_cap = 10e9;
/* Finds ln_eta0 and, when it is auto, the cap. */
ff_status viscosity_law_ready(viscosity_law *law, double auto_cap);
ff_status viscosity_law_assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                               ff_assessment *assessment);
const void *viscosity_law_service(void *self, uint32_t output);
void viscosity_law_destroy(void *self);

/* Pressure at which the law itself is evaluated; from there on ln(eta) follows the tangent. */
static inline double viscosity_law_clip(double p, double cap)
{
    p = p > 0 ? p : 0;
    return p < cap ? p : cap;
}

/* Ends an eval of a law that does not depend on temperature: clears dln_dT, which may be NULL, and
   returns FF_DOMAIN when a pressure lay above the cap. */
ff_status viscosity_law_end(const viscosity_law *law, size_t n, const double *p, double *dln_dT);

#endif
