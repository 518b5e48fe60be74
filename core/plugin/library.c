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

/* What became of one id that was asked for. */
typedef struct entry {
    char *id;
    ff_loaded *loaded; /* NULL: it failed, and `text` says why */
    int exit_code;
    char *text, *hint;
} entry;

struct ff_library {
    ff_places places;
    entry *entries;
    size_t count;
    char **ids;
    size_t id_count;
};

const ff_param *ff_model_param(const ff_model *model, size_t index)
{
    const char *rows = (const char *)model->params;
    return (const ff_param *)(const void *)(rows + index * model->param_stride);
}

const ff_port *ff_model_input(const ff_model *model, size_t index)
{
    const char *rows = (const char *)model->inputs;
    return (const ff_port *)(const void *)(rows + index * model->input_stride);
}

const ff_port *ff_model_output(const ff_model *model, size_t index)
{
    const char *rows = (const char *)model->outputs;
    return (const ff_port *)(const void *)(rows + index * model->output_stride);
}

int ff_model_find_param(const ff_model *model, const char *name)
{
    for (size_t i = 0; i < model->param_count; i++)
        if (!strcmp(ff_model_param(model, i)->name, name))
            return (int)i;
    return -1;
}

int ff_model_find_output(const ff_model *model, const char *name)
{
    for (size_t i = 0; i < model->output_count; i++)
        if (!strcmp(ff_model_output(model, i)->name, name))
            return (int)i;
    return -1;
}

ff_library *ff_library_new(const char *const *directories, size_t count)
{
    ff_library *library = ff_alloc(sizeof *library);
    ff_places_find(&library->places, directories, count);
    return library;
}

static void free_loaded(ff_loaded *loaded)
{
    if (!loaded)
        return;
    free(loaded->path);
    free(loaded->param_units);
    free(loaded->input_units);
    free(loaded->output_units);
    free(loaded->input_dims);
    free(loaded->output_dims);
    free(loaded);
}

void ff_library_free(ff_library *library)
{
    if (!library)
        return;
    for (size_t i = 0; i < library->count; i++) {
        entry *e = &library->entries[i];
        free_loaded(e->loaded);
        free(e->id);
        free(e->text);
        free(e->hint);
    }
    free(library->entries);
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
static bool open_object(const char *id, ff_loaded *loaded, char *why, size_t why_size)
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
    return ff_model_check(loaded->model, id, loaded, why, why_size);
}

/* Opens the object at e->loaded->path; on failure the reason goes to the entry. */
static void open_entry(entry *e, ff_place place, ff_report *report)
{
    char why[1024], clean[1024];
    ff_environment environment;
    ff_loaded *loaded = e->loaded;
    ff_environment_keep(&environment);
    ff_guard_mark previous = ff_guard_enter(loaded->path, NULL, "load");
    bool good = open_object(e->id, loaded, why, sizeof why);
    ff_guard_leave(previous);
    const char *changed = ff_environment_restore(&environment);
    if (changed)
        ff_warn(report, place, "the plugin %s %s when it was loaded; this was set back",
                loaded->path, changed);
    if (good)
        return;
    ff_clean_text(clean, sizeof clean, why);
    e->text = ff_print_text("the plugin %s %s", loaded->path, clean);
    e->exit_code = FF_EXIT_PLUGIN;
    free_loaded(loaded);
    e->loaded = NULL;
}

static void not_found(ff_library *library, entry *e, const char *tried)
{
    size_t count;
    const char *const *ids = ff_library_ids(library, &count);
    const char *near = ff_nearest(e->id, ids, count);
    e->text = near ? ff_print_text("there is no model \"%s\"; did you mean \"%s\"?", e->id, near)
                   : ff_print_text("there is no model \"%s\"", e->id);
    e->hint =
        ff_print_text("looked for %s; --plugin-path and FLANKFILM_PLUGIN_PATH add directories",
                      tried[0] ? tried : "it in no directory at all");
    e->exit_code = near ? FF_EXIT_INPUT : FF_EXIT_PLUGIN;
}

static entry *new_entry(ff_library *library, const char *id)
{
    entry *grown = ff_alloc((library->count + 1) * sizeof *grown);
    if (library->count > 0)
        memcpy(grown, library->entries, library->count * sizeof *grown);
    free(library->entries);
    library->entries = grown;
    entry *e = &grown[library->count++];
    e->id = ff_print_text("%s", id);
    return e;
}

static entry *find_entry(ff_library *library, const char *id)
{
    for (size_t i = 0; i < library->count; i++)
        if (!strcmp(library->entries[i].id, id))
            return &library->entries[i];
    return NULL;
}

const ff_loaded *ff_library_load(ff_library *library, const char *id, ff_place place,
                                 ff_report *report)
{
    if (!ff_id_is_legal(id)) {
        ff_error(report, FF_EXIT_INPUT, place, NULL,
                 "\"%.100s\" names no model: a model is written kind/name, in lower-case letters, "
                 "digits and hyphens",
                 id);
        return NULL;
    }
    entry *e = find_entry(library, id);
    if (!e) {
        char *tried;
        e = new_entry(library, id);
        char *path = ff_places_look(&library->places, id, &tried);
        if (path) {
            e->loaded = ff_alloc(sizeof *e->loaded);
            e->loaded->path = path;
            open_entry(e, place, report);
        } else
            not_found(library, e, tried);
        free(tried);
    }
    if (!e->loaded)
        ff_error(report, e->exit_code, place, e->hint, "%s", e->text);
    return e->loaded;
}
