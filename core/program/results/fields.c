/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lists the requested outputs, and writes their arrays. */
#include "../arrays/npy.h"
#include "write.h"

#include "../accuracy/axis.h"
#include "../memory/memory.h"

#include <stdlib.h>

static int compare_places(const void *a, const void *b)
{
    const results_requested *x = a, *y = b;
    uint32_t left = x->stage->results[x->output].requested;
    uint32_t right = y->stage->results[y->output].requested;
    return (left > right) - (left < right);
}

results_requested *results_list_requested(const ff_pipeline *pipeline, size_t *count)
{
    results_requested *list = memory_alloc(sizeof *list);
    *count = 0;
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[s];
        for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++) {
            if (!stage->results[i].data || !stage->results[i].requested)
                continue;
            char *name = memory_print_text("%s.%s", stage->name, stage->results[i].row->name);
            list = memory_resize(list, (*count + 1) * sizeof *list);
            list[(*count)++] = (results_requested){stage, i, name};
        }
    }
    qsort(list, *count, sizeof *list, compare_places);
    return list;
}

void results_free_requested(results_requested *list, size_t count)
{
    for (size_t i = 0; i < count; i++)
        free(list[i].name);
    free(list);
}

const ff_result **results_axes(const ff_pipeline *pipeline)
{
    const ff_result **axes = memory_alloc(sizeof *axes);
    size_t count = 0;
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[s];
        for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++) {
            const ff_result *asked = &stage->results[i];
            for (uint32_t k = 0; asked->requested && asked->data && k < asked->rank; k++) {
                const ff_result *axis =
                    accuracy_axis(pipeline, stage, asked->dims[k], asked->shape[k], asked, NULL);
                axes = memory_resize(axes, (count + 2) * sizeof *axes);
                axes[count] = axis;
                count += axis != NULL;
            }
        }
    }
    axes[count] = NULL;
    return axes;
}

bool results_is_kept(const ff_result *result, const ff_result *const *axes)
{
    while (*axes && *axes != result)
        axes++;
    return result->data && (result->requested || *axes);
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
    const ff_result **axes = results_axes(pipeline);
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[s];
        for (size_t i = 0; stage->ran && i < stage->loaded->model->output_count; i++) {
            const ff_result *result = &stage->results[i];
            if (result->rank == 0 || !results_is_kept(result, axes))
                continue;
            write_array(stage, result, "", result->data, folder);
            const accuracy_error *error = accuracy_find(outcome->errors, result);
            if (error && error->bar)
                write_array(stage, result, ACCURACY_BAR, error->bar, folder);
        }
    }
    free(axes);
}
