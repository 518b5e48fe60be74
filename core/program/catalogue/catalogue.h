/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints the tables of models as text, for editors and for other programs. */
#ifndef CATALOGUE_H
#define CATALOGUE_H

#include <flankfilm/engine.h>

#include "../memory/memory.h"

#include <jansson.h>

typedef struct catalogue_entry {
    const char *id;
    const ff_model *model; /* NULL: it cannot be loaded */
    const char *why;       /* why it cannot be loaded, or NULL */
    const char *file;      /* path of the plugin; NULL: it cannot be loaded */
    const char *user;      /* name of the stage of a pipeline that uses it, or "" */
} catalogue_entry;

/* The models to print, sorted by id or in the order in which a pipeline uses them. Starts
   zeroed. */
typedef struct catalogue {
    memory_arena arena;
    catalogue_entry *entries;
    size_t count;
} catalogue;

/* Adds a model. `loaded` is NULL if it could not be loaded; the reason is the first error of the
   report. */
void catalogue_add(catalogue *c, const char *id, const ff_loaded *loaded, const char *user,
                   const ff_report *report);
void catalogue_free(catalogue *c);

/* Print to stdout (the schema to `out`). Each function has its own file. With `page` the only entry
   is printed in full, otherwise all are listed. `version` is the version of the program; `commit`
   is the commit of its sources, or "" if unknown. */
void catalogue_print_text(const catalogue *c, bool page);
void catalogue_print_markdown(const catalogue *c, bool page);
void catalogue_print_json(const catalogue *c, bool page, const char *version);
void catalogue_print_schema(const catalogue *c, const char *version, FILE *out);
void catalogue_print_bibtex(const catalogue *c, const char *version, const char *commit);

/* Write the type of a parameter's value, "2 numbers in mm", and its limits, "above 0 to 10;
 * calibrated from 1 to 5", or "" without any. */
const char *catalogue_type_name(const ff_param *row);
void catalogue_print_type(const ff_param *row, char *out, size_t size);
void catalogue_print_limits(const ff_param *row, char *out, size_t size);

/* Returns the length of the kind in "kind/name". */
size_t catalogue_kind_length(const char *id);
/* Prints the value and frees it. */
void catalogue_print_value(json_t *value, size_t flags, FILE *out);

#endif
