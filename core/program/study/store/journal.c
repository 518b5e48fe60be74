/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The journal has one line of JSON for each finished case. A line is written at once and ends
 * with its checksum. */
#include "journal.h"

#include "hash.h"
#include "record-schema.h"

#include "../../arrays/log.h"
#include "../../memory/file.h"
#include "../../memory/memory.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

const char study_marker[] = ".flankfilm-study";
static const char sum_head[] = ",\"sum\":\"";
enum { SUM_TAIL = sizeof sum_head - 1 + 16 + 3 /* a quote, the brace and the line break */ };

double study_seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

json_t *study_json_real(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

bool study_record_is_ok(const json_t *record)
{
    const char *status = json_string_value(json_object_get(record, "status"));
    return status && !strcmp(status, "ok");
}

bool study_state_is_settled(enum study_state state, enum study_rerun rerun)
{
    return state != STUDY_UNKNOWN &&
           (rerun == STUDY_RERUN_NONE || (rerun == STUDY_RERUN_FAILED && state == STUDY_OK));
}

char *study_journal_line(json_t *record, json_t *written_forms)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = memory_require(open_memstream(&text, &length));
    study_form_write(record, written_forms, out);
    fflush(out);
    fprintf(out, "%s%016llx\"}\n", sum_head,
            (unsigned long long)study_hash(STUDY_HASH_START, text, length));
    fclose(out);
    return text;
}

bool study_line_is_whole(const char *line, size_t length)
{
    char sum[40];
    if (length <= SUM_TAIL || line[length - 1] != '\n')
        return false;
    size_t body = length - SUM_TAIL;
    snprintf(sum, sizeof sum, "%s%016llx\"}\n", sum_head,
             (unsigned long long)study_hash(STUDY_HASH_START, line, body));
    return !memcmp(line + body, sum, SUM_TAIL);
}

json_t *study_line_parse(const char *line, size_t length)
{
    return study_line_is_whole(line, length) ? json_loadb(line, length - 1, 0, NULL) : NULL;
}

bool study_make_path(const char *path)
{
    char *copy = memory_print_text("%s/", path);
    bool made = true;
    for (char *slash = strchr(copy + 1, '/'); made && slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        made = mkdir(copy, 0777) == 0 || errno == EEXIST;
        *slash = '/';
    }
    free(copy);
    return made;
}

/* Checks that the directory is marked as that of a study, and marks it if it is empty. Returns
   false with errno 0 if it belongs to something else. */
static bool mark_directory(const char *path)
{
    DIR *list = opendir(path);
    const struct dirent *item;
    bool empty = true, marked = false;
    if (!list)
        return false;
    while ((item = readdir(list))) {
        marked = marked || !strcmp(item->d_name, study_marker);
        empty = empty && (!strcmp(item->d_name, ".") || !strcmp(item->d_name, ".."));
    }
    int cause = 0;
    if (!marked && empty) {
        int fd = openat(dirfd(list), study_marker, O_WRONLY | O_CREAT | O_CLOEXEC, 0666);
        cause = errno;
        marked = fd >= 0;
        if (marked)
            close(fd);
    }
    closedir(list);
    errno = cause;
    return marked;
}

/* Removes what follows the last complete line. */
static bool drop_torn_tail(study_journal *journal)
{
    char c;
    off_t end = lseek(journal->fd, 0, SEEK_END);
    ssize_t got = 1;
    while (end > 0 && ((got = pread(journal->fd, &c, 1, end - 1)) != 1 || c != '\n')) {
        if (got != 1 && (got == 0 || errno != EINTR))
            return false;
        end -= got == 1;
    }
    journal->end = end;
    return end >= 0 && ftruncate(journal->fd, end) == 0;
}

enum lock { LOCK_TAKEN, LOCK_BUSY, LOCK_REFUSED /* the file system has no locks */ };

/* Tries for half a second, since a killed run may hold the lock for a short time after its end. */
static enum lock lock_file(int fd, int how)
{
    const struct timespec nap = {0, 20000000};
    int tries = 25, state;
    while ((state = flock(fd, how | LOCK_NB)) != 0 && (errno == EINTR || errno == EWOULDBLOCK) &&
           tries-- > 0)
        nanosleep(&nap, NULL);
    return state == 0                               ? LOCK_TAKEN
           : errno == EINTR || errno == EWOULDBLOCK ? LOCK_BUSY
                                                    : LOCK_REFUSED;
}

static bool claim_directory(const char *path, ff_report *report)
{
    return (study_make_path(path) && mark_directory(path)) ||
           ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, "name another directory with -o",
                    errno ? "the result directory \"%s\" cannot be used: %s"
                          : "\"%s\" contains files that are not results of a study",
                    path, strerror(errno));
}

void study_journal_name(size_t shard, size_t shards, char name[STUDY_NAME_SIZE])
{
    if (shards == 1)
        snprintf(name, STUDY_NAME_SIZE, "journal.jsonl");
    else
        snprintf(name, STUDY_NAME_SIZE, "journal.%zu-of-%zu.jsonl", shard, shards);
}

