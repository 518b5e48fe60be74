/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "wrap.h"

#include <stdbool.h>
#include <string.h>

static bool begins_character(char byte)
{
    return ((unsigned char)byte & 0xC0) != 0x80; /* UTF-8 */
}

static int columns_of(const char *text, size_t length)
{
    int columns = 0;
    for (size_t i = 0; i < length; i++)
        columns += begins_character(text[i]);
    return columns;
}

int ff_columns(const char *text)
{
    return columns_of(text, strlen(text));
}

void ff_print_wrapped(FILE *stream, const char *text, int column, int indent)
{
    bool fresh = true; /* no word stands on this line yet */
    while (*text) {
        size_t length = strcspn(text, " \n");
        int columns = columns_of(text, length);
        if (!fresh && column + 1 + columns > FF_WIDTH) {
            fprintf(stream, "\n%*s", indent, "");
            column = indent;
            fresh = true;
        }
        fprintf(stream, "%s%.*s", fresh ? "" : " ", (int)length, text);
        column += columns + (fresh ? 0 : 1);
        fresh = false;
        text += length;
        text += strspn(text, " \n");
    }
    fputc('\n', stream);
}
