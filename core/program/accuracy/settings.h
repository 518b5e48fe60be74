/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The settings of a stage that trade speed for accuracy, and their coarser values. */
#ifndef ACCURACY_SETTINGS_H
#define ACCURACY_SETTINGS_H

#include "../memory/memory.h"

#include <flankfilm/engine.h>

/* A numeric parameter with FF_TUNABLE. */
typedef struct accuracy_setting {
    const char *name;
    size_t param;   /* index in the stage */
    bool open;      /* the file leaves it to the model's preset */
    bool tolerance; /* a tolerance, not a count */
} accuracy_setting;

/* Factor of a tolerance per level. */
static const double accuracy_tolerance_factor = 4;

enum { ACCURACY_MOST_SETTINGS = 16 };

/* Prints the assignment that makes a setting `levels` levels coarser (finer if below 0). NULL if
   the value is outside the row's limits. */
const char *accuracy_setting_at(const ff_stage *stage, size_t param, double levels,
                                memory_arena *arena);

/* Fills `list` and returns its length. One level halves a count of points, cells or steps. Any
   other number is a tolerance or a distance of points and is quadrupled, which is one level if the
   error is of second order. Words such as "auto" are left to the model. */
size_t accuracy_settings(const ff_stage *stage, accuracy_setting list[ACCURACY_MOST_SETTINGS]);

#endif
