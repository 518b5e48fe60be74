/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the inputs that ratings need from gears, oil and motion. */
#include "pair.h"

#include "../numerics/exchange.h"
#include "../numerics/pinion.h"

#include <assert.h>
#include <flankfilm/author.h>

#include <math.h>

const ff_port rating_inputs[1 + RATING_INPUTS + 1] = {
    {.name = "ehl.h_min",
     .unit = "m",
     .doc = "minimum film thickness of the tooth pair",
     .dims = "t",
     .flags = FF_OPTIONAL,
     .from = "ehl"},
    {.name = "gear.teeth", .unit = "1", .doc = "numbers of teeth", .dims = "gear", .from = "gear"},
    NUMERICS_PINION_ROW("gear"),
    {.name = "gear.base_radius",
     .unit = "m",
     .doc = "base circles",
     .dims = "gear",
     .from = "gear"},
    {.name = "gear.pitch_radius",
     .unit = "m",
     .doc = "working pitch circles",
     .dims = "gear",
     .from = "gear"},
    {.name = "gear.tip_radius", .unit = "m", .doc = "tip circles", .dims = "gear", .from = "gear"},
    {.name = "gear.centre_distance",
     .unit = "m",
     .doc = "working centre distance",
     .dims = "",
     .from = "gear"},
    {.name = "gear.working_pressure_angle",
     .unit = "rad",
     .doc = "working pressure angle",
     .dims = "",
     .from = "gear"},
    {.name = "gear.pressure_angle",
     .unit = "rad",
     .doc = "pressure angle of the basic rack",
     .dims = "",
     .from = "gear"},
    {.name = "gear.face_width",
     .unit = "m",
     .doc = "width of the teeth in contact",
     .dims = "",
     .from = "gear"},
    {.name = "gear.reduced_modulus",
     .unit = "Pa",
     .doc = "E': 2/E' = sum (1 - nu^2)/E",
     .dims = "",
     .from = "gear"},
    {.name = "gear.roughness",
     .unit = "m",
     .doc = "root mean square roughness of the flanks",
     .dims = "gear",
     .from = "gear"},
    {.name = "gear.profile_deviation",
     .unit = "m",
     .doc = "deviations of the flanks; their last points give the tip relief",
     .dims = "gear profile",
     .flags = FF_OPTIONAL,
     .from = "gear"},
    {.name = "gear.back_profile_deviation",
     .unit = "m",
     .doc = "deviations of the back flanks, which carry the load if the torque is negative",
     .dims = "gear back_profile",
     .flags = FF_OPTIONAL,
     .from = "gear"},
    {.name = "gear.yield_strength",
     .unit = "Pa",
     .doc = "yield strengths of the flanks; 0: unknown",
     .dims = "gear",
     .flags = FF_OPTIONAL,
     .from = "gear"},
    {.name = "gear.flank_class",
     .unit = "1",
     .doc = "tolerance classes of ISO 1328-1 of the flanks; 0: unknown",
     .dims = "gear",
     .flags = FF_OPTIONAL,
     .from = "gear"},
    {.name = "gear.elastic_modulus",
     .unit = "Pa",
     .doc = "Young's moduli, which show whether the gears are of steel",
     .dims = "gear",
     .flags = FF_OPTIONAL,
     .from = "gear"},
    NUMERICS_HEAT_ROWS("gear"),
    {.name = "operating.line_force",
     .unit = "N",
     .doc = "normal force along the line of action",
     .dims = "",
     .from = "operating"},
    {.name = "operating.speed",
     .unit = "rad/s",
     .doc = "speed of gear 1",
     .dims = "",
     .from = "operating"},
    {.name = "operating.oil_temperature",
     .unit = "K",
     .doc = "temperature of the oil",
     .dims = "",
     .from = "operating"},
    {.name = "dynamics.dynamic_factor_tooth",
     .unit = "1",
     .doc = "dynamic factor K_V; 1 if no motion is wired",
     .dims = "",
     .flags = FF_OPTIONAL,
     .from = "dynamics"},
    {.name = "oil",
     .unit = "",
     .doc = "the oil as a function of temperature",
     .dims = "",
     .service = FF_LIQUID_ID,
     .from = "lubricant"},
    {.name = "losses.contact_temperature_max",
     .unit = "K",
     .doc = "highest contact temperature, computed from the friction of the film",
     .dims = "",
     .flags = FF_OPTIONAL,
     .from = "losses"},
};

static ff_status read_two(const ff_host *host, const ff_array *in, const char *name, double to[2])
{
    for (size_t i = 0; i < 2; i++) {
        to[i] = in->data && in->rank == 1 && in->shape[0] > i ? in->data[i] : NAN;
        if (!isfinite(to[i]) || to[i] < 0)
            return ff_failf(host, FF_INVALID, name,
                            "gear %zu: the value must not be negative, but is %g", i + 1, to[i]);
    }
    return FF_OK;
}

