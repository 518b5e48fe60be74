/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Preloaded: a system that refuses or interrupts calls, as the environment says. REFUSE_flock,
   REFUSE_fdatasync: the errno of each such call. INTERRUPT: every other read and write fails with
   EINTR. SHORT: reads and writes do a part of what is asked. */
#include <dlfcn.h>
#include <errno.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/uio.h>
#include <unistd.h>

static bool is_refused(const char *name)
{
    const char *cause = getenv(name);
    if (cause)
        errno = atoi(cause);
    return cause != NULL;
}

static bool is_interrupted(unsigned *calls)
{
    bool interrupted = getenv("INTERRUPT") && ++*calls % 2;
    if (interrupted)
        errno = EINTR;
    return interrupted;
}

static size_t shorten(size_t size)
{
    return getenv("SHORT") && size > 1 ? size / 2 + 1 : size;
}

int flock(int fd, int operation)
{
    int (*real)(int, int) = (int (*)(int, int))(uintptr_t)dlsym(RTLD_NEXT, "flock");
    return is_refused("REFUSE_flock") ? -1 : real(fd, operation);
}

int fdatasync(int fd)
{
    int (*real)(int) = (int (*)(int))(uintptr_t)dlsym(RTLD_NEXT, "fdatasync");
    return is_refused("REFUSE_fdatasync") ? -1 : real(fd);
}

ssize_t write(int fd, const void *data, size_t size)
{
    static unsigned calls;
    ssize_t (*real)(int, const void *, size_t) =
        (ssize_t(*)(int, const void *, size_t))(uintptr_t)dlsym(RTLD_NEXT, "write");
    return is_interrupted(&calls) ? -1 : real(fd, data, shorten(size));
}

ssize_t read(int fd, void *data, size_t size)
{
    static unsigned calls;
    ssize_t (*real)(int, void *, size_t) =
        (ssize_t(*)(int, void *, size_t))(uintptr_t)dlsym(RTLD_NEXT, "read");
    return is_interrupted(&calls) ? -1 : real(fd, data, shorten(size));
}

ssize_t pread(int fd, void *data, size_t size, off_t at)
{
    static unsigned calls;
    ssize_t (*real)(int, void *, size_t, off_t) =
        (ssize_t(*)(int, void *, size_t, off_t))(uintptr_t)dlsym(RTLD_NEXT, "pread");
    return is_interrupted(&calls) ? -1 : real(fd, data, shorten(size), at);
}

ssize_t pwritev(int fd, const struct iovec *parts, int count, off_t at)
{
    static unsigned calls;
    ssize_t (*real)(int, const struct iovec *, int, off_t) =
        (ssize_t(*)(int, const struct iovec *, int, off_t))(uintptr_t)dlsym(RTLD_NEXT, "pwritev");
    return is_interrupted(&calls) ? -1 : real(fd, parts, getenv("SHORT") ? 1 : count, at);
}

ssize_t pwrite(int fd, const void *data, size_t size, off_t at)
{
    static unsigned calls;
    ssize_t (*real)(int, const void *, size_t, off_t) =
        (ssize_t(*)(int, const void *, size_t, off_t))(uintptr_t)dlsym(RTLD_NEXT, "pwrite");
    return is_interrupted(&calls) ? -1 : real(fd, data, shorten(size), at);
}
