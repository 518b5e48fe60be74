/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The settings that a file leaves open, and their levels. */
#ifndef ACCURACY_OPEN_H
#define ACCURACY_OPEN_H

#include "settings.h"

/* Finest level: eight times the cells and steps of the presets, 64 times the work. */
static const double accuracy_finest = -3;

/* The level of a setting that the file leaves open. */
typedef struct accuracy_level {
    bool cheap;   /* belongs to a cheap stage */
    bool idle;    /* the setting has no effect */
    double level; /* levels coarser than the preset */
} accuracy_level;

/* Starts zeroed. */
typedef struct accuracy_open {
    const ff_pipeline *presets; /* pipeline with the presets */
    accuracy_knob *knobs;
    accuracy_level *levels; /* one for each knob */
    size_t count;
    const char *fixed; /* "film.cells, film.steps": settings fixed by the file; "" if there are
                          none */
    double at;         /* levels coarser than the presets */
    memory_arena arena;
} accuracy_open;

/* Lists the open settings of the needed stages, at their presets, or one level finer for cheap
 * stages. */
void accuracy_open_list(accuracy_open *open, const ff_pipeline *presets);
/* Freezes the settings that had no effect in a run. `messages` has the messages of that run; its
 * settings have the place `place`. */
void accuracy_open_freeze_idle(accuracy_open *open, const ff_report *messages, ff_place place);
/* Sets the level; each setting gets the nearest one within its limits. Returns true if a setting
 * changes. */
bool accuracy_open_move(accuracy_open *open, double to);
/* Returns the assignment of a setting, such as "film.cells=362". */
const char *accuracy_open_set(accuracy_open *open, size_t knob);
/* Returns how many settings of the stage with that index are open. */
size_t accuracy_open_count(const accuracy_open *open, size_t stage);

#endif
