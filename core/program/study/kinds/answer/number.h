/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes numbers as text. */
#ifndef STUDY_NUMBER_H
#define STUDY_NUMBER_H

enum { STUDY_NUMBER_SIZE = 32, STUDY_QUANTITY_SIZE = 64 };

/* Writes the shortest decimal number that reads back as the same value; "nan" for one that is not
   finite. */
void study_number_exact(double value, char out[STUDY_NUMBER_SIZE]);

/* Writes so many digits as engineers read them: no power of ten between 1e-4 and 1e9, and from
   10000 on `gap` between the thousands, "14 000"; "not known" for one that is not finite. */
void study_number_text(double value, int digits, const char *gap, char out[STUDY_NUMBER_SIZE]);

/* Writes three digits of a line of quality, or "not known". */
void study_number_short(double value, char out[STUDY_NUMBER_SIZE]);

/* A unit in which a value of that size reads well: number = si * factor + offset. */
typedef struct study_readable {
    double factor, offset;
    const char *unit; /* "" for a pure number */
} study_readable;

study_readable study_readable_unit(const char *si_unit, double magnitude);
/* The unit of an output of that name: temperatures are in degC. */
study_readable study_readable_output(const char *name, const char *si_unit, double magnitude);

/* Writes an SI value in such a unit, "14 000 rpm", as study_number_text does its number. */
void study_quantity_text(double si, const study_readable *unit, int digits, const char *gap,
                         char out[STUDY_QUANTITY_SIZE]);

#endif
