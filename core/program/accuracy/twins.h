/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Twins of an answer: runs with coarser or finer settings, from which the errors of the answer are
 * estimated. A twin is an earlier run, or is run here. */
#ifndef ACCURACY_TWINS_H
#define ACCURACY_TWINS_H

#include "measure.h"
#include "settings.h"
#include "twin.h"

typedef struct accuracy_twins {
    accuracy_record *record;
    accuracy_scene scene;
    const ff_pipeline *answer;
    const ff_report *messages; /* messages of the answer; NULL if no setting was chosen */
    ff_place request; /* place of the accuracy request in the file; chosen settings have this
                       * place */
    bool one_by_one; /* each call finds one twin, and none that separates the effects of settings */
    bool far_first;  /* if `one_by_one`: the first twin is two levels coarser */
    accuracy_knob *knobs; /* the settings of all stages on which a measured output depends */
    size_t count;
    const accuracy_twin *half, *quarter, *twice; /* all settings 1 and 2 levels coarser, and 1 level
                                                    finer; NULL: there is none, or it failed */
    const accuracy_twin **refined;    /* one for each knob: this knob is one level finer than in
                                         `quarter`, the others as there; NULL if it was not run */
    const accuracy_twin *fixed_finer; /* like `quarter`, but settings that the file fixes are one
                                  level finer; NULL if it was not run, or failed */
    size_t estimating; /* the only stage that estimates errors of its own; SIZE_MAX: there is none,
                          or there are several */
    const accuracy_twin *others_finer; /* the same for the settings of all other stages */
    bool carried;                      /* the errors that other stages cause in it are known */
    bool estimates; /* the order of the stages' own estimates is wanted, from `half` */
    bool checking;  /* a finer twin checks errors that other twins have measured */
    bool stopped;
} accuracy_twins;

/* Finds or runs twins. The first four members are given; the outputs to be measured are in the
 * record. With `one_by_one`, the first call finds one twin and the second call another. False if
 * there are no more. */
bool accuracy_twins_find(accuracy_twins *twins);
/* Runs the twin that shows the effect of the settings that the file fixes, if there are any. `half`
 * and `quarter` must exist. */
void accuracy_twins_run_fixed(accuracy_twins *twins);
/* Whether other stages than `estimating` have settings. */
bool accuracy_twins_have_others(const accuracy_twins *twins);
/* Runs the twin that shows the effect of these settings. `quarter` must exist. */
void accuracy_twins_run_others(accuracy_twins *twins);
/* Returns a twin whose settings are all a level finer: an earlier run, or a run with the outputs of
   the answer. NULL if no setting can be finer. The first three members are given. */
const accuracy_twin *accuracy_twins_find_finer(accuracy_twins *twins);

#endif
