/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study that a model drives, for model.c and ask.c. */
#ifndef FF_DESK_H
#define FF_DESK_H

#include "private.h"

#include "../pipeline/tool.h"

#include <flankfilm/study.h>

/* A case that the model has asked for. */
typedef struct ff_asked {
    const ff_study_point *points; /* one for each path; copies */
    size_t repeat;
    const char *label;
    ff_place place;
    const ff_study_answer *answer; /* NULL: nobody has looked yet */
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
    const ff_study *base; /* limits and request of every case */
    ff_expanded *blocks;
    size_t block_count;
    ff_asked *cases;
    size_t count, planned;
    char (*keys)[FF_KEY_SIZE]; /* of each case; "": it has not run */

    const ff_campaign *campaign; /* of the run; NULL: nothing may run yet */
    ff_tally *tally;
    json_t *records;
    json_t *facts; /* or NULL */
    ff_text_file *files;
    size_t file_count;
    int verdict; /* FF_GOOD ...; -1: not said */
};

/* ask.c: a copy of a text of the model's, NULL as "". */
const char *ff_desk_keep(ff_desk *desk, const char *text);
/* What the model may call. */
void ff_desk_open(ff_desk *desk);
/* The cases with these numbers, one by one: a study of one axis. */
void ff_desk_lay_out(const ff_desk *desk, const size_t *numbers, size_t count, ff_study *study,
                     ff_arena *arena);

/* answer.c */
const ff_study_answer *ff_desk_answer(ff_desk *desk, size_t number);

#endif
