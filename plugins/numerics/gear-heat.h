/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Thermal data of a gear pair: given by the gear stage or, without a gear, by parameters. */
#ifndef NUMERICS_GEAR_HEAT_H
#define NUMERICS_GEAR_HEAT_H

#include <flankfilm/author.h>

#include <math.h>

/* Data of steel, as presets of parameters. */
#define NUMERICS_STEEL_CONDUCTIVITY "50 W/(m K)"
#define NUMERICS_STEEL_DENSITY      "7850 kg/m3"
#define NUMERICS_STEEL_HEAT         "484 J/(kg K)"

/* For rows of bulk temperatures, in K: the formulas are accurate to 30 % of a rise of about 30
   K. */
#define NUMERICS_BULK_QUANTITY                                                                     \
    .shown = "degC", .quantity = "bulk temperature of the teeth", .apart = 10

/* A list for both gears that an input of a gear stage replaces if it is offered. */
#define NUMERICS_LIST_UNLESS(wire, name, unit, type, member, preset, min, max, doc)                \
    FF_ROW_UNLESS(wire, name, unit, doc, FF_REALS, 0, preset, NULL, NULL, min, max, 0, 0, 1, 2,    \
                  FF_PLACE(type, member, ff_reals))

/* Three consecutive input rows. */
#define NUMERICS_HEAT_ROWS(kind)                                                                   \
    {.name = "gear.thermal_conductivity",                                                          \
     .unit = "W/(m K)",                                                                            \
     .doc = "thermal conductivities of the gears; 0: unknown",                                     \
     .dims = "gear",                                                                               \
     .flags = FF_OPTIONAL,                                                                         \
     .from = kind},                                                                                \
        {.name = "gear.density",                                                                   \
         .unit = "kg/m3",                                                                          \
         .doc = "densities of the gears",                                                          \
         .dims = "gear",                                                                           \
         .flags = FF_OPTIONAL,                                                                     \
         .from = kind},                                                                            \
    {                                                                                              \
        .name = "gear.specific_heat", .unit = "J/(kg K)",                                          \
        .doc = "specific heats of the gears; 0: unknown", .dims = "gear", .flags = FF_OPTIONAL,    \
        .from = kind                                                                               \
    }
enum { NUMERICS_HEAT_INPUTS = 3 };

/* Parameters of both flanks for pipelines without a gear; the model has the members
   flank_conductivity, flank_density and flank_heat_capacity. */
#define NUMERICS_HEAT_PARAMS(when, type)                                                           \
    FF_QUANTITY_UNLESS("gear.thermal_conductivity", "flank_conductivity", "W/(m K)", type,         \
                       flank_conductivity, 0, NUMERICS_STEEL_CONDUCTIVITY, NULL, 1e-3, 1e4, 0, 0,  \
                       when ": thermal conductivity of both flanks, if no gear gives it; steel: "  \
                            "50"),                                                                 \
        FF_QUANTITY_UNLESS("gear.density", "flank_density", "kg/m3", type, flank_density, 0,       \
                           NUMERICS_STEEL_DENSITY, NULL, 1, 1e5, 0, 0,                             \
                           "density of both flanks, "                                              \
                           "if no gear gives it; "                                                 \
                           "steel: 7850"),                                                         \
        FF_QUANTITY_UNLESS("gear.specific_heat", "flank_heat_capacity", "J/(kg K)", type,          \
                           flank_heat_capacity, 0, NUMERICS_STEEL_HEAT, NULL, 1, 1e5, 0, 0,        \
                           "specific heat of both flanks, if no gear gives it; steel: 484")

typedef struct numerics_heat {
    double conductivity, density, specific_heat; /* SI */
} numerics_heat;

/* Returns the thermal contact coefficient B = sqrt(k rho c), J/(m2 K s^0.5). */
static inline double numerics_heat_contact(const numerics_heat *h)
{
    return sqrt(h->conductivity * h->density * h->specific_heat);
}

/* Returns the diffusivity k/(rho c), m2/s. */
static inline double numerics_heat_diffusivity(const numerics_heat *h)
{
    return h->conductivity / (h->density * h->specific_heat);
}

/* Returns the value of gear g in row k; NaN if the row is too short. */
static inline double numerics_heat_value(const ff_array *in,
                                         const double said[NUMERICS_HEAT_INPUTS], int k, int g)
{
    const ff_array *row = &in[k];
    if (!row->data)
        return said[k];
    return row->rank == 1 && row->shape[0] > (size_t)g ? row->data[g] : NAN;
}

/* Finds the thermal data of gear `g`, 0 or 1. `in` has the three input rows, `said` the parameters
   used without them. A gear without data is refused. */
static inline ff_status numerics_heat_of(const ff_host *host, const ff_array *in,
                                         const double said[NUMERICS_HEAT_INPUTS], int g,
                                         numerics_heat *h)
{
    static const char *const item[] = {"gear.thermal_conductivity", "gear.density",
                                       "gear.specific_heat"};
    static const char *const name[] = {"thermal_conductivity", "density", "specific_heat"};
    double value[NUMERICS_HEAT_INPUTS];
    for (int k = 0; k < NUMERICS_HEAT_INPUTS; k++) {
        value[k] = numerics_heat_value(in, said, k, g);
        if (!(value[k] > 0 && isfinite(value[k])))
            return ff_failf(
                host, FF_INVALID, item[k],
                "%s of gear %d is unknown, since its modulus or density differs from that of its "
                "material (default: steel); give thermal_conductivity and specific_heat to the "
                "gear stage, or name the material",
                name[k], g + 1);
    }
    *h = (numerics_heat){value[0], value[1], value[2]};
    return FF_OK;
}

/* Whether the data of gear `g` are known. */
static inline int numerics_heat_known(const ff_array *in, const double said[NUMERICS_HEAT_INPUTS],
                                      int g)
{
    int known = 1;
    for (int k = 0; k < NUMERICS_HEAT_INPUTS; k++)
        known &= numerics_heat_value(in, said, k, g) > 0;
    return known;
}

#endif
