/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "folder.h"

#include "../value/memory.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MAX_NAME = 200, BUFFER = 1 << 18 };

static const char manifest[] = ".flankfilm";
static const char manifest_head[] = "flankfilm result directory; its files:";
static const char part[] = ".part";

typedef struct name_list {
    char **names;
    size_t count;
} name_list;

struct ff_folder {
    char *path;
    int fd;
    name_list old, files;
    FILE *stream; /* of the last of `files`, while it is written */
    char *buffer;
    int error; /* errno of the first failure, 0 */
    char *culprit;
};

static void list_add(name_list *list, const char *name)
{
    list->names = ff_resize(list->names, (list->count + 1) * sizeof *list->names);
    list->names[list->count++] = ff_copy_text(name, strlen(name));
}

static bool list_has(const name_list *list, const char *name)
{
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->names[i], name) == 0)
            return true;
    return false;
}

static void list_free(name_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        free(list->names[i]);
    free(list->names);
}

static void part_name(const char *name, char *out, size_t size)
{
    snprintf(out, size, "%s%s", name, part);
}

static void note_failure(ff_folder *folder, const char *name)
{
    if (folder->error)
        return;
    folder->error = errno ? errno : EIO;
    folder->culprit = ff_copy_text(name, strlen(name));
}

static FILE *open_part(ff_folder *folder, const char *name)
{
    char temporary[MAX_NAME + 8];
    part_name(name, temporary, sizeof temporary);
    int fd = openat(folder->fd, temporary, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    FILE *stream = fd < 0 ? NULL : fdopen(fd, "w");
    if (!stream) {
        note_failure(folder, name);
        if (fd >= 0)
            close(fd);
    }
    return stream;
}

static void close_part(ff_folder *folder, FILE *stream, const char *name)
{
    errno = 0;
    bool lost = ferror(stream) != 0;
    if (fclose(stream) != 0 || lost)
        note_failure(folder, name);
}

static void publish(ff_folder *folder, const char *name)
{
    char temporary[MAX_NAME + 8];
    part_name(name, temporary, sizeof temporary);
    if (renameat(folder->fd, temporary, folder->fd, name) != 0)
        note_failure(folder, name);
}

static void write_manifest(ff_folder *folder, const name_list *a, const name_list *b)
{
    FILE *stream = open_part(folder, manifest);
    if (!stream)
        return;
    fprintf(stream, "%s\n", manifest_head);
    for (size_t i = 0; a && i < a->count; i++)
        fprintf(stream, "%s\n", a->names[i]);
    for (size_t i = 0; b && i < b->count; i++)
        fprintf(stream, "%s\n", b->names[i]);
    close_part(folder, stream, manifest);
    if (!folder->error)
        publish(folder, manifest);
}

/* Reads the names of the earlier results; false when the directory has no manifest of ours. */
static bool read_manifest(ff_folder *folder)
{
    int fd = openat(folder->fd, manifest, O_RDONLY | O_CLOEXEC);
    FILE *stream = fd < 0 ? NULL : fdopen(fd, "r");
    if (!stream)
        return false;
    char line[MAX_NAME + 64];
    bool ours = fgets(line, sizeof line, stream) &&
                strncmp(line, manifest_head, sizeof manifest_head - 1) == 0;
    while (ours && fgets(line, sizeof line, stream)) {
        line[strcspn(line, "\n")] = '\0';
        bool safe = *line && *line != '.' && !strchr(line, '/');
        if (safe && !list_has(&folder->old, line))
            list_add(&folder->old, line);
    }
    fclose(stream);
    return ours;
}

/* Number of entries; when `clean`, leftovers of a run that was killed are removed. */
static size_t scan(const ff_folder *folder, bool clean)
{
    size_t count = 0;
    DIR *directory = opendir(folder->path);
    const struct dirent *entry;
    while (directory && (entry = readdir(directory))) {
        const char *name = entry->d_name;
        size_t length = strlen(name);
        if (strcmp(name, ".") == 0 || strcmp(name, "..") == 0)
            continue;
        count++;
        if (clean && length > sizeof part && strcmp(name + length - sizeof part + 1, part) == 0)
            unlinkat(folder->fd, name, 0);
    }
    if (directory)
        closedir(directory);
    return count;
}

static bool make_path(const char *path)
{
    char *copy = ff_copy_text(path, strlen(path));
    bool made = true;
    for (char *c = copy; made && *c; c++) {
        if (*c != '/' || c == copy)
            continue;
        *c = '\0';
        made = mkdir(copy, 0777) == 0 || errno == EEXIST;
        *c = '/';
    }
    made = made && (mkdir(copy, 0777) == 0 || errno == EEXIST);
    free(copy);
    return made;
}

static bool take_hold(ff_folder *folder, ff_report *report)
{
    const char *path = folder->path;
    folder->fd = make_path(path) ? open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    if (folder->fd < 0)
        return ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, "name another directory with -o",
                        "the result directory \"%s\" cannot be used: %s", path, strerror(errno));
    if (flock(folder->fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, "name another directory with -o",
                        "another run is using the result directory \"%s\"", path);
    bool ours = read_manifest(folder);
    if (!ours && scan(folder, false) > 0)
        return ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, "name another directory with -o",
                        "\"%s\" holds files that are not results of flankfilm", path);
    scan(folder, true);
    write_manifest(folder, &folder->old, NULL);
    if (folder->error)
        return ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, "name another directory with -o",
                        "nothing can be written into \"%s\": %s", path, strerror(folder->error));
    return true;
}

