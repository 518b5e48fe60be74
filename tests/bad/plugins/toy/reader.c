/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads a table, rightly and wrongly. */
#include <flankfilm/table.h>

#include <stdlib.h>
#include <string.h>

enum { USED, CELL, REPLACED, IGNORED, FOREIGN, UNIT, LATE, NOWHERE };

static const ff_param columns[] = {
    {.name = "level",
     .unit = "mm",
     .doc = "of the liquid",
     .type = FF_REALS,
     .flags = FF_REQUIRED,
     .min = 0,
     .max = 1000},
};
static const ff_param unknown[] = {
    {.name = "level", .unit = "cubit", .doc = "of the flood", .type = FF_REALS},
};

static const ff_param params[] = {
    {.name = "file", .unit = "", .doc = "the table", .type = FF_FILE, .flags = FF_REQUIRED},
    {.name = "how",
     .unit = "",
     .doc = "what becomes of it",
     .type = FF_CHOICE,
     .preset = "used",
     .choices = "used|cell|replaced|ignored|foreign|unit|late|nowhere"},
};

static const ff_port outputs[] = {
    {.name = "sum", .unit = "m", .doc = "of all levels", .dims = ""},
};

typedef struct reader {
    const ff_host *host;
    char *path;
    int64_t how;
    const ff_table *table;
} reader;

static ff_status create(const ff_host *host, void **self)
{
    reader *r = calloc(1, sizeof *r);
    if (!r)
        return FF_NOMEM;
    r->host = host;
    *self = r;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    reader *r = self;
    if (param == 0)
        r->path = strdup(value->text);
    else
        r->how = value->integer;
    return r->path || param > 0 ? FF_OK : FF_NOMEM;
}

static ff_status ready(void *self)
{
    reader *r = self;
    static const ff_table none = {.size = sizeof none};
    if (r->how == NOWHERE)
        return ff_table_read(r->host, NULL, NULL, FF_TABLE(columns), &r->table);
    ff_status status = r->how == UNIT
                           ? ff_table_read(r->host, "file", r->path, FF_TABLE(unknown), &r->table)
                           : ff_table_read(r->host, "file", r->path, FF_TABLE(columns), &r->table);
    if (r->how == CELL && status == FF_OK)
        return ff_table_failf(r->host, r->table, 1, 0, "the level of %s is wrong", "row 2");
    if (r->how == REPLACED)
        return ff_failf(r->host, FF_INVALID, "how", "another reason");
    if (r->how == FOREIGN)
        return ff_table_failf(r->host, &none, 0, 0, "whose?");
    return r->how == IGNORED ? FF_OK : status;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const reader *r = self;
    double sum = 0;
    (void)wanted, (void)in;
    if (r->how == LATE)
        return ff_table_failf(r->host, r->table, FF_TABLE_ALL, 0, "a thought came late");
    for (size_t i = 0; r->table && i < r->table->row_count; i++)
        sum += r->table->columns[0][i];
    return ff_put_scalar(r->host, 0, sum);
}

static void destroy(void *self)
{
    reader *r = self;
    if (r)
        free(r->path);
    free(r);
}

static const ff_model model = {
    .size = sizeof model,
    .abi_major = FF_ABI_MAJOR,
    .id = "toy/reader",
    .version = "1.0.0",
    .summary = "A reader of a table",
    .reference = "",
    .bibtex = "",
    .licence = "GPL-3.0-or-later",
    .params = params,
    .param_count = 2,
    .param_stride = sizeof params[0],
    .outputs = outputs,
    .output_count = 1,
    .output_stride = sizeof outputs[0],
    .create = create,
    .set = set,
    .ready = ready,
    .evaluate = evaluate,
    .destroy = destroy,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
