/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A twin: the file once more, with other settings of some stages. */
#ifndef ACCURACY_TWIN_H
#define ACCURACY_TWIN_H

#include "../memory/memory.h"

#include <flankfilm/engine.h>

/* What twins of an answer share. */
typedef struct accuracy_scene {
    const ff_run *file; /* of which a twin is a copy */
    ff_engine *engine;
    /* What does not depend on the changes has its results from there; NULL: nothing has. */
    const ff_pipeline *donor;
    const ff_pipeline *start; /* of the same file; in a chain the twin starts from its states */
    const char *outputs;      /* "outputs=[film.h_min]"; NULL: what `start` has to compute */
    const ff_observer *watch; /* its progress; NULL: nobody looks */
} accuracy_scene;

/* What a stage said. */
typedef struct accuracy_note {
    size_t stage;
    int32_t level;
    const char *text;
} accuracy_note;

typedef struct accuracy_twin {
    ff_run *run;
    ff_report *report;     /* its messages */
    ff_pipeline *pipeline; /* of it; may be NULL after errors */
    bool good;             /* it ran, and its results can be trusted */
    bool stopped;          /* the observer stopped it */
    double work;           /* s: CPU time of its stages */
    accuracy_note *notes;
    size_t note_count;
    memory_arena arena;
} accuracy_twin;

/* Runs the file with the assignments, as if it said them at `place`. `changed` marks the stages
   whose settings are not those of the donor: they and all that they feed are computed, of a loop
   all stages. */
void accuracy_twin_run(accuracy_twin *twin, const accuracy_scene *scene, const char *const *sets,
                       size_t count, const ff_place *place, const bool *changed);
/* In a chain the answer started from its neighbour's state; its twin starts from what the answer
   left, so that both are of one branch. */
void accuracy_hand_states(const ff_pipeline *from, ff_pipeline *to);
/* Why it is not good. */
const char *accuracy_twin_reason(const accuracy_twin *twin);
/* Whether it is a warning about what was set at that place, which the file does not say. */
bool accuracy_is_about(const ff_message *message, ff_place place);
/* Whether a setting that was set at that place changes nothing, as a tolerance of steps that the
   file gives. */
bool accuracy_is_idle(const ff_report *report, ff_place place, const char *stage,
                      const char *setting);
/* Says what the run has to say, but for what the report has already, and what is about the place.
 */
void accuracy_twin_hand_on(const accuracy_twin *run, ff_place chosen, const ff_observer *watch,
                           ff_report *report);
/* Zeroed is nothing. */
void accuracy_twin_free(accuracy_twin *twin);

#endif
