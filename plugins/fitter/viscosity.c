/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Viscosity laws from measured points of pressure, temperature and viscosity. */
#include "fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Within this many K rows are one isotherm. */
static const double SAME = 0.5;

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

typedef struct fitter {
    const ff_host *host;
    ff_fitter service;
} fitter;

static void free_data(fit_data *d)
{
    free(d->p);
    free(d->T);
    free(d->ln_eta);
    free(d->root);
    free(d->row);
}

/* "40, 80, 100" degC, each isotherm once. */
static void list_isotherms(const double *T, size_t n, char *out, size_t size)
{
    size_t at = 0;
    out[0] = 0;
    for (size_t i = 0; i < n && at + 20 < size; i++) {
        size_t k = 0;
        while (k < i && fabs(T[k] - T[i]) > SAME)
            k++;
        if (k == i)
            at += (size_t)snprintf(out + at, size - at, "%s%.4g", at ? ", " : "", T[i] - 273.15);
    }
}

/* Copies the rows of the temperature that was asked for, or all. */
static void take_rows(const ff_fit *fit, fit_data *d)
{
    const double *T = fit->columns[FIT_TEMPERATURE];
    for (size_t i = 0; i < fit->row_count; i++) {
        if (T && fabs(T[i] - fit->at[FIT_TEMPERATURE]) > SAME)
            continue; /* never where nothing was asked: NaN */
        d->row[d->n] = i;
        d->p[d->n] = fit->columns[FIT_PRESSURE][i];
        d->ln_eta[d->n] = log(fit->columns[FIT_VISCOSITY][i]);
        if (T)
            d->T[d->n] = T[i];
        d->highest = d->n ? fmax(d->highest, d->p[d->n]) : d->p[0];
        d->n++;
    }
}

