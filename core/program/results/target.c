/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "target.h"

#include "../study/kinds/kinds.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Whether the text is in the file, which is read in parts that overlap. */
static bool has_text(FILE *stream, const char *text)
{
    char part[1 << 16];
    size_t kept = 0, got, length = strlen(text);
    while ((got = fread(part + kept, 1, sizeof part - kept, stream)) > 0) {
        size_t used = kept + got;
        if (memmem(part, used, text, length))
            return true;
        kept = used < length ? used : length - 1;
        memmove(part, part + used - kept, kept);
    }
    return false;
}

/* Whether the file does not exist or was written by this program. */
static bool may_replace(const results_target *target)
{
    char start[32] = "";
    struct stat about;
    size_t length = strlen(target->begins);
    if (stat(target->path, &about) != 0)
        return true;
    FILE *stream = S_ISREG(about.st_mode) ? fopen(target->path, "re") : NULL;
    bool ours = stream && (about.st_size == 0 || (fread(start, 1, length, stream) == length &&
                                                  !memcmp(start, target->begins, length) &&
                                                  has_text(stream, "flankfilm")));
    if (stream)
        fclose(stream);
    return ours ||
           ff_error(target->report, FF_FAULT_INPUT, FF_NOWHERE, "name another file",
                    S_ISREG(about.st_mode) ? "\"%s\" exists and was not written by this command"
                                           : "\"%s\" is not a regular file",
                    target->path);
}

static bool open_file(results_target *target)
{
    if (!may_replace(target))
        return false;
    const char *slash = strrchr(target->path, '/');
    char *parent =
        slash ? memory_print_text("%.*s", (int)(slash - target->path + 1), target->path) : NULL;
    if (!parent || study_make_path(parent))
        target->file = study_file_begin(NULL, target->path);
    free(parent);
    return target->file.out ||
           ff_error(target->report, FF_FAULT_INPUT, FF_NOWHERE, "name another file with -o",
                    "\"%s\" cannot be written: %s", target->path, strerror(errno));
}

bool results_target_open(results_target *target, bool directory)
{
    if (!directory)
        return open_file(target);
    target->folder = results_folder_open(target->path, "table", target->report);
    if (target->folder)
        results_folder_sync(target->folder);
    return target->folder != NULL;
}

bool results_target_commit(results_target *target)
{
    return target->folder ? results_folder_commit(target->folder)
                          : study_file_end(&target->file, NULL, target->report);
}

void results_target_close(results_target *target)
{
    study_file_drop(&target->file);
    results_folder_discard(target->folder);
    free(target->path);
}
