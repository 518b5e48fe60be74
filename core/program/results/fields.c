/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "../arrays/npy.h"
#include "write.h"

#include "../memory/memory.h"

#include <stdlib.h>

bool results_has_file(const ff_result *result)
{
    return result->rank > 1 || result->count > RESULTS_LONGEST_TEXT;
}

static void write_array(const ff_stage *stage, const ff_result *result, const char *ending,
                        const double *values, results_folder *folder)
{
    char *stem = memory_print_text("%s.%s%s", stage->name, result->row->name, ending);
    FILE *stream = results_folder_begin(folder, stem, ".npy");
    if (stream)
        arrays_npy_write(stream, values, result->shape, result->rank);
    free(stem);
}

void results_write_arrays(const results_outcome *outcome, results_folder *folder)
{
    const ff_pipeline *pipeline = outcome->pipeline;
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[s];
        for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++) {
            const ff_result *result = &stage->results[i];
            if (!result->data || !results_has_file(result) ||
                (!result->requested && result->rank > 1))
                continue;
            write_array(stage, result, "", result->data, folder);
            const accuracy_error *error = accuracy_find(outcome->errors, result);
            if (error && error->bar)
                write_array(stage, result, ACCURACY_BAR, error->bar, folder);
        }
    }
}