ff_folder *ff_folder_open(const char *path, ff_report *report)
{
    ff_folder *folder = ff_alloc(sizeof *folder);
    folder->fd = -1;
    folder->path = ff_copy_text(path, strlen(path));
    folder->buffer = ff_alloc(BUFFER);
    if (take_hold(folder, report))
        return folder;
    ff_folder_free(folder);
    return NULL;
}

static void tidy_name(ff_folder *folder, const char *stem, const char *suffix, char *out,
                      size_t size)
{
    char base[MAX_NAME / 2];
    snprintf(base, sizeof base, "%s", stem);
    for (char *c = base; *c; c++)
        if (!isalnum((unsigned char)*c) && !strchr("._-+", *c))
            *c = '_';
    if (*base == '.')
        *base = '_';
    snprintf(out, size, "%s%s", base, suffix);
    for (int i = 2; list_has(&folder->files, out); i++)
        snprintf(out, size, "%s-%d%s", base, i, suffix);
}

FILE *ff_folder_begin(ff_folder *folder, const char *stem, const char *suffix)
{
    char name[MAX_NAME];
    tidy_name(folder, stem, suffix, name, sizeof name);
    list_add(&folder->files, name);
    folder->stream = open_part(folder, name);
    if (folder->stream)
        setvbuf(folder->stream, folder->buffer, _IOFBF, BUFFER);
    return folder->stream;
}

void ff_folder_end(ff_folder *folder)
{
    if (folder->stream)
        close_part(folder, folder->stream, folder->files.names[folder->files.count - 1]);
    folder->stream = NULL;
}

static void drop_parts(ff_folder *folder)
{
    char temporary[MAX_NAME + 8];
    for (size_t i = 0; i < folder->files.count; i++) {
        part_name(folder->files.names[i], temporary, sizeof temporary);
        unlinkat(folder->fd, temporary, 0);
    }
}

bool ff_folder_commit(ff_folder *folder, ff_report *report)
{
    if (!folder->error)
        write_manifest(folder, &folder->old, &folder->files);
    for (size_t i = 0; i < folder->files.count && !folder->error; i++)
        publish(folder, folder->files.names[i]);
    for (size_t i = 0; i < folder->old.count && !folder->error; i++)
        if (!list_has(&folder->files, folder->old.names[i]))
            unlinkat(folder->fd, folder->old.names[i], 0);
    if (!folder->error)
        write_manifest(folder, &folder->files, NULL);
    if (!folder->error)
        return true;
    drop_parts(folder);
    return ff_error(report, FF_EXIT_FAILED, FF_NOWHERE, NULL, "%s/%s could not be written: %s",
                    folder->path, folder->culprit ? folder->culprit : "a file",
                    strerror(folder->error));
}

const char *ff_folder_path(const ff_folder *folder)
{
    return folder->path;
}

void ff_folder_free(ff_folder *folder)
{
    if (!folder)
        return;
    if (folder->fd >= 0)
        close(folder->fd);
    list_free(&folder->old);
    list_free(&folder->files);
    free(folder->path);
    free(folder->buffer);
    free(folder->culprit);
    free(folder);
}
