/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A JSON file whose long lists of numbers are read only when they are wanted. */
#ifndef RESULTS_DOCUMENT_H
#define RESULTS_DOCUMENT_H

#include <jansson.h>
#include <stdbool.h>

typedef struct results_document {
    char *text;
    size_t length;
    json_t *root; /* where each "data" is the offset of its list in the text */
} results_document;

/* False when the file cannot be read, or is not a JSON object: then errno is 0. */
bool results_document_open(results_document *document, int directory, const char *name);
void results_document_close(results_document *document);
/* Reads a list of `count` numbers, with NaN for null; false when it is not such a list. */
bool results_document_read_numbers(const results_document *document, const json_t *data,
                                   size_t count, double *out);

#endif
