/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the measured points: their columns, the requested conditions, and the rows to be fitted. */
#include "fit.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>

/* Rows whose temperatures differ by less than this, in K, belong to one isotherm. */
static const double ISOTHERM = 0.5;

enum { MOST_ROWS = 10000 };

static const ff_param columns[FIT_COLUMNS] = {
    [FIT_PRESSURE] = {.name = "pressure",
                      .unit = "GPa",
                      .type = FF_REAL,
                      .doc = "above ambient",
                      .flags = FF_REQUIRED,
                      .min = -1e-4,
                      .max = 100},
    [FIT_VISCOSITY] = {.name = "viscosity",
                       .unit = "mPa s",
                       .type = FF_REAL,
                       .doc = "dynamic, at low shear",
                       .flags = FF_REQUIRED | FF_MIN_OPEN,
                       .max = 1e18},
    [FIT_TEMPERATURE] = {.name = "temperature",
                         .unit = "degC",
                         .type = FF_REAL,
                         .doc = "of the liquid",
                         .min = -150,
                         .max = 1000},
    [FIT_UNCERTAINTY] = {.name = "uncertainty",
                         .unit = "%",
                         .type = FF_REAL,
                         .doc = "standard uncertainty of the viscosity",
                         .flags = FF_MIN_OPEN,
                         .group = "weight",
                         .max = 1000},
    [FIT_WEIGHT] = {.name = "weight",
                    .unit = "1",
                    .type = FF_REAL,
                    .doc = "of the row",
                    .flags = FF_MIN_OPEN,
                    .group = "weight",
                    .max = 1e12},
};

/* Writes the temperature of each isotherm once, in degC: "40, 80, 100". */
static void list_isotherms(const double *T, size_t n, char *out, size_t size)
{
    size_t at = 0;
    out[0] = 0;
    for (size_t i = 0; i < n && at + 20 < size; i++) {
        size_t k = 0;
        while (k < i && fabs(T[k] - T[i]) > ISOTHERM)
            k++;
        if (k == i)
            at += (size_t)snprintf(out + at, size - at, "%s%.4g", at ? ", " : "", T[i] - 273.15);
    }
}

/* Copies the rows at the requested temperature, or all rows if none was requested. */
static void copy_rows(const fit *f, fit_data *d)
{
    const double *T = f->table->columns[FIT_TEMPERATURE];
    for (size_t i = 0; i < f->table->row_count; i++) {
        if (T && fabs(T[i] - f->at[FIT_TEMPERATURE]) > ISOTHERM)
            continue; /* the comparison is false for NaN, so without a requested temperature no
                         row is left out */
        d->row[d->n] = i;
        d->p[d->n] = f->table->columns[FIT_PRESSURE][i];
        d->ln_eta[d->n] = log(f->table->columns[FIT_VISCOSITY][i]);
        if (T)
            d->T[d->n] = T[i];
        d->highest = d->n ? fmax(d->highest, d->p[d->n]) : d->p[0];
        d->n++;
    }
}

/* The weights are 1/u^2, or as given, or 1, scaled to a mean of 1. */
static void compute_weights(const fit *f, fit_data *d)
{
    const double *u = f->table->columns[FIT_UNCERTAINTY], *w = f->table->columns[FIT_WEIGHT];
    double sum = 0;
    for (size_t i = 0; i < d->n; i++) {
        d->root[i] = u ? 1 / u[d->row[i]] : w ? sqrt(w[d->row[i]]) : 1;
        sum += d->root[i] * d->root[i];
    }
    double mean = sqrt(sum / (double)d->n);
    for (size_t i = 0; i < d->n; i++)
        d->root[i] /= mean;
    d->uncertain = u != NULL;
    d->uncertainty = 1 / mean;
}

static void find_temperature(fit_data *d)
{
    double low = HUGE_VAL, high = -HUGE_VAL, sum = 0;
    for (size_t i = 0; d->T && i < d->n; i++) {
        low = fmin(low, d->T[i]);
        high = fmax(high, d->T[i]);
        sum += d->T[i];
    }
    d->isothermal = !d->T || high - low <= 2 * ISOTHERM;
    d->temperature = d->T && d->isothermal ? sum / (double)d->n : NAN;
}

/* Returns a number with the sign of the slope of ln(eta) against pressure. */
static double covariance(const fit_data *d)
{
    double p = 0, ln_eta = 0, sum = 0;
    for (size_t i = 0; i < d->n; i++) {
        p += d->p[i] / (double)d->n;
        ln_eta += d->ln_eta[i] / (double)d->n;
    }
    for (size_t i = 0; i < d->n; i++)
        sum += (d->p[i] - p) * (d->ln_eta[i] - ln_eta);
    return sum;
}

static size_t find_duplicate(const fit_data *d, size_t i)
{
    size_t k = 0;
    while (k < i &&
           (d->p[k] != d->p[i] || d->ln_eta[k] != d->ln_eta[i] || (d->T && d->T[k] != d->T[i])))
        k++;
    return k;
}

static ff_place place_of(const fit *f, size_t row, size_t column)
{
    return ff_columns_place(f->table, row, column);
}

