/* SPDX-License-Identifier: MIT */
/* Shared by the files of core/engine/plugin alone. */
#ifndef FE_PLUGIN_PRIVATE_H
#define FE_PLUGIN_PRIVATE_H

#include "engine.h"
#include "guard.h"

#include <sys/stat.h>

/* A file that was checked. */
typedef struct fe_object_file {
    struct stat status;
    uint64_t hash; /* of its bytes */
} fe_object_file;

/* Whether the file is as long as its header says. On failure, `why` is a clause that completes 'the
   plugin x.so ...'. */
bool fe_elf_check(const char *path, fe_object_file *checked, char *why, size_t why_size);

/* Whether the path, seen from the folder of that descriptor, still names the file that was checked,
   unchanged. */
bool fe_elf_is_same(int folder, const char *path, const fe_object_file *checked);

/* The model of that id that the object exports: NULL where its only one is. On failure false, and
   `why` is a clause that completes 'the plugin x.so ...'. */
bool fe_entry_find(void *object, const char *id, const ff_model **model, char *why,
                   size_t why_size);

/* Checks the descriptor of loaded->model, calling none of its functions, and reads the units and
   dimensions of its rows. A descriptor or rows of an older version are replaced by copies of
   today's length. On failure, `why` is a clause that completes 'the plugin x.so ...'. */
bool fe_model_check(ff_loaded *loaded, const char *id, char *why, size_t why_size);

/* Whether it is "kind/name" of lower-case letters, digits and hyphens, which can be part of a path.
 */
bool fe_id_is_legal(const char *id);

/* Those of the options come first. */
void fe_search_path_new(fe_search_path *search, const char *const *given, size_t count);

/* Returns the first file of that id, or NULL, and in *tried the names that were tried. The caller
   frees both. */
char *fe_search_path_find(const fe_search_path *search, const char *id, char **tried);

/* The further files of that id, "a.so, b.so", without those that are the one in use under another
   name; NULL: there are none. The caller frees it. */
char *fe_search_path_others(const fe_search_path *search, const char *id, const char *used);

/* Sorted ids of all files, each once; freed by the caller. */
char **fe_search_path_list(const fe_search_path *search, size_t *count);

#endif
