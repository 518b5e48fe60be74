/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "write.h"

#include "../accuracy/lines.h"

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

/* What was computed for the error of another series alone has no column. */
static bool is_series(const ff_stage *stage, size_t output, const char *dim)
{
    const ff_result *result = &stage->results[output];
    bool beside = !result->requested && accuracy_is_estimate(stage, result);
    return result->data && !beside && result->rank == 1 && !results_has_file(result) &&
           strcmp(result->dims[0], dim) == 0;
}

/* A column of a table. */
typedef struct column {
    const ff_result *result;
    const char *ending;   /* of its name: "" or "_error_bar" */
    const double *values; /* of the result, or its error bar */
} column;

/* Writes all series along one dimension, each with the error that was measured beside it. */
static void write_series(const results_outcome *outcome, const ff_stage *stage, const char *dim,
                         results_folder *folder)
{
    column columns[2 * MOST_COLUMNS];
    size_t count = 0;
    char suffix[64] = ".csv";
    if (strcmp(dim, main_dim(stage)) != 0)
        snprintf(suffix, sizeof suffix, "-%s.csv", dim);
    FILE *stream = results_folder_begin(folder, stage->name, suffix);
    if (!stream)
        return;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const ff_result *result = &stage->results[i];
        const accuracy_error *error = accuracy_find(outcome->errors, result);
        if (!is_series(stage, i, dim))
            continue;
        columns[count++] = (column){result, "", result->data};
        if (error && error->bar)
            columns[count++] = (column){result, ACCURACY_BAR, error->bar};
    }
    for (size_t i = 0; i < count; i++)
        fprintf(stream, "%s%s%s [%s]", i ? "," : "", columns[i].result->row->name,
                columns[i].ending, columns[i].result->row->unit);
    fputc('\n', stream);
    for (size_t row = 0; row < columns[0].result->count; row++)
        for (size_t i = 0; i < count; i++) {
            write_number(columns[i].values[row], stream);
            fputc_unlocked(i + 1 < count ? ',' : '\n', stream);
        }
}

static void write_all_series(const results_outcome *outcome, const ff_stage *stage,
                             results_folder *folder)
{
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const char *dim = stage->results[i].dims[0];
        bool first = is_series(stage, i, dim);
        for (size_t earlier = 0; earlier < i; earlier++)
            first = first && !is_series(stage, earlier, dim);
        if (first)
            write_series(outcome, stage, dim, folder);
    }
}

static void write_scalars(const results_outcome *outcome, const ff_stage *stage,
                          results_folder *folder)
{
    FILE *stream = NULL;
    const bool measured = outcome->errors->count > 0;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const ff_result *result = &stage->results[i];
        if (!result->data || result->rank != 0)
            continue;
        if (!stream) {
            stream = results_folder_begin(folder, stage->name, "-scalars.csv");
            if (!stream)
                return;
            fputs(measured ? "name,value,unit,error\n" : "name,value,unit\n", stream);
        }
        fprintf(stream, "%s,", result->row->name);
        write_number(result->data[0], stream);
        fprintf(stream, ",%s%s", result->row->unit, measured ? "," : "");
        const accuracy_error *error = accuracy_find(outcome->errors, result);
        if (error && error->bar)
            write_number(error->bar[0], stream);
        putc('\n', stream);
    }
}

void results_write_run_csv(const results_outcome *outcome, results_folder *folder)
{
    const ff_pipeline *pipeline = outcome->pipeline;
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        if (!stage->ran)
            continue;
        write_all_series(outcome, stage, folder);
        write_scalars(outcome, stage, folder);
    }
}
