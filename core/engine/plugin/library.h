/* SPDX-License-Identifier: MIT */
#ifndef FE_LIBRARY_H
#define FE_LIBRARY_H

#include <flankfilm/engine.h>

/* Finds models in these directories before all others. */
ff_library *fe_library_new(const char *const *directories, size_t count);
void fe_library_free(ff_library *library);

#endif
