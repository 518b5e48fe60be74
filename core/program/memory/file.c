/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

int file_open(int directory, const char *name, const char **why)
{
    struct stat info;
    const char *unheard;
    why = why ? why : &unheard;
    int fd = openat(directory, name, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (fd < 0 || fstat(fd, &info) != 0) {
        *why = strerror(errno);
    } else if (S_ISREG(info.st_mode)) {
        return fd;
    } else {
        *why = S_ISDIR(info.st_mode) ? strerror(EISDIR) : "it is not a regular file";
    }
    if (fd >= 0)
        close(fd);
    return -1;
}

FILE *file_stream(int directory, const char *name)
{
    int fd = file_open(directory, name, NULL);
    FILE *stream = fd < 0 ? NULL : fdopen(fd, "r");
    if (fd >= 0 && !stream)
        close(fd);
    return stream;
}

/* Whether to continue after a call that transferred this many bytes. */
static bool may_continue(ssize_t moved)
{
    errno = moved == 0 ? EIO : errno;
    return moved > 0 || (moved < 0 && errno == EINTR);
}

bool file_read(int fd, void *data, size_t size, off_t at)
{
    for (size_t done = 0; done < size;) {
        char *next = (char *)data + done;
        const size_t left = size - done;
        ssize_t got = at < 0 ? read(fd, next, left) : pread(fd, next, left, at + (off_t)done);
        if (!may_continue(got))
            return false;
        done += got > 0 ? (size_t)got : 0;
    }
    return true;
}

bool file_write(int fd, const void *data, size_t size, off_t at)
{
    for (size_t done = 0; done < size;) {
        const char *next = (const char *)data + done;
        const size_t left = size - done;
        ssize_t put = at < 0 ? write(fd, next, left) : pwrite(fd, next, left, at + (off_t)done);
        if (!may_continue(put))
            return false;
        done += put > 0 ? (size_t)put : 0;
    }
    return true;
}
