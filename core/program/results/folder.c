/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "folder.h"

#include "../memory/file.h"
#include "../study/kinds/kinds.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

enum { LONGEST_NAME = 255, LONGEST_PART = LONGEST_NAME + 20 };

static const char manifest[] = ".flankfilm";
static const char manifest_head[] = "flankfilm "; /* the kind of results follows */
static const char manifest_rest[] = " directory; its files:\n";
/* prefix and suffix of a temporary name */
static const char head[] = ".flankfilm.", part[] = ".part";

typedef struct entry {
    char *name;
    bool fresh; /* true if this run wrote it */
} entry;

struct results_folder {
    char *path;
    const char *kind; /* "result" */
    int fd;
    entry *entries; /* result files that exist or are being written */
    size_t count;
    FILE *stream;        /* the file that is being written */
    const char *writing; /* its final name */
    const char *last;    /* the file that was begun last; NULL if there is none */
    ff_report *report;
    bool failed; /* an error is in the report */
    bool sync;
};

static entry *find_entry(const results_folder *folder, const char *name)
{
    for (size_t i = 0; i < folder->count; i++)
        if (strcmp(folder->entries[i].name, name) == 0)
            return &folder->entries[i];
    return NULL;
}

static entry *add_entry(results_folder *folder, const char *name)
{
    entry *known = find_entry(folder, name);
    if (known)
        return known;
    folder->entries = memory_resize(folder->entries, (folder->count + 1) * sizeof *folder->entries);
    entry *made = &folder->entries[folder->count++];
    *made = (entry){.name = memory_print_text("%s", name)};
    return made;
}

static void note_failure(results_folder *folder, const char *name)
{
    if (!folder->failed)
        ff_error(folder->report, FF_FAULT_RUN, FF_NOWHERE, NULL, "%s/%s could not be written: %s",
                 folder->path, name, strerror(errno ? errno : EIO));
    folder->failed = true;
}

/* Opens the temporary file for `name`. */
static FILE *open_part(results_folder *folder, const char *name)
{
    char temporary[LONGEST_PART];
    snprintf(temporary, sizeof temporary, "%s%s%s", head, name, part);
    int fd = openat(folder->fd, temporary, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    folder->writing = name;
    folder->stream = fd < 0 ? NULL : fdopen(fd, "w");
    if (!folder->stream)
        note_failure(folder, name);
    if (!folder->stream && fd >= 0)
        close(fd);
    return folder->stream;
}

static void close_part(results_folder *folder)
{
    errno = 0;
    bool lost = folder->stream && ferror(folder->stream);
    if (lost && write(fileno(folder->stream), "\n", 1) == 1) /* otherwise the reason would be
                                                              * reported twice */
        errno = 0;
    if (folder->stream && folder->sync)
        lost = fflush(folder->stream) != 0 || fsync(fileno(folder->stream)) != 0 || lost;
    if (folder->stream && (fclose(folder->stream) != 0 || lost))
        note_failure(folder, folder->writing);
    folder->stream = NULL;
}

/* Renames the temporary file to its final name, unless something failed. */
static void rename_part(results_folder *folder, const char *name)
{
    char temporary[LONGEST_PART];
    snprintf(temporary, sizeof temporary, "%s%s%s", head, name, part);
    if (!folder->failed && renameat(folder->fd, temporary, folder->fd, name) != 0)
        note_failure(folder, name);
}

static void write_manifest(results_folder *folder)
{
    FILE *stream = folder->failed ? NULL : open_part(folder, manifest);
    if (stream)
        fprintf(stream, "%s%s%s", manifest_head, folder->kind, manifest_rest);
    for (size_t i = 0; stream && i < folder->count; i++)
        fprintf(stream, "%s\n", folder->entries[i].name);
    close_part(folder);
    rename_part(folder, manifest);
}

/* Copies the kind of results from the first line of the manifest; false if this program did not
 * write the line. */
static bool read_kind(const char *line, char kind[LONGEST_NAME])
{
    size_t length = strlen(line), before = sizeof manifest_head - 1;
    size_t behind = sizeof manifest_rest - 1;
    if (length <= before + behind || strncmp(line, manifest_head, before) != 0 ||
        strcmp(line + length - behind, manifest_rest) != 0)
        return false;
    snprintf(kind, LONGEST_NAME, "%.*s", (int)(length - behind - before), line + before);
    return true;
}

/* Reads the names of the earlier files; false if the directory has no manifest of this program. */
static bool read_manifest(results_folder *folder, char kind[LONGEST_NAME])
{
    FILE *stream = folder->fd < 0 ? NULL : file_stream(folder->fd, manifest);
    if (!stream)
        return false;
    char line[LONGEST_NAME + 2];
    bool ours = fgets(line, sizeof line, stream) && read_kind(line, kind);
    while (ours && fgets(line, sizeof line, stream)) {
        line[strcspn(line, "\n")] = '\0';
        if (*line && *line != '.' && !strchr(line, '/'))
            add_entry(folder, line);
    }
    fclose(stream);
    return ours;
}

/* Whether the name belongs to a temporary file. */
static bool is_part(const char *name)
{
    size_t length = strlen(name), tail = sizeof part - 1;
    return strncmp(name, head, sizeof head - 1) == 0 && length > tail &&
           strcmp(name + length - tail, part) == 0;
}

/* Counts the files in the directory; temporary files do not count if they are removed. */
static size_t count_files(const results_folder *folder, bool remove_parts)
{
    size_t count = 0;
    DIR *directory = opendir(folder->path);
    const struct dirent *item;
    while (directory && (item = readdir(directory))) {
        if (is_part(item->d_name) && remove_parts)
            unlinkat(folder->fd, item->d_name, 0);
        else
            count += strcmp(item->d_name, ".") != 0 && strcmp(item->d_name, "..") != 0 &&
                     !is_part(item->d_name); /* a killed run may have left it */
    }
    if (directory)
        closedir(directory);
    return count;
}

static bool lock_directory(results_folder *folder)
{
    ff_report *report = folder->report;
    static const char hint[] = "name another directory with -o";
    const char *path = folder->path;
    folder->fd = study_make_path(path) ? open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    if (folder->fd < 0 || access(path, W_OK) != 0)
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, hint,
                        "the result directory \"%s\" cannot be used: %s", path, strerror(errno));
    if (flock(folder->fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, hint,
                        "another run is using the result directory \"%s\"", path);
    char kind[LONGEST_NAME] = "";
    bool ours = read_manifest(folder, kind);
    if (ours && strcmp(kind, folder->kind) != 0)
        return ff_error(
            report, FF_FAULT_INPUT, FF_NOWHERE, hint,
            "\"%s\" is a %s directory of flankfilm, but a %s directory is to be written", path,
            kind, folder->kind);
    if (!ours && count_files(folder, false) > 0)
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, hint,
                        "\"%s\" contains files that are not results of flankfilm", path);
    count_files(folder, true); /* left by a killed run */
    write_manifest(folder);
    return !folder->failed;
}

