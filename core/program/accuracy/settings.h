/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The settings that trade speed for accuracy, and their coarser and finer values. */
#ifndef ACCURACY_SETTINGS_H
#define ACCURACY_SETTINGS_H

#include "../memory/memory.h"

#include <flankfilm/engine.h>

/* A setting: a numeric parameter with FF_TUNABLE. */
typedef struct accuracy_knob {
    size_t stage; /* index in the pipeline */
    const char *name;
    size_t param; /* index in the stage */
    bool open;    /* the file leaves it to the model's preset */
} accuracy_knob;

/* One level coarser multiplies a tolerance by this factor. */
static const double accuracy_tolerance_factor = 4;

/* Prints the assignment that makes a setting `levels` levels coarser (finer if below 0). NULL if
   the value is outside the row's limits. */
const char *accuracy_setting_at(const ff_stage *stage, size_t param, double levels,
                                memory_arena *arena);

/* Lists the settings of the stages that are needed, in the order in which these run. One level
   halves a count of points, cells or steps. Any other number is a tolerance or a distance of
   points. One level multiplies it by 4, since halving a count multiplies an error of second order
   by 4, too. Words such as "auto" are left to the model. */
accuracy_knob *accuracy_knobs(const ff_pipeline *pipeline, size_t *count, memory_arena *arena);

/* Prints the assignments of all these settings, "film.cells=362". */
const char **accuracy_list_settings(const ff_pipeline *pipeline, size_t *count,
                                    memory_arena *arena);

#endif
