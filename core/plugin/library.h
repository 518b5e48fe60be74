/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Finds and loads plugins. A model is loaded once, checked in full, and never unloaded.
 *
 * Search order: the given directories (--plugin-path), FLANKFILM_PLUGIN_PATH, the user's data
 * directory, the installed directory and, when the program runs from its build tree, the build's
 * plugins. The first file found is the one used; what stands behind it is not looked at.
 */
#ifndef FF_LIBRARY_H
#define FF_LIBRARY_H

#include <flankfilm/rows.h>

#include "../value/report.h"
#include "../value/unit.h"

enum { FF_MAX_RANK = 4 };

/* The dimensions of a port row, read from its `dims`. */
typedef struct ff_dims {
    uint32_t rank;       /* with the optional one */
    bool first_optional; /* "engagement? station" */
    char name[FF_MAX_RANK][24];
} ff_dims;

/* A model that passed every check; its tables' texts are read into units and dimensions. */
typedef struct ff_loaded {
    const ff_model *model;
    char *path; /* of the shared object */
    ff_unit *param_units;
    ff_unit *input_units;
    ff_unit *output_units;
    ff_dims *input_dims;
    ff_dims *output_dims;
} ff_loaded;

typedef struct ff_library ff_library;

ff_library *ff_library_new(const char *const *directories, size_t count);
void ff_library_free(ff_library *library);

/*
 * The model `id`, loaded at need. NULL after an error in the report: not found (every path tried,
 * the nearest id: FF_EXIT_INPUT when the id looks like a slip of another's, else FF_EXIT_PLUGIN),
 * no shared object, wrong ABI, bad table. `place` is where the user named it.
 */
const ff_loaded *ff_library_load(ff_library *library, const char *id, ff_place place,
                                 ff_report *report);

/* Sorted ids of all models that can be found, without loading one. Freed with the library. */
const char *const *ff_library_ids(ff_library *library, size_t *count);

/* The first file of that name in the directories of plugins, freed by the caller, or NULL. */
char *ff_library_file(const ff_library *library, const char *name);

#endif
