/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads and writes whole files, also if signals interrupt the system calls. */
#ifndef MEMORY_FILE_H
#define MEMORY_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>

/* Opens a regular file for reading. Refuses anything else, such as a pipe, whose opening could
 * block. Returns -1 on failure and writes the reason to `why`, which may be NULL. */
int file_open(int directory, const char *name, const char **why);
FILE *file_stream(int directory, const char *name); /* the same, as a stream; NULL on failure */

/* Read or write `size` bytes at offset `at`, or at the current position if `at` is below 0. On
 * failure they return false and set errno; to EIO if the file ends too early. */
bool file_read(int fd, void *data, size_t size, off_t at);
bool file_write(int fd, const void *data, size_t size, off_t at);

#endif
