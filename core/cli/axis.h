/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a dimension of a result is plotted against. */
#ifndef FF_AXIS_H
#define FF_AXIS_H

#include "../pipeline/pipeline.h"

typedef struct ff_axis {
    const char *name, *unit;
    const double *data;
} ff_axis;

/*
 * The axis of dimension `dim`, of length `count`, of a stage: among the stage's own series and
 * then those that it was fed, the one named like the dimension, else the first rising one in a
 * unit of `units` (in their order; NULL-terminated), else the stage's first rising one. `self` (or
 * NULL) is the series that asks. False: there is none, use the index.
 */
bool ff_axis_find(const ff_pipeline *pipeline, const ff_stage *stage, const char *dim, size_t count,
                  const ff_result *self, const char *const *units, ff_axis *axis);

#endif
