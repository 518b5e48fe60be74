/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines on the terminal and texts of tables and figures, for the drivers. */
#ifndef STUDY_TEXT_H
#define STUDY_TEXT_H

#include "context.h"

typedef struct study_line {
    size_t used;
    char text[4000];
} study_line;

/* Puts more behind the line, as far as there is room. */
void study_put(study_line *line, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Says the line, and begins another one. */
void study_tell(const study_context *context, study_line *line, int indent);

/* A plain number at the start of the text; *end: what stands behind it. False: there is none. */
bool study_number(const char *text, double *number, const char **end);

/* Members of a JSON object; "" and NaN where there is none. */
const char *study_text_of(const json_t *map, const char *key);
double study_number_of(const json_t *map, const char *key);

/* Text of XML. */
void study_put_xml(FILE *out, const char *text, size_t length);
/* A cell of a table, in quotes. */
void study_put_cell(FILE *out, const char *text);

#endif
