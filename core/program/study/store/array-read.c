/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads an array of a case from its log. The record in the journal gives its place. */
#include "array-read.h"

const double *study_array_read(arrays_reader *reader, const json_t *record, const char *name,
                               memory_arena *arena, size_t *rank, size_t *count,
                               char why[ARRAYS_WHY])
{
    const json_t *entry = json_object_get(json_object_get(record, "arrays"), name),
                 *shape = json_array_get(entry, 2), *log = json_object_get(record, "log");
    const char *file = json_string_value(json_array_get(log, 0));
    off_t offset = (off_t)json_integer_value(json_array_get(entry, 3));
    arrays_label label = {.key = json_string_value(json_object_get(record, "key")), .output = name};
    *why = '\0';
    if (!entry || !file || !label.key || json_array_size(shape) > 4)
        return NULL;
    *count = 1;
    for (; label.rank < json_array_size(shape); label.rank++) {
        label.shape[label.rank] = (size_t)json_integer_value(json_array_get(shape, label.rank));
        *count *= label.shape[label.rank];
    }
    *rank = label.rank;
    double *values = arrays_reader_has(reader, file, offset, &label, why)
                         ? memory_arena_alloc(arena, (*count + 1) * sizeof *values)
                         : NULL;
    return values && arrays_reader_read(reader, file, offset, &label, values, why) ? values : NULL;
}
