/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A writer that takes all memory while it has a file open, then asks for what the program refuses
   with a message. When it goes on, it closes its file and leaves a note of that. */
#include <flankfilm/author.h>
#include <flankfilm/writer.h>

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

typedef struct hoarder {
    const ff_host *host;
    ff_writer service;
} hoarder;

typedef struct hoard {
    struct hoard *next;
} hoard;

static hoard *take_all(void)
{
    hoard *all = NULL;
    for (size_t size = 1 << 20; size >= sizeof *all; size /= 2)
        for (hoard *more; (more = malloc(size)); all = more)
            more->next = all;
    return all;
}

static void give_back(hoard *all)
{
    for (hoard *next; all; all = next) {
        next = all->next;
        free(all);
    }
}

static ff_status write_all(void *self, const ff_view *view, const ff_target *target)
{
    const char *path = target->path(target->ctx, "data.txt");
    FILE *file = path ? fopen(path, "w") : NULL;
    struct rlimit before, none;
    (void)self, (void)view;
    if (!file || fputs("one\n", file) < 0 || getrlimit(RLIMIT_AS, &before) != 0)
        return FF_BUG;
    none = before;
    none.rlim_cur = 0;
    syscall(SYS_setrlimit, RLIMIT_AS, &none); /* setrlimit itself is refused */
    hoard *all = take_all();
    path = target->path(target->ctx, "no/name");
    give_back(all);
    syscall(SYS_setrlimit, RLIMIT_AS, &before);
    fclose(file);
    file = fopen("closed", "w");
    if (file)
        fclose(file);
    return path ? FF_BUG : FF_NOCONV;
}

FF_SERVICE_MODEL(model, hoarder, "writer", FF_WRITER_ID, "a writer",
                 ((ff_writer){sizeof(ff_writer), NULL, "", write_all}), .id = "writer/hoarder",
                 .version = "1.0.0", .summary = "Takes all memory", .reference = "", .bibtex = "",
                 .licence = "GPL-3.0-or-later");
FF_EXPORT_MODELS(&model);
