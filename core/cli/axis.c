/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "axis.h"

#include <string.h>

/* Rank of the output that feeds input row `input`, and its stage; NULL when not connected. */
static const ff_result *feeding(const ff_pipeline *pipeline, const ff_stage *stage,
                                const ff_port *input)
{
    const char *dot = strchr(input->name, '.');
    for (size_t i = 0; dot && i < stage->wire_count; i++) {
        const ff_wire *wire = &stage->wires[i];
        size_t length = (size_t)(dot - input->name);
        if (wire->stage < 0 || strlen(wire->name) != length ||
            strncmp(wire->name, input->name, length) != 0)
            continue;
        const ff_stage *source = &pipeline->stages[wire->stage];
        int output = source->loaded ? ff_model_find_output(source->loaded->model, dot + 1) : -1;
        return output < 0 ? NULL : &source->results[output];
    }
    return NULL;
}

/* Series number `index` of the stage along `dim`: its outputs first, then its inputs. */
static const ff_result *series_at(const ff_pipeline *pipeline, const ff_stage *stage, size_t index,
                                  const char *dim)
{
    const ff_loaded *loaded = stage->loaded;
    size_t outputs = loaded->model->output_count;
    if (index < outputs) {
        const ff_result *own = &stage->results[index];
        bool fits = own->data && own->rank == 1 && strcmp(ff_result_dim(stage, index, 0), dim) == 0;
        return fits ? own : NULL;
    }
    const ff_dims *dims = &loaded->input_dims[index - outputs];
    if (dims->rank != 1 || strcmp(dims->name[0], dim) != 0)
        return NULL;
    return feeding(pipeline, stage, ff_model_input(loaded->model, index - outputs));
}

static bool rises(const ff_result *series)
{
    for (size_t i = 1; i < series->count; i++)
        if (!(series->data[i] >= series->data[i - 1]))
            return false;
    return series->count > 1 && series->data[series->count - 1] > series->data[0];
}

bool ff_axis_find(const ff_pipeline *pipeline, const ff_stage *stage, const char *dim, size_t count,
                  const ff_result *self, const char *const *units, ff_axis *axis)
{
    size_t outputs = stage->loaded->model->output_count;
    size_t all = outputs + stage->loaded->model->input_count;
    const ff_result *best = NULL;
    size_t best_merit = 0;
    size_t unit_count = 0;
    while (units[unit_count])
        unit_count++;
    for (size_t i = 0; i < all; i++) {
        const ff_result *series = series_at(pipeline, stage, i, dim);
        if (!series || !series->data || series == self || series->rank != 1 ||
            series->count != count || !rises(series))
            continue;
        size_t merit = i < outputs ? 1 : 0;
        for (size_t u = 0; u < unit_count; u++)
            if (strcmp(series->row->unit, units[u]) == 0)
                merit = 1 + unit_count - u;
        if (strcmp(series->row->name, dim) == 0)
            merit = 2 + unit_count;
        if (merit > best_merit) {
            best = series;
            best_merit = merit;
        }
    }
    if (best)
        *axis = (ff_axis){best->row->name, best->row->unit, best->data};
    return best != NULL;
}
