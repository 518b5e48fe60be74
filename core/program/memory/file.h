/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads and writes files to the end, whatever signals interrupt the calls of the system. */
#ifndef MEMORY_FILE_H
#define MEMORY_FILE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>

/* Opens a file for reading, which must be a regular one: a pipe in its place is not waited for.
 * Without a file -1, with why in words, which may be NULL. */
int file_open(int directory, const char *name, const char **why);
FILE *file_stream(int directory, const char *name); /* the same; NULL without a file */

/* Read or write all of it, from that place on, or where the file stands if `at` is below 0. False
 * with errno; EIO if the file ends before. */
bool file_read(int fd, void *data, size_t size, off_t at);
bool file_write(int fd, const void *data, size_t size, off_t at);

#endif
