/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The twins of an answer, which tell its errors: those that were run before, and the rest. */
#ifndef ACCURACY_TWINS_H
#define ACCURACY_TWINS_H

#include "measure.h"
#include "settings.h"
#include "twin.h"

/* A setting with the stage that it belongs to. */
typedef struct accuracy_knob {
    size_t stage; /* in the pipeline */
    accuracy_setting setting;
} accuracy_knob;

typedef struct accuracy_twins {
    accuracy_record *record;
    accuracy_scene scene;
    const ff_pipeline *answer;
    const accuracy_known *known; /* NULL: no attempts are made */
    accuracy_knob *knobs;        /* the settings of all stages that something measured depends on */
    size_t count;
    const accuracy_twin *half, *quarter, *twice; /* NULL: it cannot be had */
    const accuracy_twin *middle, *tight, *loose; /* estimate.h; NULL: not told apart */
    bool is_finer;
    accuracy_twin *refined; /* one for each knob; not good: errors are not split by it */
    bool stopped;
} accuracy_twins;

/* Finds or runs them. The first four are given, and what is to be measured is in the record. */
void accuracy_twins_find(accuracy_twins *twins);
void accuracy_twins_free(accuracy_twins *twins);

#endif
