/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "terminal.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { USUAL_WIDTH = 100, LEAST_WIDTH = 40 };

bool terminal_colour(FILE *stream)
{
    const char *refusal = getenv("NO_COLOR");
    const char *terminal = getenv("TERM");
    return isatty(fileno(stream)) && !(refusal && *refusal) &&
           !(terminal && strcmp(terminal, "dumb") == 0);
}

int terminal_width(void)
{
    struct winsize size;
    if (!isatty(STDOUT_FILENO) || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || !size.ws_col)
        return USUAL_WIDTH;
    return size.ws_col < LEAST_WIDTH ? LEAST_WIDTH : size.ws_col;
}

void terminal_print_messages(const ff_report *report, FILE *stream, bool colour)
{
    char *text = ff_report_text(report, colour);
    fputs(text, stream);
    ff_free(text);
}

/* Counts UTF-8 characters, not bytes. */
static int columns_of(const char *text, size_t length)
{
    int columns = 0;
    for (size_t i = 0; i < length; i++)
        columns += ((unsigned char)text[i] & 0xC0) != 0x80;
    return columns;
}

void terminal_print_wrapped(const char *text, int column, int indent)
{
    assert(column >= 0 && indent >= 0);
    const char *gap = "";
    int width = terminal_width();
    while (*text) {
        size_t length = strcspn(text, " \n");
        int columns = columns_of(text, length);
        if (*gap && column + 1 + columns > width) {
            printf("\n%*s", indent, "");
            column = indent;
            gap = "";
        }
        printf("%s%.*s", gap, (int)length, text);
        column += columns + (*gap ? 1 : 0);
        gap = " ";
        text += length;
        text += strspn(text, " \n");
    }
    putchar('\n');
}

void terminal_print_cut(const char *text, int column)
{
    size_t length = strlen(text);
    int width = terminal_width();
    bool fits = column + columns_of(text, length) <= width;
    while (!fits && length > 0 && column + columns_of(text, length) + 3 > width)
        length--;
    printf("%.*s%s\n", (int)length, text, fits ? "" : "...");
}
