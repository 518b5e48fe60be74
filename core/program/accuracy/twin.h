/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A twin is a second run of the file with other settings of some stages. */
#ifndef ACCURACY_TWIN_H
#define ACCURACY_TWIN_H

#include "../memory/memory.h"

#include <flankfilm/engine.h>

/* Owns all runs that were made for one answer, in their order. Starts zeroed. */
typedef struct accuracy_runs {
    struct accuracy_twin **list;
    size_t count;
} accuracy_runs;

/* What all twins of an answer share. The answer is the run whose error the twins measure. */
typedef struct accuracy_scene {
    accuracy_runs *runs; /* receives the twins */
    const ff_run *file;  /* the file that a twin copies */
    ff_engine *engine;
    /* Stages that do not depend on the changes reuse the results of this pipeline; NULL: none do.
     */
    const ff_pipeline *reuse_from;
    /* The answer's pipeline, or a pipeline of the same file before there is an answer. In a chain
       of cases a twin starts from the states of this pipeline. */
    const ff_pipeline *start;
    const char *outputs; /* "outputs=[film.h_min]", of which the numbers alone are read; NULL if
                            the outputs are unchanged */
    bool estimates; /* with `outputs`, the stages' estimates of their errors are read as well */
    const ff_observer *watch; /* receives the progress; may be NULL */
} accuracy_scene;

/* A message of a stage. */
typedef struct accuracy_note {
    size_t stage;
    int32_t level;
    const char *text;
} accuracy_note;

typedef struct accuracy_twin {
    ff_run *run;
    ff_report *report;     /* its messages */
    ff_pipeline *pipeline; /* its pipeline; may be NULL after errors */
    bool good;             /* it ran, and its results are usable */
    bool stopped;          /* the observer stopped it */
    double work;           /* CPU time of its stages, s */
    accuracy_note *notes;
    size_t note_count;
    memory_arena arena;
} accuracy_twin;

/* Runs the file with the assignments, as if they were in the file at `place`. `changed` marks the
   stages whose settings differ from those in scene->reuse_from. These and all stages downstream are
   computed; if a stage of a loop is computed, all stages of the loop are. */
const accuracy_twin *accuracy_twin_run(const accuracy_scene *scene, const char *const *sets,
                                       size_t count, const ff_place *place, const bool *changed);
/* Copies the states of all stages if the case belongs to a chain, in which each case starts from
   the final state of the previous case. A twin gets the final states of the answer, so that twin
   and answer follow the same branch of solutions. */
void accuracy_copy_states(const ff_pipeline *from, ff_pipeline *to);
/* Returns why the twin is not usable. */
const char *accuracy_twin_reason(const accuracy_twin *twin);
/* True if the report says that the setting given at `place` changes nothing. An example is the
   tolerance of the automatic steps if the file fixes the number of steps. */
bool accuracy_is_idle(const ff_report *report, ff_place place, const char *stage,
                      const char *setting);
/* Copies the run's messages to the report, except those that the report already has and those about
 * assignments with the place `chosen`. */
void accuracy_twin_copy_messages(const accuracy_twin *run, ff_place chosen,
                                 const ff_observer *watch, ff_report *report);
void accuracy_runs_free(accuracy_runs *runs);

#endif
