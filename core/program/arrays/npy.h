/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays in NumPy's format .npy, version 1.0: float64, little-endian, in C order. */
#ifndef ARRAYS_NPY_H
#define ARRAYS_NPY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum {
    ARRAYS_WHY = 200,       /* bytes of a text that says what is wrong */
    ARRAYS_NPY_HEADER = 266 /* bytes of the longest header that is written */
};

/* Makes the header, whose length is a multiple of 64, and returns that. */
size_t arrays_npy_header(const size_t *shape, uint32_t rank, char header[ARRAYS_NPY_HEADER]);

/* Writes the header and the numbers with one call each; the stream takes note of a failure. */
void arrays_npy_write(FILE *stream, const double *data, const size_t *shape, uint32_t rank);

/* Opens a file that must hold float64 in C order and in this shape, and nothing else. Returns a
   descriptor at the first number; -1 when it does not, and what is wrong. */
int arrays_npy_open(int directory, const char *name, const size_t *shape, uint32_t rank,
                    char why[ARRAYS_WHY]);
/* Reads the numbers, with NaN for each that is not finite, and closes the file. */
bool arrays_npy_read(int fd, double *out, size_t count);

/* Puts NaN in the place of each number that is not finite. */
void arrays_npy_clean(double *numbers, size_t count);

#endif
