/* SPDX-License-Identifier: MIT */
/* Stores a mark of the running code for each thread, and prints it for messages. */
#include "guard.h"

#include "private.h"

#include <string.h>

/* With the initial-exec model, nothing is allocated if a signal handler is the first to read
   these. */
static _Thread_local ff_guard_mark running __attribute__((tls_model("initial-exec")));
static _Thread_local ff_guard_mirror *mirror __attribute__((tls_model("initial-exec")));

ff_guard_mark ff_guard_current(void)
{
    return running;
}

const ff_guard_mark *ff_guard_written_over(const ff_guard_mark *mark)
{
    if (mark->loaded && fe_is_written_over(mark->loaded))
        return mark;
    const ff_guard_mark *found = NULL;
    for (size_t i = 0; !found && mark->services && mark->services[i]; i++)
        found = ff_guard_written_over(mark->services[i]);
    return found;
}

static size_t append(char *out, size_t size, size_t length, const char *text)
{
    for (; *text && length + 1 < size; text++)
        out[length++] = *text;
    out[length] = 0;
    return length;
}

/* Writes ', or one that serves it (oil: the plugin oil.so, rho: the plugin rho.so', without the
 * closing bracket. */
static void print_services(const ff_guard_mark *mark, const char *before, char *out, size_t size)
{
    size_t length = append(out, size, 0, "");
    for (size_t i = 0; mark->services && mark->services[i]; i++) {
        const ff_guard_mark *service = mark->services[i];
        length = append(out, size, length, length ? ", " : before);
        length = append(out, size, length, service->stage);
        length = append(out, size, length, ": the plugin ");
        length = append(out, size, length, service->path);
        print_services(service, ", ", out + length, size - length);
        length += strlen(out + length);
    }
}

void fe_guard_name(const ff_guard_mark *mark, char *out, size_t size)
{
    size_t length = append(out, size, 0, mark->stage ? mark->stage : "");
    length = append(out, size, length, mark->stage ? ": the plugin " : "the plugin ");
    length = append(out, size, length, mark->path);
    print_services(mark, ", or one that serves it (", out + length, size - length);
    if (out[length])
        append(out, size, strlen(out), "),");
}

static void write_mirror(void)
{
    mirror->who[0] = mirror->action[0] = 0;
    if (!running.path)
        return;
    fe_guard_name(&running, mirror->who, sizeof mirror->who);
    append(mirror->action, sizeof mirror->action, 0, running.action ? running.action : "its work");
}

void ff_guard_mirror_set(ff_guard_mirror *to)
{
    mirror = to;
    if (mirror)
        write_mirror();
}

ff_guard_mark fe_guard_enter(ff_guard_mark mark)
{
    ff_guard_mark previous = running;
    running = mark;
    if (mirror)
        write_mirror();
    return previous;
}

void fe_guard_leave(ff_guard_mark previous)
{
    running = previous;
    if (mirror)
        write_mirror();
}
