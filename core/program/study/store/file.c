/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes files of a study next to its journal. If writing fails, the earlier file is kept. */
#include "journal.h"

#include "../../memory/file.h"
#include "../../memory/memory.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char study_description[] = "study.json";

study_file study_file_begin(const char *directory, const char *name)
{
    study_file file = {.path = memory_print_text("%s%s%s", directory ? directory : "",
                                                 directory ? "/" : "", name)};
    file.part = memory_print_text("%s.%ld.part", file.path,
                                  /* part of the name, since other shards may write the same file */
                                  (long)getpid());
    file.out = fopen(file.part, "we");
    file.cause = errno;
    return file;
}

bool study_file_end(study_file *file, const char *hint, ff_report *report)
{
    FILE *out = file->out;
    errno = out ? EIO : file->cause; /* the cause of an earlier write error may be lost */
    bool good = out && fflush(out) == 0 && !ferror(out) && fsync(fileno(out)) == 0;
    int cause = errno;
    if (out && fclose(out) != 0 && good) {
        cause = errno;
        good = false;
    }
    if (good && rename(file->part, file->path) != 0) {
        cause = errno;
        good = false;
    }
    file->out = NULL;
    if (!good)
        ff_error(report, FF_FAULT_RUN, FF_NOWHERE, hint, "%s could not be written: %s", file->path,
                 strerror(cause));
    study_file_drop(file);
    return good;
}

void study_file_drop(study_file *file)
{
    if (file->out)
        fclose(file->out);
    if (file->part)
        unlink(file->part); /* a renamed file no longer has this name */
    free(file->path);
    free(file->part);
    *file = (study_file){.out = NULL};
}

bool study_write_file(const char *directory, const char *name, const char *text, const char *hint,
                      ff_report *report)
{
    study_file file = study_file_begin(directory, name);
    if (file.out)
        fputs(text, file.out);
    return study_file_end(&file, hint, report);
}

json_t *study_read_json(int directory, const char *name, json_error_t *error)
{
    const char *why;
    int fd = file_open(directory, name, &why);
    if (fd < 0)
        snprintf(error->text, sizeof error->text, "%s", why);
    json_t *root = fd < 0 ? NULL : json_loadfd(fd, 0, error);
    if (fd >= 0)
        close(fd);
    return root;
}

bool study_check_format(const char *directory, ff_report *report)
{
    char *path = memory_print_text("%s/%s", directory, study_description);
    json_error_t error;
    json_t *study = study_read_json(AT_FDCWD, path, &error);
    const json_t *told = json_object_get(study, "format");
    json_int_t format = told ? json_integer_value(told) : 1;
    bool good = !study || format == STUDY_FORMAT ||
                ff_error(report, FF_FAULT_INPUT, FF_NOWHERE,
                         format < STUDY_FORMAT
                             ? "name another directory with -o, or read it with that flankfilm"
                             : "read it with a newer flankfilm",
                         "\"%s\" was written by %s flankfilm: its files have format %lld, not %d",
                         directory, format < STUDY_FORMAT ? "an older" : "a newer",
                         (long long)format, STUDY_FORMAT);
    json_decref(study);
    free(path);
    return good;
}

void study_remove_parts(int directory)
{
    static const char end[] = ".part";
    const char *const heads[] = {study_description, "table.csv"};
    int fd = openat(directory, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *list = fd < 0 ? NULL : fdopendir(fd);
    const struct dirent *item;
    while (list && (item = readdir(list)))
        for (size_t i = 0; i < sizeof heads / sizeof *heads; i++) {
            size_t length = strlen(item->d_name), head = strlen(heads[i]);
            if (length > head + sizeof end && !strncmp(item->d_name, heads[i], head) &&
                !strcmp(item->d_name + length - (sizeof end - 1), end))
                unlinkat(dirfd(list), item->d_name, 0);
        }
    if (list)
        closedir(list);
    else if (fd >= 0)
        close(fd);
}
