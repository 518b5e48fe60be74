/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What the models of this folder share: an oil as functions of its temperature, offered as
 * flankfilm.liquid/1, and its values at the temperature that it runs at. A model says how the
 * kinematic viscosity follows from its parameters.
 */
#ifndef LUBRICANT_LIQUID_H
#define LUBRICANT_LIQUID_H

#include "curve.h"

#include <flankfilm/author.h>
#include <flankfilm/laws.h>

/* First member of both instances. NaN and -1: not given. */
typedef struct lubricant_oil {
    ff_liquid service;
    const ff_host *host;
    double density_15, expansion, alpha, alpha_at, conductivity, heat_capacity, temperature;
    int32_t base;

    char *text; /* the oil's copy of the text that `set` was given */

    /* Filled in by the model before lubricant_oil_ready. */
    lubricant_curve viscosity; /* ordinate of ASTM D341 over ln T; one point: serves that alone */
    lubricant_curve tables[4]; /* measured, in the order of the properties from FF_LIQUID_RHO0 */
    double low, high;          /* K, that the data reach */

    double coldest, hottest; /* K, that ASTM D341 holds in; set by lubricant_oil_ready */
    double alpha_scale;      /* of the base's correlation; NaN: alpha is not known from it */
} lubricant_oil;

/* The rows that both models have; `type` begins with a lubricant_oil called `oil`. */
#define LUBRICANT_ROWS(type)                                                                       \
    FF_QUANTITY("alpha", "1/GPa", type, oil.alpha, FF_MIN_OPEN, NULL, NULL, 0, 1000, 2, 50,        \
                "pressure coefficient dln(eta)/dp at ambient pressure and the temperature "        \
                "alpha_at; over temperature it follows the base oil"),                             \
        FF_QUANTITY("alpha_at", "degC", type, oil.alpha_at, 0, NULL, NULL, -150, 500, -60, 250,    \
                    "temperature that alpha holds at"),                                            \
        FF_QUANTITY("conductivity", "W/(m K)", type, oil.conductivity, FF_MIN_OPEN, NULL, NULL, 0, \
                    100, 0.08, 0.3,                                                                \
                    "thermal conductivity, taken for every temperature; without it that of the "   \
                    "base oil"),                                                                   \
        FF_QUANTITY("heat_capacity", "J/(kg K)", type, oil.heat_capacity, FF_MIN_OPEN, NULL, NULL, \
                    0, 1e5, 1200, 3500,                                                            \
                    "specific heat, taken for every temperature; without it that of the base "     \
                    "oil"),                                                                        \
        FF_QUANTITY("temperature", "degC", type, oil.temperature, 0, NULL, NULL, -150, 500, 0, 0,  \
                    "of the oil in the inlet, where no operating stage gives oil_temperature")

extern const char lubricant_reference[], lubricant_bibtex[];
extern const ff_port lubricant_inputs[1];
extern const ff_port lubricant_outputs[8];

/* Of an instance of `size` bytes that begins with a lubricant_oil. */
ff_status lubricant_create(const ff_host *host, size_t size, void **self);
ff_status lubricant_set(void *self, const ff_param *row, const ff_value *value);
ff_status lubricant_oil_ready(lubricant_oil *oil);
/* The viscosity by ASTM D341 from those at 40 and 100 degC, m2/s. */
ff_status lubricant_oil_ready_from(lubricant_oil *oil, double nu_40, double nu_100);
/* kg/m3 at T, once density_15 or a table of the density is there. */
double lubricant_density(const lubricant_oil *oil, double T);
ff_status lubricant_evaluate(void *self, uint64_t wanted, const ff_array *in);
const void *lubricant_service(void *self, uint32_t output);
void lubricant_destroy(void *self);

#endif
