/* SPDX-License-Identifier: MIT */
/* Rows of older versions of the interface, and how rows name each other. */
#ifndef FE_ROWS_H
#define FE_ROWS_H

#include <flankfilm/engine.h>

/* A copy of the descriptor with all members of this version; what an older one lacks is 0. */
const ff_model *fe_model_complete(const ff_model *model);

/* "gear.teeth" and the service "gear" are on the wire "gear". */
bool fe_is_on_wire(const char *input, const char *wire);

#endif
