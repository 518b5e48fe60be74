/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the axis along which a series is plotted and compared. */
#ifndef ACCURACY_AXIS_H
#define ACCURACY_AXIS_H

#include "measure.h"

#include "../memory/memory.h"

#include <flankfilm/engine.h>

/* Finds the axis of dimension `dim` (length `count`) of a stage. Candidates are the rising series
   of the stage and, with a pipeline, those that feed it. The best one is named like the dimension,
   else in rad, else in s, else any of the stage's own. If `named` is not NULL, only the series with
   that name is a candidate. `self`, which may be NULL, is the series to be plotted: it is no
   candidate. Returns NULL if there is none: the axis is the index. */
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

/* Returns the difference of the output between two pipelines with the stages of `of`, which has the
   error, in the form of `reached`; NaN if they cannot be compared. */
double accuracy_between(const accuracy_error *e, const ff_pipeline *of, const ff_pipeline *one,
                        const ff_pipeline *other, memory_arena *arena);

/* If a series is requested, makes stages with a series of angles also compute their scalar angles,
   such as the one at which a second pair of teeth enters contact. Called before the run. */
void accuracy_want_points(const ff_pipeline *pipeline);

/* Marks as wanted, before the run, the axes of the requested series and, if `estimates`, the
 * outputs in which stages estimate errors of requested outputs. */
void accuracy_want_beside(const ff_pipeline *pipeline, bool estimates);

#endif
