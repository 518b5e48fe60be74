/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Appends to a log of arrays. */
#include "record.h"

#include "../memory/file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

/* Forces the names in a directory to the disk. File systems that do not support this keep names on
   their own, or never. */
static bool sync_names(int directory)
{
    return fsync(directory) == 0 || errno == EINVAL;
}

bool arrays_force(int file)
{
    int state;
    while ((state = fdatasync(file)) != 0 && errno == EINTR)
        ;
    return state == 0 || errno == EINVAL || errno == ENOSYS || errno == EOPNOTSUPP;
}

/* Writes the title of a log that is new or was cut off within its title. */
static bool write_title(arrays_log *log, int directory)
{
    char title[ARRAYS_LOG_HEAD];
    arrays_log_title(title);
    log->end = ARRAYS_LOG_HEAD;
    return ftruncate(log->fd, 0) == 0 && file_write(log->fd, title, sizeof title, 0) &&
           arrays_force(log->fd) && sync_names(directory);
}

/* Cuts off what follows the end. Returns false with the reason in `why`, which is "" if errno
   contains it. A log that is shorter than `end`, through no fault of this program, is continued at
   its end. */
static bool enter_log(arrays_log *log, int directory, off_t end, char why[ARRAYS_WHY])
{
    struct stat info;
    char title[ARRAYS_LOG_HEAD];
    *why = '\0';
    if (fstat(log->fd, &info) != 0)
        return false;
    if (info.st_size < ARRAYS_LOG_HEAD)
        return write_title(log, directory);
    if (!file_read(log->fd, title, sizeof title, 0) || !arrays_log_check_title(title, why))
        return false;
    log->end = end < info.st_size ? end : info.st_size / 8 * 8;
    if (log->end < ARRAYS_LOG_HEAD)
        log->end = ARRAYS_LOG_HEAD;
    return log->end == info.st_size || ftruncate(log->fd, log->end) == 0;
}

bool arrays_log_open(arrays_log *log, int directory, const char *name, off_t end, bool fresh,
                     char why[ARRAYS_WHY])
{
    int flags = O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | (fresh ? O_EXCL : 0);
    log->fd = openat(directory, name, flags, 0666);
    arrays_checksum_prepare(&log->checksum);
    *why = '\0';
    if (log->fd >= 0 && enter_log(log, directory, end, why))
        return true;
    int cause = errno;
    if (!*why)
        snprintf(why, ARRAYS_WHY, "%s", strerror(cause));
    arrays_log_close(log);
    errno = cause;
    return false;
}

bool arrays_log_append(arrays_log *log, const arrays_label *label, const double *data,
                       off_t *offset)
{
    arrays_head head;
    arrays_head_make(&head, label);
    size_t size = head.count * sizeof *data;
    off_t at = *offset = log->end;
    uint64_t sum = arrays_checksum_add(&log->checksum, 0, head.bytes, head.size);
    sum = arrays_checksum_add(&log->checksum, (uint32_t)sum, data, size);
    size_t whole = head.size + size + sizeof sum;
    const struct iovec parts[] = {
        {head.bytes, head.size}, {(double *)(uintptr_t)data, size}, {&sum, sizeof sum}};
    bool good = pwritev(log->fd, parts, 3, at) == (ssize_t)whole ||
                /* a partial write sets no errno: a second attempt does */
                (file_write(log->fd, head.bytes, head.size, at) &&
                 file_write(log->fd, data, size, at + (off_t)head.size) &&
                 file_write(log->fd, &sum, sizeof sum, at + (off_t)(head.size + size)));
    if (good)
        log->end = at + (off_t)whole;
    return good;
}

void arrays_log_close(arrays_log *log)
{
    if (log->fd >= 0)
        close(log->fd);
    log->fd = -1;
}
