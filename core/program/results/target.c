/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "target.h"

#include "../study/study.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The temporary file stands beside the file, since both must be of the same file system. */
static bool open_file(results_target *target)
{
    const char *slash = strrchr(target->path, '/');
    char *parent =
        slash ? memory_print_text("%.*s", (int)(slash - target->path + 1), target->path) : NULL;
    bool good = !parent || study_make_path(parent);
    free(parent);
    target->part = memory_print_text("%s.%ld.part", target->path, (long)getpid());
    int fd = good ? open(target->part, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666) : -1;
    if (fd >= 0)
        close(fd);
    return fd >= 0 ||
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
    if (target->folder)
        return results_folder_commit(target->folder);
    return (results_file_sync(target->part) && rename(target->part, target->path) == 0) ||
           ff_error(target->report, FF_FAULT_RUN, FF_NOWHERE, NULL, "\"%s\" cannot be written: %s",
                    target->path, strerror(errno));
}

void results_target_close(results_target *target)
{
    if (target->part)
        unlink(target->part);
    results_folder_discard(target->folder);
    free(target->part);
    free(target->path);
}
