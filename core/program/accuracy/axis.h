/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the axis along which a series is plotted and compared. */
#ifndef ACCURACY_AXIS_H
#define ACCURACY_AXIS_H

#include "../memory/memory.h"

#include <flankfilm/engine.h>

/* Finds the axis of dimension `dim` (length `count`) of a stage. Candidates are the stage's own
 * series, then with a pipeline its inputs: first the series named like the dimension, then the
 * first rising series in rad, then in s, then the first rising one of the stage. If `named` is not
 * NULL, only the series with that name is a candidate. `self` is the series that asks, or NULL.
 * Returns NULL if there is none: the axis is the index. */
const ff_result *accuracy_axis(const ff_pipeline *pipeline, const ff_stage *stage, const char *dim,
                               size_t count, const ff_result *self, const char *named);

/* Returns the axis of a result; NULL if it is the index. */
const ff_result *accuracy_axis_of(const ff_pipeline *pipeline, const ff_stage *stage,
                                  const ff_result *result);

/* True for a time, an angle or a series with the name of its dimension: series are compared along
   it. */
bool accuracy_is_axis(const ff_result *result);
/* True if the output could be the axis of `of`: both have the same dimension. Works before the
   run. */
bool accuracy_may_be_axis(const ff_port *row, const ff_port *of);

/* Returns the same output of another pipeline with the same stages, interpolated to the points of
   this one. NULL if the two cannot be compared or a number is not finite. */
const double *accuracy_numbers_like(const ff_pipeline *pipeline, const ff_stage *stage,
                                    const ff_result *result, const ff_pipeline *other,
                                    memory_arena *arena);

/* Returns the difference of a result and the same one in another pipeline, relative to the distance
   from `zero`, or absolute; NaN if the two cannot be compared. */
double accuracy_distance(const ff_pipeline *pipeline, const ff_stage *stage,
                         const ff_result *result, double zero, bool absolute,
                         const ff_pipeline *other, memory_arena *arena);

/* If a series is requested, makes the pipeline also compute its points on angles, such as those
 * where a second pair of teeth enters. Called before the run. */
void accuracy_want_points(const ff_pipeline *pipeline);

/* Marks, before the run, two kinds of outputs to be computed as well: the axes of series and, for
 * an answer, the stages' error estimates of its outputs. */
void accuracy_want_beside(const ff_pipeline *pipeline, bool estimates);

#endif
