/* SPDX-License-Identifier: MIT */
/* Shared by the files of core/engine/plugin only. */
#ifndef FE_PLUGIN_PRIVATE_H
#define FE_PLUGIN_PRIVATE_H

#include "engine.h"
#include "guard.h"

#include <sys/stat.h>

/* A shared object that has passed the check. */
typedef struct fe_object_file {
    struct stat status;
    uint64_t hash; /* hash of its bytes */
} fe_object_file;

/* Checks that the file is as long as its header states. If not, `why` is a clause that completes
   'the plugin x.so ...'. */
bool fe_elf_check(const char *path, fe_object_file *checked, char *why, size_t why_size);

/* Whether the path, relative to the open directory, still names the checked file, unchanged. */
bool fe_elf_is_same(int folder, const char *path, const fe_object_file *checked);

/* Finds the model with that id among those that the object exports; with id NULL, its only model.
   If it fails, `why` is a clause that completes 'the plugin x.so ...'. */
bool fe_entry_find(void *object, const char *id, const ff_model **model, char *why,
                   size_t why_size);

/* Checks the descriptor of loaded->model without calling its functions, and parses the units and
   dimensions of its rows. Descriptors and rows of an older version are replaced by copies with all
   members of this version. If it fails, `why` is a clause that completes 'the plugin x.so ...'. */
bool fe_model_check(ff_loaded *loaded, const char *id, char *why, size_t why_size);

/* Whether the text is "kind/name" in lower-case letters, digits and hyphens, so that it is safe in
   a path. */
bool fe_id_is_legal(const char *id);

/* Sets up the search path; the given directories come first. */
void fe_search_path_new(fe_search_path *search, const char *const *given, size_t count);

/* Returns the first file with that id, or NULL; *tried lists the names that were tried. The caller
   frees both. */
char *fe_search_path_find(const fe_search_path *search, const char *id, char **tried);

/* Returns the other files with that id, "a.so, b.so"; links to the file in use do not count.
 * NULL: none. The caller frees it. */
char *fe_search_path_others(const fe_search_path *search, const char *id, const char *used);

/* Returns the ids of all files, sorted, each once; the caller frees them. */
char **fe_search_path_list(const fe_search_path *search, size_t *count);

#endif
