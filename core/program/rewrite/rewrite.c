/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "private.h"

#include <stdlib.h>
#include <string.h>

/* The place of "1" in the first file that says it. */
static ff_place place_of(const rewrite_file *file, ff_source *source)
{
    const ff_node *format = ff_node_get(file->root, "format");
    *source = (ff_source){.name = file->path,
                          .text = file->text,
                          .length = strlen(file->text),
                          .directory = ".",
                          .temporary = true};
    return (ff_place){.source = source,
                      .line = format->place.line,
                      .column = format->place.column,
                      .width = format->place.width};
}

/* Each file that is written in another way now, behind a line that names it. */
static void print_files(const rewrite_world *world, FILE *out)
{
    for (size_t i = world->count; i-- > 0;) {
        const rewrite_file *file = &world->files[i];
        char *text = NULL;
        size_t length = 0;
        if (!file->text || (file->current && i + 1 < world->count))
            continue;
        FILE *stream = memory_require(open_memstream(&text, &length));
        rewrite_print_file(world, file, stream);
        fclose(stream);
        if (strcmp(text, file->text) != 0)
            fprintf(out, "\n# ---- %s\n%s%s", file->path, text,
                    length && text[length - 1] == '\n' ? "" : "\n");
        free(text);
    }
    fputs("\n# ----", out);
}

/* Assignments that have another path now. */
static void print_sets(const rewrite_world *world, const char *const *sets, size_t count, FILE *out)
{
    for (size_t i = 0; i < count; i++) {
        size_t head = strcspn(sets[i], "="), length = 0;
        char *path = NULL;
        FILE *stream = memory_require(open_memstream(&path, &length));
        rewrite_print_path(world, sets[i], head, stream);
        fclose(stream);
        if (length != head || strncmp(path, sets[i], head) != 0)
            fprintf(out, "\n--set %.*s is written --set %s now", (int)head, sets[i], path);
        free(path);
    }
    bool one = world->mode == REWRITE_OIL || world->mode == REWRITE_BARE;
    if (one && strcmp(world->viscosity, "viscosity") != 0)
        fprintf(out, "\nAnother law: --set viscosity.use=viscosity/barus, no longer %s.use",
                world->viscosity);
}

bool rewrite_old_format(const char *path, const char *const *sets, size_t set_count,
                        ff_report *report)
{
    rewrite_world world;
    bool old = rewrite_read(&world, path);
    size_t first = world.count;
    while (old && first > 0 && !world.files[first - 1].old)
        first--;
    if (old) {
        char *text = NULL;
        size_t length = 0;
        ff_source source;
        FILE *out = memory_require(open_memstream(&text, &length));
        fputs("\nwrite instead, file by file:", out);
        print_files(&world, out);
        print_sets(&world, sets, set_count, out);
        fclose(out);
        ff_place place = place_of(&world.files[first - 1], &source);
        ff_error(report, FF_FAULT_INPUT, place, text,
                 "format 1 is read no more: the oil is a stage of its own in format 2, and laws "
                 "have shape parameters alone");
        free(text);
    }
    rewrite_close(&world);
    return old;
}
