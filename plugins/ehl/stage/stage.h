/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters and life cycle of the line-contact film models. The models differ only in the
   solver. */
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
    /* Parameters by their names. auto and none are -1 or NaN; a word is its index. */
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
    const ff_rheology_2 *shear_rate; /* NULL: the rheology does not provide it */
    const ff_film *outside;          /* NULL: the solver of `maker` is used */
    const ff_asperity *asperities;   /* NULL: no statistical surface is wired */
    int rough;                       /* whether a surface is wired */
} ehl_model;

struct ehl_heat;
struct ehl_march;
struct ehl_thermal;

/* Returns the bulk temperature of the teeth, K: as heated by their loss, or as given, or that of
   the oil (which an isothermal film has). Returns 0 if no oil is wired. */
double ehl_stage_bulk(const ehl_model *m, const ff_array *in);

/* Sets up the heating of the film by the parameters `heat` or `thermal`. Without the parameter
   thermal the film stays isothermal. */
ff_status ehl_stage_heat(const ehl_model *m, const ff_array *in, struct ehl_march *march,
                         struct ehl_heat *heat, struct ehl_thermal *thermal);

#endif
