/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where plugins stand. */
#include "../value/memory.h"
#include "private.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool is_directory(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}

/* Takes `directory`; empty and repeated ones are left out, so that "" is never the current one. */
static void add(ff_places *places, char *directory)
{
    bool known = !directory || !directory[0];
    for (size_t i = 0; i < places->count && !known; i++)
        known = !strcmp(places->directories[i], directory);
    if (known) {
        free(directory);
        return;
    }
    char **grown = ff_alloc((places->count + 1) * sizeof *grown);
    if (places->count > 0)
        memcpy(grown, places->directories, places->count * sizeof *grown);
    grown[places->count++] = directory;
    free(places->directories);
    places->directories = grown;
}

static void add_list(ff_places *places, const char *list)
{
    for (const char *at = list; at;) {
        size_t length = strcspn(at, ":");
        add(places, ff_print_text("%.*s", (int)length, at));
        at = at[length] ? at + length + 1 : NULL;
    }
}

static void add_user(ff_places *places)
{
    const char *data = secure_getenv("XDG_DATA_HOME");
    const char *home = secure_getenv("HOME");
    if (data && data[0] == '/')
        add(places, ff_print_text("%s/flankfilm/plugins", data));
    else if (home && home[0] == '/')
        add(places, ff_print_text("%s/.local/share/flankfilm/plugins", home));
}

/* The plugins of the build tree that the program stands in: beside it, or beside the build file of
   a directory above. */
static void add_build(ff_places *places)
{
    char program[4096];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length <= 0)
        return;
    program[length] = 0;
    for (int up = 0; up < 4; up++) {
        char *slash = strrchr(program, '/');
        if (!slash || slash == program)
            return;
        *slash = 0;
        char *plugins = ff_print_text("%s/plugins", program);
        char *build = ff_print_text("%s/build.ninja", program);
        bool here = is_directory(plugins) && (up == 0 || access(build, F_OK) == 0);
        free(build);
        if (here) {
            add(places, plugins);
            return;
        }
        free(plugins);
    }
}

void ff_places_find(ff_places *places, const char *const *given, size_t count)
{
    *places = (ff_places){.count = 0};
    for (size_t i = 0; i < count; i++)
        add(places, ff_print_text("%s", given[i]));
    add_list(places, secure_getenv("FLANKFILM_PLUGIN_PATH"));
    add_user(places);
    add(places, ff_print_text("%s", FF_PLUGIN_DIR));
    add_build(places);
}

void ff_places_free(ff_places *places)
{
    for (size_t i = 0; i < places->count; i++)
        free(places->directories[i]);
    free(places->directories);
    *places = (ff_places){.count = 0};
}

char *ff_places_look(const ff_places *places, const char *id, char **tried)
{
    struct stat status;
    *tried = ff_print_text("%s", "");
    for (size_t i = 0; i < places->count; i++) {
        char *path = ff_print_text("%s/%s.so", places->directories[i], id);
        /* lstat: a link that leads nowhere is a broken plugin, not an absent one */
        if (lstat(path, &status) == 0)
            return path;
        char *longer = ff_print_text("%s%s%s", *tried, i ? ", " : "", path);
        free(*tried);
        free(path);
        *tried = longer;
    }
    return NULL;
}

typedef struct names {
    char **list;
    size_t count, room;
} names;

static void add_name(names *n, char *name)
{
    if (n->count + 2 > n->room) {
        n->room = 2 * n->room + 16;
        char **grown = ff_alloc(n->room * sizeof *grown);
        if (n->count > 0)
            memcpy(grown, n->list, n->count * sizeof *grown);
        free(n->list);
        n->list = grown;
    }
    n->list[n->count++] = name;
    n->list[n->count] = NULL;
}

static void list_kind(names *n, const char *directory, const char *kind)
{
    char *path = ff_print_text("%s/%s", directory, kind);
    DIR *files = opendir(path);
    free(path);
    if (!files)
        return;
    for (struct dirent *entry; (entry = readdir(files));) {
        size_t length = strlen(entry->d_name);
        if (length < 4 || strcmp(entry->d_name + length - 3, ".so") != 0)
            continue;
        char *id = ff_print_text("%s/%.*s", kind, (int)length - 3, entry->d_name);
        if (ff_id_is_legal(id))
            add_name(n, id);
        else
            free(id);
    }
    closedir(files);
}

static int compare(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

char **ff_places_list(const ff_places *places, size_t *count)
{
    names n = {.list = ff_alloc(sizeof *n.list), .room = 1};
    for (size_t i = 0; i < places->count; i++) {
        DIR *kinds = opendir(places->directories[i]);
        if (!kinds)
            continue;
        for (struct dirent *entry; (entry = readdir(kinds));)
            if (entry->d_name[0] != '.')
                list_kind(&n, places->directories[i], entry->d_name);
        closedir(kinds);
    }
    qsort(n.list, n.count, sizeof *n.list, compare);
    *count = 0;
    for (size_t i = 0; i < n.count; i++) {
        if (*count > 0 && !strcmp(n.list[*count - 1], n.list[i]))
            free(n.list[i]);
        else
            n.list[(*count)++] = n.list[i];
    }
    n.list[*count] = NULL;
    return n.list;
}
