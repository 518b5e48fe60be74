/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The settings that a file leaves open, and how coarse each of them is. */
#ifndef ACCURACY_OPEN_SETTINGS_H
#define ACCURACY_OPEN_SETTINGS_H

#include "settings.h"

/* Level of the finest settings: four times as many cells and steps as by preset, 16 times the work.
 */
static const double accuracy_finest = -2;

typedef struct accuracy_open_setting {
    const ff_stage *stage;
    accuracy_setting setting;
    bool cheap;    /* its stage costs little */
    bool dearest;  /* none costs more than its stage */
    double behind; /* levels that it is coarser than the others */
    double level;  /* coarser than the preset by so much */
} accuracy_open_setting;

typedef struct accuracy_open {
    accuracy_open_setting *all;
    size_t count;
    const char *given; /* "film.cells, film.steps": settings that the file gives itself; "": none */
    memory_arena *arena;
} accuracy_open;

/* Lists those of a pipeline. */
void accuracy_open_list(accuracy_open *open, const ff_pipeline *pipeline);
void accuracy_open_free(accuracy_open *open);
/* "film.cells=256"; NULL: the limits of the setting forbid its level. */
const char *accuracy_open_set(const accuracy_open *open, size_t i);
/* Sets the level of all: settings of stages that cost little are finer. Returns whether one
 * changes. */
bool accuracy_open_move(accuracy_open *open, double level);
/* Whether all can be two levels coarser, as in a twin of a twin. */
bool accuracy_open_have_twins(const accuracy_open *open);

#endif
