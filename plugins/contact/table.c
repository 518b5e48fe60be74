/* SPDX-License-Identifier: GPL-3.0-or-later */
/* contact/table: the history of a line contact from a file, instant by instant. */
#include "history.h"
#include "line-contact.h"

#include <flankfilm/table.h>

#include <stdlib.h>
#include <string.h>

enum { P_FILE, P_REDUCED_MODULUS, P_ELASTIC_MODULUS, P_POISSON_RATIO, PARAM_COUNT };

/* Columns of the file, in the order of the rows. */
enum { TIME, RADIUS, RADIUS_1, RADIUS_2, SPEED_1, SPEED_2, LOAD, GAP };

static const ff_param columns[] = {
    {.name = "time",
     .unit = "s",
     .doc = "of the instant",
     .type = FF_REALS,
     .flags = FF_REQUIRED | FF_INCREASING,
     .max_count = 1000000},
    {.name = "radius",
     .unit = "mm",
     .doc = "equivalent radius of the contact, or both radii",
     .type = FF_REALS,
     .flags = FF_REQUIRED,
     .group = "radius",
     .min = 1e-6,
     .max = 1e9},
    {.name = "radius_1",
     .unit = "mm",
     .doc = "radius of body 1, beside radius_2",
     .type = FF_REALS,
     .flags = FF_REQUIRED,
     .group = "radius",
     .min = 1e-6,
     .max = 1e9},
    {.name = "radius_2",
     .unit = "mm",
     .doc = "radius of body 2, beside radius_1",
     .type = FF_REALS,
     .min = 1e-6,
     .max = 1e9},
    {.name = "speed_1",
     .unit = "m/s",
     .doc = "speed of surface 1",
     .type = FF_REALS,
     .flags = FF_REQUIRED,
     .min = -1e6,
     .max = 1e6},
    {.name = "speed_2",
     .unit = "m/s",
     .doc = "speed of surface 2",
     .type = FF_REALS,
     .flags = FF_REQUIRED,
     .min = -1e6,
     .max = 1e6},
    {.name = "load_per_width",
     .unit = "N/mm",
     .doc = "normal force over the width",
     .type = FF_REALS,
     .flags = FF_REQUIRED,
     .min = 0,
     .max = 1e9},
    {.name = "gap",
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
    CONTACT_REDUCED_MODULUS_ROW,
    CONTACT_ELASTIC_MODULUS_ROW,
    CONTACT_POISSON_RATIO_ROW,
};

typedef struct table_contact {
    const ff_host *host;
    char *path;
    contact_value param[PARAM_COUNT]; /* all but the file */
    const ff_viscosity *law;
    double reduced_modulus;
    const ff_table *file;
} table_contact;

static ff_status create(const ff_host *host, void **self)
{
    table_contact *t = calloc(1, sizeof *t);
    if (!t)
        return FF_NOMEM;
    t->host = host;
    *self = t;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    table_contact *t = self;
    if (param == P_FILE) {
        free(t->path);
        t->path = strdup(value->text);
        return t->path ? FF_OK : FF_NOMEM;
    }
    contact_value_set(&t->param[param], &params[param], value);
    return FF_OK;
}

static ff_status wire(void *self, uint32_t input, const void *service)
{
    table_contact *t = self;
    (void)input;
    t->law = service;
    return FF_OK;
}

static ff_status check_row(const table_contact *t, size_t i)
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

static ff_status check_file(const table_contact *t)
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
    table_contact *t = self;
    if (!t->path)
        return ff_failf(t->host, FF_INVALID, "file", "a table is needed: file");
    ff_status status =
        contact_reduced_modulus(t->host, &t->param[P_REDUCED_MODULUS], &t->reduced_modulus);
    if (status == FF_OK)
        status = ff_table_read(t->host, "file", t->path, FF_TABLE(columns), &t->file);
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
    const table_contact *t = self;
    contact_history history;
    (void)in;
    ff_status status = contact_history_open(&history, t->host, wanted, t->file->row_count,
                                            t->reduced_modulus, t->law);
    for (size_t i = 0; i < t->file->row_count && status == FF_OK; i++) {
        contact_point point = point_at(t->file, i);
        status = contact_history_set(&history, i, &point);
    }
    if (status == FF_OK)
        contact_history_report(&history);
    return status;
}

static void destroy(void *self)
{
    table_contact *t = self;
    if (t)
        free(t->path);
    free(t);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "contact/table",
    .version = "1.0.0",
    .summary = "line contact whose radii, speeds and load are read from a file",
    .reference = contact_line_reference,
    .bibtex = contact_line_bibtex,
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .inputs = FF_TABLE(contact_line_inputs),
    .outputs = contact_outputs,
    .output_count = CONTACT_ROLL_ANGLE,
    .output_stride = sizeof contact_outputs[0],
    .create = create,
    .set = set,
    .wire = wire,
    .ready = ready,
    .evaluate = evaluate,
    .destroy = destroy,
    .columns = FF_TABLE(columns),
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
