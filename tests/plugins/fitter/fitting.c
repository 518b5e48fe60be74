/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fitting.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void set_all(stage *s, const char *const *params)
{
    for (; *params; params += 2)
        stage_set_text(s, params[0], params[1]);
}

void fitting_truth(const char *id, const char *const *params, size_t n, const double *p,
                   double *ln_eta)
{
    stage *s = stage_open(id);
    set_all(s, params);
    const ff_viscosity *law = stage_service(s, FF_VISCOSITY_ID);
    law->eval(law->self, n, p, NULL, ln_eta, NULL, NULL);
    stage_close(s);
}

static const void *open_law(void *ctx, size_t law, const double *values)
{
    fitting *f = ctx;
    (void)law;
    if (f->law)
        stage_close(f->law);
    f->law = stage_open(f->id);
    set_all(f->law, f->hold);
    for (size_t i = 0; i < f->count; i++)
        if (!isnan(values[i]))
            stage_set(f->law, f->params[i].row->name, values[i]);
    return stage_ready(f->law) == FF_OK ? stage_service(f->law, FF_VISCOSITY_ID) : NULL;
}

static const char *why(void *ctx)
{
    const fitting *f = ctx;
    return f->law ? stage_why(f->law) : "";
}

static ff_status refuse(void *ctx, size_t row, size_t column, const char *text)
{
    fitting *f = ctx;
    (void)row, (void)column;
    snprintf(f->refusal, sizeof f->refusal, "%s", text);
    return FF_INVALID;
}

static void take(void *ctx, const ff_fit_found *found)
{
    fitting *f = ctx;
    f->told++;
    f->found = *found;
    snprintf(f->why, sizeof f->why, "%s", found->why ? found->why : "");
    snprintf(f->note, sizeof f->note, "%s", found->note);
    for (size_t i = 0; !found->why && i < f->count; i++)
        f->values[i] = *found->values[i];
}

static void ignore(void *ctx, const char *name, const char *text)
{
    (void)ctx, (void)name, (void)text;
}

/* Factor to SI of the units that the rows of the laws here are written in. */
static double factor_of(const char *unit)
{
    static const struct {
        const char *unit;
        double factor;
    } known[] = {{"GPa", 1e9}, {"1/GPa", 1e-9}, {"MPa", 1e6}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (!strcmp(known[i].unit, unit))
            return known[i].factor;
    return 1;
}

void fitting_open(fitting *f)
{
    f->fitter = stage_open("fitter/viscosity");
    stage *law = stage_open(f->id);
    const ff_param *row;
    while ((row = stage_param(law, f->count))) {
        f->params[f->count] = (ff_fit_param){.size = sizeof *f->params,
                                             .row = row,
                                             .factor = factor_of(row->unit),
                                             .said = FF_FIT_UNSAID,
                                             .value = NAN};
        for (size_t k = 0; f->hold[k]; k += 2)
            if (!strcmp(f->hold[k], row->name))
                f->params[f->count].said = FF_FIT_HELD;
        f->rows[f->count] = &f->params[f->count];
        f->count++;
    }
    stage_close(law);
}

void fitting_close(fitting *f)
{
    if (f->law)
        stage_close(f->law);
    stage_close(f->fitter);
}

ff_status fitting_run(fitting *f, const points *data)
{
    const ff_fitter *fitter = stage_service(f->fitter, FF_FITTER_ID);
    const double *columns[] = {data->p, data->eta, data->T, data->uncertainty, data->weight};
    const double at[] = {NAN, NAN, NAN, NAN, NAN};
    const ff_fit_law law = {
        .size = sizeof law, .id = f->id, .params = f->rows, .param_count = f->count};
    const ff_fit_law *laws[] = {&law};
    const ff_fit fit = {
        .size = sizeof fit,
        .ctx = f,
        .source = "numbers",
        .row_count = data->n,
        .columns = columns,
        .at = at,
        .laws = laws,
        .law_count = 1,
        .open = open_law,
        .why = why,
        .refuse = refuse,
        .found = take,
        .file = ignore,
    };
    return fitter->fit(fitter->self, &fit);
}

const ff_fit_value *fitting_value(const fitting *f, const char *param)
{
    for (size_t i = 0; i < f->count; i++)
        if (!strcmp(f->params[i].row->name, param))
            return &f->values[i];
    fprintf(stderr, "no parameter %s\n", param);
    exit(2);
}

/* Splitmix64, then Box and Muller. */
static double uniform(uint64_t *state)
{
    uint64_t z = *state += UINT64_C(0x9E3779B97F4A7C15);
    z = (z ^ z >> 30) * UINT64_C(0xBF58476D1CE4E5B9);
    z = (z ^ z >> 27) * UINT64_C(0x94D049BB133111EB);
    return ((double)((z ^ z >> 31) >> 11) + 0.5) * 0x1p-53;
}

double fitting_normal(uint64_t *state)
{
    double radius = sqrt(-2 * log(uniform(state)));
    return radius * cos(6.283185307179586 * uniform(state));
}
