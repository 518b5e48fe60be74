/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a series is plotted against, and compared along. */
#ifndef ACCURACY_AXIS_H
#define ACCURACY_AXIS_H

#include "../memory/memory.h"

#include <flankfilm/engine.h>

/*
 * Finds what dimension `dim` of a stage's results, of length `count`, is plotted against: among the
 * stage's own series and then those that it was fed, the one named like the dimension, else the
 * first rising one in the unit `better`, in s or in rad, else its own first rising one. `self` (or
 * NULL) is the series that asks. NULL: there is none, use the index.
 */
const ff_result *accuracy_axis(const ff_pipeline *pipeline, const ff_stage *stage, const char *dim,
                               size_t count, const ff_result *self, const char *better);

/* What a result of the pipeline is compared along; NULL: the index. */
const ff_result *accuracy_axis_of(const ff_pipeline *pipeline, const ff_stage *stage,
                                  const ff_result *result);

/* The same output in another pipeline, of the same stages, at the points of this one. NULL: it
   cannot be compared, or is not finite. */
const double *accuracy_numbers_like(const ff_pipeline *pipeline, const ff_stage *stage,
                                    const ff_result *result, const ff_pipeline *other,
                                    memory_arena *arena);

/* Makes the pipeline compute what lies beside its results: what series are compared along, and what
   stages estimate that an output is off by. Before it runs. */
void accuracy_want_beside(const ff_pipeline *pipeline);

#endif
