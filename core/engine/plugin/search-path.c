/* SPDX-License-Identifier: MIT */
/* The directories that are searched for plugins. */
#include "../value/home.h"
#include "private.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Adds `directory` and takes ownership of it. Repeated and empty directories are left out; "" would
   mean the current directory. */
static void add(fe_search_path *search, char *directory)
{
    bool known = !directory[0];
    for (size_t i = 0; i < search->count && !known; i++)
        known = !strcmp(search->directories[i], directory);
    if (known) {
        fe_free(directory);
        return;
    }
    size_t size = (search->count + 1) * sizeof *search->directories;
    search->directories = fe_resize(search->directories, size);
    search->directories[search->count++] = directory;
}

static void add_list(fe_search_path *search, const char *list)
{
    for (const char *at = list; at;) {
        size_t length = strcspn(at, ":");
        add(search, fe_copy_text(at, length));
        at = at[length] ? at + length + 1 : NULL;
    }
}

static void add_user(fe_search_path *search)
{
    const char *data = secure_getenv("XDG_DATA_HOME");
    const char *home = secure_getenv("HOME");
    if (data && data[0] == '/')
        add(search, fe_print_text("%s/flankfilm/plugins", data));
    else if (home && home[0] == '/')
        add(search, fe_print_text("%s/.local/share/flankfilm/plugins", home));
}

/* Adds a directory found beside the engine's own file. */
static void add_own(fe_search_path *search, char *directory)
{
    if (directory)
        add(search, directory);
}

void fe_search_path_new(fe_search_path *search, const char *const *given, size_t count)
{
    for (size_t i = 0; i < count; i++)
        add(search, fe_print_text("%s", given[i]));
    add_list(search, secure_getenv("FLANKFILM_PLUGIN_PATH"));
    add_user(search);
    add_own(search, fe_installed_file(FE_PLUGIN_FOLDER));
    add(search, fe_copy_text(FE_PLUGIN_DIR, strlen(FE_PLUGIN_DIR)));
    add_own(search, fe_built_file("plugins"));
}

char *fe_search_path_find(const fe_search_path *search, const char *id, char **tried)
{
    struct stat status;
    *tried = fe_copy_text("", 0);
    for (size_t i = 0; i < search->count; i++) {
        char *path = fe_print_text("%s/%s.so", search->directories[i], id);
        /* lstat, not stat: a dangling link is a broken plugin, not an absent one */
        if (lstat(path, &status) == 0)
            return path;
        char *longer = fe_print_text("%s%s%s", *tried, i ? ", " : "", path);
        fe_free(*tried);
        fe_free(path);
        *tried = longer;
    }
    return NULL;
}

/* Whether both paths lead to the same file. */
static bool is_same_file(const char *a, const char *b)
{
    struct stat first, second;
    return stat(a, &first) == 0 && stat(b, &second) == 0 && first.st_dev == second.st_dev &&
           first.st_ino == second.st_ino;
}

char *fe_search_path_others(const fe_search_path *search, const char *id, const char *used)
{
    struct stat status;
    char *list = NULL;
    for (size_t i = 0; i < search->count; i++) {
        char *path = fe_print_text("%s/%s.so", search->directories[i], id);
        if (lstat(path, &status) == 0 && !is_same_file(path, used)) {
            char *longer = fe_print_text("%s%s%s", list ? list : "", list ? ", " : "", path);
            fe_free(list);
            list = longer;
        }
        fe_free(path);
    }
    return list;
}

static int compare(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

typedef struct folder {
    fe_resource open;
    DIR *stream;
} folder;

static void close_folder(void *of)
{
    closedir(((folder *)of)->stream);
}

/* Opens a folder; NULL: there is none. */
static folder *open_folder(const char *path)
{
    folder *f = fe_alloc(sizeof *f);
    f->stream = opendir(path);
    if (f->stream) {
        fe_resource_add(&f->open, close_folder, f);
        return f;
    }
    fe_free(f);
    if (errno == ENOMEM)
        fe_out_of_memory();
    return NULL;
}

/* Returns the next name with that ending, at least one character before it, and no leading dot;
   NULL after the last one. */
static const char *next_name(folder *f, const char *ending)
{
    const struct dirent *entry;
    while ((entry = readdir(f->stream))) {
        size_t length = strlen(entry->d_name), tail = strlen(ending);
        if (entry->d_name[0] != '.' && length > tail &&
            !strcmp(entry->d_name + length - tail, ending))
            return entry->d_name;
    }
    fe_resource_remove(&f->open);
    close_folder(f);
    fe_free(f);
    return NULL;
}

typedef struct id_list {
    char **ids;
    size_t count;
} id_list;

/* Adds the ids of all files KIND/name.so in the directory. */
static void list_kind(id_list *list, const char *directory, const char *kind)
{
    static const char ending[] = ".so";
    char *path = fe_print_text("%s/%s", directory, kind);
    folder *files = open_folder(path);
    const char *name;
    while (files && (name = next_name(files, ending))) {
        int length = (int)(strlen(name) - strlen(ending));
        list->ids = fe_resize(list->ids, (list->count + 1) * sizeof *list->ids);
        list->ids[list->count++] = fe_print_text("%s/%.*s", kind, length, name);
    }
    fe_free(path);
}

char **fe_search_path_list(const fe_search_path *search, size_t *count)
{
    id_list list = {NULL, 0};
    for (size_t i = 0; i < search->count; i++) {
        folder *kinds = open_folder(search->directories[i]);
        const char *kind;
        while (kinds && (kind = next_name(kinds, "")))
            list_kind(&list, search->directories[i], kind);
    }
    char **ids = list.ids;
    size_t found = list.count;
    if (found > 0)
        qsort(ids, found, sizeof *ids, compare);
    *count = 0;
    for (size_t i = 0; i < found; i++)
        if (fe_id_is_legal(ids[i]) && (*count == 0 || strcmp(ids[*count - 1], ids[i]) != 0))
            ids[(*count)++] = ids[i];
        else
            fe_free(ids[i]);
    return ids;
}
