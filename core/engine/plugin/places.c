/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where plugins stand. */
#include "../value/memory.h"
#include "private.h"

#include <glob.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Takes `directory`; empty and repeated ones are left out, so that "" is never the current one. */
static void add(fe_places *places, char *directory)
{
    bool known = !directory[0];
    for (size_t i = 0; i < places->count && !known; i++)
        known = !strcmp(places->directories[i], directory);
    if (known) {
        free(directory);
        return;
    }
    size_t size = (places->count + 1) * sizeof *places->directories;
    places->directories = fe_resize(places->directories, size);
    places->directories[places->count++] = directory;
}

static void add_list(fe_places *places, const char *list)
{
    for (const char *at = list; at;) {
        size_t length = strcspn(at, ":");
        add(places, fe_copy_text(at, length));
        at = at[length] ? at + length + 1 : NULL;
    }
}

static void add_user(fe_places *places)
{
    const char *data = secure_getenv("XDG_DATA_HOME");
    const char *home = secure_getenv("HOME");
    if (data && data[0] == '/')
        add(places, fe_print_text("%s/flankfilm/plugins", data));
    else if (home && home[0] == '/')
        add(places, fe_print_text("%s/.local/share/flankfilm/plugins", home));
}

static bool is_there(const char *directory, const char *name)
{
    char *path = fe_print_text("%s/%s", directory, name);
    bool there = access(path, F_OK) == 0;
    free(path);
    return there;
}

/* The plugins of the build tree that the program stands in: beside it, or beside the build file of
   a directory above. */
static void add_build(fe_places *places)
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
            add(places, fe_print_text("%s/plugins", program));
            return;
        }
    }
}

/* Those that were installed with the program, wherever its tree was moved to. */
static void add_installed(fe_places *places)
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
        add(places, whole);
    else
        free(whole);
    free(moved);
    add(places, fe_print_text("%s", FE_PLUGIN_DIR));
}

void fe_places_find(fe_places *places, const char *const *given, size_t count)
{
    *places = (fe_places){.count = 0};
    for (size_t i = 0; i < count; i++)
        add(places, fe_print_text("%s", given[i]));
    add_list(places, secure_getenv("FLANKFILM_PLUGIN_PATH"));
    add_user(places);
    add_installed(places);
    add_build(places);
}

void fe_places_free(fe_places *places)
{
    for (size_t i = 0; i < places->count; i++)
        free(places->directories[i]);
    free(places->directories);
}

char *fe_places_look(const fe_places *places, const char *id, char **tried)
{
    struct stat status;
    *tried = fe_copy_text("", 0);
    for (size_t i = 0; i < places->count; i++) {
        char *path = fe_print_text("%s/%s.so", places->directories[i], id);
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

/* All files kind/name.so of the directory, whose own name is taken letter by letter. */
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

char **fe_places_list(const fe_places *places, size_t *count)
{
    char **ids = NULL;
    size_t found = 0;
    for (size_t i = 0; i < places->count; i++) {
        size_t before = strlen(places->directories[i]) + 1;
        glob_t files;
        find_files(places->directories[i], &files);
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
