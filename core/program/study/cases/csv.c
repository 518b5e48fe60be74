/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "csv.h"

#include "../../memory/memory.h"

#include <stdlib.h>
#include <string.h>

bool study_csv_is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static uint32_t count_characters(const char *from, const char *to)
{
    uint32_t count = 0;
    for (; from < to; from++)
        count += ((unsigned char)*from & 0xc0) != 0x80;
    return count;
}

char study_csv_separator(const char *text)
{
    bool quoted = false;
    for (; *text; text++) {
        quoted = quoted != (*text == '"');
        if (!quoted && strchr(";,\t", *text))
            return *text;
    }
    return '\0';
}

/* Copies a quoted field, whose quotes are written twice; returns what follows it, NULL when it has
   no end. */
static const char *read_quoted(const char *at, char *out)
{
    for (at++; *at; at++) {
        if (*at == '"' && at[1] != '"') {
            *out = '\0';
            return at + 1;
        }
        at += *at == '"';
        *out++ = *at;
    }
    return NULL;
}

/* Reads the field at `at`; returns its end, NULL after a fault. */
static const char *read_field(study_csv_line *l, const char *begin, const char *at, char separator)
{
    study_csv_field *f = &l->fields[l->count++];
    while (study_csv_is_blank(*at) && *at != separator)
        at++;
    const char *first = at, *end;
    f->quoted = *at == '"';
    if (f->quoted) {
        f->text = memory_alloc(strlen(at) + 1);
        end = at = read_quoted(at, f->text);
        l->fault = at ? NULL : "a quote is opened and not closed on its line";
        while (at && study_csv_is_blank(*at) && *at != separator)
            at++;
        if (at && *at && *at != separator)
            l->fault = "something follows the closing quote";
    } else {
        while (*at && *at != separator)
            at++;
        for (end = at; end > first && study_csv_is_blank(end[-1]);)
            end--;
        f->text = memory_copy_text(first, (size_t)(end - first));
    }
    f->column = 1 + count_characters(begin, first);
    f->width = count_characters(first, end ? end : first + strlen(first));
    return l->fault ? NULL : at;
}

study_csv_line study_csv_split(const char *text, char separator)
{
    size_t most = 1;
    for (const char *at = text; *at; at++)
        most += *at == separator;
    study_csv_line l = {.fields =
                            memory_alloc((most > STUDY_CSV_FIELDS ? STUDY_CSV_FIELDS + 1 : most) *
                                         sizeof(study_csv_field))};
    const char *at = text;
    do {
        if (l.count > STUDY_CSV_FIELDS)
            return l;
        at = read_field(&l, text, at, separator);
    } while (at && *at && *at++ == separator);
    return l;
}

void study_csv_free(study_csv_line *l)
{
    for (size_t i = 0; i < l->count; i++)
        free(l->fields[i].text);
    free(l->fields);
}

bool study_csv_is_silent(const char *text)
{
    while (study_csv_is_blank(*text))
        text++;
    return !*text || *text == '#';
}

void study_csv_write(FILE *out, const char *text, size_t length, bool always)
{
    bool quoted = always || strcspn(text, ",\"\n\r") < length;
    if (quoted)
        fputc('"', out);
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '"')
            fputc('"', out);
        fputc(text[i] == '\n' || text[i] == '\r' ? ' ' : text[i], out);
    }
    if (quoted)
        fputc('"', out);
}
