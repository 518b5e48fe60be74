/* SPDX-License-Identifier: GPL-3.0-or-later */
/* lubricant/measured: an oil from its data sheet or from measurements. */
#include "base-oil.h"
#include "liquid.h"

#include <flankfilm/table.h>

#include <math.h>
#include <stdlib.h>

static const ff_param params[] = {
    FF_QUANTITY("nu_40", "cSt", lubricant_oil, nu_40, FF_REQUIRED, NULL, "viscosity", 0.5, 1e5, 2,
                5000, "kinematic viscosity at 40 degC; with nu_100"),
    FF_PATH("file", lubricant_oil, file, FF_REQUIRED, "viscosity",
            "table with the columns temperature [degC] and viscosity [mPa s] or "
            "kinematic_viscosity [cSt]; optional columns: density [kg/m3], conductivity [W/(m K)], "
            "heat_capacity [J/(kg K)], alpha [1/GPa]"),
    FF_QUANTITY("eta0", "mPa s", lubricant_oil, eta0, FF_REQUIRED | FF_MIN_OPEN, NULL, "viscosity",
                0, 1e9, 0.1, 1e5,
                "dynamic viscosity at the temperature `at`; the oil is then known at that "
                "temperature only"),
    FF_QUANTITY("nu_100", "cSt", lubricant_oil, nu_100, 0, NULL, NULL, 0.5, 1e4, 1, 500,
                "kinematic viscosity at 100 degC; with nu_40"),
    FF_QUANTITY("at", "degC", lubricant_oil, at, 0, NULL, NULL, -120, 400, -60, 250,
                "temperature of eta0"),
    FF_QUANTITY("density_15", "kg/m3", lubricant_oil, density_15, 0, NULL, "density", 500, 2500,
                800, 1164, "density at 15 degC; it decreases with temperature by ASTM D1250"),
    FF_QUANTITY("density", "kg/m3", lubricant_oil, density, 0, NULL, "density", 400, 2500, 700,
                1164, "density at the temperature `at`; with eta0"),
    FF_QUANTITY("expansion", "1/K", lubricant_oil, expansion, 0, NULL, NULL, 0, 0.01, 4e-4, 1.2e-3,
                "constant thermal expansion coefficient, instead of ASTM D1250"),
    FF_ONE_OF(LUBRICANT_BASES, "base", lubricant_oil, base, 0, NULL,
              "base oil, which gives the pressure coefficient and the thermal data that are not "
              "measured; left out: they are unknown"),
    LUBRICANT_ROWS,
};

/* Columns of the file. DENSITY and the columns after it have the order of the properties of a
   liquid from FF_LIQUID_RHO0 on. */
enum { TEMPERATURE, VISCOSITY, KINEMATIC, DENSITY };

static const ff_param columns[] = {
    {.name = "temperature",
     .unit = "degC",
     .doc = "temperature of the oil",
     .type = FF_REALS,
     .flags = FF_REQUIRED | FF_INCREASING,
     .min = -120,
     .max = 400,
     .max_count = 10000},
    {.name = "viscosity",
     .unit = "mPa s",
     .doc = "dynamic viscosity",
     .type = FF_REALS,
     .flags = FF_REQUIRED | FF_MIN_OPEN,
     .group = "viscosity",
     .max = 1e9},
    {.name = "kinematic_viscosity",
     .unit = "cSt",
     .doc = "kinematic viscosity",
     .type = FF_REALS,
     .flags = FF_REQUIRED,
     .group = "viscosity",
     .min = 0.21,
     .max = 2e7},
    {.name = "density",
     .unit = "kg/m3",
     .doc = "density; without this column density_15 is needed",
     .type = FF_REALS,
     .min = 400,
     .max = 2500},
    {.name = "conductivity",
     .unit = "W/(m K)",
     .doc = "thermal conductivity",
     .type = FF_REALS,
     .flags = FF_MIN_OPEN,
     .max = 100},
    {.name = "heat_capacity",
     .unit = "J/(kg K)",
     .doc = "specific heat",
     .type = FF_REALS,
     .flags = FF_MIN_OPEN,
     .max = 1e5},
    {.name = "alpha",
     .unit = "1/GPa",
     .doc = "pressure coefficient at ambient pressure",
     .type = FF_REALS,
     .flags = FF_MIN_OPEN,
     .max = 1000},
};

static ff_status density_missing(const lubricant_oil *oil, const char *why)
{
    return ff_failf(oil->host, FF_INVALID, "density_15",
                    "the density of the oil is missing: give density_15%s", why);
}

/* Refuses parameters that do not belong to the parameters by which the viscosity is given. */
static ff_status check_companions(const lubricant_oil *oil)
{
    const ff_host *host = oil->host;
    if (isnan(oil->nu_40) != isnan(oil->nu_100))
        return ff_failf(host, FF_INVALID, isnan(oil->nu_40) ? "nu_100" : "nu_40",
                        "nu_40 and nu_100 belong together");
    if (isnan(oil->eta0) != isnan(oil->at))
        return ff_failf(host, FF_INVALID, isnan(oil->eta0) ? "at" : "eta0",
                        "eta0 needs its temperature: give eta0 and at");
    if (!isnan(oil->density) && isnan(oil->at))
        return ff_failf(host, FF_INVALID, "density",
                        "density holds at the temperature `at` of eta0, which is not given: give "
                        "density_15 instead");
    return FF_OK;
}

/* Returns the density at 15 degC that gives `density` at T by ASTM D1250 or by constant
 * expansion. */
