/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pick.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

size_t writer_point_of(const ff_view *view, size_t index, size_t dimension)
{
    for (size_t d = view->dimension_count; d-- > dimension + 1;)
        index /= view->lengths[d];
    return index % view->lengths[dimension];
}

bool writer_same_dims(const ff_view_variable *a, const ff_view_variable *b)
{
    bool same = a->stage == b->stage && a->rank == b->rank;
    for (uint32_t i = 0; same && i < a->rank; i++)
        same = !strcmp(a->dims[i], b->dims[i]);
    return same;
}

bool writer_is_coordinate(const ff_view_variable *series, const ff_view_variable *other,
                          uint32_t dim)
{
    bool named = series->rank == 1 && !strcmp(series->output, series->dims[0]);
    if (series->rank != 1 || series == other)
        return false;
    if (!strcmp(series->name, other->against[dim]))
        return true;
    return series->stage == other->stage && !strcmp(series->dims[0], other->dims[dim]) &&
           (named || !strcmp(series->unit, "s") || !strcmp(series->unit, "rad"));
}

bool writer_full_shape(const ff_view *view, size_t variable, size_t index, size_t shape[4])
{
    size_t found[4] = {0};
    int32_t rank = view->shape(view->ctx, variable, index, found);
    uint32_t full = view->variables[variable]->rank;
    if (rank < 0 || (uint32_t)rank > full)
        return false;
    uint32_t absent = full - (uint32_t)rank;
    for (uint32_t i = 0; i < full; i++)
        shape[i] = i < absent ? 1 : found[i - absent];
    return true;
}

void writer_print_exact(double value, char out[WRITER_EXACT_SIZE])
{
    if (!isfinite(value)) {
        strcpy(out, "nan");
        return;
    }
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(out, WRITER_EXACT_SIZE, "%.*g", digits, value);
        if (strtod(out, NULL) == value)
            return;
    }
}

const char *writer_verdict_word(int32_t verdict)
{
    return verdict == FF_GOOD ? "good" : verdict == FF_DOUBTFUL ? "doubtful" : "bad";
}

const ff_port writer_outputs[1] = {
    {.name = "writer",
     .unit = "",
     .doc = "makes files of the results of a run or a study",
     .dims = "",
     .service = FF_WRITER_ID},
};

ff_status writer_create(const ff_host *host, const ff_writer *table, void **self)
{
    writer_self *made = calloc(1, sizeof *made);
    *self = made;
    if (!made)
        return FF_NOMEM;
    made->host = host;
    made->table = *table;
    made->table.size = sizeof made->table;
    made->table.self = made;
    return FF_OK;
}

const void *writer_service(void *self, uint32_t output)
{
    (void)output;
    return &((const writer_self *)self)->table;
}

void writer_destroy(void *self)
{
    free(self);
}
