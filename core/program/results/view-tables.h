/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A directory of results as it is being read, and the tables of the view that grow on the way. */
#ifndef RESULTS_VIEW_TABLES_H
#define RESULTS_VIEW_TABLES_H

#include "../arrays/log.h"
#include "../study/kinds/kinds.h"
#include "view.h"

typedef struct results_rows {
    void **rows;
    size_t count;
} results_rows;

/* What a case gave of a variable. */
typedef struct results_output {
    uint32_t variable;
    uint32_t rank;
    const size_t *shape;
    const json_t *entry; /* of a run: {unit, value} or {unit, dims, shape, data or file} */
    double value;        /* of a study: a scalar */
    off_t offset;        /* of a study: where an array is in the log of the case */
} results_output;

typedef struct results_case {
    const results_output *outputs;
    size_t output_count;
    const char *log; /* of a study, with arrays: the file that holds them */
    char key[STUDY_KEY_SIZE];
} results_case;

typedef struct results_reader {
    results_view view;
    ff_report *report;
    memory_arena arena;
    const char *path;
    int directory;
    arrays_reader logs;      /* of a study */
    json_t *root;            /* of a run: result.json */
    results_case *per_case;  /* one for each case of the view */
    json_t *index;           /* {variable: its index in view.variables} */
    json_t *texts;           /* {text: its address} of texts that many cases share */
    study_tally tally;       /* of the cases that have run */
    results_output *outputs; /* of the case that is being added, with room for more */
    size_t output_count, output_room;
    results_rows facts, citations, stages, axes, variables, cases, figures;
} results_reader;

/* Reads a file of the directory, or of one below it: an object; NULL with errno, which is 0 when it
   is none. */
json_t *results_view_read_json(const results_reader *reader, const char *name);
const char *results_view_text(results_reader *reader,
                              const json_t *text); /* "" when it is not a text */
/* The same of a member of an object. */
const char *results_view_member(results_reader *reader, const json_t *of, const char *key);
/* Returns the same address for the same text. */
const char *results_view_shared_text(results_reader *reader, const char *text);
void *results_view_add_row(results_reader *reader, results_rows *rows, size_t size);
/* Returns the rows in the form that the view has, and empties the table. */
const void *results_view_take_rows(results_reader *reader, results_rows *rows);

void results_view_add_head(results_reader *reader, const json_t *root); /* title, facts, stages */
void results_view_add_citation(results_reader *reader, const char *model, const json_t *entry);
/* What is said of an output; parts that are missing are NULL. */
typedef struct results_entry {
    const json_t *unit, *dims, *shape, *against, *doc, *extremes;
} results_entry;

/* Adds the variable; one that is known already only changes when this entry has more dimensions.
   Then adds the output to the case that is being added, and returns it; NULL when it is none. */
results_output *results_view_add_output(results_reader *reader, const char *name,
                                        const results_entry *entry, uint32_t flags);
/* Hands the outputs that were added over to the case. */
void results_view_take_outputs(results_reader *reader, results_case *of);
/* `line` is as in the record of a case. */
void results_view_add_quality(results_reader *reader, results_rows *rows, const char *stage,
                              const char *name, const json_t *line, const char *text,
                              const char *accepted);

/* Judges a case by its record, which is NULL when it has not run. */
void results_view_judge(results_reader *reader, results_view_case *c, size_t number,
                        const json_t *record);

/* view-run.c and view-study.c: fill in the view; false after an error. */
bool results_view_read_run(results_reader *reader);
bool results_view_read_study(results_reader *reader);

#endif
