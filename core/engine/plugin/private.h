/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the files of core/engine/plugin alone. */
#ifndef FE_PLUGIN_PRIVATE_H
#define FE_PLUGIN_PRIVATE_H

#include "../value/memory.h"
#include "library.h"

#include <stdbool.h>

/* All of the file that the loader will map is there. On failure a clause that completes 'the plugin
   x.so ...' in why. */
bool fe_elf_check(const char *path, char *why, size_t why_size);

/* Everything that the interface asks of loaded->model but its working; reads the units and
   dimensions of its rows. On failure a clause that completes 'the plugin x.so ...' in why. */
bool fe_model_check(fe_loaded *loaded, const char *id, fe_arena *memory, char *why,
                    size_t why_size);

/* "kind/name" of lower-case letters, digits and hyphens: safe to make a path of. */
bool fe_id_is_legal(const char *id);

/* Directories in the order in which they are searched. */
typedef struct fe_places {
    char **directories;
    size_t count;
} fe_places;

void fe_places_find(fe_places *places, const char *const *given, size_t count);
void fe_places_free(fe_places *places);

/* The first file of that id, or NULL; the names that were tried go to *tried. Freed by the caller.
 */
char *fe_places_look(const fe_places *places, const char *id, char **tried);

/* Sorted ids of all files, each once; freed by the caller. */
char **fe_places_list(const fe_places *places, size_t *count);

#endif
