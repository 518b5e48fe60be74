/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the models of this folder: an oil as functions of temperature, offered as
   flankfilm.liquid/1, and its values at the temperature of the run. Each model computes the
   kinematic viscosity from its own parameters. */
#ifndef LUBRICANT_LIQUID_H
#define LUBRICANT_LIQUID_H

#include "curve.h"
#include "references.h"

#include <flankfilm/author.h>
#include <flankfilm/laws.h>

enum { LUBRICANT_PROPERTIES = FF_LIQUID_CONDUCTIVITY_BEND + 1 };

/* An instance of either model. Parameters that are not given are NaN, -1 or NULL. */
typedef struct lubricant_oil {
    const ff_host *host;
    ff_liquid service;
    double density_15, expansion, alpha, alpha_at, conductivity, heat_capacity, temperature;
    int32_t base;
    double nu_40, nu_100, eta0, at, density;
    const char *grade, *file;
    ff_reals conductivity_pressure; /* c1 and c2, 1/Pa, or empty */

    /* The model fills in these members before lubricant_oil_ready. */
    lubricant_curve viscosity; /* ordinate of ASTM D341 over ln T; one point: the oil is known at
                                  that temperature only */
    lubricant_curve tables[4]; /* measured properties, in order from FF_LIQUID_RHO0 */
    double low, high;          /* range of the data, K */

    double coldest, hottest; /* range of ASTM D341, K; set by lubricant_oil_ready */
    double viscosity_index;  /* from nu_40 and nu_100; 0 or NaN: unknown */
    double alpha_scale;      /* factor on the correlation for the base oil; NaN: the correlation is
                                not used */

    /* Values at the temperature of the run, stored since films request them very often; NaN: there
       is no run. */
    double run_temperature, run_value[LUBRICANT_PROPERTIES], run_slope[LUBRICANT_PROPERTIES];
} lubricant_oil;

/* The parameters common to both models. */
#define LUBRICANT_ROWS                                                                             \
    FF_QUANTITY("alpha", "1/GPa", lubricant_oil, alpha, FF_MIN_OPEN, NULL, NULL, 0, 1000, 2, 50,   \
                "pressure coefficient dln(eta)/dp at ambient pressure and at the temperature "     \
                "alpha_at; its variation with temperature is that of the base oil"),               \
        FF_QUANTITY("alpha_at", "degC", lubricant_oil, alpha_at, 0, NULL, NULL, -150, 500, -60,    \
                    250, "temperature at which alpha is given"),                                   \
        FF_QUANTITY("conductivity", "W/(m K)", lubricant_oil, conductivity, FF_MIN_OPEN, NULL,     \
                    NULL, 0, 100, 0.08, 0.3,                                                       \
                    "thermal conductivity, used for all temperatures; left out: that of the "      \
                    "base oil"),                                                                   \
        FF_LIST("conductivity_pressure", "1/GPa", lubricant_oil, conductivity_pressure, 0, NULL,   \
                NULL, 0, 100, 0.1, 5, 1, 2,                                                        \
                "c1 and c2 of the conductivity under pressure, which is 1 + c1 p/(1 + c2 p) "      \
                "times the conductivity at ambient pressure; left out: it does not depend on "     \
                "pressure. Paraffinic oils: 1.72 and 0.54, naphthenic 1.54 and 0.33, PAO 1.40 "    \
                "and 0.34"),                                                                       \
        FF_QUANTITY("heat_capacity", "J/(kg K)", lubricant_oil, heat_capacity, FF_MIN_OPEN, NULL,  \
                    NULL, 0, 1e5, 1200, 3500,                                                      \
                    "specific heat, used for all temperatures; left out: that of the base "        \
                    "oil"),                                                                        \
        FF_QUANTITY(                                                                               \
            "temperature", "degC", lubricant_oil, temperature, 0, NULL, NULL, -150, 500, 0, 0,     \
            "temperature of the oil in the inlet, if no operating stage gives oil_temperature")

#define LUBRICANT_REFERENCE                                                                        \
    "ASTM D341-20 (viscosity over temperature), ASTM D1250 table 54D (density), ISO 3448 and "     \
    "ASTM D2270 (grades); Gold, Schmidt, Dicke, Loos and Assmann 2001, J. Synth. Lubr. 18 "        \
    "(pressure coefficient); Cragoe 1929, Bureau of Standards Misc. Publ. 97 (thermal data)"
#define LUBRICANT_BIBTEX BIB_ASTMD341 "\n" BIB_Gold2001 "\n" BIB_Cragoe1929
extern const ff_port lubricant_inputs[1];
extern const ff_port lubricant_outputs[8];

ff_status lubricant_oil_ready(lubricant_oil *oil);
/* Sets the viscosity by ASTM D341 from the kinematic viscosities at 40 and 100 degC, m2/s. */
ff_status lubricant_oil_ready_from(lubricant_oil *oil, double nu_40, double nu_100);
/* Stores all properties at the temperature of the run. The service only reads them and therefore
   stays pure. */
void lubricant_keep_run(lubricant_oil *oil, double T);
/* Returns the density at T, kg/m3, once density_15 or a table of the density is set. */
double lubricant_density(const lubricant_oil *oil, double T);
ff_status lubricant_evaluate(void *self, uint64_t wanted, const ff_array *in);
const void *lubricant_service(void *self, uint32_t output);
void lubricant_destroy(void *self);

#endif
