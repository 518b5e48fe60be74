/* SPDX-License-Identifier: GPL-3.0-or-later */
/* contact/table: the history of a line contact from a file, instant by instant. */
#include "history.h"

#include <flankfilm/table.h>

#include <stdlib.h>
#include <string.h>

enum { P_FILE, P_REDUCED_MODULUS, P_ELASTIC_MODULUS, P_POISSON_RATIO, PARAM_COUNT };

/* Columns of the file. */
enum { TIME, RADIUS, RADIUS_1, RADIUS_2, SPEED_1, SPEED_2, LOAD, GAP };

static const ff_param columns[] = {
    [TIME] = {.name = "time",
              .unit = "s",
              .doc = "of the instant",
              .type = FF_REALS,
              .flags = FF_REQUIRED | FF_INCREASING,
              .max_count = 1000000},
    [RADIUS] = {.name = "radius",
                .unit = "mm",
                .doc = "equivalent radius of the contact, or both radii",
                .type = FF_REALS,
                .flags = FF_REQUIRED,
                .group = "radius",
                .min = 1e-6,
                .max = 1e9},
    [RADIUS_1] = {.name = "radius_1",
                  .unit = "mm",
                  .doc = "radius of body 1, beside radius_2",
                  .type = FF_REALS,
                  .flags = FF_REQUIRED,
                  .group = "radius",
                  .min = 1e-6,
                  .max = 1e9},
    [RADIUS_2] = {.name = "radius_2",
                  .unit = "mm",
                  .doc = "radius of body 2, beside radius_1",
                  .type = FF_REALS,
                  .min = 1e-6,
                  .max = 1e9},
    [SPEED_1] = {.name = "speed_1",
                 .unit = "m/s",
                 .doc = "speed of surface 1",
                 .type = FF_REALS,
                 .flags = FF_REQUIRED,
                 .min = -1e6,
                 .max = 1e6},
    [SPEED_2] = {.name = "speed_2",
                 .unit = "m/s",
                 .doc = "speed of surface 2",
                 .type = FF_REALS,
                 .flags = FF_REQUIRED,
                 .min = -1e6,
                 .max = 1e6},
    [LOAD] = {.name = "load_per_width",
              .unit = "N/mm",
              .doc = "normal force over the width",
              .type = FF_REALS,
              .flags = FF_REQUIRED,
              .min = 0,
              .max = 1e9},
    [GAP] = {.name = "gap",
             .unit = "um",
             .doc = "between the surfaces where the contact is lost",
             .type = FF_REALS,
             .min = 0,
             .max = 1e12},
};

static const ff_param params[] = {
    {.name = "file",
     .unit = "",
     .doc =
         "table with the columns time [s], radius [mm] (equivalent) or radius_1 [mm] and radius_2 "
         "[mm], speed_1 [m/s], speed_2 [m/s], load_per_width [N/mm], and gap [um] where the "
         "contact is lost; straight lines between the rows, a time given twice is a jump, at "
         "the first time from the film of the first row",
     .type = FF_FILE,
     .flags = FF_REQUIRED},
    {.name = "reduced_modulus",
     .unit = "GPa",
     .doc = "E' of 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2",
     .type = FF_REAL,
     .preset = "226.4 GPa",
     .group = "modulus",
     .min = 1e-6,
     .max = 1e6},
    {.name = "elastic_modulus",
     .unit = "GPa",
     .doc = "Young's moduli E1 and E2, in place of reduced_modulus",
     .type = FF_REALS,
     .group = "modulus",
     .min = 1e-6,
     .max = 1e6,
     .min_count = 1,
     .max_count = 2},
    {.name = "poisson_ratio",
     .unit = "1",
     .doc = "Poisson's ratios, together with elastic_modulus; left out: 0.3",
     .type = FF_REALS,
     .min = 0,
     .max = 0.5,
     .min_count = 1,
     .max_count = 2},
};

static const ff_port inputs[] = {
    {.name = "viscosity",
     .unit = "",
     .doc = "viscosity law, for the Moes numbers",
     .dims = "",
     .service = FF_VISCOSITY_ID,
     .flags = FF_OPTIONAL},
};

typedef struct table {
    const ff_host *host;
    char *path;
    double value[PARAM_COUNT][2]; /* a single number is in both */
    int given[PARAM_COUNT];
    const ff_viscosity *law;
    double reduced_modulus;
    const ff_table *file;
} table;

static ff_status create(const ff_host *host, void **self)
{
    table *t = calloc(1, sizeof *t);
    if (!t)
        return FF_NOMEM;
    t->host = host;
    t->value[P_POISSON_RATIO][0] = t->value[P_POISSON_RATIO][1] = 0.3;
    *self = t;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    table *t = self;
    t->given[param] = 1;
    if (param == P_FILE) {
        free(t->path);
        t->path = strdup(value->text);
        return t->path ? FF_OK : FF_NOMEM;
    }
    int list = params[param].type == FF_REALS;
    t->value[param][0] = list ? value->reals[0] : value->real;
    t->value[param][1] = list ? value->reals[value->count - 1] : value->real;
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    table *t = self;
    (void)input;
    t->law = service;
    return FF_OK;
}

