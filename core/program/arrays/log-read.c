/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads logs of arrays. */
#include "record.h"

#include "../memory/file.h"
#include "../memory/memory.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

void arrays_reader_open(arrays_reader *reader, int directory)
{
    *reader = (arrays_reader){.directory = directory};
    arrays_checksum_prepare(&reader->checksum);
}

static void close_log(arrays_reader *reader, size_t i)
{
    if (reader->logs[i].name)
        close(reader->logs[i].fd);
    free(reader->logs[i].name);
    reader->logs[i].name = NULL;
}

void arrays_reader_close(arrays_reader *reader)
{
    for (size_t i = 0; i < ARRAYS_MOST_OPEN; i++)
        close_log(reader, i);
}

/* Opens a file that must be a log. Returns -1 with the reason in `why`. */
static int open_log(int directory, const char *name, off_t *size, char why[ARRAYS_WHY])
{
    struct stat info;
    char title[ARRAYS_LOG_HEAD];
    const char *unopened;
    int fd = file_open(directory, name, &unopened);
    if (fd < 0)
        snprintf(why, ARRAYS_WHY, "%s", unopened);
    else if (fstat(fd, &info) != 0 || info.st_size < ARRAYS_LOG_HEAD)
        snprintf(why, ARRAYS_WHY, "it is not a log of arrays");
    else if (!file_read(fd, title, sizeof title, 0))
        snprintf(why, ARRAYS_WHY, "%s", strerror(errno));
    else if (arrays_log_check_title(title, why)) {
        *size = info.st_size;
        return fd;
    }
    if (fd >= 0)
        close(fd);
    return -1;
}

/* Returns the index of a log, and opens it if necessary. Returns -1 with the reason in `why`. */
static int find_log(arrays_reader *reader, const char *name, char why[ARRAYS_WHY])
{
    for (int i = 0; i < ARRAYS_MOST_OPEN; i++)
        if (reader->logs[i].name && !strcmp(reader->logs[i].name, name))
            return i;
    if (!*name || *name == '.' || strchr(name, '/')) {
        snprintf(why, ARRAYS_WHY, "that is not the name of a file beside the journal");
        return -1;
    }
    size_t at = reader->next;
    off_t size;
    int fd = open_log(reader->directory, name, &size, why);
    if (fd < 0)
        return -1;
    reader->next = (at + 1) % ARRAYS_MOST_OPEN;
    close_log(reader, at);
    reader->logs[at].name = memory_copy_text(name, strlen(name));
    reader->logs[at].fd = fd;
    reader->logs[at].size = size;
    return (int)at;
}

/* Returns whether the record is within the log. The length of the log is read again, since it may
   have grown. */
static bool fits(arrays_reader *reader, int log, off_t offset, const arrays_head *head)
{
    struct stat info;
    double end = (double)offset + head->length;
    if (offset < ARRAYS_LOG_HEAD || offset % 8)
        return false;
    if (end > (double)reader->logs[log].size && fstat(reader->logs[log].fd, &info) == 0)
        reader->logs[log].size = info.st_size;
    return end <= (double)reader->logs[log].size;
}

bool arrays_reader_has(arrays_reader *reader, const char *name, off_t offset,
                       const arrays_label *label, char why[ARRAYS_WHY])
{
    arrays_head head;
    arrays_head_make(&head, label);
    int log = find_log(reader, name, why);
    if (log < 0 || fits(reader, log, offset, &head))
        return log >= 0;
    snprintf(why, ARRAYS_WHY, "the record at byte %lld, of %.0f bytes, is cut off",
             (long long)offset, head.length);
    return false;
}

bool arrays_reader_read(arrays_reader *reader, const char *name, off_t offset,
                        const arrays_label *label, double *out, char why[ARRAYS_WHY])
{
    arrays_head head;
    char found[ARRAYS_RECORD_HEAD];
    uint64_t told;
    int log = find_log(reader, name, why);
    if (log < 0)
        return false;
    arrays_head_make(&head, label);
    int fd = reader->logs[log].fd;
    size_t size = head.count * sizeof *out;
    off_t numbers = offset + (off_t)head.size;
    if (!file_read(fd, found, head.size, offset) || !file_read(fd, out, size, numbers) ||
        !file_read(fd, &told, sizeof told, numbers + (off_t)size)) {
        snprintf(why, ARRAYS_WHY, "%s", strerror(errno));
        return false;
    }
    uint32_t sum = arrays_checksum_add(&reader->checksum, 0, found, head.size);
    sum = arrays_checksum_add(&reader->checksum, sum, out, size);
    if (sum != told) {
        snprintf(why, ARRAYS_WHY, "the record at byte %lld does not have its checksum",
                 (long long)offset);
        return false;
    }
    if (memcmp(found, head.bytes, head.size) != 0) {
        snprintf(why, ARRAYS_WHY, "the record at byte %lld belongs to another array",
                 (long long)offset);
        return false;
    }
    arrays_npy_clean(out, head.count);
    return true;
}