/* Weights 1/u^2 or as given, scaled to a mean of 1. */
static void take_weights(const ff_fit *fit, fit_data *d)
{
    const double *u = fit->columns[FIT_UNCERTAINTY], *w = fit->columns[FIT_WEIGHT];
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

static void take_temperature(fit_data *d)
{
    double low = HUGE_VAL, high = -HUGE_VAL, sum = 0;
    for (size_t i = 0; d->T && i < d->n; i++) {
        low = fmin(low, d->T[i]);
        high = fmax(high, d->T[i]);
        sum += d->T[i];
    }
    d->isothermal = !d->T || high - low <= 2 * SAME;
    d->temperature = d->T && d->isothermal ? sum / (double)d->n : NAN;
}

static bool equal(double a, double b)
{
    return a == b;
}

/* Its sign is that of the regression of ln(eta) on pressure. */
static double slope(const fit_data *d)
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

static ff_status check_rows(const ff_fit *fit, const fit_data *d)
{
    char text[200], list[120];
    bool same_p = true, same_eta = true;
    if (d->n == 0) {
        list_isotherms(fit->columns[FIT_TEMPERATURE], fit->row_count, list, sizeof list);
        snprintf(text, sizeof text, "no row is within %g K of %.4g degC; there are %s degC", SAME,
                 fit->at[FIT_TEMPERATURE] - 273.15, list);
        return fit->refuse(fit->ctx, SIZE_MAX, FIT_TEMPERATURE, text);
    }
    for (size_t i = 0; i < d->n; i++) {
        same_p = same_p && equal(d->p[i], d->p[0]);
        same_eta = same_eta && fabs(d->ln_eta[i] - d->ln_eta[0]) < 1e-9;
        for (size_t k = 0; k < i; k++)
            if (equal(d->p[k], d->p[i]) && equal(d->ln_eta[k], d->ln_eta[i]) &&
                (!d->T || equal(d->T[k], d->T[i]))) {
                snprintf(text, sizeof text,
                         "this row repeats row %zu of the table to the last digit: a point that "
                         "counts twice would feign confidence",
                         d->row[k] + 1);
                return fit->refuse(fit->ctx, d->row[i], SIZE_MAX, text);
            }
    }
    if (same_p) {
        snprintf(text, sizeof text,
                 "all rows have the pressure %.4g GPa: a law of pressure needs several",
                 1e-9 * d->p[0]);
        return fit->refuse(fit->ctx, SIZE_MAX, FIT_PRESSURE, text);
    }
    if (same_eta)
        return fit->refuse(fit->ctx, SIZE_MAX, FIT_VISCOSITY,
                           "the viscosity is the same in all rows: there is no rise to fit");
    if (d->isothermal && slope(d) < 0)
        return fit->refuse(
            fit->ctx, SIZE_MAX, FIT_VISCOSITY,
            "the viscosity falls with pressure, which no oil's does: are the columns "
            "what they say?");
    return FF_OK;
}

static ff_status read_data(const ff_fit *fit, fit_data *d)
{
    size_t n = fit->row_count + 1;
    *d = (fit_data){.p = calloc(n, sizeof(double)),
                    .T = fit->columns[FIT_TEMPERATURE] ? calloc(n, sizeof(double)) : NULL,
                    .ln_eta = calloc(n, sizeof(double)),
                    .root = calloc(n, sizeof(double)),
                    .row = calloc(n, sizeof(size_t))};
    if (!d->p || !d->ln_eta || !d->root || !d->row || (!d->T && fit->columns[FIT_TEMPERATURE]))
        return FF_NOMEM;
    if (fit->row_count > FIT_MOST_ROWS)
        return fit->refuse(fit->ctx, SIZE_MAX, SIZE_MAX,
                           "the table has more than 10000 rows: average them first");
    take_rows(fit, d);
    take_temperature(d);
    ff_status status = check_rows(fit, d);
    if (status != FF_OK)
        return status;
    take_weights(fit, d);
    return FF_OK;
}

static void tell(const ff_fit *fit, const fit_data *d, const fit_regression *r)
{
    const ff_fit_found found = {
        .size = sizeof found,
        .law = r->law,
        .why = *r->why ? r->why : NULL,
        .values = r->value_rows,
        .correlation = r->correlation,
        .free_count = r->free_count,
        .rms = r->rms,
        .largest = r->largest,
        .largest_row = d->row[r->largest_row],
        .criterion = r->criterion,
        .asked = r->asked,
        .note = r->note,
    };
    fit->found(fit->ctx, &found);
}

static void write(const ff_fit *fit, const char *name, char *text)
{
    if (text)
        fit->file(fit->ctx, name, text);
    free(text);
}

static ff_status fit_laws(void *self, const ff_fit *fit)
{
    fitter *f = self;
    fit_data data;
    fit_regression *laws = calloc(fit->law_count + 1, sizeof *laws);
    bool any = false;
    ff_status status = read_data(fit, &data);
    if (!laws)
        status = FF_NOMEM;
    for (size_t i = 0; status == FF_OK && i < fit->law_count; i++) {
        laws[i].law = i;
        any = fit_regress(fit, &data, &laws[i]) || any;
        tell(fit, &data, &laws[i]);
        if (f->host->progress(f->host->ctx, (double)(i + 1) / (double)fit->law_count))
            status = FF_STOPPED;
    }
    if (status == FF_OK && any) {
        write(fit, "card.yaml", fit_card(fit, &data, laws));
        write(fit, "residuals.csv", fit_residual_table(fit, &data, laws));
        write(fit, "residuals.svg", fit_residual_plot(fit, &data, laws));
    }
    for (size_t i = 0; laws && i < fit->law_count; i++) {
        free(laws[i].values);
        free(laws[i].value_rows);
        free(laws[i].correlation);
        free(laws[i].residual);
    }
    free(laws);
    free_data(&data);
    return status;
}

static ff_status create(const ff_host *host, void **self)
{
    fitter *f = calloc(1, sizeof *f);
    if (!f)
        return FF_NOMEM;
    f->host = host;
    f->service = (ff_fitter){
        .size = sizeof f->service,
        .self = f,
        .columns = columns,
        .column_count = FIT_COLUMNS,
        .column_stride = sizeof columns[0],
        .quantity = FIT_VISCOSITY,
        .service = FF_VISCOSITY_ID,
        .laws = "viscosity/barus|viscosity/two-slope|viscosity/roelands|viscosity/doolittle-tait",
        .criterion = "AICc",
        .fit = fit_laws,
    };
    *self = f;
    return FF_OK;
}

static const void *service(void *self, uint32_t output)
{
    const fitter *f = self;
    return output == 0 ? &f->service : NULL;
}

static void destroy(void *self)
{
    free(self);
}

static const ff_port outputs[] = {{.name = "fitter",
                                   .unit = "",
                                   .doc = "finds the parameters of laws",
                                   .dims = "",
                                   .service = FF_FITTER_ID}};

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "fitter/viscosity",
    .version = "1.0.0",
    .summary = "parameters of viscosity laws from measured data, with their confidence",
    .reference = "Hurvich & Tsai 1989, Biometrika 76, 297-307 (the criterion AICc)",
    .bibtex = "@article{HurvichTsai1989, author={Hurvich, C. M. and Tsai, C.-L.}, "
              "title={Regression and time series model selection in small samples}, "
              "journal={Biometrika}, volume={76}, pages={297--307}, year={1989}}",
    .licence = "GPL-3.0-or-later",
    .params = FF_NO_TABLE,
    .inputs = FF_NO_TABLE,
    .outputs = FF_TABLE(outputs),
    .create = create,
    .service = service,
    .destroy = destroy,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
