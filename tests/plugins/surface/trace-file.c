/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "trace-file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static FILE *open_new(char path[PATH_ROOM])
{
    strcpy(path, "/tmp/flankfilm-trace-XXXXXX");
    int descriptor = mkstemp(path);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
    if (!file) {
        fprintf(stderr, "%s cannot be written\n", path);
        exit(2);
    }
    return file;
}

static void close_it(FILE *file)
{
    if (fclose(file) != 0)
        exit(2);
}

void write_text(char path[PATH_ROOM], const char *text)
{
    FILE *file = open_new(path);
    fputs(text, file);
    close_it(file);
}

void write_trace(char path[PATH_ROOM], size_t n, const double *position, const double *height)
{
    FILE *file = open_new(path);
    fputs("position [m], height [m]\n", file);
    for (size_t i = 0; i < n; i++)
        fprintf(file, "%.17g, %.17g\n", position[i], height[i]);
    close_it(file);
}
