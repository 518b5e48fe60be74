/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The assignments of a case, and how they are applied to the file. */
#include "case.h"
#include "rows.h"

#include "../../run/run.h"

#include <string.h>

bool study_names_file(const char *assignment)
{
    return !strncmp(assignment, "include=", 8);
}

const char *study_case_assignment(const study_definition *study, size_t index,
                                  const char *const *sets, size_t set_count, size_t i)
{
    size_t n = study->varied_count, k = i < n ? i : i - set_count - n;
    if (i >= n && i < n + set_count)
        return sets[i - n];
    if (k >= n)
        return NULL;
    const char *text = study_assignment(study, k, index);
    return study_names_file(text) == (i < n) ? text : "";
}

void study_overlay(const study_definition *study, size_t index, const char *const *sets,
                   size_t set_count, ff_run *run)
{
    const char *text;
    size_t n = study->varied_count;
    for (size_t i = 0; (text = study_case_assignment(study, index, sets, set_count, i)); i++) {
        const study_varied *v = i >= n + set_count ? &study->varied[i - n - set_count] : NULL;
        const ff_place *path = v && v->place.source ? &v->place : NULL, *place = path;
        const study_place *cell = path && v->places ? &v->places[index] : NULL;
        ff_place in_table =
            cell ? (ff_place){path->source, cell->line, cell->column, cell->width} : FF_NOWHERE;
        if (cell)
            place = &in_table;
        if (path && v->values)
            place = &v->values->items[study_rank(study, v->axis, index)]->place;
        if (*text)
            run_set(run, text, path, place);
    }
    if (study->request)
        run_put(run, "outputs", study->request);
    if (study->streams)
        study_rows_check(study->rows, index, ff_run_report(run));
}
