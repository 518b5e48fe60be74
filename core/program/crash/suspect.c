/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "suspect.h"

#include <flankfilm/engine.h>

#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static _Noreturn void test_guards(const char *plugin)
{
    int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
    for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; stream++)
        dup2(nothing, stream);
    setenv("FLANKFILM_VERIFY_LIMIT", "2", 1); /* time limit in s */
    execl("/proc/self/exe", "flankfilm", "verify", plugin, "--only", "guards", (char *)NULL);
    _exit(EXIT_FAILURE);
}

/* Returns whether the plugin fails the test of `verify` that finds writes outside its memory.
   Returns false also for a plugin without that test. */
static bool writes_outside(const char *plugin)
{
    int status = 0;
    pid_t made = fork();
    if (made == 0)
        test_guards(plugin);
    return made > 0 && waitpid(made, &status, 0) == made && WIFEXITED(status) &&
           WEXITSTATUS(status) == FF_FAULT_PLUGIN;
}

void crash_add_suspect(char *sentence, size_t size)
{
    static const char serves[] = ", or one that serves it (", is[] = ": the plugin ";
    const char *at = strstr(sentence, serves), *end = at ? strstr(at, "),") : NULL;
    char text[1500], *next = text;
    if (!end)
        return;
    at += strlen(serves);
    snprintf(text, sizeof text, "%.*s", (int)(end - at), at);
    const char *found = NULL;
    while (next && !found) { /* "oil: the plugin oil.so, rho: the plugin rho.so" */
        char *name = next, *comma = strstr(next, ", "), *plugin;
        next = comma ? comma + 2 : NULL;
        if (comma)
            *comma = '\0';
        plugin = strstr(name, is);
        if (plugin && writes_outside(plugin + strlen(is)))
            found = name;
    }
    size_t length = strlen(sentence);
    if (found)
        snprintf(sentence + length, size - length, "; %s fails flankfilm verify --only guards",
                 found);
    else
        snprintf(sentence + length, size - length,
                 "; flankfilm verify shows for each whether it writes outside its arrays");
}
