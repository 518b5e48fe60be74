/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A law without a fault that needs a file: ln eta is linear between the points of a table. */
#include <flankfilm/author.h>
#include <flankfilm/laws.h>
#include <flankfilm/table.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const ff_param columns[] = {
    {.name = "pressure",
     .unit = "GPa",
     .doc = "pressure",
     .type = FF_REALS,
     .flags = FF_REQUIRED | FF_INCREASING,
     .max = 10,
     .high = 3,
     .min_count = 2},
    {.name = "viscosity",
     .unit = "Pa s",
     .doc = "viscosity there",
     .type = FF_REALS,
     .flags = FF_REQUIRED | FF_INCREASING | FF_MIN_OPEN,
     .max = 1e9,
     .low = 1e-3,
     .high = 1e3},
};
static const ff_param params[] = {
    {.name = "file", .unit = "", .doc = "the table", .type = FF_FILE, .flags = FF_REQUIRED}};
static const ff_port outputs[] = {
    {.name = "viscosity", .unit = "", .doc = "the law", .dims = "", .service = FF_VISCOSITY_ID}};

typedef struct law {
    ff_viscosity service;
    const ff_host *host;
    char *path;
    const ff_table *table;
} law;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const ff_table *table = ((const law *)self)->table;
    const double *pressure = table->columns[0], *eta = table->columns[1];
    (void)T;
    for (size_t i = 0; i < n; i++) {
        size_t k = 0;
        double x = fmin(fmax(p[i], -1e12), 1e12);
        while (k + 2 < table->row_count && x > pressure[k + 1])
            k++;
        double slope = log(eta[k + 1] / eta[k]) / (pressure[k + 1] - pressure[k]);
        ln_eta[i] = log(eta[k]) + slope * (x - pressure[k]);
        if (dln_dp)
            dln_dp[i] = x == p[i] ? slope : 0;
        if (dln_dT)
            dln_dT[i] = 0;
    }
    return FF_OK;
}

static ff_status create(const ff_host *host, void **self)
{
    law *l = calloc(1, sizeof *l);
    if (!l)
        return FF_NOMEM;
    l->service = (ff_viscosity){.size = sizeof l->service, .self = l, .eval = eval};
    l->host = host;
    *self = l;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    law *l = self;
    (void)param;
    l->path = malloc(strlen(value->text) + 1);
    return l->path ? (strcpy(l->path, value->text), FF_OK) : FF_NOMEM;
}

static ff_status ready(void *self)
{
    law *l = self;
    return ff_table_read(l->host, "file", l->path, FF_TABLE(columns), &l->table);
}

static const void *service(void *self, uint32_t output)
{
    (void)output;
    return &((law *)self)->service;
}

static void destroy(void *self)
{
    law *l = self;
    if (l)
        free(l->path);
    free(l);
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 1,
    .id = "viscosity/tabulated",
    .version = "1.0.0",
    .summary = "A law from a file",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(outputs),
    .create = create,
    .set = set,
    .ready = ready,
    .service = service,
    .destroy = destroy,
    .columns = FF_TABLE(columns),
};

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
