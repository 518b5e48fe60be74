/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Units and quantities. The base dimensions are m, kg, s, K and rad: angle is a dimension of its
 * own, so rpm is never silently Hz.
 */
#ifndef FE_UNIT_H
#define FE_UNIT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { FE_DIMENSIONS = 5 };

/* SI value = factor * number + offset. offset is not 0 for degC and degF alone. */
typedef struct fe_unit {
    int8_t power[FE_DIMENSIONS]; /* of m, kg, s, K, rad */
    double factor;
    double offset;
} fe_unit;

/*
 * Reads "mm", "N m", "Nm", "1/GPa", "mPa s", "N/(mm um)", "kg/m3", "rev/min". "" and "1" are
 * dimensionless. On failure writes a clause that completes 'the unit "x" ...' into why (size
 * why_size) and returns false. Thread-safe.
 */
bool fe_unit_parse(const char *text, fe_unit *unit, char *why, size_t why_size);

bool fe_unit_same_dimension(const fe_unit *a, const fe_unit *b);
bool fe_unit_is_si(const fe_unit *unit);            /* factor 1, offset 0 */
bool fe_unit_is_dimensionless(const fe_unit *unit); /* all powers 0 */

double fe_unit_to_si(const fe_unit *unit, double number);
double fe_unit_from_si(const fe_unit *unit, double si);
/* Compares `si` with a limit in the unit: -1 below, 0 at it within rounding, 1 above. */
int fe_unit_compare(const fe_unit *unit, double si, double limit);

/* A few units of the same dimension that a message can offer: "m, mm, um, nm"; "" for a dimension
   without a name. */
const char *fe_unit_examples(const fe_unit *unit);

/*
 * Reads a quantity such as "250 N m", "3mm", "20 deg", "1e-3" and gives its SI value. `row` is the
 * unit that the parameter is declared in; its text `row_text` serves messages. A bare number is
 * right only where `row` is dimensionless. NaN, infinities and overflow are refused. On failure
 * writes one sentence into why and returns false. Thread-safe.
 */
bool fe_quantity_parse(const char *text, const fe_unit *row, const char *row_text, double *si,
                       char *why, size_t why_size);

/* Reads a whole number that fits; on failure false, with a sentence in why. */
bool fe_integer_parse(const char *text, int64_t *value, char *why, size_t why_size);

/* Reads a plain finite number, locale-independent; *end is set past it. False: none there. */
bool fe_number_parse(const char *text, double *value, const char **end);

/* Writes `si` in the row's unit as a user would read it, "250 N m" (6 significant digits). */
void fe_quantity_print(double si, const fe_unit *row, const char *row_text, char *out, size_t size);

#endif
