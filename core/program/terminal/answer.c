/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "answer.h"

#include "../memory/file.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

static int file = STDOUT_FILENO;
static FILE *stream; /* collects the object in `text`; NULL: --json was not given */
static char *text;
static size_t length;

void terminal_answer_begin(void)
{
    int kept = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    stream = kept < 0 ? NULL : open_memstream(&text, &length);
    if (!stream)
        return;
    file = kept;
    dup2(STDERR_FILENO, STDOUT_FILENO);
}

FILE *terminal_answer(void)
{
    return stream ? stream : stdout;
}

int terminal_answer_file(void)
{
    return file;
}

bool terminal_answer_end(void)
{
    if (!stream)
        return true;
    bool good = fclose(stream) == 0 && file_write(file, text, length, -1);
    free(text);
    stream = NULL;
    return close(file) == 0 && good;
}
