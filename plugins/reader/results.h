/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A directory of results as it is being read. */
#ifndef RESULTS_H
#define RESULTS_H

#include <flankfilm/author.h>
#include <flankfilm/reader.h>

#include <jansson.h>
#include <stdbool.h>

/* memory.c: memory that is there, and that of one owner, freed in one go. */
void *results_alloc(size_t size); /* zeroed */
char *results_print_text(const char *format, ...) FF_PRINTF(1, 2);

typedef struct results_arena {
    struct results_block *blocks;
} results_arena;

void *results_arena_alloc(results_arena *arena, size_t size); /* zeroed, for any type */
char *results_arena_text(results_arena *arena, const char *text, size_t length);
void results_arena_free(results_arena *arena);

/* document.c: a JSON file whose long lists of numbers are read only when they are wanted. */
typedef struct results_document {
    char *text;
    size_t length;
    json_t *root; /* each "data" is the place of its list in the text */
} results_document;

/* False when there is no such file, or no such JSON; errno is 0 for the latter. */
bool results_document_open(results_document *document, int directory, const char *name);
void results_document_close(results_document *document);
/* Reads a list of `count` numbers, null as NaN; false when it is none. */
bool results_document_numbers(const results_document *document, const json_t *data, size_t count,
                              double *out);

/* A table of the view that grows. */
typedef struct results_rows {
    void **rows;
    size_t count;
} results_rows;

typedef struct results_case {
    json_t *outputs; /* {name: {unit, value} or {unit, dims, shape, data}}, owned */
    char key[20];    /* of a study: its files are in cases/<key> */
} results_case;

typedef struct results_reader {
    ff_view view;
    const ff_reader_source *source;
    results_arena arena;
    const char *path;
    int directory;
    results_document run;     /* of a single run */
    results_document of_case; /* of a study: arrays of the case that was read last */
    size_t opened;            /* which; view.case_count: none */
    results_case *own;        /* one for each case of the view */
    json_t *index;            /* {variable: rank in view.variables} */
    results_rows facts, citations, stages, axes, variables, cases, drawings;
} results_reader;

/* Says why the directory cannot be read. Returns false. */
bool results_refuse(const results_reader *results, const char *hint, const char *format, ...)
    FF_PRINTF(3, 4);

/* build.c: parts of the view from the JSON of a run or a study. */
const char *results_text(results_reader *results, const json_t *text); /* "" for what is none */
void *results_add(results_reader *results, results_rows *rows, size_t size);
const void *results_keep(results_reader *results, results_rows *rows); /* empties rows */
size_t results_stage(results_reader *results, const char *name, size_t length);
void results_head(results_reader *results, const json_t *root); /* title, facts, stages */
void results_cite(results_reader *results, const char *model, const json_t *entry);
/* name: {unit, doc, dims}; an entry that is known already is left alone. */
void results_variable(results_reader *results, const char *name, const json_t *entry,
                      const json_t *doc, uint32_t flags);
/* What the dimensions of a known variable are plotted against, from the same entry. */
void results_against(results_reader *results, const char *name, const json_t *entry);
void results_quality(results_reader *results, results_rows *rows, const char *stage,
                     const char *name, const json_t *value, const json_t *limit, int verdict,
                     const json_t *text);

/* journal.c: {key: record} of all journals; of those with one key the last that is ok, else the
   last. */
json_t *results_journal_read(int directory);
extern const char results_study_marker[]; /* makes a directory a study's */

/* run.c and study.c: fill in the view; false after results_refuse. */
bool results_read_run(results_reader *results);
bool results_read_study(results_reader *results);

#endif
