/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "write.h"

#include <math.h>
#include <string.h>

enum { CSV_DIGITS = 10, MOST_COLUMNS = 64 /* outputs of a model */ };

static void write_number(double value, FILE *stream)
{
    if (isfinite(value))
        fprintf(stream, "%.*g", CSV_DIGITS, value == 0 ? 0 : value); /* no -0 */
    else
        fputs("nan", stream);
}

/* Returns the dimension of the series in <stage>.csv, whatever was computed of them. */
static const char *main_dim(const ff_stage *stage)
{
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const ff_dims *dims = &stage->loaded->output_dims[i];
        if (dims->rank > 0 && dims->rank - dims->first_optional == 1)
            return dims->name[dims->rank - 1];
    }
    return "";
}

static bool is_series(const ff_stage *stage, size_t output, const char *dim)
{
    const ff_result *result = &stage->results[output];
    return result->data && result->rank == 1 && !results_has_file(result) &&
           strcmp(result->dims[0], dim) == 0;
}

/* Writes all series along one dimension. */
static void write_series(const ff_stage *stage, const char *dim, results_folder *folder)
{
    const ff_result *columns[MOST_COLUMNS];
    size_t count = 0;
    char suffix[64] = ".csv";
    if (strcmp(dim, main_dim(stage)) != 0)
        snprintf(suffix, sizeof suffix, "-%s.csv", dim);
    FILE *stream = results_folder_begin(folder, stage->name, suffix);
    if (!stream)
        return;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++)
        if (is_series(stage, i, dim))
            columns[count++] = &stage->results[i];
    for (size_t i = 0; i < count; i++)
        fprintf(stream, "%s%s [%s]", i ? "," : "", columns[i]->row->name, columns[i]->row->unit);
    fputc('\n', stream);
    for (size_t row = 0; row < columns[0]->count; row++)
        for (size_t i = 0; i < count; i++) {
            write_number(columns[i]->data[row], stream);
            fputc_unlocked(i + 1 < count ? ',' : '\n', stream);
        }
}

static void write_all_series(const ff_stage *stage, results_folder *folder)
{
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const char *dim = stage->results[i].dims[0];
        bool first = is_series(stage, i, dim);
        for (size_t earlier = 0; earlier < i; earlier++)
            first = first && !is_series(stage, earlier, dim);
        if (first)
            write_series(stage, dim, folder);
    }
}

static void write_scalars(const ff_stage *stage, results_folder *folder)
{
    FILE *stream = NULL;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const ff_result *result = &stage->results[i];
        if (!result->data || result->rank != 0)
            continue;
        if (!stream) {
            stream = results_folder_begin(folder, stage->name, "-scalars.csv");
            if (!stream)
                return;
            fputs("name,value,unit\n", stream);
        }
        fprintf(stream, "%s,", result->row->name);
        write_number(result->data[0], stream);
        fprintf(stream, ",%s\n", result->row->unit);
    }
}

void results_write_run_csv(const ff_pipeline *pipeline, results_folder *folder)
{
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        if (!stage->ran)
            continue;
        write_all_series(stage, folder);
        write_scalars(stage, folder);
    }
}