static double density_15_from(const lubricant_oil *oil, double T)
{
    double density_15 = oil->density, here, slope;
    if (!isnan(oil->expansion))
        return oil->density * exp(oil->expansion * (T - 288.15));
    for (int i = 0; i < 60; i++) {
        lubricant_d1250_density(density_15, 1, &T, &here, &slope);
        density_15 *= oil->density / here;
    }
    return density_15;
}

static ff_status from_one_point(lubricant_oil *oil)
{
    double x = log(oil->at);
    if (!isnan(oil->density))
        oil->density_15 = density_15_from(oil, oil->at);
    if (isnan(oil->density_15))
        return density_missing(oil, ", or density at the temperature of eta0");
    if (isnan(oil->alpha_at) && !isnan(oil->alpha))
        oil->alpha_at = oil->at;
    double nu = oil->eta0 / lubricant_density(oil, oil->at), y = lubricant_d341_ordinate(nu);
    if (!(nu >= LUBRICANT_D341_LEAST && nu <= LUBRICANT_D341_MOST))
        return ff_failf(oil->host, FF_INVALID, "eta0",
                        "the kinematic viscosity is %g cSt; ASTM D341 covers 0.21 to 2e7 cSt",
                        1e6 * nu);
    oil->low = oil->high = oil->at;
    return lubricant_curve_make(&oil->viscosity, 1, &x, &y) ? lubricant_oil_ready(oil) : FF_NOMEM;
}

static ff_status take_tables(lubricant_oil *oil, const ff_table *file)
{
    const double *T = file->columns[TEMPERATURE];
    for (size_t i = 0; i < 4; i++) {
        const double *column = file->columns[DENSITY + i];
        if (column && !lubricant_curve_make(&oil->tables[i], file->row_count, T, column))
            return FF_NOMEM;
    }
    return FF_OK;
}

/* Converts the viscosity of each row into a point of the curve. */
static ff_status take_viscosity(lubricant_oil *oil, const ff_table *file, double *x, double *y)
{
    const double *const *column = file->columns;
    size_t which = column[VISCOSITY] ? VISCOSITY : KINEMATIC;
    for (size_t i = 0; i < file->row_count; i++) {
        double T = column[TEMPERATURE][i], value = column[which][i], nu = value;
        if (which == VISCOSITY)
            nu /= lubricant_density(oil, T);
        if (!(nu >= LUBRICANT_D341_LEAST && nu <= LUBRICANT_D341_MOST))
            return ff_table_failf(oil->host, file, i, which,
                                  "%g cSt; ASTM D341 covers 0.21 to 2e7 cSt", 1e6 * nu);
        x[i] = log(T);
        y[i] = lubricant_d341_ordinate(nu);
        if (i && !(x[i] > x[i - 1]))
            return ff_table_failf(oil->host, file, i, TEMPERATURE,
                                  "this temperature appears twice");
        if (i && !(y[i] < y[i - 1]))
            return ff_table_failf(oil->host, file, i, which,
                                  "the viscosity of an oil must decrease with temperature");
    }
    return FF_OK;
}

static ff_status from_file(lubricant_oil *oil)
{
    const ff_table *file;
    ff_status status = ff_table_read(oil->host, "file", oil->file, FF_TABLE(columns), &file);
    if (status != FF_OK)
        return status;
    size_t n = file->row_count;
    if (!file->columns[DENSITY] && isnan(oil->density_15))
        return density_missing(oil, ", or a column density");
    if (file->columns[DENSITY] && !(isnan(oil->density_15) && isnan(oil->expansion)))
        return ff_failf(oil->host, FF_INVALID, isnan(oil->density_15) ? "expansion" : "density_15",
                        "the table already has a column density");
    status = take_tables(oil, file);
    if (status == FF_OK && file->columns[DENSITY])
        oil->density_15 = lubricant_density(oil, 288.15);
    oil->low = file->columns[TEMPERATURE][0];
    oil->high = file->columns[TEMPERATURE][n - 1];
    double *points = malloc(2 * n * sizeof *points);
    if (!points)
        return FF_NOMEM;
    if (status == FF_OK)
        status = take_viscosity(oil, file, points, points + n);
    if (status == FF_OK && !lubricant_curve_make(&oil->viscosity, n, points, points + n))
        status = FF_NOMEM;
    free(points);
    return status == FF_OK ? lubricant_oil_ready(oil) : status;
}

static ff_status ready(void *self)
{
    lubricant_oil *oil = self;
    ff_status status = check_companions(oil);
    if (status != FF_OK)
        return status;
    if (oil->file)
        return from_file(oil);
    if (!isnan(oil->eta0))
        return from_one_point(oil);
    if (isnan(oil->nu_40))
        return ff_failf(oil->host, FF_INVALID, "nu_40",
                        "the viscosity is missing: nu_40 and nu_100, file, or eta0 and at");
    if (isnan(oil->density_15))
        return density_missing(oil, "; the dynamic viscosity is eta0 = nu rho");
    return lubricant_oil_ready_from(oil, oil->nu_40, oil->nu_100);
}

FF_MODEL(lubricant_measured, lubricant_oil, .id = "lubricant/measured", .version = "1.0.0",
         .summary = "an oil from its data sheet or from measurements, as a function of temperature",
         .reference = LUBRICANT_REFERENCE, .bibtex = LUBRICANT_BIBTEX,
         .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
         .inputs = FF_TABLE(lubricant_inputs), .outputs = FF_TABLE(lubricant_outputs),
         .ready = ready, .evaluate = lubricant_evaluate, .service = lubricant_service,
         .destroy = lubricant_destroy, .columns = FF_TABLE(columns));
