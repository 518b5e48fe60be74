/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays in NumPy's format .npy, version 1.0: float64, little-endian, in C order. */
#ifndef ARRAYS_NPY_H
#define ARRAYS_NPY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum {
    ARRAYS_WHY = 200,       /* size of an error text, bytes */
    ARRAYS_NPY_HEADER = 266 /* size of the longest header that is written, bytes */
};

/* Writes a header, padded to a multiple of 64 bytes, and returns its length. */
size_t arrays_npy_header(const size_t *shape, uint32_t rank, char header[ARRAYS_NPY_HEADER]);

/* Writes the header and the numbers with one call each. Errors remain set in the stream. */
void arrays_npy_write(FILE *stream, const double *data, const size_t *shape, uint32_t rank);

/* Opens a file of float64 in C order with exactly this shape. Returns a descriptor positioned at
   the first number, or -1 with the reason in `why`. */
int arrays_npy_open(int directory, const char *name, const size_t *shape, uint32_t rank,
                    char why[ARRAYS_WHY]);
/* Reads the numbers, replaces those that are not finite by NaN, and closes the file. */
bool arrays_npy_read(int fd, double *out, size_t count);

/* Replaces numbers that are not finite by NaN. */
void arrays_npy_clean(double *numbers, size_t count);

#endif
