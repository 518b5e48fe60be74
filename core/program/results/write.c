/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "write.h"
#include "made.h"
#include "npy.h"

#include "../memory/memory.h"

#include <stdlib.h>

bool results_has_file(const ff_result *result)
{
    return result->rank > 1 || result->count > RESULTS_LONGEST_TEXT;
}

/* Writes <stage>.<output>.npy: of all that the file asks for and of series on the way. */
static void write_arrays(const ff_pipeline *pipeline, results_folder *folder)
{
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[s];
        for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++) {
            const ff_result *result = &stage->results[i];
            if (!result->data || !results_has_file(result) ||
                (!result->requested && result->rank > 1))
                continue;
            char *stem = memory_print_text("%s.%s", stage->name, result->row->name);
            FILE *stream = results_folder_begin(folder, stem, ".npy");
            if (stream)
                results_npy_write(stream, result->data, result->shape, result->rank);
            free(stem);
        }
    }
}

bool results_write_run(const results_outcome *outcome, const char *directory,
                       results_folder *folder, char **removed)
{
    results_write_run_csv(outcome->pipeline, folder);
    write_arrays(outcome->pipeline, folder);
    FILE *stream = results_folder_begin(folder, "result", ".json");
    if (stream)
        results_write_run_json(outcome, stream);
    if (!results_folder_end(folder))
        return results_folder_commit(folder); /* which clears up */
    *removed = results_made_remove(directory);
    return results_folder_commit(folder);
}

bool results_write_case(const ff_pipeline *pipeline, const char *directory, ff_report *report)
{
    results_folder *folder = results_folder_open(directory, report);
    if (!folder)
        return false;
    results_folder_sync(folder);
    results_write_run_csv(pipeline, folder);
    write_arrays(pipeline, folder);
    FILE *stream = results_folder_begin(folder, "arrays", ".json");
    if (stream)
        results_write_arrays_json(pipeline, stream);
    bool good = results_folder_commit(folder);
    results_folder_free(folder);
    return good;
}
