/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sets up the heating of the film from the parameters of its stage. */
#include "../estimates/inlet-heat.h"
#include "../heat/heat.h"
#include "../heat/thermal.h"
#include "stage.h"

#include <flankfilm/author.h>

#include <math.h>

double ehl_stage_bulk(const ehl_model *m, const ff_array *in)
{
    if (m->thermal == EHL_THERMAL_FULL && in[EHL_IN_BULK].data)
        return *in[EHL_IN_BULK].data;
    return m->thermal != EHL_THERMAL_FULL || isnan(m->bulk_temperature) ? m->laws.temperature
                                                                        : m->bulk_temperature;
}

/* Sets up thermal: full. */
static ff_status thermal_create(const ehl_model *m, const ff_array *in, ehl_march *march,
                                double conductivity, ehl_thermal *thermal)
{
    double T = m->laws.temperature, heat_capacity = NAN;
    const double said[] = {m->flank_conductivity, m->flank_density, m->flank_heat_capacity};
    numerics_heat flank[2];
    if (m->laws.rheology && !m->shear_rate)
        return ff_failf(m->host, FF_INVALID, "thermal",
                        "thermal: full needs the shear rate at a point of the film "
                        "(flankfilm.rheology/2), which the law of stage rheology does not give; "
                        "thermal: inlet works with it");
    ff_status status =
        m->liquid->eval(m->liquid->self, FF_LIQUID_HEAT_CAPACITY, 1, &T, &heat_capacity, NULL);
    if (status < 0 || !(heat_capacity > 0 && isfinite(heat_capacity)))
        return ff_failf(m->host, FF_INVALID, "thermal",
                        "the oil gives no heat capacity at %g degC: give heat_capacity, or its "
                        "base, to the stage of the oil",
                        T - 273.15);
    for (int g = 0; g < 2; g++)
        if (numerics_heat_of(m->host, &in[EHL_IN_HEAT], said, g, &flank[g]) != FF_OK)
            return FF_INVALID;
    const ehl_thermal_data data = {
        .across = (size_t)m->thermal_nodes,
        .conductivity = conductivity,
        .conducts = ehl_heat_conductivity_rise(m->liquid, T),
        .heat_capacity = heat_capacity,
        .bulk = ehl_stage_bulk(m, in),
        .flank_contact = {numerics_heat_contact(&flank[0]), numerics_heat_contact(&flank[1])},
        .flank_diffusivity = {numerics_heat_diffusivity(&flank[0]),
                              numerics_heat_diffusivity(&flank[1])},
        .friction = m->boundary_friction,
        .flow = m->shear_rate,
    };
    return ehl_thermal_create(thermal, m->host, march, &data);
}

ff_status ehl_stage_heat(const ehl_model *m, const ff_array *in, ehl_march *march, ehl_heat *heat,
                         ehl_thermal *thermal)
{
    double conductivity;
    if (in[EHL_IN_BULK].data && m->thermal != EHL_THERMAL_FULL)
        return ff_failf(m->host, FF_INVALID, "bulk",
                        "the teeth are warmer than the oil, which this film model does not "
                        "include: bulk needs thermal: full");
    if (m->thermal == EHL_THERMAL_NONE)
        return FF_OK;
    if (m->outside)
        return ff_failf(m->host, FF_UNSUPPORTED, "thermal",
                        "the discretisation of another stage does not include heat: use thermal: "
                        "none, or remove the wire discretisation");
    ff_status status = ehl_heat_conductivity(m->host, m->liquid, &m->laws, &conductivity);
    if (m->thermal == EHL_THERMAL_FULL)
        return status == FF_OK ? thermal_create(m, in, march, conductivity, thermal) : status;
    if (status == FF_OK && ehl_heat_conductivity_rise(m->liquid, m->laws.temperature).rise > 0)
        m->host->quality(m->host->ctx, "constant_conductivity", 1, 0, FF_RANGE,
                         "the conductivity of the oil increases with pressure, which thermal: "
                         "inlet does not include");
    if (status == FF_OK)
        status = ehl_heat_create(heat, march->solver->grid->nodes, conductivity);
    march->heat = heat;
    march->solver->reynolds->ease = heat->ease;
    return status;
}
