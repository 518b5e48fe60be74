/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions that look up the cases of a study after it has been read. */
#include "rows.h"
#include "spectrum.h"

#include <stdlib.h>
#include <string.h>

/* Lists the possible keys, as many as fit. */
static void list_keys(char *text, size_t size, const char *const *known)
{
    size_t length = (size_t)snprintf(text, size, "it takes ");
    for (size_t i = 0; known[i] && length < size; i++)
        length += (size_t)snprintf(text + length, size - length, "%s%s", i ? ", " : "", known[i]);
}

bool study_check_keys(const ff_node *map, const char *whose, const char *where,
                      const char *const *known, ff_report *report)
{
    char takes[200];
    list_keys(takes, sizeof takes, known);
    bool good = true;
    for (size_t i = 0; map->kind == FF_MAP && i < map->count; i++) {
        size_t count = 0, found = 0;
        for (; known[count]; count++)
            found += !strcmp(map->keys[i], known[count]);
        const char *near = ff_nearest(map->keys[i], known, count);
        if (found || !strncmp(map->keys[i], "x-", 2))
            continue;
        good = ff_error(report, FF_FAULT_INPUT, map->key_places[i], near ? NULL : takes,
                        "%s: %s%sunknown key \"%.80s\"%s%s%s", whose, where, *where ? ": " : "",
                        map->keys[i], near ? "; did you mean \"" : "", near ? near : "",
                        near ? "\"?" : "");
    }
    return good;
}

void study_definition_free(study_definition *study)
{
    if (!study)
        return;
    study_rows_free(study->rows);
    if (study->spectrum)
        free(study->spectrum->times);
    memory_arena_free(&study->arena);
    free(study);
}

size_t study_stride(const study_definition *study, size_t axis)
{
    size_t stride = 1;
    for (size_t a = study->axis_count; --a > axis;)
        stride *= study->points[a];
    return stride;
}

size_t study_rank(const study_definition *study, size_t axis, size_t index)
{
    return index / study_stride(study, axis) % study->points[axis];
}

const char *study_assignment(const study_definition *study, size_t k, size_t index)
{
    const study_varied *varied = &study->varied[k];
    return varied->assignments[study_rank(study, varied->axis, index)];
}

const char *study_varied_value(const study_varied *varied, size_t point)
{
    const char *assignment = varied->assignments[point];
    return varied->names ? varied->names[point]
           : *assignment ? assignment + strlen(varied->path) + 1
                         : "";
}

const char *study_value(const study_definition *study, size_t k, size_t index)
{
    const study_varied *varied = &study->varied[k];
    return study_varied_value(varied, study_rank(study, varied->axis, index));
}

const char *study_next_use(const study_definition *study, study_use *at)
{
    for (; at->path < study->varied_count; at->path++, at->point = 0) {
        const study_varied *varied = &study->varied[at->path];
        const char *dot = strrchr(varied->path, '.');
        if (dot && !strcmp(dot, ".use") && at->point < study->points[varied->axis])
            return study_varied_value(varied, at->point++);
    }
    return NULL;
}
