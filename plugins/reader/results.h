/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A directory of results as it is being read. */
#ifndef FF_RESULTS_H
#define FF_RESULTS_H

#include <flankfilm/author.h>
#include <flankfilm/reader.h>

#include <jansson.h>
#include <stdbool.h>

/* memory.c: memory that is there, and that of one owner, freed in one go. */
void *ff_alloc(size_t size); /* zeroed */
char *ff_print_text(const char *format, ...) FF_PRINTF(1, 2);

typedef struct ff_arena {
    struct ff_block *blocks;
} ff_arena;

void *ff_arena_alloc(ff_arena *arena, size_t size); /* zeroed, for any type */
char *ff_arena_text(ff_arena *arena, const char *text, size_t length);
void ff_arena_free(ff_arena *arena);

/* document.c: a JSON file whose long lists of numbers are read only when they are wanted. */
typedef struct ff_document {
    char *text;
    size_t length;
    json_t *root; /* each "data" is the place of its list in the text */
} ff_document;

/* False when there is no such file, or no such JSON; errno is 0 for the latter. */
bool ff_document_open(ff_document *document, int directory, const char *name);
void ff_document_close(ff_document *document);
/* Reads a list of `count` numbers, null as NaN; false when it is none. */
bool ff_document_numbers(const ff_document *document, const json_t *data, size_t count,
                         double *out);

/* A table of the view that grows. */
typedef struct ff_rows {
    void **rows;
    size_t count;
} ff_rows;

typedef struct ff_results_case {
    json_t *outputs; /* {name: {unit, value} or {unit, dims, shape, data}}, owned */
    char key[20];    /* of a study: its files are in cases/<key> */
} ff_results_case;

typedef struct ff_results {
    ff_view view;
    const ff_reader_source *source;
    ff_arena arena;
    const char *path;
    int directory;
    ff_document run;      /* of a single run */
    ff_document of_case;  /* of a study: arrays of the case that was read last */
    size_t opened;        /* which; view.case_count: none */
    ff_results_case *own; /* one for each case of the view */
    json_t *index;        /* {variable: rank in view.variables} */
    ff_rows facts, citations, stages, axes, variables, cases, drawings;
} ff_results;

/* Says why the directory cannot be read. Returns false. */
bool ff_refuse(const ff_results *results, const char *hint, const char *format, ...)
    FF_PRINTF(3, 4);

/* build.c: parts of the view from the JSON of a run or a study. */
const char *ff_results_text(ff_results *results, const json_t *text); /* "" for what is none */
void *ff_results_add(ff_results *results, ff_rows *rows, size_t size);
const void *ff_results_keep(ff_results *results, ff_rows *rows); /* empties rows */
size_t ff_results_stage(ff_results *results, const char *name, size_t length);
void ff_results_head(ff_results *results, const json_t *root); /* title, facts, stages */
void ff_results_cite(ff_results *results, const char *model, const json_t *entry);
/* name: {unit, doc, dims}; an entry that is known already is left alone. */
void ff_results_variable(ff_results *results, const char *name, const json_t *entry,
                         const json_t *doc, uint32_t flags);
/* What the dimensions of a known variable are plotted against, from the same entry. */
void ff_results_against(ff_results *results, const char *name, const json_t *entry);
void ff_results_quality(ff_results *results, ff_rows *rows, const char *stage, const char *name,
                        const json_t *value, const json_t *limit, int verdict, const json_t *text);

/* journal.c: {key: record} of all journals; of those with one key the last that is ok, else the
   last. */
json_t *ff_journal_read(int directory);
extern const char ff_study_marker[]; /* makes a directory a study's */

/* run.c and study.c: fill in the view; false after ff_refuse. */
bool ff_results_read_run(ff_results *results);
bool ff_results_read_study(ff_results *results);

#endif
