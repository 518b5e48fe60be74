/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the isothermal viscosity laws of this folder share: the parameters that say which oil it
 * is, the viscosity eta0 at ambient pressure that follows from them, and the pressure cap. A law
 * adds ln(eta/eta0) as a function of pressure.
 */
#ifndef VISCOSITY_LAW_H
#define VISCOSITY_LAW_H

#include "../lubricant/base-oil.h"

#include <flankfilm/author.h>
#include <flankfilm/laws.h>

/* The oil of a law. */
typedef struct viscosity_oil {
    double eta0, nu_40, nu_100, density_15, temperature; /* NaN: not given */
    const char *grade;                                   /* NULL: not given */
    int32_t base;                                        /* rank in LUBRICANT_BASES */
    double pressure_cap;     /* Pa; NaN: auto, until viscosity_oil_ready */
    const ff_liquid *liquid; /* NULL: none is wired, and the parameters say which oil it is */
    double ln_eta0; /* set by viscosity_oil_ready; 0 with a liquid, which gives it over T */
} viscosity_oil;

/* First members of every law's instance. */
typedef struct viscosity_law {
    const ff_host *host;
    ff_viscosity service;
    viscosity_oil oil;
} viscosity_law;

/* The one input of every law, and `wire`. */
extern const ff_port viscosity_inputs[1];
ff_status viscosity_wire(void *self, uint32_t input, const void *service);

/* The parameters of every law stand first in its table. */
#define VISCOSITY_OIL_ROWS(type)                                                                   \
    FF_QUANTITY_UNLESS("oil", "eta0", "Pa s", type, oil.eta0, FF_REQUIRED | FF_MIN_OPEN, NULL,     \
                       "viscosity", 0, 1e6, 1e-4, 100,                                             \
                       "dynamic viscosity at ambient pressure and running temperature"),           \
        FF_PHRASE_UNLESS(                                                                          \
            "oil", "grade", type, oil.grade, FF_REQUIRED, NULL, "viscosity",                       \
            "ISO 3448 grade, as ISO VG 220; gives eta0 at `temperature` by ASTM D341"),            \
        FF_QUANTITY_UNLESS(                                                                        \
            "oil", "nu_40", "cSt", type, oil.nu_40, FF_REQUIRED, NULL, "viscosity", 0.5, 1e5, 2,   \
            5000, "kinematic viscosity at 40 degC; with nu_100 gives eta0 as a grade does"),       \
        FF_QUANTITY_UNLESS(                                                                        \
            "oil", "nu_100", "cSt", type, oil.nu_100, 0, NULL, NULL, 0.5, 1e4, 1, 500,             \
            "kinematic viscosity at 100 degC; for a grade it replaces that of its base"),          \
        FF_QUANTITY_UNLESS("oil", "density_15", "kg/m3", type, oil.density_15, 0, NULL, NULL, 500, \
                           2500, 800, 1164,                                                        \
                           "density at 15 degC, to find eta0; without it that of the base"),       \
        FF_ONE_OF_UNLESS("oil", LUBRICANT_BASES, "base", type, oil.base, 0, "mineral",             \
                         "base oil of the grade, as lubricant/grade has them"),                    \
        FF_QUANTITY_UNLESS("oil", "temperature", "degC", type, oil.temperature, 0, NULL, NULL,     \
                           -40, 250, 0, 150,                                                       \
                           "oil temperature; a grade and nu_40 need it, eta0 holds without"),      \
        FF_QUANTITY_OR(                                                                            \
            "auto", "pressure_cap", "GPa", type, oil.pressure_cap, 0, "auto", NULL, 1e-3, 100, 0,  \
            0, "ln(eta) goes on linearly above it; auto: 10 GPa, or less if the law needs it")

/* The cap of a law that needs no less, Pa. */
static const double viscosity_highest_cap = 10e9;
/* Finds ln_eta0 and, when it is auto, the cap. */
ff_status viscosity_oil_ready(const ff_host *host, viscosity_oil *oil, double auto_cap);

/* Refuses a liquid, where one is wired, that does not tell its pressure coefficient. */
ff_status viscosity_alpha_ready(const ff_host *host, const viscosity_oil *oil);

/* Pressure at which the law itself is evaluated; from there on ln(eta) follows the tangent. */
static inline double viscosity_clip(double p, double cap)
{
    p = p > 0 ? p : 0;
    return p < cap ? p : cap;
}

/* Ends an eval of a law whose ln(eta/eta0) does not depend on temperature: adds what a liquid
   gives, fills dln_dT, which may be NULL, and returns FF_DOMAIN when a pressure lay above the cap
   or the liquid was continued. */
ff_status viscosity_oil_end(const viscosity_oil *oil, size_t n, const double *p, const double *T,
                            double *ln_eta, double *dln_dT);

#endif
