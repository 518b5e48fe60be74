/* SPDX-License-Identifier: GPL-3.0-or-later */
/* lubricant/measured: an oil from its data sheet or from measurements. */
#include "base-oil.h"
#include "liquid.h"

#include <flankfilm/table.h>

#include <math.h>
#include <stdlib.h>

typedef struct measured {
    lubricant_oil oil;
    double nu_40, nu_100, eta0, at, density;
    const char *file;
} measured;

static const ff_param params[] = {
    FF_QUANTITY("nu_40", "cSt", measured, nu_40, FF_REQUIRED, NULL, "viscosity", 0.5, 1e5, 2, 5000,
                "kinematic viscosity at 40 degC, beside nu_100"),
    FF_PATH("file", measured, file, FF_REQUIRED, "viscosity",
            "table with the columns temperature [degC] and viscosity [mPa s] or "
            "kinematic_viscosity [cSt], and what is measured of density [kg/m3], conductivity "
            "[W/(m K)], heat_capacity [J/(kg K)] and alpha [1/GPa]"),
    FF_QUANTITY("eta0", "mPa s", measured, eta0, FF_REQUIRED | FF_MIN_OPEN, NULL, "viscosity", 0,
                1e9, 0.1, 1e5,
                "dynamic viscosity at the temperature `at`, which alone the oil then serves"),
    FF_QUANTITY("nu_100", "cSt", measured, nu_100, 0, NULL, NULL, 0.5, 1e4, 1, 500,
                "kinematic viscosity at 100 degC, beside nu_40"),
    FF_QUANTITY("at", "degC", measured, at, 0, NULL, NULL, -120, 400, -60, 250,
                "temperature of eta0"),
    FF_QUANTITY("density_15", "kg/m3", measured, oil.density_15, 0, NULL, "density", 500, 2500, 800,
                1164, "density at 15 degC; it falls with temperature by ASTM D1250"),
    FF_QUANTITY("density", "kg/m3", measured, density, 0, NULL, "density", 400, 2500, 700, 1164,
                "density at the temperature `at`, beside eta0"),
    FF_QUANTITY("expansion", "1/K", measured, oil.expansion, 0, NULL, NULL, 0, 0.01, 4e-4, 1.2e-3,
                "constant thermal expansion, in place of ASTM D1250"),
    FF_ONE_OF(LUBRICANT_BASES, "base", measured, oil.base, 0, NULL,
              "base oil, for the pressure coefficient and the thermal data that are not measured; "
              "without it they are not known"),
    LUBRICANT_ROWS(measured),
};

/* Columns of the file; those from DENSITY on by property. */
enum { TEMPERATURE, VISCOSITY, KINEMATIC, DENSITY };

