/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Finds and loads plugins. A model is loaded once, checked in full, and never unloaded.
 *
 * Search order: the given directories (--plugin-path), FLANKFILM_PLUGIN_PATH, the user's data
 * directory, the installed directory and, when the program runs from its build tree, the build's
 * plugins. The first file found is the one used; further ones are not looked at.
 */
#ifndef FE_LIBRARY_H
#define FE_LIBRARY_H

#include <flankfilm/rows.h>

#include "../value/report.h"
#include "../value/unit.h"

enum { FE_MAX_RANK = 4 };

/* The dimensions of a port row, read from its `dims`. */
typedef struct fe_dims {
    uint32_t rank;       /* with the optional one */
    bool first_optional; /* "engagement? station" */
    char name[FE_MAX_RANK][24];
} fe_dims;

/* A model that passed every check, with the units and dimensions of its rows. The descriptor and
   its rows have all members of this version, also where the plugin was compiled for an older one.
 */
typedef struct fe_loaded {
    const ff_model *model;
    char *path; /* of the shared object */
    fe_unit *param_units;
    fe_unit *input_units;
    fe_unit *output_units;
    fe_dims *input_dims;
    fe_dims *output_dims;
} fe_loaded;

typedef struct fe_library fe_library;

fe_library *fe_library_new(const char *const *directories, size_t count);
void fe_library_free(fe_library *library);

/*
 * Returns the model `id`, which is loaded at the first call. NULL after an error: it was not found
 * (FE_EXIT_INPUT when the id looks like a misspelt one, else FE_EXIT_PLUGIN), is not a shared
 * object, or has a wrong ABI or a bad table. `place` is where the user named it.
 */
const fe_loaded *fe_library_load(fe_library *library, const char *id, fe_place place,
                                 fe_report *report);

/* Sorted ids of all models that can be found, without loading one. Freed with the library. */
const char *const *fe_library_ids(fe_library *library, size_t *count);

/* The first file of that name in the directories of plugins, freed by the caller, or NULL. */
char *fe_library_file(const fe_library *library, const char *name);

#endif
