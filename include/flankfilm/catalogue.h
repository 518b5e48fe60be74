/* SPDX-License-Identifier: MIT */
/*
 * Service "flankfilm.catalogue/1": what the tables of models say, printed for people, editors and
 * other programs.
 *
 * A model of the kind "catalogue" that offers it is no stage of a pipeline: `models` uses
 * catalogue/text, or json or markdown when these are asked for, `schema` catalogue/schema and
 * `cite` catalogue/bibtex. Texts are UTF-8.
 */
#ifndef FLANKFILM_CATALOGUE_H
#define FLANKFILM_CATALOGUE_H

#include "plugin.h"

#ifdef __cplusplus
extern "C" {
#endif

#define FF_CATALOGUE_ID "flankfilm.catalogue/1"

typedef struct ff_catalogue_entry {
    size_t size;
    const char *id;
    const ff_model *model; /* NULL: it cannot be loaded */
    const char *why;       /* then: for which reason */
    const char *file;      /* of the plugin; NULL when it cannot be loaded */
    const char *user;      /* of a pipeline: the stage that uses it; else "" */
} ff_catalogue_entry;

/* What is to be printed; valid until `print` returns. */
typedef struct ff_catalogue {
    size_t size;
    void *ctx;           /* first argument of the functions below */
    const char *version; /* of the program */
    const ff_catalogue_entry *const *entries;
    size_t entry_count; /* sorted by id, or in the order in which a pipeline uses them */
    int32_t page;       /* 1: the one entry in full; 0: a list */
    /* Words that a file may have at its top, and under `study`; they end with NULL. */
    const char *const *top_keys, *const *study_keys;

    void (*put)(void *ctx, const char *text);
    /* Puts text and a line end where the cursor stands at `column` of the terminal; what has no
       room goes on on lines that begin at `indent`. */
    void (*wrap)(void *ctx, const char *text, int32_t column, int32_t indent);
    /* What may be written for a parameter, as messages say it: 'a number with a unit such as "3
       mm"'. */
    void (*expect)(void *ctx, const ff_param *row, char *out, size_t size);
} ff_catalogue;

typedef struct ff_catalogue_printer {
    size_t size;
    void *self;
    /* FF_OK, or a status after host->fail. */
    ff_status (*print)(void *self, const ff_catalogue *catalogue);
} ff_catalogue_printer;

#ifdef __cplusplus
}
#endif
#endif
