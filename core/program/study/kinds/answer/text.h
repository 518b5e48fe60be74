/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Helps the drivers with lines on the terminal and with texts in tables and figures. */
#ifndef STUDY_TEXT_H
#define STUDY_TEXT_H

#include "../../run/context.h"

typedef struct study_line {
    size_t used;
    char text[4000];
} study_line;

/* Appends to the line as much as has room. */
void study_line_add(study_line *line, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
/* Prints the line as study_context_print_line does, and empties it. */
void study_line_print(const study_context *context, study_line *line, int indent);

/* Reads a plain number at the start of the text, and sets *end to what follows it. False when there
   is none. */
bool study_read_number(const char *text, double *number, const char **end);

/* Reads a share such as "0.01" or "1 %"; false where the text, which may be NULL, is none. */
bool study_read_share(const char *text, double *share);

/* A number with its unit, as it is written. */
typedef struct study_quantity {
    double number;
    const char *text; /* of the unit, "" without one */
    ff_unit unit;
} study_quantity;

/* Reads one; reports that the key of that name has none. */
bool study_read_quantity(study_context *context, const ff_node *node, const char *name,
                         const char *hint, study_quantity *quantity);

/* Return a member of a JSON object; "" or NaN when it is missing. */
const char *study_text_of(const json_t *map, const char *key);
double study_number_of(const json_t *map, const char *key);

#endif
