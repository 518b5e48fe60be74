/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Traces written for a test. */
#ifndef TEST_TRACE_FILE_H
#define TEST_TRACE_FILE_H

#include <stddef.h>

enum { PATH_ROOM = 64 };

/* Write a new file with a text, or with n points in m; end the program if this fails. The caller
   removes the file. */
void write_text(char path[PATH_ROOM], const char *text);
void write_trace(char path[PATH_ROOM], size_t n, const double *position, const double *height);

#endif
