/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Preloaded: a system that refuses or interrupts calls, as the environment says. REFUSE_flock,
   REFUSE_fcntl (for locks), REFUSE_fdatasync, REFUSE_ftruncate: the errno of each such call.
   INTERRUPT: every other read and write fails with EINTR. SHORT: reads and writes do a part of what
   is asked. */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
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

/* What is handed on is a pointer or an int, which both fit where a pointer is passed. */
int fcntl(int fd, int operation, ...)
{
    int (*real)(int, int, void *) = (int (*)(int, int, void *))(uintptr_t)dlsym(RTLD_NEXT, "fcntl");
    va_list args;
    va_start(args, operation);
    void *argument = va_arg(args, void *);
    va_end(args);
    bool locks = operation == F_SETLK || operation == F_SETLKW || operation == F_OFD_SETLK ||
                 operation == F_OFD_SETLKW;
    return locks && is_refused("REFUSE_fcntl") ? -1 : real(fd, operation, argument);
}

int ftruncate(int fd, off_t length)
{
    int (*real)(int, off_t) = (int (*)(int, off_t))(uintptr_t)dlsym(RTLD_NEXT, "ftruncate");
    return is_refused("REFUSE_ftruncate") ? -1 : real(fd, length);
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
