/* SPDX-License-Identifier: MIT */
/* The directories in which plugins are looked for. */
#include "../value/home.h"
#include "private.h"

#include <glob.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Takes over `directory`. Empty ones are left out, since "" would be the current directory; so are
   repeated ones. */
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

/* Adds a directory that is found beside the engine. */
static void add_own(fe_search_path *search, char *directory)
{
    if (directory)
        add(search, directory);
}

void fe_search_path_new(fe_search_path *search, const char *const *given, size_t count)
{
    *search = (fe_search_path){.count = 0};
    for (size_t i = 0; i < count; i++)
        add(search, fe_print_text("%s", given[i]));
    add_list(search, secure_getenv("FLANKFILM_PLUGIN_PATH"));
    add_user(search);
    add_own(search, fe_installed_file(FE_PLUGIN_FOLDER));
    add(search, fe_copy_text(FE_PLUGIN_DIR, strlen(FE_PLUGIN_DIR)));
    add_own(search, fe_built_file("plugins"));
}

void fe_search_path_free(fe_search_path *search)
{
    for (size_t i = 0; i < search->count; i++)
        fe_free(search->directories[i]);
    fe_free(search->directories);
}

char *fe_search_path_find(const fe_search_path *search, const char *id, char **tried)
{
    struct stat status;
    *tried = fe_copy_text("", 0);
    for (size_t i = 0; i < search->count; i++) {
        char *path = fe_print_text("%s/%s.so", search->directories[i], id);
        /* lstat: a link that leads nowhere is a broken plugin, not an absent one */
        if (lstat(path, &status) == 0)
            return path;
        char *longer = fe_print_text("%s%s%s", *tried, i ? ", " : "", path);
        fe_free(*tried);
        fe_free(path);
        *tried = longer;
    }
    return NULL;
}

static int compare(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

typedef struct listing {
    fe_resource open;
    glob_t files;
} listing;

static void close_listing(void *of)
{
    listing *l = of;
    globfree(&l->files);
}

/* Finds all files kind/name.so; wildcards in the name of the directory itself are escaped. */
static listing *find_files(const char *directory)
{
    listing *l = fe_alloc(sizeof *l);
    char *pattern = fe_alloc(2 * strlen(directory) + sizeof "/*/*.so"), *end = pattern;
    for (const char *at = directory; *at; at++) {
        if (strchr("*?[]\\", *at))
            *end++ = '\\';
        *end++ = *at;
    }
    strcpy(end, "/*/*.so");
    fe_resource_add(&l->open, close_listing, l);
    if (glob(pattern, GLOB_NOSORT, NULL, &l->files) == GLOB_NOSPACE)
        fe_out_of_memory();
    fe_free(pattern);
    return l;
}

char **fe_search_path_list(const fe_search_path *search, size_t *count)
{
    char **ids = NULL;
    size_t found = 0;
    for (size_t i = 0; i < search->count; i++) {
        size_t before = strlen(search->directories[i]) + 1;
        listing *l = find_files(search->directories[i]);
        for (size_t k = 0; k < l->files.gl_pathc; k++) {
            const char *path = l->files.gl_pathv[k] + before;
            char *id = fe_copy_text(path, strlen(path) - strlen(".so"));
            ids = fe_resize(ids, (found + 1) * sizeof *ids);
            ids[found++] = id;
        }
        fe_resource_remove(&l->open);
        close_listing(l);
        fe_free(l);
    }
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
