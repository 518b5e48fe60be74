/* SPDX-License-Identifier: MIT */
/* The models of an engine: those on the search path, and those that are loaded. */
#include "environment.h"
#include "folder.h"
#include "private.h"
#include "serial.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <libintl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/statvfs.h>
#include <unistd.h>

/* Calls the function with the memory of the engine in use. */
static void protect(ff_engine *engine, void (*work)(void *ctx), void *ctx)
{
    if (fe_protected(&engine->heap, work, ctx) == FF_NOMEM)
        fe_out_of_memory();
}

static void list(void *ctx)
{
    ff_engine *engine = ctx;
    engine->ids = fe_search_path_list(&engine->search, &engine->id_count);
}

const char *const *ff_engine_ids(ff_engine *engine, size_t *count)
{
    if (!engine->ids)
        protect(engine, list, engine);
    *count = engine->id_count;
    return (const char *const *)engine->ids;
}

char *ff_engine_file(const ff_engine *engine, const char *name)
{
    for (size_t i = 0; i < engine->search.count; i++) {
        char *path = fe_print_text("%s/%s", engine->search.directories[i], name);
        if (access(path, R_OK) == 0)
            return path;
        fe_free(path);
    }
    return NULL;
}

/* Returns the message of the dynamic linker without the path, which the engine's message already
   has. */
static const char *linker_words(const char *path)
{
    const char *words = dlerror();
    size_t length = strlen(path);
    if (words && !strncmp(words, path, length) && !strncmp(words + length, ": ", 2))
        words += length + 2;
    return words ? words : "the dynamic linker gives no reason";
}

/* Whether the linker failed because of missing memory. If it cannot map a file it gives no reason:
   either memory is missing, or the file system forbids execution. */
static bool is_memory_error(const char *path, const char *words)
{
    struct statvfs system;
    const char *unmapped = dgettext("libc", "failed to map segment from shared object");
    return strstr(words, strerror(ENOMEM)) ||
           (strstr(words, unmapped) && statvfs(path, &system) == 0 && !(system.f_flag & ST_NOEXEC));
}

/* Opens a shared object for the rest of the process, since unloading breaks what it registered.
   RTLD_LOCAL separates the symbols of plugins. RTLD_DEEPBIND is not used, since it would give a
   plugin an allocator of its own. If memory is missing, the linker often gives another reason. The
   open is therefore tried twice: a fault of the file gives the same reason again. */
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
    if (strcmp(first, why) != 0 || is_memory_error(path, why))
        fe_out_of_memory();
    return NULL;
}

/* A model that is being loaded. */
typedef struct loading {
    ff_engine *engine;
    const char *id;
    ff_place place;
    ff_report *report;
    ff_loaded *loaded;
    bool good;
    char why[1024]; /* reason for the failure */
} loading;

static void open_object(void *ctx)
{
    loading *l = ctx;
    fe_object_file file;
    if (!fe_elf_check(l->loaded->path, &file, l->why, sizeof l->why))
        return;
    /* to return to, since a constructor of the plugin may change the directory */
    int folder = open(".", O_PATH | O_DIRECTORY | O_CLOEXEC);
    void *object = open_file(l->loaded->path, l->why, sizeof l->why);
    l->loaded->build = file.hash;
    fe_object_file *kept = fe_alloc(sizeof *kept);
    *kept = file;
    l->loaded->file = kept;
    bool same = fe_elf_is_same(folder < 0 ? AT_FDCWD : folder, l->loaded->path, &file);
    if (folder >= 0)
        close(folder);
    if (object && !same) {
        snprintf(l->why, sizeof l->why, "was replaced while it was loaded; run the command again");
        return;
    }
    l->good = object && fe_entry_find(object, l->id, &l->loaded->model, l->why, sizeof l->why) &&
              fe_model_check(l->loaded, l->id, l->why, sizeof l->why);
}

/* Loads the file; false after an error. */
static bool load_file(loading *l, char *path)
{
    char clean[1024];
    ff_environment environment;
    fe_folder folder;
    l->loaded = fe_alloc(sizeof *l->loaded);
    l->loaded->path = path;
    fe_environment_keep(&environment);
    fe_folder_keep(&folder);
    ff_guard_mark previous = fe_guard_enter((ff_guard_mark){.path = path, .action = "load"});
    fe_serial_enter(FE_SERIAL_LOADING);
    ff_status status = fe_protected(&l->engine->heap, open_object, l);
    fe_serial_leave(FE_SERIAL_LOADING);
    fe_guard_leave(previous);
    const char *changed = ff_environment_restore(&environment);
    changed = fe_folder_restore(&folder) ? "changed the working directory" : changed;
    if (status == FF_NOMEM)
        fe_out_of_memory();
    if (changed)
        ff_warn(l->report, l->place, "the plugin %s %s when it was loaded; this was undone", path,
                changed);
    if (l->good)
        return true;
    ff_clean_text(clean, sizeof clean, l->why);
    return ff_error(l->report, FF_FAULT_PLUGIN, l->place, NULL, "the plugin %s %s", path, clean);
}