static const ff_param columns[] = {
    {.name = "temperature",
     .unit = "degC",
     .doc = "of the oil",
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
     .doc = "density; without the column density_15 is needed",
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

static ff_status create(const ff_host *host, void **self)
{
    ff_status status = lubricant_create(host, sizeof(measured), self);
    measured *m = status == FF_OK ? *self : NULL;
    if (m)
        m->nu_40 = m->nu_100 = m->eta0 = m->at = m->density = NAN;
    return status;
}

static ff_status density_missing(const measured *m, const char *why)
{
    return ff_failf(m->oil.host, FF_INVALID, "density_15",
                    "the density of the oil is missing: give density_15%s", why);
}

/* What belongs to another way to give the viscosity is refused, not ignored. */
static ff_status check_companions(const measured *m)
{
    const ff_host *host = m->oil.host;
    if (isnan(m->nu_40) != isnan(m->nu_100))
        return ff_failf(host, FF_INVALID, isnan(m->nu_40) ? "nu_100" : "nu_40",
                        "nu_40 and nu_100 belong together");
    if (isnan(m->eta0) != isnan(m->at))
        return ff_failf(host, FF_INVALID, isnan(m->eta0) ? "at" : "eta0",
                        "eta0 needs the temperature that it holds at: eta0 and at");
    if (!isnan(m->density) && isnan(m->at))
        return ff_failf(host, FF_INVALID, "density",
                        "density is that at the temperature `at`, which belongs to eta0; here "
                        "give density_15");
    return FF_OK;
}

/* The density at 15 degC that ASTM D1250, or the constant expansion, turns into `density` at T. */
static double density_15_from(const measured *m, double T)
{
    double density_15 = m->density, slope;
    if (!isnan(m->oil.expansion))
        return m->density * exp(m->oil.expansion * (T - 288.15));
    for (int i = 0; i < 60; i++)
        density_15 *= m->density / lubricant_d1250_density(density_15, T, &slope);
    return density_15;
}

static ff_status from_one_point(measured *m)
{
    lubricant_oil *oil = &m->oil;
    double x = log(m->at);
    if (!isnan(m->density))
        oil->density_15 = density_15_from(m, m->at);
    if (isnan(oil->density_15))
        return density_missing(m, ", or density at the temperature of eta0");
    if (isnan(oil->alpha_at) && !isnan(oil->alpha))
        oil->alpha_at = m->at;
    double nu = m->eta0 / lubricant_density(oil, m->at), y = lubricant_d341_ordinate(nu);
    if (!(nu >= LUBRICANT_D341_LEAST && nu <= LUBRICANT_D341_MOST))
        return ff_failf(oil->host, FF_INVALID, "eta0",
                        "the kinematic viscosity is %g cSt; ASTM D341 knows 0.21 to 2e7 cSt",
                        1e6 * nu);
    oil->low = oil->high = m->at;
    return lubricant_curve_make(&oil->viscosity, 1, &x, &y) ? lubricant_oil_ready(oil) : FF_NOMEM;
}

static ff_status take_tables(measured *m, const ff_table *file)
{
    const double *T = file->columns[TEMPERATURE];
    for (size_t i = 0; i < 4; i++) {
        const double *column = file->columns[DENSITY + i];
        if (column && !lubricant_curve_make(&m->oil.tables[i], file->row_count, T, column))
            return FF_NOMEM;
    }
    return FF_OK;
}

/* The viscosity of each row as a point of the curve. */
static ff_status take_viscosity(measured *m, const ff_table *file, double *x, double *y)
{
    const double *const *column = file->columns;
    size_t which = column[VISCOSITY] ? VISCOSITY : KINEMATIC;
    for (size_t i = 0; i < file->row_count; i++) {
        double T = column[TEMPERATURE][i], value = column[which][i], nu = value;
        if (which == VISCOSITY)
            nu /= lubricant_density(&m->oil, T);
        if (!(nu >= LUBRICANT_D341_LEAST && nu <= LUBRICANT_D341_MOST))
            return ff_table_failf(m->oil.host, file, i, which,
                                  "%g cSt; ASTM D341 knows 0.21 to 2e7 cSt", 1e6 * nu);
        x[i] = log(T);
        y[i] = lubricant_d341_ordinate(nu);
        if (i && !(x[i] > x[i - 1]))
            return ff_table_failf(m->oil.host, file, i, TEMPERATURE, "a temperature stands twice");
        if (i && !(y[i] < y[i - 1]))
            return ff_table_failf(m->oil.host, file, i, which,
                                  "the viscosity of an oil falls with temperature");
    }
    return FF_OK;
}

static ff_status from_file(measured *m)
{
    lubricant_oil *oil = &m->oil;
    const ff_table *file;
    ff_status status = ff_table_read(oil->host, "file", m->file, FF_TABLE(columns), &file);
    if (status != FF_OK)
        return status;
    size_t n = file->row_count;
    if (!file->columns[DENSITY] && isnan(oil->density_15))
        return density_missing(m, ", or a column density");
    if (file->columns[DENSITY] && !(isnan(oil->density_15) && isnan(oil->expansion)))
        return ff_failf(oil->host, FF_INVALID, isnan(oil->density_15) ? "expansion" : "density_15",
                        "the table has a column density already");
    status = take_tables(m, file);
    if (status == FF_OK && file->columns[DENSITY])
        oil->density_15 = lubricant_density(oil, 288.15);
    oil->low = file->columns[TEMPERATURE][0];
    oil->high = file->columns[TEMPERATURE][n - 1];
    double *points = malloc(2 * n * sizeof *points);
    if (!points)
        return FF_NOMEM;
    if (status == FF_OK)
        status = take_viscosity(m, file, points, points + n);
    if (status == FF_OK && !lubricant_curve_make(&oil->viscosity, n, points, points + n))
        status = FF_NOMEM;
    free(points);
    return status == FF_OK ? lubricant_oil_ready(oil) : status;
}

static ff_status ready(void *self)
{
    measured *m = self;
    ff_status status = check_companions(m);
    if (status != FF_OK)
        return status;
    if (m->file)
        return from_file(m);
    if (!isnan(m->eta0))
        return from_one_point(m);
    if (isnan(m->nu_40))
        return ff_failf(m->oil.host, FF_INVALID, "nu_40",
                        "the viscosity is missing: nu_40 and nu_100, file, or eta0 and at");
    if (isnan(m->oil.density_15))
        return density_missing(m, "; the film is made by eta0 = nu rho");
    return lubricant_oil_ready_from(&m->oil, m->nu_40, m->nu_100);
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    return lubricant_set(self, &params[param], value);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "lubricant/measured",
    .version = "1.0.0",
    .summary = "an oil from its data sheet or from measurements, over temperature",
    .reference = lubricant_reference,
    .bibtex = lubricant_bibtex,
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .inputs = FF_TABLE(lubricant_inputs),
    .outputs = FF_TABLE(lubricant_outputs),
    .create = create,
    .set = set,
    .ready = ready,
    .evaluate = lubricant_evaluate,
    .service = lubricant_service,
    .destroy = lubricant_destroy,
    .columns = FF_TABLE(columns),
    .self_size = sizeof(measured),
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