results_folder *results_folder_open(const char *path, const char *kind, ff_report *report)
{
    results_folder *folder = memory_alloc(sizeof *folder);
    folder->fd = -1;
    folder->path = memory_print_text("%s", path);
    folder->kind = kind;
    folder->report = report;
    if (lock_directory(folder))
        return folder;
    results_folder_free(folder);
    return NULL;
}

void results_folder_free(results_folder *folder)
{
    if (!folder)
        return;
    if (folder->fd >= 0)
        close(folder->fd);
    for (size_t i = 0; i < folder->count; i++) {
        free(folder->entries[i].name);
    }
    free(folder->entries);
    free(folder->path);
    free(folder);
}

void results_folder_discard(results_folder *folder)
{
    if (folder) {
        close_part(folder);
        count_files(folder, true);
    }
    results_folder_free(folder);
}

void results_folder_sync(results_folder *folder)
{
    folder->sync = true;
}

FILE *results_folder_begin(results_folder *folder, const char *stem, const char *suffix)
{
    char name[LONGEST_NAME];
    close_part(folder);
    snprintf(name, sizeof name, "%s%s", stem, suffix);
    for (int i = 2; find_entry(folder, name) && find_entry(folder, name)->fresh; i++)
        snprintf(name, sizeof name, "%s-%d%s", stem, i, suffix);
    entry *made = add_entry(folder, name);
    made->fresh = true;
    folder->last = made->name;
    return open_part(folder, made->name);
}

/* Removes the earlier files that this run has not written; false if there are none. */
static bool remove_stale(results_folder *folder)
{
    size_t kept = 0, before = folder->count;
    for (size_t i = 0; i < folder->count; i++) {
        entry *at = &folder->entries[i];
        if (at->fresh) {
            folder->entries[kept++] = *at;
        } else {
            unlinkat(folder->fd, at->name, 0);
            free(at->name);
        }
    }
    folder->count = kept;
    return kept < before;
}

bool results_folder_end(results_folder *folder)
{
    close_part(folder);
    return !folder->failed;
}

/* At any moment the manifest names all existing result files, and the file that was begun last
 * exists only together with the other files of its run. */
bool results_folder_commit(results_folder *folder)
{
    close_part(folder);
    write_manifest(folder);
    if (!folder->failed && folder->last)
        unlinkat(folder->fd, folder->last, 0);
    for (size_t i = 0; i < folder->count; i++)
        if (folder->entries[i].fresh && folder->entries[i].name != folder->last)
            rename_part(folder, folder->entries[i].name);
    if (folder->last)
        rename_part(folder, folder->last);
    if (folder->failed) {
        count_files(folder, true);
        return false;
    }
    if (remove_stale(folder))
        write_manifest(folder);
    if (!folder->failed && folder->sync && fsync(folder->fd) != 0) /* makes the renames durable */
        note_failure(folder, folder->last ? folder->last : manifest);
    return !folder->failed;
}

bool results_folder_remove(const char *path)
{
    results_folder folder = {.path = memory_print_text("%s", path),
                             .fd = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    char kind[LONGEST_NAME];
    bool ours = read_manifest(&folder, kind);
    for (size_t i = 0; ours && i < folder.count; i++)
        unlinkat(folder.fd, folder.entries[i].name, 0);
    if (ours)
        unlinkat(folder.fd, manifest, 0);
    for (size_t i = 0; i < folder.count; i++)
        free(folder.entries[i].name);
    free(folder.entries);
    free(folder.path);
    if (folder.fd >= 0)
        close(folder.fd);
    return ours && rmdir(path) == 0;
}
