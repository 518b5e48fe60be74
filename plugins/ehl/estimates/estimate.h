/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Common part of the models that estimate the film without solving for the pressure: parameters,
   instants, and results for the Hertzian contact. Each model adds only its formula for the film. */
#ifndef EHL_ESTIMATE_H
#define EHL_ESTIMATE_H

#include "../contact/grid.h"
#include "../contact/history.h"
#include "../contact/ports.h"
#include "../contact/surface.h"
#include "inlet.h"
#include "local.h"

#include <flankfilm/plugin.h>

/* Parameter rows of every such model. */
#define EHL_ESTIMATE_PARAMS                                                                        \
    FF_COUNT("cells", ehl_estimate, cells, 0, "512", NULL, 4, 65536, 0, 0,                         \
             "number of cells from inlet to outlet for the fields film and pressure; other "       \
             "outputs do not depend on it"),                                                       \
        FF_QUANTITY_OR("auto", "inlet", "1", ehl_estimate, inlet, FF_MIN_OPEN, "auto", NULL, 0,    \
                       1e6, 0, 0,                                                                  \
                       "start of the fields in front of the contact, in largest Hertz "            \
                       "half-widths; auto: a + 10 sqrt(2 R h) of every load"),                     \
        FF_QUANTITY_OR("auto", "outlet", "1", ehl_estimate, outlet, FF_MIN_OPEN, "auto", NULL, 0,  \
                       1e6, 0, 0,                                                                  \
                       "end of the fields behind the contact, in largest Hertz half-widths; "      \
                       "auto: a + 2 sqrt(2 R h) of every load"),                                   \
        FF_COUNT_OR("auto", "steps", ehl_estimate, steps, FF_TUNABLE, "auto", NULL, 1, 1e6, 0, 0,  \
                    "number of equal time steps of the results; auto: the times of the contact"),  \
        FF_QUANTITY_OR("none", "light_load", "N/m", ehl_estimate, light_load, FF_MIN_OPEN, "none", \
                       NULL, 0, 1e9, 0, 0,                                                         \
                       "smallest load per width, which replaces smaller loads; none: loads below " \
                       "1 % of the largest load have the film of 1 %, plus the gap while contact " \
                       "is lost"),                                                                 \
        FF_ONE_OF("none|inlet|local", "thermal", ehl_estimate, thermal, 0, "none",                 \
                  "heat of shear in the film. none: the film has the temperature of the oil. "     \
                  "inlet: heat thins the oil in the inlet, as if only conduction removed the "     \
                  "heat. local: as inlet, with the film at the temperature of the teeth, and the " \
                  "friction is computed at one temperature, to which it heats the oil in the "     \
                  "contact. inlet and local need an oil with a conductivity"),                     \
        FF_QUANTITY_OR("auto", "bulk_temperature", "degC", ehl_estimate, bulk_temperature, 0,      \
                       "auto", NULL, -150, 1000, 0, 0,                                             \
                       "for thermal: local, temperature of the teeth; auto: that of the oil, "     \
                       "which is a lower bound"),                                                  \
        NUMERICS_HEAT_PARAMS("thermal: local", ehl_estimate),                                      \
        FF_ONE_OF("greenwood-tripp|masjedi-khonsari|clarke", "share", ehl_estimate, share, 0,      \
                  "greenwood-tripp",                                                               \
                  "for statistical flanks, method for the share of the load on asperities. "       \
                  "greenwood-tripp: load of the asperities at the film that the oil forms under "  \
                  "the rest of the load; masjedi-khonsari: fit to films computed with this "       \
                  "asperity model; clarke: 1 - erf(lambda). The difference between the methods "   \
                  "shows how accurately the share is known"),                                      \
        FF_QUANTITY("boundary_friction", "1", ehl_estimate, boundary_friction, 0,                  \
                    EHL_BOUNDARY_FRICTION, NULL, 0, 2, 0.05, 0.2,                                  \
                    "friction coefficient of the asperities in contact"),                          \
        FF_QUANTITY_UNLESS("gear.hardness", "asperity_hardness", "GPa", ehl_estimate,              \
                           asperity_hardness, 0, "7 GPa", NULL, 0, 1e3, 0, 0,                      \
                           "for statistical flanks, highest pressure of asperities if no gear "    \
                           "gives its hardness; 0: elastic at every pressure"),                    \
        EHL_HEATING_PARAMS(ehl_estimate)

extern const ff_model ehl_film_formula_model; /* ehl/film-formula */

/* One instant of the results. For the film, loads below 1 % of the largest load are replaced by 1
   %, since the film would otherwise grow without bound. The pressure uses the actual load. */
typedef struct ehl_moment {
    ehl_instant at;  /* at.load is the load used for the film */
    double load;     /* actual load */
    double a, p_max; /* Hertz: half-width for at.load, pressure for the actual load */
    double moes_M, moes_L;
    double engagement; /* number of the engagement */
    int begins;        /* 1: first instant of an engagement */
} ehl_moment;

/* A film at one instant. */
typedef struct ehl_estimate_film {
    double h_min, h_central, error;
} ehl_estimate_film;

typedef struct ehl_estimate ehl_estimate;

/* First member of the instance of each model. */
struct ehl_estimate {
    const ff_host *host;
    /* Computes the films of the instants, in their order, after one call of `begin`. */
    ff_status (*begin)(ehl_estimate *e);
    void (*film)(ehl_estimate *e, size_t k, ehl_estimate_film *film);
    /* Computes h at n points with |x| <= a, for the instant whose film was computed last. */
    void (*profile)(const ehl_estimate *e, size_t k, size_t n, const double *x, double *h);
    void (*report)(const ehl_estimate *e); /* writes the model's quality lines */
    void (*end)(ehl_estimate *e);

    int64_t cells, steps; /* steps -1: the times of the history */
    double inlet, outlet, light_load;
    int rough; /* 1: a surface is wired */
    int32_t thermal, share;
    double bulk_temperature; /* K; NaN: the temperature of the oil */
    double flank_conductivity, flank_density, flank_heat_capacity;
    double boundary_friction, asperity_hardness;
    const ff_asperity *asperities; /* NULL: no statistical flanks */
    const ff_liquid *liquid;       /* NULL: no oil is wired */
    ehl_inlet_heating heating;
    ehl_laws laws;
    ehl_isothermal isothermal;

    /* history of one run */
    ehl_history history;
    ehl_oil oil;
    ehl_film_coefficient alpha_star;
    double alpha;        /* film-forming coefficient alpha*, 1/Pa */
    double conductivity; /* conductivity of the oil, W/(m K), if heat is included; else 0 */
    ehl_local local;
    double worst_rise; /* largest temperature rise of the oil over the teeth, K */
    double outside;    /* number of instants outside the range of the model for the share */
    ehl_grid grid;
    size_t count;
    ehl_moment *moment;
    double roughness; /* combined roughness of both flanks, m; 0: not known */
    ehl_law_answer answered;
};

ff_status ehl_estimate_ready(void *self);
ff_status ehl_estimate_wire(void *self, uint32_t input, const void *service);
ff_status ehl_estimate_evaluate(void *self, uint64_t wanted, const ff_array *in);

/* Returns the gap of the dry Hertzian contact at |x|/a = s >= 1, over a^2/(2 R) (Johnson 1985,
 * ch. 4.2). */
double ehl_hertz_gap(double s);

/* Returns the central film thickness of Moes 2000 for any coefficient alpha, incompressible. */
double ehl_estimate_moes(const ehl_estimate *e, const ehl_instant *at);

#endif
