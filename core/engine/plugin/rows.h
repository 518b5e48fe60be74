/* SPDX-License-Identifier: MIT */
/* Extends rows of older interface versions, and resolves the names by which rows refer to each
   other. */
#ifndef FE_ROWS_H
#define FE_ROWS_H

#include <flankfilm/engine.h>

/* Returns a copy of the descriptor with all members of this version; members that an older version
   lacks are 0. */
const ff_model *fe_model_complete(const ff_model *model);

/* Whether the input is on the wire: "gear.teeth" and the service "gear" are on "gear". */
bool fe_is_on_wire(const char *input, const char *wire);

/* dims.c: a name has letters, digits and "_", and does not begin with a digit. */
enum { FE_LONGEST_NAME = 64 };
bool fe_is_name(const char *text, size_t length);
/* Reads the dimensions of a row, such as "", "station", "engagement? gear.station". Returns
 * NULL, or what is wrong. The names in `dims` are without their wires. */
const char *fe_dims_read(const ff_model *model, const char *text, ff_dims *dims);
/* Returns the wire to which the i-th dimension of a row belongs: "gear" for "t gear.station"; for
   an input row without a prefix, the row's own wire. Length 0: an output's own dimension. The
   length is always 0 for a model built for an interface before version 1.3, in which equal names
   mean equal lengths on all wires. The text is not NUL-terminated. */
const char *fe_dim_wire(const ff_model *model, const ff_port *row, uint32_t i, size_t *length);
/* Returns a name that this output and an earlier one use for dimensions of different stages, or
   NULL. */
const char *fe_dims_clash(const ff_loaded *loaded, size_t output);

#endif
