/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures the numerical error of an answer by twins of the stages that it comes from. */
#ifndef ACCURACY_MEASURE_H
#define ACCURACY_MEASURE_H

#include "../memory/memory.h"

#include <flankfilm/engine.h>

/* What a setting of a stage, a row with FF_TUNABLE, adds to the error of an output. */
typedef struct accuracy_part {
    const ff_stage *stage;
    const char *setting; /* "cells"; "use": the model that was chosen */
    double error;        /* relative, as that of the output */
} accuracy_part;

/* What files and pages call the bar of an output: "h_min_error_bar". */
#define ACCURACY_BAR "_error_bar"

/* Runs of the same file, and what the answer said of the settings at a place. */
typedef struct accuracy_known {
    const struct accuracy_twin *const *runs;
    size_t count;
    const ff_report *said;
    ff_place place;
} accuracy_known;

/* Twins of an answer at most. */
enum { ACCURACY_OWN = 5 };

/* The numerical error of an output. */
typedef struct accuracy_error {
    const ff_stage *stage;
    const ff_result *result;
    double goal;          /* what the file asks for, relative; NaN: nothing */
    double zero;          /* SI: what shares of a number are counted from */
    double *bar;          /* of each number, SI, at least 0; NULL: not known */
    double relative;      /* over the number; of a series at 95 of 100 points; NaN: not known */
    double largest;       /* along a series, over the number there */
    double by_tolerances; /* of `relative`; 0: they are not told from the counts */
    double order;         /* observed; NaN: none was */
    bool by_stage;        /* it is what the stage estimates, which is more than twins tell */
    accuracy_part *parts; /* the largest first; none where no twin tells them apart */
    size_t part_count;
} accuracy_error;

/* What was run for an answer. */
typedef struct accuracy_spent {
    const char **settings; /* "film.cells=362": all tunable ones, also those that the file gives */
    size_t setting_count;
    double seconds; /* s: CPU time */
} accuracy_spent;

/* Starts zeroed. */
typedef struct accuracy_record {
    accuracy_error *errors;
    size_t count;
    size_t twins;        /* that were run */
    bool two_levels;     /* errors are told by one coarser twin */
    bool contradicted;   /* a stage estimates an error more than twice as large: what all twins
                            sample too coarsely none of them shows */
    double seconds;      /* s, work of their stages: CPU time */
    const char *failure; /* why a twin failed; NULL: none did */
    size_t attempts;     /* answers that were measured, the last one included; 0: none had a goal */
    const char **chosen; /* "film.cells=362": settings that the file leaves open, of the answer */
    size_t chosen_count;
    accuracy_spent *spent; /* attempts and their twins; none where nothing was chosen */
    size_t spent_count;
    const char *given;   /* "film.cells, film.steps": settings that the file gives; "": none */
    ff_pipeline *answer; /* the pipeline that was run, or another one of `twin` */
    struct accuracy_twin *twin;
    struct accuracy_twin *own[ACCURACY_OWN]; /* that were run for it */
    size_t own_count;
    struct accuracy_choice
        *choice; /* of models, whose part counts with the rest; NULL: none was made */
    memory_arena arena;
} accuracy_record;

/*
 * Measures the errors of the scalars and series that the file asks for, from a run of it that has
 * ended well. Known runs serve as twins where they have their settings; then the errors are told
 * apart by counts and tolerances, and not by settings, which takes more twins than the rest. False
 * where the observer stopped it.
 */
bool accuracy_measure(accuracy_record *record, const ff_run *run, ff_engine *engine,
                      const ff_observer *watch, const accuracy_known *known);
void accuracy_free(accuracy_record *record);

/* NULL: the error of the output was not measured. */
const accuracy_error *accuracy_find(const accuracy_record *record, const ff_result *result);

#endif
