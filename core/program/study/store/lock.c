/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Locks by files, for file systems without locks. */
#include "journal.h"

#include "../../memory/memory.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LOCK_NAME = STUDY_NAME_SIZE + 8, LOCK_TEXT = 300 };

static const char lock_end[] = ".lock";

static void name_lock(const study_journal *journal, char name[LOCK_NAME])
{
    snprintf(name, LOCK_NAME, "%s%s", journal->name, lock_end);
}

static void name_self(char text[LOCK_TEXT])
{
    char host[200] = "";
    gethostname(host, sizeof host - 1);
    snprintf(text, LOCK_TEXT, "%ld %s\n", (long)getpid(), host);
}

static void read_lock(const study_journal *journal, const char *name, char text[LOCK_TEXT])
{
    int fd = openat(journal->directory, name, O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
    ssize_t length = fd < 0 ? 0 : read(fd, text, LOCK_TEXT - 1);
    text[length > 0 ? length : 0] = '\0';
    text[strcspn(text, "\n")] = '\0';
    if (fd >= 0)
        close(fd);
}

/* Returns whether the process named in a lock was on this machine and has ended. */
static bool is_left_behind(const char *text)
{
    char own[LOCK_TEXT], *end;
    long pid = strtol(text, &end, 10);
    name_self(own);
    own[strcspn(own, "\n")] = '\0';
    const char *host = strchr(own, ' ');
    return pid > 0 && host && !strcmp(host, end) && kill((pid_t)pid, 0) != 0 && errno == ESRCH;
}

static bool refuse(const study_journal *journal, const char *name, const char *text,
                   ff_report *report)
{
    char *hint =
        memory_print_text("\"%s/%s\" names process %s; remove it if that process has ended",
                          journal->path, name, text);
    ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, hint,
             "another run is using the result directory \"%s\"", journal->path);
    free(hint);
    return false;
}

/* Makes the lock file. A lock file left by an ended process is replaced. */
static bool make_lock(const study_journal *journal, const char *name, ff_report *report)
{
    char text[LOCK_TEXT], other[LOCK_TEXT];
    int fd = -1;
    for (int tries = 0; fd < 0 && tries < 2; tries++) {
        fd = openat(journal->directory, name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd >= 0 || errno != EEXIST)
            break;
        read_lock(journal, name, other);
        if (!is_left_behind(other))
            return refuse(journal, name, other, report);
        unlinkat(journal->directory, name, 0);
    }
    name_self(text);
    bool good = fd >= 0 && write(fd, text, strlen(text)) == (ssize_t)strlen(text);
    int cause = errno;
    if (fd >= 0)
        close(fd);
    if (fd >= 0 && !good)
        unlinkat(journal->directory, name, 0);
    return good || ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, "name another directory with -o",
                            "the result directory \"%s\" cannot be used: %s", journal->path,
                            strerror(cause));
}

/* Returns whether a lock excludes the lock of this journal. A run of all cases excludes every other
 * run. */
static bool excludes(const char *name, const char *own, bool alone)
{
    size_t length = strlen(name), end = sizeof lock_end - 1;
    if (length <= end || length >= LOCK_NAME || strcmp(name + length - end, lock_end) != 0 ||
        strncmp(name, "journal.", 8) != 0 || !strcmp(name, own))
        return false;
    return alone || !strcmp(name, "journal.jsonl.lock");
}

bool study_lock_take(study_journal *journal, bool alone, ff_report *report)
{
    char own[LOCK_NAME], text[LOCK_TEXT];
    name_lock(journal, own);
    if (!make_lock(journal, own, report))
        return false;
    journal->lock_file = true;
    int copy = openat(journal->directory, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *list = copy < 0 ? NULL : fdopendir(copy);
    const struct dirent *item;
    bool good = true;
    while (good && list && (item = readdir(list)))
        if (excludes(item->d_name, own, alone)) {
            read_lock(journal, item->d_name, text);
            good = is_left_behind(text) || refuse(journal, item->d_name, text, report);
        }
    if (list)
        closedir(list);
    else if (copy >= 0)
        close(copy);
    return good;
}

void study_lock_drop(const study_journal *journal)
{
    char name[LOCK_NAME];
    name_lock(journal, name);
    unlinkat(journal->directory, name, 0);
}
