/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The twins that tell the errors of an answer: earlier runs, and those still to be run. */
#ifndef ACCURACY_TWINS_H
#define ACCURACY_TWINS_H

#include "measure.h"
#include "settings.h"
#include "twin.h"

/* A setting and its stage. */
typedef struct accuracy_knob {
    size_t stage; /* index in the pipeline */
    accuracy_setting setting;
} accuracy_knob;

typedef struct accuracy_twins {
    accuracy_record *record;
    accuracy_scene scene;
    const ff_pipeline *answer;
    const accuracy_known *known; /* NULL if no attempts are made */
    accuracy_knob *knobs;        /* the settings of all stages on which a measured output
                                    depends */
    size_t count;
    const accuracy_twin *half, *quarter, *twice; /* NULL if it cannot be had */
    accuracy_twin *refined; /* one for each knob; not good if errors are not split by it */
    bool stopped;
} accuracy_twins;

/* Finds or runs twins. The first four members are given; the outputs to be measured are in the
   record. Where attempts are made, the first call finds one twin and the second call another. False
   if there are no more. */
bool accuracy_twins_find(accuracy_twins *twins);
void accuracy_twins_free(accuracy_twins *twins);

#endif
