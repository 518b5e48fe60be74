/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How a record of a log is laid out, for those who write and read it. */
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

/* What stands before the numbers of a record. */
typedef struct arrays_head {
    char bytes[ARRAYS_RECORD_HEAD];
    size_t size;   /* of these */
    size_t count;  /* numbers */
    double length; /* of the record, which may be too large for any file */
} arrays_head;

/* Makes what the label says; `output` and `key` are cut to what has room. */
void arrays_head_make(arrays_head *head, const arrays_label *label);

/* The text at the start of a log. */
void arrays_log_title(char title[ARRAYS_LOG_HEAD]);
/* Says what is wrong with the start of a log, if anything. */
bool arrays_log_check_title(const char title[ARRAYS_LOG_HEAD], char why[ARRAYS_WHY]);

bool arrays_read_at(int fd, void *out, size_t size, off_t at);

#endif
