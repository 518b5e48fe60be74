/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The settings that a file leaves open, and how coarse they are. */
#ifndef ACCURACY_OPEN_H
#define ACCURACY_OPEN_H

#include "settings.h"

/* Eight times as many cells and steps as by preset: 64 times the work. */
static const double accuracy_finest = -3;

/* A setting that the file leaves open. */
typedef struct accuracy_knob {
    const ff_stage *stage; /* of the pipeline that was asked for */
    accuracy_setting setting;
    bool cheap;   /* its stage costs little */
    bool idle;    /* it changes nothing */
    double level; /* coarser than the preset by so much */
} accuracy_knob;

/* Coarser than the presets by so many levels. */
typedef struct accuracy_levels {
    double counts, tolerances;
} accuracy_levels;

/* Starts zeroed. */
typedef struct accuracy_open {
    accuracy_knob *knobs;
    size_t count;
    const char *given; /* "film.cells, film.steps": settings that the file gives itself; "": none */
    accuracy_levels at;
    memory_arena arena;
} accuracy_open;

/* Lists the settings of the stages that are needed, as by preset. */
void accuracy_open_list(accuracy_open *open, const ff_pipeline *asked);
/* Leaves the settings at their levels that changed nothing in a run which set them at the place. */
void accuracy_open_leave_idle(accuracy_open *open, const ff_report *said, ff_place place);
/* Sets the levels of the first attempt for outputs that may be off by `asked`, relative. */
void accuracy_open_begin(accuracy_open *open, double asked);
/* Sets the levels, or what is nearest to them within the limits of the settings. Returns whether a
   setting changes. */
bool accuracy_open_move(accuracy_open *open, accuracy_levels to);
/* The assignment of a setting: "film.cells=362". */
const char *accuracy_open_set(accuracy_open *open, size_t knob);
/* Whether the limits of the settings leave room for twins. */
bool accuracy_open_has_twins(accuracy_open *open);
void accuracy_open_free(accuracy_open *open);

#endif
