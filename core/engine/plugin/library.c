/* SPDX-License-Identifier: MIT */
#include "library.h"

#include "../value/memory.h"
#include "folder.h"
#include "private.h"
#include "serial.h"

#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct ff_library {
    fe_heap *heap;
    fe_arena memory; /* of the models */
    fe_search_path search;
    ff_loaded **models;
    size_t count;
    char **ids;
    size_t id_count;
};

ff_library *fe_library_new(const char *const *directories, size_t count)
{
    ff_library *library = fe_alloc(sizeof *library);
    library->heap = fe_heap_in_use();
    fe_search_path_new(&library->search, directories, count);
    return library;
}

void fe_library_free(ff_library *library)
{
    if (!library)
        return;
    fe_arena_free(&library->memory);
    fe_free(library->models);
    for (size_t i = 0; i < library->id_count; i++)
        fe_free(library->ids[i]);
    fe_free(library->ids);
    fe_search_path_free(&library->search);
    fe_free(library);
}

const char *const *ff_library_ids(ff_library *library, size_t *count)
{
    fe_heap *before = fe_heap_use(library->heap);
    if (!library->ids)
        library->ids = fe_search_path_list(&library->search, &library->id_count);
    fe_heap_use(before);
    *count = library->id_count;
    return (const char *const *)library->ids;
}

char *ff_library_file(const ff_library *library, const char *name)
{
    for (size_t i = 0; i < library->search.count; i++) {
        char *path = fe_print_text("%s/%s", library->search.directories[i], name);
        if (access(path, R_OK) == 0)
            return path;
        fe_free(path);
    }
    return NULL;
}

/* The message of the dynamic linker without the path, which our sentence names already. */
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
 * Without memory the linker often gives another reason. So it is asked twice: what is wrong with
 * the file is so again.
 */
static void *open_file(const char *path, char *why, size_t why_size)
{
    char first[1024];
    void *object = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (object)
        return object;
    snprintf(first, sizeof first, "cannot be loaded: %s", linker_words(path));
    object = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (object)
        return object;
    snprintf(why, why_size, "cannot be loaded: %s", linker_words(path));
    if (strcmp(first, why) != 0 || strstr(why, strerror(ENOMEM)))
        fe_out_of_memory();
    return NULL;
}

static bool open_object(const char *id, ff_loaded *loaded, fe_arena *memory, char *why,
                        size_t why_size)
{
    if (!fe_elf_check(loaded->path, why, why_size))
        return false;
    void *object = open_file(loaded->path, why, why_size);
    return object && fe_entry_find(object, id, &loaded->model, why, why_size) &&
           fe_model_check(loaded, id, memory, why, why_size);
}

/* A model that is being loaded. */
typedef struct loading {
    ff_library *library;
    const char *id;
    ff_loaded *loaded;
    bool good;
    char why[1024]; /* it is not */
} loading;

static void load(void *ctx)
{
    loading *l = ctx;
    l->good = open_object(l->id, l->loaded, &l->library->memory, l->why, sizeof l->why);
}

/* NULL after an error. */
static ff_loaded *load_model(ff_library *library, const char *id, const char *path, ff_place place,
                             ff_report *report)
{
    char clean[1024];
    ff_environment environment;
    fe_folder folder;
    ff_loaded *loaded = fe_arena_alloc(&library->memory, sizeof *loaded);
    loading l = {.library = library, .id = id, .loaded = loaded};
    loaded->path = fe_arena_text(&library->memory, path, strlen(path));
    ff_environment_keep(&environment);
    fe_folder_keep(&folder);
    ff_guard_mark previous =
        ff_guard_enter((ff_guard_mark){.path = loaded->path, .action = "load"});
    fe_serial_enter(NULL);
    ff_status status = fe_protected(library->heap, load, &l);
    fe_serial_leave(NULL);
    ff_guard_leave(previous);
    const char *changed = ff_environment_restore(&environment);
    changed = fe_folder_restore(&folder) ? "changed the working directory" : changed;
    if (status == FF_NOMEM)
        fe_out_of_memory();
    if (changed)
        ff_warn(report, place, "the plugin %s %s when it was loaded; this was set back", path,
                changed);
    if (l.good)
        return loaded;
    ff_clean_text(clean, sizeof clean, l.why);
    ff_error(report, FF_FAULT_PLUGIN, place, NULL, "the plugin %s %s", path, clean);
    return NULL;
}

/* The model with the nearest id, or of that name in any kind; NULL: there is none. */
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
        fe_print_text("looked for %s; --plugin-path and FLANKFILM_PLUGIN_PATH add directories",
                      tried[0] ? tried : "it in no directory at all");
    ff_error(report, near ? FF_FAULT_INPUT : FF_FAULT_PLUGIN, place, hint,
             "there is no model \"%s\"%s%s%s", id, near ? "; did you mean \"" : "",
             near ? near : "", near ? "\"?" : "");
    fe_free(hint);
}

const ff_loaded *ff_library_load(ff_library *library, const char *id, ff_place place,
                                 ff_report *report)
{
    char *tried;
    if (!fe_id_is_legal(id)) {
        const char *near = meant(library, id);
        ff_error(report, FF_FAULT_INPUT, place, NULL,
                 "\"%.100s\" does not name a model: a model is written kind/name, in lower-case "
                 "letters, "
                 "digits and hyphens%s%s%s",
                 id, near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
        return NULL;
    }
    for (size_t i = 0; i < library->count; i++)
        if (!strcmp(library->models[i]->model->id, id))
            return library->models[i];
    fe_heap *before = fe_heap_use(library->heap);
    char *path = fe_search_path_find(&library->search, id, &tried);
    ff_loaded *loaded = path ? load_model(library, id, path, place, report) : NULL;
    if (!path)
        report_absence(library, id, tried, place, report);
    fe_free(tried);
    fe_free(path);
    if (loaded) {
        size_t size = (library->count + 1) * sizeof *library->models;
        library->models = fe_resize(library->models, size);
        library->models[library->count++] = loaded;
    }
    fe_heap_use(before);
    return loaded;
}
