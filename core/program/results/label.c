/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "label.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

const char *results_called(const ff_port *row)
{
    return row->label && *row->label ? row->label : row->doc;
}

/* Whether the label must end here. Brackets behind an operator belong to a formula. */
static bool is_end(const char *doc, size_t at)
{
    return !doc[at] || !strncmp(doc + at, "; ", 2) ||
           (at > 0 && !strncmp(doc + at, " (", 2) && isalnum((unsigned char)doc[at - 1]));
}

/* Whether the comma is part of a list of numbers: behind a digit or in brackets. */
static bool is_clause_end(const char *doc, size_t at)
{
    int open = 0;
    for (size_t i = 0; i < at; i++)
        open += (doc[i] == '[' || doc[i] == '(') - (doc[i] == ']' || doc[i] == ')');
    return is_end(doc, at) || (!strncmp(doc + at, ", ", 2) && at > 0 && open == 0 &&
                               !isdigit((unsigned char)doc[at - 1]));
}

void results_label(const char *doc, size_t room, char out[RESULTS_LABEL_SIZE])
{
    size_t length = 0, at = 0;
    do {
        while (!is_clause_end(doc, at))
            at++;
        if (length == 0 || at <= room)
            length = at;
    } while (!is_end(doc, at++));
    snprintf(out, RESULTS_LABEL_SIZE, "%.*s", (int)length, doc);
}
