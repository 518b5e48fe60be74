/* SPDX-License-Identifier: GPL-3.0-or-later */
/* contact/table: the history of a line contact from a file, instant by instant. */
#include "history.h"
#include "line-contact.h"
#include "references.h"

#include <flankfilm/table.h>

#include <stdlib.h>

/* Columns of the file, in the order of the rows. */
enum { TIME, RADIUS, RADIUS_1, RADIUS_2, SPEED_1, SPEED_2, LOAD, GAP };

static const ff_param columns[] = {
    FF_ROW("time", "s", "time of the row", FF_REALS, FF_REQUIRED | FF_INCREASING, NULL, NULL, NULL,
           0, 0, 0, 0, 0, 1000000, 0),
    FF_COLUMN("radius", "mm", FF_REQUIRED, "radius", 1e-6, 1e9,
              "equivalent radius of the contact, instead of radius_1 and radius_2"),
    FF_COLUMN("radius_1", "mm", FF_REQUIRED, "radius", 1e-6, 1e9,
              "radius of surface 1; with radius_2"),
    FF_COLUMN("radius_2", "mm", 0, NULL, 1e-6, 1e9, "radius of surface 2; with radius_1"),
    FF_COLUMN("speed_1", "m/s", FF_REQUIRED, NULL, -1e6, 1e6, "speed of surface 1"),
    FF_COLUMN("speed_2", "m/s", FF_REQUIRED, NULL, -1e6, 1e6, "speed of surface 2"),
    FF_COLUMN("load_per_width", "N/mm", FF_REQUIRED, NULL, 0, 1e9, "load per width"),
    FF_COLUMN("gap", "um", 0, NULL, 0, 1e12, "separation of the surfaces; 0 in contact"),
};

typedef struct table_contact {
    const ff_host *host;
    const char *path;
    contact_moduli moduli;
    const ff_viscosity *law;
    double reduced_modulus;
    const ff_table *file;
} table_contact;

static const ff_param params[] = {
    FF_PATH("file", table_contact, path, FF_REQUIRED, NULL,
            "table with the columns time [s], radius [mm] (equivalent) or radius_1 [mm] and "
            "radius_2 [mm], speed_1 [m/s], speed_2 [m/s], load_per_width [N/mm], and optionally "
            "gap [um] during contact loss; values are linear between the rows. A repeated time "
            "marks a jump. If the first time is repeated, the film starts as the steady film of "
            "the first row"),
    CONTACT_MODULI_ROWS(table_contact),
};

static ff_status wire(void *self, uint32_t input, const void *service)
{
    table_contact *t = self;
    if (input == CONTACT_LINE_VISCOSITY)
        t->law = service;
    return FF_OK;
}

static ff_status check_row(const table_contact *t, size_t i)
{
    const ff_table *file = t->file;
    const double *const *column = file->columns, *time = column[TIME];
    if (i > 1 && !(time[i] > time[i - 2]))
        return ff_table_failf(t->host, file, i, TIME,
                              "a jump has two rows with the same time, not three");
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
                              "all rows have the same time; for a steady contact give one row");
    return status;
}

static ff_status ready(void *self)
{
    table_contact *t = self;
    ff_status status = contact_reduced_modulus(t->host, &t->moduli, &t->reduced_modulus);
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
    ff_status status = contact_history_open(&history, t->host, wanted, t->file->row_count,
                                            t->reduced_modulus, t->law, &in[CONTACT_LINE_OIL]);
    for (size_t i = 0; i < t->file->row_count && status == FF_OK; i++) {
        contact_point point = point_at(t->file, i);
        status = contact_history_set(&history, i, &point);
    }
    if (status == FF_OK)
        contact_history_report(&history);
    return status;
}

FF_MODEL(contact_table, table_contact, .id = "contact/table", .version = "1.0.0",
         .summary = "line contact whose radii, speeds and load are read from a file",
         .reference = contact_line_reference, .bibtex = BIB_johnson1985 "\n" BIB_moes2000,
         .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
         .inputs = FF_TABLE(contact_line_inputs), .outputs = contact_outputs,
         .output_count = CONTACT_ROLL_ANGLE, .output_stride = sizeof contact_outputs[0],
         .wire = wire, .ready = ready, .evaluate = evaluate, .destroy = free,
         .columns = FF_TABLE(columns));
