/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FF_REFERENCE_H
#define FF_REFERENCE_H

#include "../plugin/library.h"

void ff_print_reference(const ff_model *model);
/* A line of the list that leads to the pages; previous: the id before it, or NULL. */
void ff_print_reference_index(const char *id, const char *summary, const char *previous);

#endif
