/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Arrays in files of NumPy's format .npy, version 1.0: float64, little-endian, in C order. */
#ifndef RESULTS_NPY_H
#define RESULTS_NPY_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

enum { RESULTS_NPY_WHY = 200 };

/* Writes the header and the numbers with one call each; the stream takes note of a failure. */
void results_npy_write(FILE *stream, const double *data, const size_t *shape, uint32_t rank);

/* Opens a file that must hold float64 in C order and in this shape, and nothing else. Returns a
   descriptor at the first number; -1 when it does not, and what is wrong. */
int results_npy_open(int directory, const char *name, const size_t *shape, uint32_t rank,
                     char why[RESULTS_NPY_WHY]);
/* Reads the numbers, with NaN for each that is not finite, and closes the file. */
bool results_npy_read(int fd, double *out, size_t count);

#endif
