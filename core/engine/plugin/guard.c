/* SPDX-License-Identifier: MIT */
#include "guard.h"

#include <string.h>

/* With this model of access nothing is allocated when a signal handler is the first to read it. */
static _Thread_local ff_guard_mark running __attribute__((tls_model("initial-exec")));

ff_guard_mark fe_guard_enter(ff_guard_mark mark)
{
    ff_guard_mark previous = running;
    running = mark;
    return previous;
}

void fe_guard_leave(ff_guard_mark previous)
{
    running = previous;
}

ff_guard_mark ff_guard_current(void)
{
    return running;
}

static size_t append(char *out, size_t size, size_t length, const char *text)
{
    for (; *text && length + 1 < size; text++)
        out[length++] = *text;
    out[length] = 0;
    return length;
}

void ff_guard_print_services(const ff_guard_mark *mark, const char *before, char *out, size_t size)
{
    size_t length = append(out, size, 0, "");
    for (size_t i = 0; mark->services && mark->services[i]; i++) {
        const ff_guard_mark *service = mark->services[i];
        length = append(out, size, length, length ? ", " : before);
        length = append(out, size, length, service->stage);
        length = append(out, size, length, ": the plugin ");
        length = append(out, size, length, service->path);
        ff_guard_print_services(service, ", ", out + length, size - length);
        length += strlen(out + length);
    }
}
