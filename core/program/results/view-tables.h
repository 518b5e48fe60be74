/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A directory of results as it is being read, and the tables of the view that grow on the way. */
#ifndef RESULTS_VIEW_TABLES_H
#define RESULTS_VIEW_TABLES_H

#include "../study/study.h"

#include <flankfilm/writer.h>

typedef struct results_rows {
    void **rows;
    size_t count;
} results_rows;

typedef struct results_case {
    json_t *outputs; /* {name: {unit, value} or {unit, dims, shape, data or file}}, owned */
    char key[STUDY_KEY_SIZE]; /* of a study: its files are in cases/<key> */
} results_case;

typedef struct results_reader {
    ff_view view;
    ff_report *report;
    memory_arena arena;
    const char *path;
    int directory;
    json_t *arrays;         /* of a study: what arrays.json says of the case that was read last */
    size_t arrays_case;     /* the case of `arrays`; view.case_count: none */
    results_case *per_case; /* one for each case of the view */
    json_t *index;          /* {variable: its index in view.variables} */
    study_tally tally;      /* of the cases that have run */
    results_rows facts, citations, stages, axes, variables, cases, drawings;
} results_reader;

/* Reads a file of the directory, or of one below it: an object; NULL with errno, which is 0 when it
   is none. */
json_t *results_view_read_json(const results_reader *reader, const char *name);
const char *results_view_text(results_reader *reader,
                              const json_t *text); /* "" when it is not a text */
void *results_view_add_row(results_reader *reader, results_rows *rows, size_t size);
/* Returns the rows in the form that the view has, and empties the table. */
const void *results_view_take_rows(results_reader *reader, results_rows *rows);

void results_view_add_head(results_reader *reader, const json_t *root); /* title, facts, stages */
void results_view_add_citation(results_reader *reader, const char *model, const json_t *entry);
/* Adds a variable from its entry {unit, dims, against}; one that is known already only changes when
   this entry has more dimensions. */
void results_view_add_variable(results_reader *reader, const char *name, const json_t *entry,
                               const json_t *doc, uint32_t flags);
/* Sets what the dimensions of a known variable are plotted against, from its entry. */
void results_view_set_against(results_reader *reader, const char *name, const json_t *entry);
void results_view_add_quality(results_reader *reader, results_rows *rows, const char *stage,
                              const char *name, const json_t *value, const json_t *limit,
                              int verdict, const json_t *text);

/* Judges a case by its record, which is NULL when it has not run. */
void results_view_judge(results_reader *reader, ff_view_case *c, size_t number,
                        const json_t *record);

/* view-run.c and view-study.c: fill in the view; false after an error. */
bool results_view_read_run(results_reader *reader);
bool results_view_read_study(results_reader *reader);

#endif