static bool check_rows(const fit *f, const fit_data *d)
{
    bool same_p = true, same_eta = true;
    for (size_t i = 0; i < d->n; i++) {
        size_t duplicate = find_duplicate(d, i);
        same_p = same_p && d->p[i] == d->p[0];
        same_eta = same_eta && fabs(d->ln_eta[i] - d->ln_eta[0]) < 1e-9;
        if (duplicate < i)
            return ff_error(f->report, FF_FAULT_INPUT, place_of(f, d->row[i], SIZE_MAX), NULL,
                            "this row repeats row %zu of the table to the last digit: a point that "
                            "counts twice would make the fit seem more certain",
                            d->row[duplicate] + 1);
    }
    if (same_p)
        return ff_error(f->report, FF_FAULT_INPUT, place_of(f, SIZE_MAX, FIT_PRESSURE), NULL,
                        "all rows have the pressure %.4g GPa: a pressure law needs several",
                        1e-9 * d->p[0]);
    if (same_eta)
        return ff_error(f->report, FF_FAULT_INPUT, place_of(f, SIZE_MAX, FIT_VISCOSITY), NULL,
                        "the viscosity is the same in all rows: there is no rise to fit");
    if (d->isothermal && covariance(d) < 0)
        return ff_error(f->report, FF_FAULT_INPUT, place_of(f, SIZE_MAX, FIT_VISCOSITY), NULL,
                        "the viscosity falls with pressure, unlike that of any oil: do the columns "
                        "contain what their names say?");
    return true;
}

static bool select_rows(fit *f)
{
    fit_data *d = &f->data;
    size_t n = f->table->row_count;
    const double *T = f->table->columns[FIT_TEMPERATURE];
    char list[120];
    if (n > MOST_ROWS)
        return ff_error(f->report, FF_FAULT_INPUT, place_of(f, SIZE_MAX, SIZE_MAX), NULL,
                        "the table has more than %d rows: average them first", MOST_ROWS);
    *d = (fit_data){.p = memory_alloc(n * sizeof(double)),
                    .T = T ? memory_alloc(n * sizeof(double)) : NULL,
                    .ln_eta = memory_alloc(n * sizeof(double)),
                    .root = memory_alloc(n * sizeof(double)),
                    .row = memory_alloc(n * sizeof(size_t))};
    copy_rows(f, d);
    if (d->n == 0) {
        list_isotherms(T, n, list, sizeof list);
        return ff_error(f->report, FF_FAULT_INPUT, place_of(f, SIZE_MAX, FIT_TEMPERATURE), NULL,
                        "no row is within %g K of %.4g degC; the data have %s degC", ISOTHERM,
                        f->at[FIT_TEMPERATURE] - 273.15, list);
    }
    find_temperature(d);
    compute_weights(f, d);
    return check_rows(f, d);
}

bool fit_read(fit *f, const char *path)
{
    char why[200];
    f->path = path;
    f->rows = columns;
    for (size_t k = 0; k < FIT_COLUMNS; k++)
        ff_unit_parse(columns[k].unit, &f->units[k], why, sizeof why);
    f->table = ff_columns_read(path, columns, FIT_COLUMNS, sizeof columns[0], f->report);
    return f->table != NULL;
}

void fit_range(const fit *f, size_t column, double *low, double *high)
{
    const double *values = f->table->columns[column];
    *low = *high = values[0];
    for (size_t i = 1; i < f->table->row_count; i++) {
        *low = fmin(*low, values[i]);
        *high = fmax(*high, values[i]);
    }
}

/* Reads a quantity of --at, which must be inside the range of the data, into the column with its
 * dimension. */
static bool set_condition(fit *f, const char *text)
{
    char why[300] = "";
    for (size_t k = 0; k < FIT_COLUMNS; k++) {
        double low, high, si;
        const ff_param *row = &f->rows[k];
        if (k == FIT_VISCOSITY || ff_unit_is_dimensionless(&f->units[k]) ||
            !ff_quantity_parse(text, &f->units[k], row->unit, &si, why, sizeof why))
            continue;
        if (!f->table->columns[k])
            return ff_error(f->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                            "--at \"%s\" asks for a %s, but the data have no such column", text,
                            row->name);
        fit_range(f, k, &low, &high);
        double slack = 1e-9 * fmax(fabs(low), fabs(high));
        f->at[k] = si;
        if (si >= low - slack && si <= high + slack)
            return true;
        char first[64], last[64];
        ff_quantity_print(low, &f->units[k], row->unit, first, sizeof first);
        ff_quantity_print(high, &f->units[k], row->unit, last, sizeof last);
        return ff_error(f->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                        "--at \"%s\" lies outside the data, whose %s ranges from %s to %s: a fit "
                        "says nothing beyond",
                        text, row->name, first, last);
    }
    return ff_error(f->report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                    "--at \"%s\" is not a quantity of the data: %s", text, why);
}

bool fit_set_conditions(fit *f, const char *const *quantities, size_t count)
{
    bool good = true;
    for (size_t k = 0; k < FIT_COLUMNS; k++)
        f->at[k] = NAN;
    for (size_t i = 0; i < count; i++)
        good = set_condition(f, quantities[i]) && good;
    return good && select_rows(f);
}