/* Opens the journal. A link is not followed, and a pipe is not waited for. */
static bool open_journal(study_journal *journal, ff_report *report)
{
    struct stat info;
    int flags = O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
    journal->fd = openat(journal->directory, journal->name, flags, 0666);
    if (journal->fd < 0 && errno != ELOOP && errno != EISDIR)
        return false;
    if (journal->fd >= 0 && fstat(journal->fd, &info) == 0 && S_ISREG(info.st_mode))
        return true;
    return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, "name another directory with -o",
                    "\"%s/%s\" is not a regular file", journal->path, journal->name);
}

static bool open_files(study_journal *journal, size_t shard, size_t shards, ff_report *report)
{
    static const char hint[] = "name another directory with -o";
    const char *path = journal->path;
    size_t errors = ff_report_errors(report);
    bool alone = shards == 1;
    enum lock lock = LOCK_TAKEN;
    study_journal_name(shard, shards, journal->name);
    if (study_make_path(path))
        journal->directory = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (journal->directory >= 0)
        lock = lock_file(journal->directory, alone ? LOCK_EX : LOCK_SH);
    if (lock == LOCK_BUSY)
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, hint,
                        "another run is using the result directory \"%s\"", path);
    if (journal->directory >= 0 &&
        (!claim_directory(path, report) || !study_check_format(path, report) ||
         (lock == LOCK_REFUSED && !study_lock_take(journal, alone, report))))
        return false;
    bool open = journal->directory >= 0 && open_journal(journal, report);
    if (open && lock == LOCK_TAKEN && lock_file(journal->fd, LOCK_EX) == LOCK_BUSY)
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                        "another run works on shard %zu of \"%s\"", shard, path);
    return (open && drop_torn_tail(journal)) ||
           (ff_report_errors(report) == errors &&
            ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, hint,
                     "the result directory \"%s\" cannot be used: %s", path, strerror(errno)));
}

bool study_journal_open(study_journal *journal, const char *directory, size_t shard, size_t shards,
                        ff_report *report)
{
    *journal = (study_journal){
        .fd = -1, .directory = -1, .path = directory, .synced = study_seconds_now()};
    bool good = open_files(journal, shard, shards, report);
    if (!good)
        study_journal_close(journal);
    return good;
}

/* Returns how another process has changed the journal, or NULL if it is unchanged. */
static const char *find_change(const study_journal *journal)
{
    struct stat own, named, directory, path;
    bool kept = stat(journal->path, &path) == 0 && fstat(journal->directory, &directory) == 0 &&
                path.st_ino == directory.st_ino && path.st_dev == directory.st_dev;
    if (!kept)
        return "was removed with its directory";
    if (fstatat(journal->directory, journal->name, &named, AT_SYMLINK_NOFOLLOW) != 0)
        return "was removed";
    if (fstat(journal->fd, &own) != 0 || own.st_ino != named.st_ino || own.st_dev != named.st_dev)
        return "was replaced";
    return own.st_size == 0 && journal->end > 0 ? "was emptied"
           : own.st_size < journal->end         ? "was cut short"
           : own.st_size > journal->end         ? "was written to by another process"
                                                : NULL;
}

static bool is_as_left(const study_journal *journal, ff_report *report)
{
    const char *change = find_change(journal);
    return !change || ff_error(report, FF_FAULT_RUN, FF_NOWHERE,
                               "the same command runs the cases that the journal does not have",
                               "the journal \"%s/%s\" %s while the study ran", journal->path,
                               journal->name, change);
}

static bool refuse_write(int cause, ff_report *report)
{
    return ff_error(report, FF_FAULT_RUN, FF_NOWHERE,
                    "no finished case is lost; the same command continues",
                    "the journal could not be written: %s", strerror(cause));
}

static bool force(study_journal *journal, ff_report *report)
{
    bool done = arrays_force(journal->fd);
    int cause = errno;
    journal->synced = study_seconds_now();
    return done || refuse_write(cause, report);
}

bool study_journal_append(study_journal *journal, const char *line, size_t length,
                          ff_report *report)
{
    if (!is_as_left(journal, report))
        return false;
    if (!file_write(journal->fd, line, length, -1)) {
        int cause = errno;
        if (ftruncate(journal->fd, journal->end) != 0)
            cause = errno; /* the next run drops the incomplete line */
        return refuse_write(cause, report);
    }
    journal->end += (off_t)length;
    return study_seconds_now() - journal->synced <= 1 || force(journal, report);
}

bool study_journal_settle(study_journal *journal, ff_report *report)
{
    return is_as_left(journal, report) && force(journal, report);
}

void study_journal_close(study_journal *journal)
{
    if (journal->fd >= 0) {
        fdatasync(journal->fd);
        close(journal->fd);
    }
    if (journal->lock_file)
        study_lock_drop(journal);
    if (journal->directory >= 0)
        close(journal->directory);
    journal->lock_file = false;
    journal->fd = journal->directory = -1;
}
