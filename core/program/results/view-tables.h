/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A directory of results while it is being read, and the growing tables of the view. */
#ifndef RESULTS_VIEW_TABLES_H
#define RESULTS_VIEW_TABLES_H

#include "../arrays/log.h"
#include "../study/kinds/kinds.h"
#include "view.h"

typedef struct results_rows {
    void **rows;
    size_t count;
} results_rows;

/* The value of a variable in a case. */
typedef struct results_output {
    uint32_t variable;
    uint32_t rank;
    const size_t *shape;
    const json_t *entry; /* for a run: {unit, value} or {unit, dims, shape, data or file} */
    double value;        /* for a study: a scalar */
    off_t offset;        /* for a study: offset of an array in the log of the case */
} results_output;

typedef struct results_case {
    const results_output *outputs;
    size_t output_count;
    const char *log; /* for a study with arrays: the log file that contains them */
    char key[STUDY_KEY_SIZE];
} results_case;

typedef struct results_reader {
    results_view view;
    ff_report *report;
    memory_arena arena;
    const char *path;
    int directory;
    arrays_reader logs;      /* study.json; for a study */
    json_t *root;            /* result.json; for a run */
    results_case *per_case;  /* one for each case of the view */
    json_t *index;           /* {variable: its index in view.variables} */
    json_t *texts;           /* {text: its address} for texts that many cases share */
    study_tally tally;       /* counts of the cases that have run */
    results_output *outputs; /* outputs of the case that is being added, and the allocated number */
    size_t output_count, output_room;
    results_rows facts, citations, stages, axes, variables, cases, figures;
} results_reader;

/* Reads a JSON object from a file in the directory or below it. Returns NULL and sets errno, to 0
 * if the file is not a JSON object. */
json_t *results_view_read_json(const results_reader *reader, const char *name);
const char *results_view_text(results_reader *reader,
                              const json_t *text); /* "" if it is not a text */
/* Copies a member of an object in the same way. */
const char *results_view_member(results_reader *reader, const json_t *of, const char *key);
/* Returns the same address for the same text. */
const char *results_view_shared_text(results_reader *reader, const char *text);
void *results_view_add_row(results_reader *reader, results_rows *rows, size_t size);
/* Returns the rows in the form of the view, and empties the table. */
const void *results_view_take_rows(results_reader *reader, results_rows *rows);

void results_view_add_head(results_reader *reader, const json_t *root); /* title, facts, stages */
void results_view_add_citation(results_reader *reader, const char *model, const json_t *entry);
/* Description of an output; missing parts are NULL. */
typedef struct results_entry {
    const json_t *unit, *dims, *shape, *against, *doc, *extremes;
} results_entry;

/* Adds the variable; a known one changes only if this entry has more dimensions. Then adds the
 * output to the current case, and returns it; NULL if the entry is not an output. */
results_output *results_view_add_output(results_reader *reader, const char *name,
                                        const results_entry *entry, uint32_t flags);
/* Moves the added outputs to the case. */
void results_view_take_outputs(results_reader *reader, results_case *of);
/* Adds a quality line in the form of the record of a case. */
void results_view_add_quality(results_reader *reader, results_rows *rows, const char *stage,
                              const char *name, const json_t *line, const char *text,
                              const char *accepted);

/* Sets the verdicts of a case from its record, which is NULL if it has not run. */
void results_view_judge(results_reader *reader, results_view_case *c, size_t number,
                        const json_t *record);

/* view-run.c and view-study.c: fill in the view; false after an error. */
bool results_view_read_run(results_reader *reader);
bool results_view_read_study(results_reader *reader);

#endif