static ff_status read_one(const ff_host *host, const ff_array *in, const char *name, double *to)
{
    *to = in->data ? in->data[0] : NAN;
    if (!(isfinite(*to) && *to > 0))
        return ff_failf(host, FF_INVALID, name, "the value must be above 0, but is %g", *to);
    return FF_OK;
}

/* Reads the tip reliefs: the metal removed at the last points of the profiles. */
static void read_relief(const ff_array *in, double relief[2])
{
    if (!in->data || in->rank != 2 || in->shape[0] < 2 || in->shape[1] < 1)
        return;
    for (size_t i = 0; i < 2; i++)
        relief[i] = fmax(0, -in->data[(i + 1) * in->shape[1] - 1]);
}

/* Young's moduli of steels, Pa. */
static const double least_steel = 185e9, most_steel = 225e9;

/* Refuses gears that are not of steel, and reads their thermal data. */
static ff_status read_materials(const ff_host *host, const char *standard, const ff_array *in,
                                const rating_heat *heat, rating_pair *p)
{
    const double said[] = {heat->conductivity, heat->density, heat->specific_heat};
    ff_status status = FF_OK;
    double modulus[2] = {least_steel, least_steel};
    if (in[RATING_IN_MODULI].data)
        status = read_two(host, &in[RATING_IN_MODULI], "gear.elastic_modulus", modulus);
    for (int i = 0; i < 2 && status == FF_OK; i++) {
        numerics_heat of_gear = {0};
        if (!(modulus[i] >= least_steel && modulus[i] <= most_steel))
            return ff_failf(host, FF_INVALID, "gear.elastic_modulus",
                            "%s covers gears of steel, with Young's moduli of %g to %g GPa; gear "
                            "%d has %g GPa",
                            standard, 1e-9 * least_steel, 1e-9 * most_steel, i + 1,
                            1e-9 * modulus[i]);
        status = numerics_heat_of(host, &in[RATING_IN_HEAT], said, i, &of_gear);
        p->contact[i] = numerics_heat_contact(&of_gear);
    }
    return status;
}

/* Reads the pair, with gear indices exchanged if necessary so that gear 1 drives. */
static ff_status read_pair(const ff_host *host, const char *standard, const ff_array *in,
                           const rating_heat *heat, const ff_liquid *oil, rating_pair *p)
{
    double roughness[2];
    double yield[2] = {0}, grade[2] = {0};
    *p = (rating_pair){.oil = oil, .dynamic_factor = 1, .yield = NAN};
    const struct {
        int row;
        const char *name;
        double *to;
    } twos[] = {{RATING_IN_TEETH, "gear.teeth", p->teeth},
                {RATING_IN_BASE, "gear.base_radius", p->base},
                {RATING_IN_PITCH, "gear.pitch_radius", p->pitch},
                {RATING_IN_TIP, "gear.tip_radius", p->tip},
                {RATING_IN_ROUGHNESS, "gear.roughness", roughness}},
      ones[] = {{RATING_IN_DISTANCE, "gear.centre_distance", &p->centre_distance},
                {RATING_IN_ANGLE, "gear.working_pressure_angle", &p->working_angle},
                {RATING_IN_PRESSURE_ANGLE, "gear.pressure_angle", &p->pressure_angle},
                {RATING_IN_WIDTH, "gear.face_width", &p->width},
                {RATING_IN_MODULUS, "gear.reduced_modulus", &p->modulus},
                {RATING_IN_FORCE, "operating.line_force", &p->force},
                {RATING_IN_SPEED, "operating.speed", &p->omega},
                {RATING_IN_OIL_TEMPERATURE, "operating.oil_temperature", &p->oil_temperature}};
    ff_status status = FF_OK;
    for (size_t i = 0; i < sizeof twos / sizeof twos[0] && status == FF_OK; i++)
        status = read_two(host, &in[twos[i].row], twos[i].name, twos[i].to);
    if (status == FF_OK && in[RATING_IN_FORCE].data && in[RATING_IN_FORCE].data[0] == 0)
        return ff_failf(host, FF_UNSUPPORTED, "operating.line_force",
                        "the torque is 0: there is nothing to rate, since flanks without load "
                        "neither scuff nor pit");
    for (size_t i = 0; i < sizeof ones / sizeof ones[0] && status == FF_OK; i++)
        status = read_one(host, &in[ones[i].row], ones[i].name, ones[i].to);
    if (status == FF_OK && in[RATING_IN_DYNAMIC_FACTOR].data)
        status = read_one(host, &in[RATING_IN_DYNAMIC_FACTOR], "dynamics.dynamic_factor_tooth",
                          &p->dynamic_factor);
    if (status == FF_OK)
        status = numerics_pinion(host, &in[RATING_IN_PINION], p->teeth, &p->pinion);
    if (status == FF_OK && in[RATING_IN_YIELD].data)
        status = read_two(host, &in[RATING_IN_YIELD], "gear.yield_strength", yield);
    if (status == FF_OK && in[RATING_IN_CLASS].data)
        status = read_two(host, &in[RATING_IN_CLASS], "gear.flank_class", grade);
    if (status == FF_OK)
        status = read_materials(host, standard, in, heat, p);
    if (status != FF_OK)
        return status;
    for (int i = 0; i < 2; i++)
        p->yield = yield[i] > 0 ? fmin(p->yield, yield[i]) : p->yield;
    p->grade = fmax(grade[0], grade[1]);
    /* Ra = sqrt(2/pi) Rq for Gaussian heights */
    p->roughness = (roughness[0] + roughness[1]) / 2 * sqrt(2 / M_PI);
    if (!(p->roughness > 0))
        return ff_failf(
            host, FF_INVALID, "gear.roughness",
            "the rating needs the roughness of the flanks; give roughness_ra to the gear");
    read_relief(&in[RATING_IN_PROFILE], p->tip_relief);
    p->ratio = p->teeth[1] / p->teeth[0];
    p->line = p->centre_distance * sin(p->working_angle);
    p->base_pitch = 2 * M_PI * p->base[0] / p->teeth[0];
    p->pitch_point = p->base[0] * tan(p->working_angle);
    p->pitch_speed = p->omega * p->pitch[0];
    p->sap = p->line - sqrt((p->tip[1] - p->base[1]) * (p->tip[1] + p->base[1]));
    p->end = sqrt((p->tip[0] - p->base[0]) * (p->tip[0] + p->base[0]));
    if (!(p->sap > 0 && p->end > p->sap && p->end < p->line && p->base_pitch < p->end - p->sap))
        return ff_failf(host, FF_INVALID, "gear.tip_radius",
                        "with these radii the path of contact is shorter than one base pitch");
    return FF_OK;
}

