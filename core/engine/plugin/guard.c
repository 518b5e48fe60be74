/* SPDX-License-Identifier: MIT */
#include <flankfilm/engine.h>

/* With this model of access nothing is allocated when a signal handler is the first to read it. */
static _Thread_local ff_guard_mark running __attribute__((tls_model("initial-exec")));

ff_guard_mark ff_guard_enter(const char *path, const char *stage, const char *action)
{
    ff_guard_mark previous = running;
    running = (ff_guard_mark){.path = path, .stage = stage, .action = action};
    return previous;
}

void ff_guard_leave(ff_guard_mark previous)
{
    running = previous;
}

ff_guard_mark ff_guard_current(void)
{
    return running;
}
