/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measures the numerical error of an answer by running its stages again with other settings
   (twins). */
#ifndef ACCURACY_MEASURE_H
#define ACCURACY_MEASURE_H

#include "twin.h"

#include <flankfilm/engine.h>

/* The part of an output's error that one setting of a stage (a row with FF_TUNABLE) causes. */
typedef struct accuracy_part {
    const ff_stage *stage;
    const char *setting; /* "cells"; "use" for an accepted model */
    double error;        /* relative, like the error of the output */
} accuracy_part;

/* Suffix of an output's error bar in files and pages, as in "h_min_error_bar". */
#define ACCURACY_BAR "_error_bar"

/* Size of a progress text, which says what is being run. */
enum { ACCURACY_PROGRESS = 120 };

/* The numerical error of an output. */
typedef struct accuracy_error {
    const ff_stage *stage;
    const ff_result *result;
    double goal;   /* the file's goal; NaN if it states none */
    bool absolute; /* the goal is absolute, in SI, not relative */
    /* the error to be compared with the goal: `relative`, or absolute in SI */
    double reached;
    double zero_point; /* zero point of relative errors, SI */
    double *bar;       /* error bar of each number, SI, at least 0; NULL if it is not known */
    double relative;   /* relative error; for a series, at 95 of 100 points; NaN if it is not
                        * known */
    double largest;    /* largest relative error along a series */
    double order; /* observed order; if `by_stage`, that of the stage's estimate; NaN if none was
                     observed */
    double twin_difference; /* difference from a finer twin, in the form of `reached`; NaN if not
                             * comparable */
    double fixed_part; /* part of `reached`, if above the goal, that is due to settings of the file;
                          0 if unknown */
    bool by_stage; /* the bar comes from the stage's own estimate, which is larger than that of the
                    * twins */
    accuracy_part *parts; /* contributions of the settings, largest first; empty if no twin
                           * separates them */
    size_t part_count;
} accuracy_error;

/* Starts zeroed. */
typedef struct accuracy_record {
    accuracy_error *errors;
    size_t count;
    accuracy_runs runs;  /* all attempts and twins */
    bool two_levels;     /* the errors come from a single coarser twin */
    const char *failure; /* why a twin failed; NULL if none did */
    /* number of answers measured, including the last one; 0 if there are no goals */
    size_t attempts;
    const char **chosen; /* "film.cells=362": the answer's values of the settings that the file
                            leaves open */
    size_t chosen_count;
    const char *fixed;   /* "film.cells, film.steps": settings fixed by the file; "" if there are
                            none */
    ff_pipeline *answer; /* the pipeline with the answer, of the file's run or of `twin` */
    const accuracy_twin *twin; /* the attempt that is the answer; NULL if there were none */
    /* Choice of models, whose errors are included; NULL if none was made. */
    struct accuracy_choice *choice;
    bool checked;              /* the file asks that a finer twin checks the errors */
    bool from_finer;           /* the errors come from that same twin */
    const char *check_failure; /* why there is no such twin; NULL if there is one */
    char *progress; /* set by the caller: receives the progress text, at most ACCURACY_PROGRESS
                     * characters; or NULL */
    memory_arena arena;
} accuracy_record;

/* The number of twins that measure an answer. */
enum accuracy_effort {
    ACCURACY_ENOUGH, /* a second one only if the first leaves an error above its goal */
    ACCURACY_ORDER,  /* two, which show the order */
    ACCURACY_PARTS,  /* also one for each setting, which shows the contribution of that setting */
};

/*
 * Measures the errors of the requested scalars and series in an attempt or, if `attempt` is NULL,
 * in the file's own run. The scene's runs serve as twins if their settings fit. Returns false if
 * the observer stopped it.
 */
bool accuracy_measure(accuracy_record *record, const accuracy_scene *scene,
                      const accuracy_twin *attempt, enum accuracy_effort effort);
/* Compares the answer of a measured record with a twin whose settings are all a level finer, as
 * `accuracy: {check: twins}` asks. If the twin fails, the record has the reason. Returns false if
 * the observer stopped it. */
bool accuracy_check_twin(accuracy_record *record, const accuracy_scene *scene);
size_t accuracy_twin_count(const accuracy_record *record);
/* CPU time of the twins and of the attempts that are not the answer, s. */
double accuracy_seconds(const accuracy_record *record);
void accuracy_free(accuracy_record *record);

/* NULL if the output's error was not measured. */
const accuracy_error *accuracy_find(const accuracy_record *record, const ff_result *result);

#endif
