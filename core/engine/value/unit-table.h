/* SPDX-License-Identifier: MIT */
/* The fixed table of unit symbols. Internal to core/engine/value. */
#ifndef FE_UNIT_TABLE_H
#define FE_UNIT_TABLE_H

#include <flankfilm/engine.h>

/* One unit in terms of the base units: scale * 10^ten. The power of ten is stored separately, so
   that the factor of a product of decimal units is correctly rounded. */
typedef struct fe_symbol {
    const char *name;
    double scale;
    int ten;
    int8_t power[FF_DIMENSIONS];
    bool prefixed; /* may have SI prefixes */
    double offset; /* non-zero for degC and degF */
} fe_symbol;

/* Finds the unit `word`. The scale includes its prefix. */
bool fe_symbol_find(const char *word, fe_symbol *symbol);

/* Returns the symbol nearest to `word`, or NULL. */
const char *fe_symbol_nearest(const char *word);

/* Returns the name of a dimension such as "a length" or "a rotational speed"; NULL if it has
   none. */
const char *fe_dimension_name(const ff_unit *unit);

#endif
