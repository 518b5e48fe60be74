/* SPDX-License-Identifier: MIT */
/* The closed table of unit symbols. Internal to core/engine/value. */
#ifndef FE_UNIT_TABLE_H
#define FE_UNIT_TABLE_H

#include <flankfilm/engine.h>

/* One unit in terms of the base units: scale * 10^ten. The power of ten is kept apart, so that
 * the factor of a product of decimal units is correctly rounded. */
typedef struct fe_symbol {
    const char *name;
    double scale;
    int ten;
    int8_t power[FF_DIMENSIONS];
    bool prefixed; /* takes SI prefixes */
    double offset; /* degC and degF */
} fe_symbol;

/* Finds the unit written as `word`, with its prefix included in the scale. */
bool fe_symbol_find(const char *word, fe_symbol *symbol);

/* Returns the symbol nearest to `word`, or NULL. */
const char *fe_symbol_nearest(const char *word);

/* Returns "a length", "a rotational speed"; NULL if the dimension has no name. */
const char *fe_dimension_name(const ff_unit *unit);

#endif
