/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the least and the greatest number of a result. */
#include "extremes.h"

#include "../accuracy/axis.h"
#include "../accuracy/compare.h"

#include <math.h>
#include <string.h>

const ff_stage *results_stage_of(const ff_pipeline *pipeline, const ff_result *result)
{
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        const size_t count = stage->loaded ? stage->loaded->model->output_count : 0;
        if (stage->results && result >= stage->results && result < stage->results + count)
            return stage;
    }
    return NULL;
}

/* Returns the series of which a result is a share: for a friction coefficient, the load. */
static const ff_result *whole_of(const ff_pipeline *pipeline, const ff_stage *stage,
                                 const ff_result *result)
{
    const int input =
        result->row->origin ? ff_model_find_input(stage->loaded->model, result->row->origin) : -1;
    const ff_result *whole = input < 0 ? NULL : ff_feeding_result(pipeline, stage, (size_t)input);
    return whole && whole->data && whole->rank == 1 && result->rank == 1 ? whole : NULL;
}

/* Finds the least and the greatest number of a result. `whole`, if not NULL, is the series of which
   the result is a share. */
static bool search(const ff_result *result, const accuracy_series *whole, const double *at,
                   double least_whole, results_extremes *out)
{
    bool known = false;
    *out = (results_extremes){.partial = false};
    for (size_t i = 0; i < result->count; i++) {
        const double there = !whole ? INFINITY
                             : at   ? accuracy_interpolate(whole, at[i], false)
                                    : whole->value[i];
        if (!isfinite(result->data[i]) || !(fabs(there) >= least_whole)) {
            out->partial = out->partial || whole;
            continue;
        }
        out->least = known && result->data[i] >= result->data[out->least] ? out->least : i;
        out->greatest = known && result->data[i] <= result->data[out->greatest] ? out->greatest : i;
        known = true;
    }
    return known;
}

bool results_find_extremes(const ff_pipeline *pipeline, const ff_stage *stage,
                           const ff_result *result, results_extremes *out)
{
    static const double vanishing =
        0.01; /* a share is ignored if its whole is below this part of the largest whole */
    const ff_result *whole = whole_of(pipeline, stage, result);
    const ff_stage *of = whole ? results_stage_of(pipeline, whole) : NULL;
    const ff_result *along = of ? accuracy_axis_of(pipeline, stage, result) : NULL;
    const ff_result *there = of ? accuracy_axis_of(pipeline, of, whole) : NULL;
    const bool placed = along && there && !strcmp(along->row->name, there->row->name);
    double most = 0;
    if (!whole || (!placed && whole->count != result->count))
        return search(result, NULL, NULL, 0, out);
    for (size_t i = 0; i < whole->count; i++)
        most = fmax(most, fabs(whole->data[i]));
    const accuracy_series series = {1, whole->count, placed ? there->data : NULL, whole->data,
                                    0, false};
    return search(result, &series, placed ? along->data : NULL, vanishing * most, out) ||
           search(result, NULL, NULL, 0, out);
}
