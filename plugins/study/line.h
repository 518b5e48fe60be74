/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines on the terminal and texts, shared by the studies of this folder. */
#ifndef STUDY_LINE_H
#define STUDY_LINE_H

#include <flankfilm/author.h>
#include <flankfilm/study.h>

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct study_line {
    size_t used;
    char text[4000];
} study_line;

/* Puts more behind the line, as far as there is room. */
FF_UNUSED FF_PRINTF(2, 3) static void study_put(study_line *line, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int length = vsnprintf(line->text + line->used, sizeof line->text - line->used, format, args);
    va_end(args);
    line->used += length > 0 ? (size_t)length : 0;
    if (line->used >= sizeof line->text)
        line->used = sizeof line->text - 1;
}

/* Says the line, and begins another one. */
FF_UNUSED static void study_tell(const ff_study_desk *desk, study_line *line, int32_t indent)
{
    desk->say(desk->ctx, indent, line->text);
    line->used = 0;
    line->text[0] = '\0';
}

/* A text that lives as long as the study. */
FF_UNUSED FF_PRINTF(2, 3) static const
    char *study_keep(const ff_study_desk *desk, const char *format, ...)
{
    va_list args, again;
    va_start(args, format);
    va_copy(again, args);
    int length = vsnprintf(NULL, 0, format, again);
    size_t size = length > 0 ? (size_t)length + 1 : 1;
    char *text = desk->memory(desk->ctx, size);
    vsnprintf(text, size, format, args);
    va_end(again);
    va_end(args);
    return text;
}

/* The entry of a map; NULL: there is none. */
FF_UNUSED static const ff_written *study_entry(const ff_written *map, const char *key)
{
    for (size_t i = 0; map && map->keys && i < map->count; i++)
        if (!strcmp(map->keys[i], key))
            return map->items[i];
    return NULL;
}

/* A plain number at the start of the text; *end: what stands behind it. False: there is none. */
FF_UNUSED static bool study_number(const char *text, double *number, const char **end)
{
    char *stop;
    size_t sign = strspn(text, "+-");
    *number = strtod(text, &stop);
    *end = stop;
    return stop != text && strspn(text + sign, "0123456789.") > 0;
}

/* A share of 1, also as "1 %". */
FF_UNUSED static bool study_share(const char *text, double *share)
{
    const char *end = text;
    bool good = text && study_number(text, share, &end);
    end += good ? strspn(end, " ") : 0;
    if (good && *end == '%')
        *share /= 100, end++;
    return good && *end == '\0';
}

/* Text of XML. */
FF_UNUSED static void study_put_xml(FILE *out, const char *text, size_t length)
{
    for (size_t i = 0; i < length && text[i]; i++)
        if (strchr("<>&", text[i]))
            fputs(text[i] == '<' ? "&lt;" : text[i] == '>' ? "&gt;" : "&amp;", out);
        else
            fputc(text[i], out);
}

/* A cell of a table. */
FF_UNUSED static void study_write_quoted(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text; text++)
        fputs(*text == '"' ? "\"\"" : (char[]){*text == '\n' ? ' ' : *text, '\0'}, out);
    fputc('"', out);
}

#endif