ff_status rating_pair_read(const ff_host *host, const char *standard, const ff_array *in,
                           const rating_heat *heat, const ff_liquid *oil, rating_pair *p)
{
    numerics_exchange exchange;
    ff_status status = numerics_exchange_open(&rating_inputs[1], RATING_INPUTS, in, &exchange);
    if (status == FF_OK)
        status = read_pair(host, standard, exchange.in, heat, oil, p);
    p->back = exchange.back;
    numerics_exchange_close(&exchange);
    return status;
}

double rating_roll(const rating_pair *p, double place)
{
    return p->back ? (p->line - place) / p->base[1] : place / p->base[0];
}

double rating_radius(const rating_pair *p, double place)
{
    return place * (p->line - place) / p->line;
}

double rating_speed(const rating_pair *p, int gear, double place)
{
    assert(gear == 0 || gear == 1);
    return gear == 0 ? p->omega * place : p->omega / p->ratio * (p->line - place);
}

double rating_grade(const rating_pair *p, const rating_load *load)
{
    if (load->grade >= 0)
        return (double)load->grade;
    return p->grade > 0 ? p->grade : 6;
}

double rating_load_share(const rating_pair *p, const rating_load *load, double place)
{
    double least = (fmax(rating_grade(p, load), 7) - 2) / 15;
    double lower = p->end - p->base_pitch, upper = p->sap + p->base_pitch; /* LPSTC and HPSTC */
    double share = 1;
    if (place < lower)
        share = least + (place - p->sap) / (lower - p->sap) / 3;
    else if (place > upper)
        share = least + (p->end - place) / (p->end - upper) / 3;
    return fmin(share, 1);
}

double rating_line_load(const rating_pair *p, const rating_load *load)
{
    return p->force / p->width * load->application * p->dynamic_factor * load->face *
           load->transverse;
}

double rating_addendum_ratio(const rating_pair *p, int gear)
{
    double over = p->tip[gear] / p->base[gear];
    return p->teeth[gear] / (2 * M_PI) * (sqrt((over - 1) * (over + 1)) - tan(p->working_angle));
}

ff_status rating_oil_at(const ff_host *host, const rating_pair *p, double T, double *viscosity,
                        double *density)
{
    double ln_eta = NAN, rho = NAN;
    const ff_status a = p->oil->eval(p->oil->self, FF_LIQUID_LN_ETA0, 1, &T, &ln_eta, NULL);
    const ff_status b = p->oil->eval(p->oil->self, FF_LIQUID_RHO0, 1, &T, &rho, NULL);
    if (a < 0 || b < 0 || !isfinite(ln_eta) || !isfinite(rho))
        return ff_failf(host, FF_INVALID, "oil",
                        "the oil has no viscosity and density at %.4g degC, which the rating needs",
                        T - 273.15);
    *viscosity = exp(ln_eta);
    *density = rho;
    return FF_OK;
}

void rating_report_draft(const ff_host *host, const char *standard, const char *held)
{
    char text[240];
    snprintf(text, sizeof text,
             "draft: formulas of %s as a public implementation quotes them; the standard itself "
             "was not available; %s",
             standard, held);
    host->quality(host->ctx, "draft", 1, 0, FF_RANGE, text);
}
