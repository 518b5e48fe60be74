/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study that a model drives, for model.c and ask.c. */
#ifndef STUDY_DESK_H
#define STUDY_DESK_H

#include "private.h"

#include "../../engine/pipeline/tool.h"

#include <flankfilm/study.h>

/* A case that the model has asked for. */
typedef struct study_asked {
    const char *label;
    fe_place place;
    const ff_study_answer *answer; /* NULL: nobody has looked yet */

    size_t of; /* of a sweep: the case that it is, but for what is laid over it */
    const char **outputs;
    size_t output_count;
} study_asked;

typedef struct study_text_file {
    const char *name, *text;
} study_text_file;

/* A map of the file, as the study of its cases. */
typedef struct study_expanded {
    study_definition *study;
    const ff_study_block *block;
} study_expanded;

struct study_desk {
    ff_study_desk table; /* what the model sees of it */
    fe_tool tool;
    const ff_study_model *model;
    const char *name; /* the key that names the model */
    fe_report *report;
    fe_arena arena;
    ff_study_plan plan;
    const study_definition *sweep; /* whose cases are the first; NULL: the plan has them all */
    study_definition list;         /* the others: layout.c */
    size_t room;                   /* for cases in its columns, and in these: */
    json_t **starts; /* what cases of chains start from; NULL: not known yet, or none */
    size_t *repeats;
    study_measure *measure; /* or NULL */
    study_expanded *blocks;
    size_t block_count;
    study_asked *cases;
    size_t count, planned;
    bool astray;                  /* the model has asked for a case that the sweep does not have */
    char (*keys)[STUDY_KEY_SIZE]; /* of each case; "": it has not run */

    const study_campaign *campaign; /* of the run; NULL: nothing may run yet */
    study_tally *tally;
    json_t *records;
    study_case seen;          /* that was looked at last; without a report there is none */
    size_t seen_number;       /* of it */
    const fe_pipeline *first; /* in `check`: of the first case */
    json_t *facts;            /* or NULL */
    study_text_file *files;
    size_t file_count;
    int verdict; /* FF_GOOD ...; -1: not said */
};

/* ask.c: a copy of a text of the model's, NULL as "". */
const char *study_desk_keep(study_desk *desk, const char *text);
/* What the model may call. */
void study_desk_open(study_desk *desk);

/* layout.c: adds the case to the list. */
void study_desk_list(study_desk *desk, const ff_study_case *c, study_asked *asked);
/* Leaves those in the list, and their keys, that have run: nothing is asked any more. */
void study_desk_drop_idle(study_desk *desk);
void study_desk_unlist(study_desk *desk); /* all of it */

/* look.c: what the model may call to see cases before they run. */
void study_desk_open_looks(ff_study_desk *table);
void study_desk_forget(study_desk *desk); /* the case that it saw last */

/* answer.c */
const ff_study_answer *study_desk_answer(study_desk *desk, size_t number);

#endif
