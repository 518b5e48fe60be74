/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The settings of a stage that trade speed for accuracy, and coarser values of them. */
#ifndef ACCURACY_SETTINGS_H
#define ACCURACY_SETTINGS_H

#include "../memory/memory.h"

#include <flankfilm/engine.h>

/* A row with FF_TUNABLE that has a number. */
typedef struct accuracy_setting {
    const char *name;
    size_t param;   /* of the stage */
    bool open;      /* the file leaves it to the model's preset */
    bool tolerance; /* it is no count */
} accuracy_setting;

/* Of a level. */
static const double accuracy_tolerance_factor = 4;

enum { ACCURACY_MOST_SETTINGS = 16 };

/* The assignment that makes a number `levels` levels coarser, or finer where that is below 0; NULL:
   outside of the row's limits. */
const char *accuracy_setting_at(const ff_stage *stage, size_t param, double levels,
                                memory_arena *arena);

/* Fills `list`, and returns how many there are. A count is halved, for it stands for points, cells
   or steps; another number is a tolerance or a distance of points and is taken four times as large,
   which is one level where the error is of second order. What a word says, "auto", the model knows
   alone. */
size_t accuracy_settings(const ff_stage *stage, accuracy_setting list[ACCURACY_MOST_SETTINGS]);

#endif