static ff_status check_row(const table *t, size_t i)
{
    const ff_table *file = t->file;
    const double *const *column = file->columns, *time = column[TIME];
    if (i > 1 && !(time[i] > time[i - 2]))
        return ff_table_failf(t->host, file, i, TIME,
                              "a jump takes two rows of one time, not three");
    if (column[GAP] && column[GAP][i] > 0 && column[LOAD][i] > 0)
        return ff_table_failf(t->host, file, i, GAP, "under load the gap must be 0");
    return FF_OK;
}

static ff_status check_file(const table *t)
{
    const ff_table *file = t->file;
    const double *time = file->columns[TIME];
    size_t n = file->row_count;
    ff_status status = FF_OK;
    if (!file->columns[RADIUS_1] != !file->columns[RADIUS_2])
        return ff_table_failf(t->host, file, FF_TABLE_ALL,
                              file->columns[RADIUS_2] ? RADIUS_2 : RADIUS_1,
                              "the header must name either radius, or radius_1 and radius_2");
    for (size_t i = 0; i < n && status == FF_OK; i++)
        status = check_row(t, i);
    if (status == FF_OK && n > 1 && !(time[n - 1] > time[0]))
        return ff_table_failf(t->host, file, FF_TABLE_ALL, TIME,
                              "the table must span a time; for a steady contact give one row");
    return status;
}

static ff_status ready(void *self)
{
    table *t = self;
    const double *E = t->value[P_ELASTIC_MODULUS], *nu = t->value[P_POISSON_RATIO];
    int moduli = t->given[P_ELASTIC_MODULUS];
    if (!t->path)
        return ff_failf(t->host, FF_INVALID, "file", "a table is needed: file");
    if (t->given[P_POISSON_RATIO] && !moduli)
        return ff_failf(t->host, FF_INVALID, "poisson_ratio",
                        "poisson_ratio has no meaning without elastic_modulus; give both or "
                        "neither");
    t->reduced_modulus = moduli ? 2 / ((1 - nu[0] * nu[0]) / E[0] + (1 - nu[1] * nu[1]) / E[1])
                                : t->value[P_REDUCED_MODULUS][0];
    ff_status status = ff_table_read(t->host, "file", t->path, FF_TABLE(columns), &t->file);
    return status == FF_OK ? check_file(t) : status;
}

static contact_point point_at(const ff_table *file, size_t i)
{
    const double *const *column = file->columns, *radius = column[RADIUS];
    return (contact_point){
        .time = column[TIME][i],
        .radius_1 = radius ? 2 * radius[i] : column[RADIUS_1][i],
        .radius_2 = radius ? 2 * radius[i] : column[RADIUS_2][i],
        .speed_1 = column[SPEED_1][i],
        .speed_2 = column[SPEED_2][i],
        .load_per_width = column[LOAD][i],
        .gap = column[GAP] ? column[GAP][i] : 0,
    };
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const table *t = self;
    contact_history history;
    (void)in;
    ff_status status = contact_history_open(&history, t->host, wanted, t->file->row_count,
                                            t->reduced_modulus, t->law);
    for (size_t i = 0; i < t->file->row_count && status == FF_OK; i++) {
        contact_point point = point_at(t->file, i);
        status = contact_history_put(&history, i, &point);
    }
    if (status == FF_OK)
        contact_history_report(&history);
    return status;
}

static void destroy(void *self)
{
    table *t = self;
    if (t)
        free(t->path);
    free(t);
}

static const ff_model model = {
    sizeof(ff_model),
    FF_ABI_MAJOR,
    FF_ABI_MINOR,
    "contact/table",
    "1.0.0",
    "line contact whose radii, speeds and load are read from a file",
    "Johnson 1985, Contact Mechanics (Hertz line contact); Moes 2000, Lubrication and Beyond",
    "@book{johnson1985, author = {Johnson, K. L.}, title = {Contact Mechanics}, publisher = "
    "{Cambridge University Press}, year = {1985}}\n"
    "@book{moes2000, author = {Moes, H.}, title = {Lubrication and Beyond}, publisher = "
    "{University of Twente}, year = {2000}}",
    "GPL-3.0-or-later",
    0,
    FF_TABLE(params),
    FF_TABLE(inputs),
    contact_outputs,
    CONTACT_ROLL_ANGLE,
    sizeof contact_outputs[0],
    create,
    set,
    wire,
    ready,
    evaluate,
    NULL,
    destroy,
    NULL,
    NULL,
    NULL,
    FF_TABLE(columns),
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
