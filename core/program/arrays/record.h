/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Layout of a record of a log, used to write and to read it. */
#ifndef ARRAYS_RECORD_H
#define ARRAYS_RECORD_H

#include "log.h"

enum {
    ARRAYS_KEY_AT = 8,
    ARRAYS_START_AT = 32,
    ARRAYS_OUTPUT_AT = 40,
    ARRAYS_SUM = 8, /* bytes of the checksum at the end */
    ARRAYS_RECORD_HEAD = ARRAYS_OUTPUT_AT + ARRAYS_LONGEST_OUTPUT + 8 + ARRAYS_NPY_HEADER
};

/* The bytes of a record before its numbers. */
typedef struct arrays_head {
    char bytes[ARRAYS_RECORD_HEAD];
    size_t size;   /* number of these bytes */
    size_t count;  /* number of doubles that follow */
    double length; /* length of the record; a damaged one may state more than any file can have */
} arrays_head;

/* Makes the head from the label. `output` and `key` are cut to the available size. */
void arrays_head_make(arrays_head *head, const arrays_label *label);

/* Writes the text at the start of a log. */
void arrays_log_title(char title[ARRAYS_LOG_HEAD]);
/* Checks the text at the start of a log. Returns false with the reason in `why`. */
bool arrays_log_check_title(const char title[ARRAYS_LOG_HEAD], char why[ARRAYS_WHY]);

#endif
