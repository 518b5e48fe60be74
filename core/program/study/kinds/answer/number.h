/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes numbers as text. */
#ifndef STUDY_NUMBER_H
#define STUDY_NUMBER_H

enum { STUDY_NUMBER_SIZE = 32, STUDY_QUANTITY_SIZE = 64 };

/* Writes the shortest decimal number that reads back as the same value; "nan" for one that is not
   finite. */
void study_number_exact(double value, char out[STUDY_NUMBER_SIZE]);

/* Writes `digits` digits in a readable form: without a power of ten between 1e-4 and 1e9, and with
 * `gap` between thousands from 10000 on, "14 000". Writes "not known" if the number is not finite.
 */
void study_number_text(double value, int digits, const char *gap, char out[STUDY_NUMBER_SIZE]);

/* Writes the value of a quality line with three digits, or "not known". */
void study_number_short(double value, char out[STUDY_NUMBER_SIZE]);

/* A readable unit for a value: number = si * factor + offset. */
typedef struct study_readable {
    double factor, offset;
    const char *unit; /* "" for a pure number */
} study_readable;

study_readable study_readable_unit(const char *si_unit, double magnitude);
/* Returns the unit for an output of that name; temperatures are in degC. */
study_readable study_readable_output(const char *name, const char *si_unit, double magnitude);

/* Writes an SI value in a readable unit, "14 000 rpm"; digits and gap as in study_number_text. */
void study_quantity_text(double si, const study_readable *unit, int digits, const char *gap,
                         char out[STUDY_QUANTITY_SIZE]);

#endif
