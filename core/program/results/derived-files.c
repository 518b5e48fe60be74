/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "derived-files.h"
#include "folder.h"

#include "../memory/file.h"
#include "../memory/memory.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char list_name[] = ".flankfilm-made";
enum { LONGEST_NAME = 255 };

/* Returns the file name of a path in this directory; NULL for any other path. */
static const char *name_within(const char *directory, const char *path)
{
    const char *slash = strrchr(path, '/');
    char *parent =
        slash ? memory_print_text("%.*s/", (int)(slash - path), path) : memory_print_text("./");
    struct stat own, other;
    bool same = stat(directory, &own) == 0 && stat(parent, &other) == 0 &&
                own.st_dev == other.st_dev && own.st_ino == other.st_ino;
    free(parent);
    const char *name = slash ? slash + 1 : path;
    return same && *name && strcmp(name, ".") != 0 && strcmp(name, "..") != 0 &&
                   !strchr(name, '\n') && strlen(name) <= LONGEST_NAME
               ? name
               : NULL;
}

/* Describes the state of a file by its length and time, and the state of a directory by its list of
 * files. */
static char *print_state(const char *path)
{
    struct stat info;
    if (stat(path, &info) != 0)
        return NULL;
    if (S_ISDIR(info.st_mode))
        return memory_print_text("directory");
    return memory_print_text("%lld,%lld.%09ld", (long long)info.st_size,
                             (long long)info.st_mtim.tv_sec, info.st_mtim.tv_nsec);
}

void results_made_note(const char *directory, const char *path, const char *written)
{
    const char *name = name_within(directory, path);
    char *state = name ? print_state(written) : NULL;
    char *list = memory_print_text("%s/%s", directory, list_name);
    FILE *stream = state ? fopen(list, "ae") : NULL;
    if (stream) {
        fprintf(stream, "%s %s\n", state, name);
        fclose(stream);
    }
    free(list);
    free(state);
}

/* Removes the file named in a line of the list. If a name has several lines, the last one has its
 * state. */
static bool remove_made(const char *directory, const char *state, const char *name)
{
    char *path = memory_print_text("%s/%s", directory, name), *now = print_state(path);
    bool same = now && !strcmp(now, state);
    bool gone =
        same && (!strcmp(state, "directory") ? results_folder_remove(path) : unlink(path) == 0);
    free(now);
    free(path);
    return gone;
}

char *results_made_remove(const char *directory)
{
    char *list = memory_print_text("%s/%s", directory, list_name);
    char *names = memory_print_text("%s", ""), *line = NULL;
    FILE *stream = file_stream(AT_FDCWD, list);
    size_t size = 0;
    while (stream && getline(&line, &size, stream) > 0) {
        line[strcspn(line, "\n")] = '\0';
        char *name = strchr(line, ' ');
        if (!name || strchr(name, '/'))
            continue;
        *name++ = '\0';
        if (!remove_made(directory, line, name))
            continue;
        memory_add_text(&names, "%s%s", *names ? ", " : "", name);
    }
    if (stream)
        fclose(stream);
    unlink(list);
    free(line);
    free(list);
    return names;
}
