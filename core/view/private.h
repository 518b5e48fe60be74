/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of core/view alone. */
#ifndef FF_VIEW_PRIVATE_H
#define FF_VIEW_PRIVATE_H

#include "view.h"

#include "../value/memory.h"

#include <jansson.h>

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

struct ff_results {
    ff_view view;
    ff_arena arena;
    ff_report *report;
    char *path;
    int directory;
    ff_document run;      /* of a single run */
    ff_document of_case;  /* of a study: arrays of the case that was read last */
    size_t opened;        /* which; view.case_count: none */
    ff_results_case *own; /* one for each case of the view */
    json_t *index;        /* {variable: rank in view.variables} */
    ff_rows facts, citations, stages, axes, variables, cases, drawings;
};

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

/* run.c and study.c: fill in the view; false with an error. */
bool ff_results_read_run(ff_results *results);
bool ff_results_read_study(ff_results *results);

#endif
