/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads the arrays of cases from their logs. */
#ifndef STUDY_ARRAY_READ_H
#define STUDY_ARRAY_READ_H

#include "../../arrays/log.h"
#include "../../memory/memory.h"

#include <jansson.h>

/* Reads an array of a case from its log. Returns NULL if there is none, or with a message if it
   cannot be read. */
const double *study_array_read(arrays_reader *reader, const json_t *record, const char *name,
                               memory_arena *arena, size_t *rank, size_t *count,
                               char why[ARRAYS_WHY]);

#endif
