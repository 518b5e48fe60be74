/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Functions with which drivers read texts, and write lines on the terminal. */
#ifndef STUDY_TEXT_H
#define STUDY_TEXT_H

#include "../../run/context.h"

typedef struct study_line {
    size_t used;
    char text[4000];
} study_line;

/* Appends as much as fits to the line. */
void study_line_add(study_line *line, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Prints the line as study_context_print_line does, and empties it. */
void study_line_print(const study_context *context, study_line *line, int indent);

/* Returns the items of a list; a word counts as a list of one. */
const ff_node *const *study_items(const ff_node *const *list, size_t *count);
/* Reads a list of "stage.name"; NULL after an error, which names the key. */
const char **study_read_names(study_context *context, const ff_node *list, const char *key,
                              size_t *count);
/* Reads the requested outputs, at least one. */
bool study_read_outputs(study_context *context, const ff_node *list);
/* Reads a list of parameters to double, or a map from parameters to factors. */
bool study_read_factors(study_context *context, const ff_node *node, const char ***names,
                        double **factors, size_t *count);

/* "film.h_min < 0.1 um" */
typedef struct study_comparison {
    const char *name;  /* name before the sign, and its length */
    char sign;         /* '<' or '>'; 0 if there is none */
    const char *limit; /* text after the sign; "" if there is none */
} study_comparison;
study_comparison study_read_comparison(study_context *context, const char *text);

/* Reads a share such as "0.01" or "1 %". Returns false if the text, which may be NULL, is not a
 * share. */
bool study_read_share(const char *text, double *share);

/* A number with its unit, as written. */
typedef struct study_quantity {
    double number;
    const char *text; /* dimension of the unit, "" if it has none */
    ff_unit unit;
} study_quantity;

/* Reads a quantity; if there is none, reports an error that names the key. */
bool study_read_quantity(study_context *context, const ff_node *node, const char *name,
                         const char *hint, study_quantity *quantity);

/* Return a member of a JSON object; "" or NaN if it is missing. */
const char *study_text_of(const json_t *map, const char *key);
double study_number_of(const json_t *map, const char *key);

#endif
