/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "fitting.h"
#include "check.h"

#include <flankfilm/viscosity.h>
#include <stage.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

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

static void write_column(FILE *out, const char *separator, const double *values, size_t i)
{
    if (values)
        fprintf(out, "%s%.17g", separator, values[i]);
}

/* The data as a file, to the last digit. */
static void write_data(const char *path, const points *data)
{
    FILE *out = fopen(path, "w");
    if (!out) {
        perror(path);
        exit(2);
    }
    fprintf(out, "pressure [Pa],viscosity [Pa s]%s%s%s\n", data->T ? ",temperature [K]" : "",
            data->uncertainty ? ",uncertainty [1]" : "", data->weight ? ",weight" : "");
    for (size_t i = 0; i < data->n; i++) {
        write_column(out, "", data->p, i);
        write_column(out, ",", data->eta, i);
        write_column(out, ",", data->T, i);
        write_column(out, ",", data->uncertainty, i);
        write_column(out, ",", data->weight, i);
        fputc('\n', out);
    }
    fclose(out);
}

typedef struct work {
    void (*checks)(void);
} work;

static void run_checks(void *ctx)
{
    const work *w = ctx;
    w->checks();
}

int fitting_test(void (*checks)(void))
{
    work w = {checks};
    check_true("memory for all checks", ff_protected(run_checks, &w) == FF_OK);
    return check_done();
}

static void forget(fitting *f)
{
    if (f->report)
        fit_free(&f->fit);
    ff_report_free(f->report);
}

bool fitting_run(fitting *f, const points *data)
{
    const char *plugins = getenv("FLANKFILM_TEST_PLUGINS");
    char path[] = "/tmp/fitting-XXXXXX";
    int file = mkstemp(path);
    size_t held = 0;
    if (file >= 0)
        close(file);
    write_data(path, data);
    ff_engine_options options = {
        .size = sizeof options, .plugin_paths = &plugins, .plugin_path_count = 1};
    if (!f->engine && ff_engine_new(&options, &f->engine) != FF_OK)
        return false;
    forget(f);
    f->report = ff_report_new();
    f->fit = (fit){.report = f->report};
    while (f->hold[held])
        held++;
    bool good = fit_read(&f->fit, path) && fit_add_laws(&f->fit, f->engine, &f->id, 1) &&
                fit_set(&f->fit, f->engine, f->hold, held) &&
                fit_set_conditions(&f->fit, NULL, 0) && fit_run(&f->fit);
    f->law = f->fit.laws;
    unlink(path);
    return good;
}

void fitting_close(fitting *f)
{
    forget(f);
    ff_engine_close(f->engine);
}

const fit_param *fitting_param(const fitting *f, const char *name)
{
    for (size_t i = 0; i < f->law->param_count; i++)
        if (!strcmp(f->law->params[i].row->name, name))
            return &f->law->params[i];
    fprintf(stderr, "no parameter %s\n", name);
    exit(2);
}

bool fitting_says(const fitting *f, const char *part)
{
    for (size_t i = 0; i < ff_report_count(f->report); i++)
        if (strstr(ff_report_at(f->report, i)->text, part))
            return true;
    return false;
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