/* Returns the id that was probably meant: the nearest one, or one with the same name and another
   kind; NULL: none. */
static const char *meant(ff_engine *engine, const char *id)
{
    size_t count;
    const char *const *ids = ff_engine_ids(engine, &count);
    const char *near = ff_nearest(id, ids, count), *slash = strchr(id, '/');
    const char *name = slash ? slash + 1 : id;
    for (size_t i = 0; i < count && !near; i++)
        if (!strcmp(strchr(ids[i], '/') + 1, name))
            near = ids[i];
    return near;
}

/* Lists the models of the kind of `id`: "kind/a, kind/b"; "": there are none. To be freed. */
static char *models_of_kind(ff_engine *engine, const char *id)
{
    size_t count, length = strcspn(id, "/") + 1;
    const char *const *ids = ff_engine_ids(engine, &count);
    char *list = fe_print_text("%s", "");
    for (size_t i = 0; i < count; i++) {
        if (strncmp(ids[i], id, length) != 0)
            continue;
        char *longer = fe_print_text("%s%s%s", list, list[0] ? ", " : "", ids[i]);
        fe_free(list);
        list = longer;
    }
    return list;
}

static void report_absence(const loading *l, const char *tried)
{
    const char *near = meant(l->engine, l->id);
    char *others = models_of_kind(l->engine, l->id);
    char *hint =
        fe_print_text("looked for %s; --plugin-path and FLANKFILM_PLUGIN_PATH add directories",
                      tried[0] ? tried : "it, but no directory is searched");
    if (near)
        ff_error(l->report, FF_FAULT_INPUT, l->place, hint,
                 "there is no model \"%s\"; did you mean \"%s\"?", l->id, near);
    else
        ff_error(l->report, FF_FAULT_INPUT, l->place, hint, "there is no model \"%s\"%s%s", l->id,
                 others[0] ? "; the models of this kind are " : "", others);
    fe_free(others);
    fe_free(hint);
}

static void load(void *ctx)
{
    loading *l = ctx;
    ff_engine *engine = l->engine;
    char *tried;
    char *path = fe_search_path_find(&engine->search, l->id, &tried);
    if (!path)
        report_absence(l, tried);
    fe_free(tried);
    if (!path || !load_file(l, path))
        return;
    l->loaded->displaced = fe_search_path_others(&engine->search, l->id, path);
    engine->models = fe_resize(engine->models, (engine->count + 1) * sizeof *engine->models);
    engine->models[engine->count++] = l->loaded;
}

void fe_warn_displaced(const ff_loaded *loaded, ff_report *report)
{
    if (loaded->displaced)
        ff_warn(report, FF_NOWHERE, "%s: the plugin %s takes the place of %s, which is not used",
                loaded->model->id, loaded->path, loaded->displaced);
}

void ff_engine_warn_displaced(const ff_engine *engine, ff_report *report)
{
    for (size_t i = 0; i < engine->count; i++)
        fe_warn_displaced(engine->models[i], report);
}

const ff_loaded *ff_engine_written_over(const ff_engine *engine)
{
    size_t i = 0;
    while (i < engine->count && !fe_is_written_over(engine->models[i]))
        i++;
    return i < engine->count ? engine->models[i] : NULL;
}

const ff_loaded *ff_engine_model(ff_engine *engine, const char *id, ff_place place,
                                 ff_report *report)
{
    if (!fe_id_is_legal(id)) {
        const char *near = meant(engine, id);
        ff_error(report, FF_FAULT_INPUT, place, NULL,
                 "\"%.100s\" does not name a model: a model is written kind/name, in lower-case "
                 "letters, "
                 "digits and hyphens%s%s%s",
                 id, near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
        return NULL;
    }
    for (size_t i = 0; i < engine->count; i++)
        if (!strcmp(engine->models[i]->model->id, id))
            return engine->models[i];
    loading l = {.engine = engine, .id = id, .place = place, .report = report};
    protect(engine, load, &l);
    return l.good ? l.loaded : NULL;
}
