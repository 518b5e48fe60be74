/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes numbers as text. */
#ifndef RESULTS_NUMBER_H
#define RESULTS_NUMBER_H

#include <stddef.h>

enum { RESULTS_NUMBER_SIZE = 32, RESULTS_NUMBER_DIGITS = 15 };

/*
 * Writes a finite value like printf's %.*g with 1 to RESULTS_NUMBER_DIGITS digits and returns the
 * length. It is several times as fast, which the fields of a film need, and ignores the locale.
 * Where the digits that are cut off are within 1e-3 of a half, the last digit may differ by one.
 */
size_t results_number_print(double value, int digits, char out[RESULTS_NUMBER_SIZE]);

/* Writes the shortest decimal number that reads back as the same value; "nan" for one that is not
   finite. */
void results_number_exact(double value, char out[RESULTS_NUMBER_SIZE]);

/* A unit in which a value of that size reads well: number = si * factor. */
typedef struct results_readable {
    double factor;
    const char *unit; /* "" for a pure number */
} results_readable;

results_readable results_readable_unit(const char *si_unit, double magnitude);

#endif
