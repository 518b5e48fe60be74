/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Twins of an answer: runs of it with coarser or finer settings, from which its errors are
 * estimated. They are taken from earlier runs, or run here. */
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
    const accuracy_twin *half, *quarter, *twice; /* all settings 1 and 2 levels coarser, and 1 level
                                                    finer; NULL: there is none, or it failed */
    accuracy_twin *refined; /* one for each knob, which alone is one level finer than in `quarter`;
                               not good if it was not run */
    bool checking;          /* the twin checks the errors that others have told */
    bool stopped;
} accuracy_twins;

/* Finds or runs twins. The first four members are given; the outputs to be measured are in the
 * record. If `known` is not NULL, the first call finds one twin and the second call another. False
 * if there are no more. */
bool accuracy_twins_find(accuracy_twins *twins);
/* Returns a twin whose settings are all a level finer: one of the record's, or `own`, which it runs
   with the outputs of the answer. The first three members are given. */
const accuracy_twin *accuracy_twins_find_finer(accuracy_twins *twins, accuracy_twin *own);
void accuracy_twins_free(accuracy_twins *twins);

#endif
