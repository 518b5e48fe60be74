/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters and life cycle of the line-contact film models, which differ in the solver alone. */
#ifndef EHL_STAGE_H
#define EHL_STAGE_H

#include "../contact/history.h"
#include "../contact/ports.h"
#include "../equations/solver.h"
#include "../estimates/inlet.h"

#include <flankfilm/plugin.h>

ff_status ehl_create(const ff_host *host, const ff_model *model, ehl_solver_maker *maker,
                     void **self);
ff_status ehl_wire(void *self, uint32_t input, const void *service);
ff_status ehl_ready(void *self);
ff_status ehl_evaluate(void *self, uint64_t wanted, const ff_array *in);
void ehl_destroy(void *self);

/* Ranks of the words of cavitation, valleys and roughness. */
enum { EHL_CONSERVING = 1, EHL_VENTILATED = 1, EHL_IGNORED = 1 };

typedef struct ehl_model {
    const ff_host *host;
    const ff_model *model; /* its descriptor */
    ehl_solver_maker *maker;
    /* parameters, by their names; auto and none read as -1 or NaN, a word as its rank */
    int64_t cells, steps;
    double inlet, outlet, time_tolerance, tolerance, light_load;
    int32_t time_scheme, wedge, cavitation, valleys, roughness, thermal;
    int64_t thermal_nodes;
    double flank_conductivity, flank_density, flank_heat_capacity, bulk_temperature;
    double contact_film, boundary_friction, asperity_hardness, valley_length, roughness_cutoff;
    ehl_inlet_heating heating;
    ehl_laws laws;
    ehl_isothermal isothermal;
    const ff_liquid *liquid;         /* NULL: no oil is wired */
    const ff_rheology_2 *shear_rate; /* NULL: the rheology does not offer it */
    const ff_film *outside;          /* NULL: the solver of `maker` */
    const ff_asperity *asperities;   /* NULL: no surface of statistical flanks is wired */
    int rough;                       /* a surface is wired */
} ehl_model;

struct ehl_heat;
struct ehl_march;
struct ehl_thermal;

/* K, of the teeth: as their loss heats them, or given, or that of the oil, which an isothermal film
   has; 0: no oil tells. */
double ehl_stage_bulk(const ehl_model *m, const ff_array *in);

/* Lets the march heat the film, by what it makes of `heat` or `thermal`; without the parameter
   thermal it stays as it is. */
ff_status ehl_stage_heat(const ehl_model *m, const ff_array *in, struct ehl_march *march,
                         struct ehl_heat *heat, struct ehl_thermal *thermal);

#endif
