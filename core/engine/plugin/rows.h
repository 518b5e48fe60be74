/* SPDX-License-Identifier: MIT */
/* Rows of older versions of the interface, and how rows name each other. */
#ifndef FE_ROWS_H
#define FE_ROWS_H

#include <flankfilm/engine.h>

/* A copy of the descriptor with all members of this version; what an older one lacks is 0. */
const ff_model *fe_model_complete(const ff_model *model);

/* "gear.teeth" and the service "gear" are on the wire "gear". */
bool fe_is_on_wire(const char *input, const char *wire);

/* dims.c: letters, digits and "_", no digit first. */
enum { FE_LONGEST_NAME = 64 };
bool fe_is_name(const char *text, size_t length);
/* Reads the "", "station", "engagement? gear.station" of a row. NULL, or what is wrong. The
   names of `dims` are without their wires. */
const char *fe_dims_read(const ff_model *model, const char *text, ff_dims *dims);
/* The wire that the i-th dimension of a row belongs to: "gear" of "t gear.station", else, of an
   input row, its own. Length 0: an output's own dimension, and any of a model that is older
   than 1.3, where equal names on all wires mean equal lengths. Not ended by '\0'. */
const char *fe_dim_wire(const ff_model *model, const ff_port *row, uint32_t i, size_t *length);
/* A name that this output and one before it have for dimensions of different stages, or NULL. */
const char *fe_dims_clash(const ff_loaded *loaded, size_t output);

#endif
