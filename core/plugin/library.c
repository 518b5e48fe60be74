/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "library.h"

#include "../value/memory.h"
#include "clean.h"
#include "environment.h"
#include "guard.h"
#include "private.h"

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct ff_library {
    ff_arena memory; /* of the models */
    ff_places places;
    ff_loaded **models;
    size_t count;
    char **ids;
    size_t id_count;
};

ff_library *ff_library_new(const char *const *directories, size_t count)
{
    ff_library *library = ff_alloc(sizeof *library);
    ff_places_find(&library->places, directories, count);
    return library;
}

void ff_library_free(ff_library *library)
{
    if (!library)
        return;
    ff_arena_free(&library->memory);
    free(library->models);
    for (size_t i = 0; i < library->id_count; i++)
        free(library->ids[i]);
    free(library->ids);
    ff_places_free(&library->places);
    free(library);
}

const char *const *ff_library_ids(ff_library *library, size_t *count)
{
    if (!library->ids)
        library->ids = ff_places_list(&library->places, &library->id_count);
    *count = library->id_count;
    return (const char *const *)library->ids;
}

char *ff_library_file(const ff_library *library, const char *name)
{
    for (size_t i = 0; i < library->places.count; i++) {
        char *path = ff_print_text("%s/%s", library->places.directories[i], name);
        if (access(path, R_OK) == 0)
            return path;
        free(path);
    }
    return NULL;
}

/* The linker's words without the path that our sentence already names. */
static const char *linker_words(const char *path)
{
    const char *words = dlerror();
    size_t length = strlen(path);
    if (words && !strncmp(words, path, length) && !strncmp(words + length, ": ", 2))
        words += length + 2;
    return words ? words : "for a reason that the linker does not tell";
}

/*
 * RTLD_LOCAL keeps one plugin's names from another's; the object stays for good, since unloading
 * breaks what it registered; RTLD_DEEPBIND would give it an allocator of its own.
 */
static bool open_object(const char *id, ff_loaded *loaded, ff_arena *memory, char *why,
                        size_t why_size)
{
    if (!ff_elf_check(loaded->path, why, why_size))
        return false;
    void *object = dlopen(loaded->path, RTLD_NOW | RTLD_LOCAL);
    if (!object) {
        snprintf(why, why_size, "cannot be loaded: %s", linker_words(loaded->path));
        return false;
    }
    const ff_model *(*model)(void);
    *(void **)(void *)&model = dlsym(object, "flankfilm_model_v1");
    if (!model) {
        snprintf(why, why_size,
                 "has no function flankfilm_model_v1: it is no flankfilm plugin, or one for "
                 "another version of the interface");
        return false;
    }
    loaded->model = model();
    return ff_model_check(loaded, id, memory, why, why_size);
}

/* NULL after an error. */
static ff_loaded *load_model(ff_library *library, const char *id, const char *path, ff_place place,
                             ff_report *report)
{
    char why[1024], clean[1024];
    ff_environment environment;
    ff_loaded *loaded = ff_arena_alloc(&library->memory, sizeof *loaded);
    loaded->path = ff_arena_text(&library->memory, path, strlen(path));
    ff_environment_keep(&environment);
    ff_guard_mark previous = ff_guard_enter(loaded->path, NULL, "load");
    bool good = open_object(id, loaded, &library->memory, why, sizeof why);
    ff_guard_leave(previous);
    const char *changed = ff_environment_restore(&environment);
    if (changed)
        ff_warn(report, place, "the plugin %s %s when it was loaded; this was set back", path,
                changed);
    if (good)
        return loaded;
    ff_clean_text(clean, sizeof clean, why);
    ff_error(report, FF_EXIT_PLUGIN, place, NULL, "the plugin %s %s", path, clean);
    return NULL;
}

/* The model that was meant, also where its kind is left out; NULL: none is near. */
static const char *meant(ff_library *library, const char *id)
{
    size_t count;
    const char *const *ids = ff_library_ids(library, &count);
    const char *near = ff_nearest(id, ids, count);
    for (size_t i = 0; i < count && !near; i++)
        if (!strcmp(strchr(ids[i], '/') + 1, id))
            near = ids[i];
    return near;
}

static void report_absence(ff_library *library, const char *id, const char *tried, ff_place place,
                           ff_report *report)
{
    const char *near = meant(library, id);
    char *hint =
        ff_print_text("looked for %s; --plugin-path and FLANKFILM_PLUGIN_PATH add directories",
                      tried[0] ? tried : "it in no directory at all");
    ff_error(report, near ? FF_EXIT_INPUT : FF_EXIT_PLUGIN, place, hint,
             "there is no model \"%s\"%s%s%s", id, near ? "; did you mean \"" : "",
             near ? near : "", near ? "\"?" : "");
    free(hint);
}

const ff_loaded *ff_library_load(ff_library *library, const char *id, ff_place place,
                                 ff_report *report)
{
    char *tried;
    if (!ff_id_is_legal(id)) {
        const char *near = meant(library, id);
        ff_error(report, FF_EXIT_INPUT, place, NULL,
                 "\"%.100s\" names no model: a model is written kind/name, in lower-case letters, "
                 "digits and hyphens%s%s%s",
                 id, near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
        return NULL;
    }
    for (size_t i = 0; i < library->count; i++)
        if (!strcmp(library->models[i]->model->id, id))
            return library->models[i];
    char *path = ff_places_look(&library->places, id, &tried);
    ff_loaded *loaded = path ? load_model(library, id, path, place, report) : NULL;
    if (!path)
        report_absence(library, id, tried, place, report);
    free(tried);
    free(path);
    if (!loaded)
        return NULL;
    library->models = ff_resize(library->models, (library->count + 1) * sizeof *library->models);
    library->models[library->count++] = loaded;
    return loaded;
}
