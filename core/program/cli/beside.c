/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "beside.h"

#include "../memory/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { NOT_THERE = 127, MOST_OUTPUT = 2000 };

/* Returns the path of a program in the same folder as flankfilm; the caller frees it. */
static char *path_beside(const char *name)
{
    char own[4096];
    ssize_t length = readlink("/proc/self/exe", own, sizeof own - 1);
    own[length > 0 ? length : 0] = '\0';
    const char *slash = strrchr(own, '/');
    return memory_print_text("%.*s/%s", slash ? (int)(slash - own) : 0, own, name);
}

/* Reads from a descriptor until its end, and keeps the beginning, without the last line break. */
static void read_output(int from, char output[MOST_OUTPUT])
{
    size_t used = 0;
    char rest[512];
    for (;;) {
        bool room = used < MOST_OUTPUT - 1;
        ssize_t got =
            read(from, room ? output + used : rest, room ? MOST_OUTPUT - 1 - used : sizeof rest);
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            break;
        used += room ? (size_t)got : 0;
    }
    while (used && output[used - 1] == '\n')
        used--;
    output[used] = '\0';
}

static int wait_for(pid_t child)
{
    int status = -1;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
        continue;
    return status;
}

bool cli_beside(const char *name, const char *first, const char *second, ff_report *report)
{
    char output[MOST_OUTPUT] = "", *path = path_beside(name);
    int ends[2], status = -1;
    pid_t child = pipe2(ends, O_CLOEXEC) == 0 ? fork() : -1;
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        dup2(ends[1], STDERR_FILENO);
        execl(path, name, first, second, (char *)NULL);
        _exit(NOT_THERE);
    }
    if (child > 0) {
        close(ends[1]);
        read_output(ends[0], output);
        close(ends[0]);
        status = wait_for(child);
    }
    free(path);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (WIFEXITED(status) && WEXITSTATUS(status) == NOT_THERE)
        return ff_error(
            report, FF_FAULT_INPUT, FF_NOWHERE,
            "flankfilm installs it if Python is available; it needs the Python package netCDF4",
            "the program %s is not in the folder of flankfilm", name);
    return ff_error(report, FF_FAULT_RUN, FF_NOWHERE, NULL, "%s: %s", name,
                    *output ? output : "it ended early");
}
