/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study that a model drives, for model.c and ask.c. */
#ifndef FF_DESK_H
#define FF_DESK_H

#include "private.h"

#include "../pipeline/tool.h"

#include <flankfilm/study.h>

/* A case that the model has asked for. */
typedef struct ff_asked {
    const char *label;
    ff_place place;
    const ff_study_answer *answer; /* NULL: nobody has looked yet */

    size_t of; /* of a sweep: the case that it is, but for what is laid over it */
    const char **outputs;
    size_t output_count;
} ff_asked;

typedef struct ff_text_file {
    const char *name, *text;
} ff_text_file;

/* A map of the file, as the study of its cases. */
typedef struct ff_expanded {
    ff_study *study;
    const ff_study_block *block;
} ff_expanded;

struct ff_desk {
    ff_study_desk table; /* what the model sees of it */
    ff_tool tool;
    const ff_study_model *model;
    const char *name; /* the key that names the model */
    ff_report *report;
    ff_arena arena;
    ff_study_plan plan;
    const ff_study *sweep; /* whose cases are the first; NULL: the plan has them all */
    ff_study list;         /* the others: layout.c */
    size_t room;           /* for cases in its columns, and in these: */
    json_t **starts;       /* what cases of chains start from; NULL: not known yet, or none */
    size_t *repeats;
    ff_measure *measure; /* or NULL */
    ff_expanded *blocks;
    size_t block_count;
    ff_asked *cases;
    size_t count, planned;
    bool astray;               /* the model has asked for a case that the sweep does not have */
    char (*keys)[FF_KEY_SIZE]; /* of each case; "": it has not run */

    const ff_campaign *campaign; /* of the run; NULL: nothing may run yet */
    ff_tally *tally;
    json_t *records;
    ff_case seen;             /* that was looked at last; without a report there is none */
    size_t seen_number;       /* of it */
    const ff_pipeline *first; /* in `check`: of the first case */
    json_t *facts;            /* or NULL */
    ff_text_file *files;
    size_t file_count;
    int verdict; /* FF_GOOD ...; -1: not said */
};

/* ask.c: a copy of a text of the model's, NULL as "". */
const char *ff_desk_keep(ff_desk *desk, const char *text);
/* What the model may call. */
void ff_desk_open(ff_desk *desk);

/* layout.c: adds the case to the list. */
void ff_desk_list(ff_desk *desk, const ff_study_case *c, ff_asked *asked);
/* Leaves those in the list, and their keys, that have run: nothing is asked any more. */
void ff_desk_drop_idle(ff_desk *desk);
void ff_desk_unlist(ff_desk *desk); /* all of it */

/* look.c: what the model may call to see cases before they run. */
void ff_desk_open_looks(ff_study_desk *table);
void ff_desk_forget(ff_desk *desk); /* the case that it saw last */

/* answer.c */
const ff_study_answer *ff_desk_answer(ff_desk *desk, size_t number);

#endif
