/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the axis along which a series is plotted and compared. */
#include "axis.h"

#include "compare.h"
#include "lines.h"

#include <math.h>
#include <string.h>

static bool is_rising(const ff_result *series)
{
    for (size_t i = 1; i < series->count; i++)
        if (!(series->data[i] >= series->data[i - 1]))
            return false;
    return series->count > 1 && series->data[series->count - 1] > series->data[0];
}

/* Rejects a series that repeats one value over many points, such as the number of the
   engagement. */
static bool has_plateaus(const ff_result *series)
{
    for (size_t i = 2; i < series->count; i++)
        if (!(series->data[i] > series->data[i - 2]))
            return true;
    return false;
}

/* Returns how well a series suits as an axis; 0: not at all. */
static int fitness_of(const ff_result *series, bool own, const char *dim, const char *named)
{
    const char *unit = series->row->unit, *name = series->row->name;
    if (!is_rising(series))
        return 0;
    if (named)
        return !strcmp(name, named);
    if (!strcmp(name, dim))
        return 4;
    if (!strcmp(unit, "rad"))
        return 3;
    if (!strcmp(unit, "s"))
        return 2;
    return own && !has_plateaus(series) ? 1 : 0;
}

const ff_result *accuracy_axis(const ff_pipeline *pipeline, const ff_stage *stage, const char *dim,
                               size_t count, const ff_result *self, const char *named)
{
    const ff_loaded *loaded = stage->loaded;
    size_t own = loaded->model->output_count, fed = pipeline ? loaded->model->input_count : 0;
    const ff_result *best = NULL;
    int best_merit = 0;
    for (size_t i = 0; i < own + fed; i++) {
        const ff_dims *dims = i < own ? &loaded->output_dims[i] : &loaded->input_dims[i - own];
        const ff_result *series =
            i < own ? &stage->results[i] : ff_feeding_result(pipeline, stage, i - own);
        if (!series || (i < own && accuracy_is_estimate(stage, series)) || !series->data ||
            series == self || series->rank != 1 || series->count != count ||
            strcmp(dims->name[dims->rank - 1], dim) != 0)
            continue;
        int merit = fitness_of(series, i < own, dim, named);
        if (merit > best_merit) {
            best = series;
            best_merit = merit;
        }
    }
    return best;
}

const ff_result *accuracy_axis_of(const ff_pipeline *pipeline, const ff_stage *stage,
                                  const ff_result *result)
{
    return result->rank
               ? accuracy_axis(pipeline, stage, result->dims[0], result->count, result, NULL)
               : NULL;
}

const double *accuracy_numbers_like(const ff_pipeline *pipeline, const ff_stage *stage,
                                    const ff_result *result, const ff_pipeline *other,
                                    memory_arena *arena)
{
    const ff_stage *there = &other->stages[stage - pipeline->stages];
    int output = ff_model_find_output(there->loaded->model, result->row->name);
    const ff_result *own = output < 0 ? NULL : &there->results[output];
    if (!own || !own->data || own->rank != result->rank || own->count == 0)
        return NULL;
    const ff_result *along = accuracy_axis_of(pipeline, stage, result);
    const ff_result *along_other = accuracy_axis_of(other, there, own);
    bool placed = along && along_other;
    if (own->rank && (placed ? strcmp(along->row->name, along_other->row->name) != 0
                             : own->count != result->count))
        return NULL;
    const accuracy_series series = {.at = placed ? along_other->data : NULL,
                                    .count = own->count,
                                    .value = own->data},
                          points = {.at = placed ? along->data : NULL};
    double *numbers = memory_arena_alloc(arena, result->count * sizeof *numbers);
    for (size_t i = 0; i < result->count; i++) {
        numbers[i] = accuracy_value_at(&series, &points, i);
        if (!isfinite(numbers[i]))
            return NULL;
    }
    return numbers;
}

static bool suits(const ff_port *row, const char *dim)
{
    return !strcmp(row->unit, "s") || !strcmp(row->unit, "rad") || !strcmp(row->name, dim);
}

bool accuracy_is_axis(const ff_result *result)
{
    return result->rank == 1 && suits(result->row, result->dims[0]);
}

bool accuracy_may_be_axis(const ff_port *row, const ff_port *of)
{
    return !row->service && row->dims && *row->dims && !strcmp(row->dims, of->dims) &&
           suits(row, of->dims);
}

/* If the stage has a series of angles, marks its scalar angles as wanted, such as the roll angle at
 * which a second pair of teeth enters contact. */
static void want_points(const ff_stage *stage, size_t count)
{
    bool angles = false;
    for (size_t i = 0; i < count; i++)
        angles = angles || (stage->results[i].row->dims && *stage->results[i].row->dims &&
                            !strcmp(stage->results[i].row->unit, "rad"));
    for (size_t i = 0; i < count && angles; i++)
        if (stage->results[i].row->dims && !*stage->results[i].row->dims &&
            !strcmp(stage->results[i].row->unit, "rad"))
            stage->results[i].wanted = true;
}

/* Whether the file asks for a series. */
static bool requests_series(const ff_pipeline *pipeline)
{
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[s];
        size_t count = stage->needed && stage->loaded ? stage->loaded->model->output_count : 0;
        for (size_t i = 0; i < count; i++)
            if (stage->results[i].requested && stage->results[i].row->dims &&
                *stage->results[i].row->dims)
                return true;
    }
    return false;
}

void accuracy_want_points(const ff_pipeline *pipeline)
{
    const bool asked = requests_series(pipeline);
    for (size_t s = 0; asked && s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[s];
        if (stage->needed && stage->loaded)
            want_points(stage, stage->loaded->model->output_count);
    }
}

void accuracy_want_beside(const ff_pipeline *pipeline, bool estimates)
{
    for (size_t s = 0; s < pipeline->count; s++) {
        const ff_stage *stage = &pipeline->stages[s];
        size_t count = stage->needed && stage->loaded ? stage->loaded->model->output_count : 0;
        for (size_t i = 0; i < count; i++)
            for (size_t k = 0; stage->results[i].requested && k < count; k++)
                if (stage->results[i].row->dims &&
                    (accuracy_may_be_axis(stage->results[k].row, stage->results[i].row) ||
                     (estimates &&
                      accuracy_may_estimate(stage->results[k].row, stage->results[i].row))))
                    stage->results[k].wanted = true;
    }
}

double accuracy_between(const accuracy_error *e, const ff_pipeline *of, const ff_pipeline *one,
                        const ff_pipeline *other, memory_arena *arena)
{
    const ff_stage *stage = &one->stages[e->stage - of->stages];
    const int output = ff_model_find_output(stage->loaded->model, e->result->row->name);
    const ff_result *result = output < 0 ? NULL : &stage->results[output];
    const double *numbers = result ? accuracy_numbers_like(one, stage, result, other, arena) : NULL;
    if (!numbers)
        return NAN;
    const ff_result *along = accuracy_axis_of(one, stage, result);
    const accuracy_series answer = {result->rank, result->count, along ? along->data : NULL,
                                    result->data, e->zero_point, e->absolute};
    double *off = memory_arena_alloc(arena, result->count * sizeof *off + 1), largest;
    for (size_t i = 0; i < result->count; i++)
        off[i] = fabs(numbers[i] - result->data[i]);
    return accuracy_relative(off, &answer, &largest);
}
