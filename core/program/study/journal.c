/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The journal has a line of JSON for each finished case, which is written at once and ends with its
   checksum. */
#include "journal.h"

#include "form.h"
#include "hash.h"

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
enum { SUM_TAIL = sizeof sum_head - 1 + 16 + 3 /* a quote, the brace and the newline */ };

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

char *study_journal_line(json_t *record, json_t *said)
{
    char *text = NULL;
    size_t length = 0;
    FILE *out = memory_require(open_memstream(&text, &length));
    study_form_write(record, said, out);
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

bool study_line_is_ok(const char *line)
{
    static const char head[] = "\"status\":\"ok\"";
    const char *status = strstr(line, "\"status\":");
    return status && !strncmp(status, head, sizeof head - 1);
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

/* Whether the directory is marked as that of a study; an empty one gets the mark. False with errno
   0 when it belongs to somebody else. */
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

/* Drops what follows the last complete line. */
static bool drop_torn_tail(int fd)
{
    char c;
    off_t end = lseek(fd, 0, SEEK_END);
    while (end > 0 && pread(fd, &c, 1, end - 1) == 1 && c != '\n')
        end--;
    return end >= 0 && ftruncate(fd, end) == 0;
}

/* Tries for half a second, since workers of a run that was killed may hold the lock for a moment.
 */
static bool lock_file(int fd, int how)
{
    const struct timespec nap = {0, 20000000};
    int tries = 25, state;
    while ((state = flock(fd, how | LOCK_NB)) != 0 && errno == EWOULDBLOCK && tries-- > 0)
        nanosleep(&nap, NULL);
    return state == 0 || errno != EWOULDBLOCK;
}

static bool claim_directory(const char *path, ff_report *report)
{
    return (study_make_path(path) && mark_directory(path)) ||
           ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, "name another directory with -o",
                    errno ? "the result directory \"%s\" cannot be used: %s"
                          : "\"%s\" holds files that are not results of a study",
                    path, strerror(errno));
}

void study_journal_name(const study_run *run, char name[STUDY_NAME_SIZE])
{
    if (run->shards == 1)
        snprintf(name, STUDY_NAME_SIZE, "journal.jsonl");
    else
        snprintf(name, STUDY_NAME_SIZE, "journal.%zu-of-%zu.jsonl", run->shard, run->shards);
}

static bool open_files(study_journal *journal, const study_run *run, ff_report *report)
{
    static const char hint[] = "name another directory with -o";
    const char *path = run->directory;
    char name[STUDY_NAME_SIZE];
    bool alone = run->shards == 1;
    study_journal_name(run, name);
    if (study_make_path(path))
        journal->directory = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (journal->directory >= 0 && !lock_file(journal->directory, alone ? LOCK_EX : LOCK_SH))
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, hint,
                        "another run is using the result directory \"%s\"", path);
    if (journal->directory >= 0 &&
        (!claim_directory(path, report) || !study_check_format(path, report)))
        return false;
    if (journal->directory >= 0)
        journal->fd =
            openat(journal->directory, name, O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (journal->fd >= 0 && !lock_file(journal->fd, LOCK_EX))
        return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
                        "another run works on shard %zu of \"%s\"", run->shard, path);
    return (journal->fd >= 0 && drop_torn_tail(journal->fd)) ||
           ff_error(report, FF_FAULT_INPUT, FF_NOWHERE, hint,
                    "the result directory \"%s\" cannot be used: %s", path, strerror(errno));
}

bool study_journal_open(study_journal *journal, const study_run *run, ff_report *report)
{
    *journal = (study_journal){.fd = -1, .directory = -1, .synced = study_seconds_now()};
    bool good = open_files(journal, run, report);
    if (!good)
        study_journal_close(journal);
    return good;
}

bool study_journal_append(study_journal *journal, const char *line, size_t length,
                          ff_report *report)
{
    off_t before = lseek(journal->fd, 0, SEEK_END);
    ssize_t written = write(journal->fd, line, length);
    if (written >= 0 && written < (ssize_t)length) /* writing the rest fails with the cause */
        written = write(journal->fd, line + written, length - (size_t)written);
    if (written < 0) {
        int cause = errno;
        if (before >= 0 && ftruncate(journal->fd, before) != 0)
            cause = errno; /* the next run drops the incomplete line */
        return ff_error(report, FF_FAULT_RUN, FF_NOWHERE,
                        "nothing that was finished is lost; the same command goes on",
                        "the journal could not be written: %s", strerror(cause));
    }
    double now = study_seconds_now();
    if (now - journal->synced > 1) {
        fdatasync(journal->fd);
        journal->synced = now;
    }
    return true;
}

void study_journal_close(study_journal *journal)
{
    if (journal->fd >= 0) {
        fdatasync(journal->fd);
        close(journal->fd);
    }
    if (journal->directory >= 0)
        close(journal->directory);
    journal->fd = journal->directory = -1;
}
