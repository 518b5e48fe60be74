/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the files of a study beside its journal: after an error the earlier file is still there.
 */
#include "journal.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const char study_description[] = "study.json";

bool study_write_file(const char *directory, const char *name, const char *text, const char *hint,
                      ff_report *report)
{
    char *path = memory_print_text("%s/%s", directory, name);
    char *part = memory_print_text("%s.%ld.part", path,
                                   (long)getpid()); /* other shards may write the same file */
    FILE *out = fopen(part, "we");
    bool good = out && fputs(text, out) >= 0 && fflush(out) == 0 && fsync(fileno(out)) == 0;
    if (out)
        good = fclose(out) == 0 && good;
    good = good && rename(part, path) == 0;
    if (!good) {
        int cause = errno;
        unlink(part);
        ff_error(report, FF_FAULT_RUN, FF_NOWHERE, hint, "%s could not be written: %s", path,
                 strerror(cause));
    }
    free(path);
    free(part);
    return good;
}

bool study_describe(const study_run *run, const study_tally *tally, ff_report *report)
{
    char *text = NULL;
    size_t length = 0;
    if (!run->describe)
        return true;
    FILE *out = memory_require(open_memstream(&text, &length));
    run->describe(run->ctx, run->described, tally, out);
    fclose(out);
    bool good = study_write_file(run->directory, study_description, text, NULL, report);
    free(text);
    return good;
}

bool study_check_format(const char *directory, ff_report *report)
{
    char *path = memory_print_text("%s/%s", directory, study_description);
    json_t *study = json_load_file(path, 0, NULL);
    const json_t *told = json_object_get(study, "format");
    json_int_t format = told ? json_integer_value(told) : 1;
    bool good =
        !study || format == STUDY_FORMAT ||
        ff_error(report, FF_FAULT_INPUT, FF_NOWHERE,
                 format < STUDY_FORMAT
                     ? "name another directory with -o, or read it with that flankfilm"
                     : "read it with a newer flankfilm",
                 "\"%s\" is of %s flankfilm: its files are of format %lld, not %d", directory,
                 format < STUDY_FORMAT ? "an older" : "a newer", (long long)format, STUDY_FORMAT);
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
