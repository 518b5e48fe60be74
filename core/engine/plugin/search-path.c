/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The directories in which plugins are looked for. */
#include "../value/memory.h"
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
        free(directory);
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

static bool is_there(const char *directory, const char *name)
{
    char *path = fe_print_text("%s/%s", directory, name);
    bool there = access(path, F_OK) == 0;
    free(path);
    return there;
}

/* Adds the plugins of the build tree in which the program is: beside it, or beside the build file
   of a directory above. */
static void add_build(fe_search_path *search)
{
    char program[4096];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = 0;
    for (int up = 0; up < 4; up++) {
        char *slash = strrchr(program, '/');
        if (!slash || slash == program)
            return;
        *slash = 0;
        if (is_there(program, "plugins/.") && (up == 0 || is_there(program, "build.ninja"))) {
            add(search, fe_print_text("%s/plugins", program));
            return;
        }
    }
}

/* Adds the plugins that were installed with the program, also after the tree was moved. */
static void add_installed(fe_search_path *search)
{
    char program[4096];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = 0;
    char *slash = strrchr(program, '/');
    if (slash)
        *slash = 0;
    char *moved = fe_print_text("%s/../%s", program, FE_PLUGIN_FOLDER),
         *whole = realpath(moved, NULL);
    if (slash && whole)
        add(search, whole);
    else
        free(whole);
    free(moved);
    add(search, fe_print_text("%s", FE_PLUGIN_DIR));
}

void fe_search_path_new(fe_search_path *search, const char *const *given, size_t count)
{
    *search = (fe_search_path){.count = 0};
    for (size_t i = 0; i < count; i++)
        add(search, fe_print_text("%s", given[i]));
    add_list(search, secure_getenv("FLANKFILM_PLUGIN_PATH"));
    add_user(search);
    add_installed(search);
    add_build(search);
}

void fe_search_path_free(fe_search_path *search)
{
    for (size_t i = 0; i < search->count; i++)
        free(search->directories[i]);
    free(search->directories);
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
        free(*tried);
        free(path);
        *tried = longer;
    }
    return NULL;
}

static int compare(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Finds all files kind/name.so; wildcards in the name of the directory itself are escaped. */
static void find_files(const char *directory, glob_t *files)
{
    char *pattern = fe_alloc(2 * strlen(directory) + sizeof "/*/*.so"), *end = pattern;
    for (const char *at = directory; *at; at++) {
        if (strchr("*?[]\\", *at))
            *end++ = '\\';
        *end++ = *at;
    }
    strcpy(end, "/*/*.so");
    *files = (glob_t){.gl_pathc = 0};
    glob(pattern, GLOB_NOSORT, NULL, files);
    free(pattern);
}

char **fe_search_path_list(const fe_search_path *search, size_t *count)
{
    char **ids = NULL;
    size_t found = 0;
    for (size_t i = 0; i < search->count; i++) {
        size_t before = strlen(search->directories[i]) + 1;
        glob_t files;
        find_files(search->directories[i], &files);
        for (size_t k = 0; k < files.gl_pathc; k++) {
            const char *path = files.gl_pathv[k] + before;
            char *id = fe_copy_text(path, strlen(path) - strlen(".so"));
            ids = fe_resize(ids, (found + 1) * sizeof *ids);
            ids[found++] = id;
        }
        globfree(&files);
    }
    if (found > 0)
        qsort(ids, found, sizeof *ids, compare);
    *count = 0;
    for (size_t i = 0; i < found; i++)
        if (fe_id_is_legal(ids[i]) && (*count == 0 || strcmp(ids[*count - 1], ids[i]) != 0))
            ids[(*count)++] = ids[i];
        else
            free(ids[i]);
    return ids;
}
