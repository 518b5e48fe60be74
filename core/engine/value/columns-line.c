/* SPDX-License-Identifier: MIT */
#include "columns-read.h"

#include "text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Separators of fields, in the order in which they are tried; " " stands for any blanks. */
static const char separators[] = ";,\t ";

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

fe_field fe_field_trim(const char *at, const char *end)
{
    while (at < end && is_blank(*at))
        at++;
    while (end > at && is_blank(end[-1]))
        end--;
    return (fe_field){at, end};
}

/* The stretch from `at` to `end` of the line that begins at `begin`. */
static ff_place place_in(const ff_source *source, uint32_t line, const char *begin, fe_field text)
{
    const char *stop = source->text + source->length;
    ff_place place = {.source = source, .line = line, .column = 1};
    uint32_t code;
    while (begin < text.at) {
        begin += fe_char_read(begin, stop, &code);
        place.column++;
    }
    for (; begin < text.end; place.width++)
        begin += fe_char_read(begin, stop, &code);
    return place;
}

ff_place fe_column_place(const fe_column_reader *r, fe_field text)
{
    return text.at ? place_in(&r->c->source, r->line, r->begin, text)
                   : (ff_place){.source = &r->c->source};
}

bool fe_column_refuse(const fe_column_reader *r, fe_field text, const char *hint,
                      const char *format, ...)
{
    char sentence[500];
    va_list args;
    va_start(args, format);
    vsnprintf(sentence, sizeof sentence, format, args);
    va_end(args);
    return ff_error(r->report, FF_FAULT_INPUT, fe_column_place(r, text), hint, "%s", sentence);
}

/* Where blanks separate the fields, a name and its unit are still one field: "time [s]". */
static const char *field_end(const char *at, const char *end, char separator)
{
    if (separator != ' ') {
        const char *stop = memchr(at, separator, (size_t)(end - at));
        return stop ? stop : end;
    }
    for (int depth = 0; at < end; at++) {
        const char *next = at;
        while (next < end && is_blank(*next) && depth <= 0)
            next++;
        if (next > at && (next == end || *next != '['))
            break;
        at = next;
        depth += (*at == '[') - (*at == ']');
    }
    return at;
}

/* Spreadsheets and R quote texts; a quoted field cannot hold a separator here. */
static fe_field unquote(fe_field field)
{
    bool quoted = field.end - field.at >= 2 && *field.at == '"' && field.end[-1] == '"';
    return quoted ? fe_field_trim(field.at + 1, field.end - 1) : field;
}

size_t fe_line_split(fe_field line, char separator, fe_field fields[FE_MOST_FIELDS])
{
    size_t count = 0;
    for (const char *at = line.at, *end;; at = end + 1) {
        while (separator == ' ' && at < line.end && is_blank(*at))
            at++;
        end = field_end(at, line.end, separator);
        if (count < FE_MOST_FIELDS)
            fields[count] = unquote(fe_field_trim(at, end));
        count++;
        if (end == line.end)
            return count;
    }
}

size_t fe_row_split(const fe_columns *c, fe_field line, fe_field fields[FE_MOST_FIELDS])
{
    bool parted =
        c->separator != ' ' && memchr(line.at, c->separator, (size_t)(line.end - line.at));
    for (const char *s = separators; *s && !parted; s++)
        if (fe_line_split(line, *s, fields) == c->width)
            return c->width;
    return fe_line_split(line, c->separator, fields);
}

char fe_line_separator(fe_field line)
{
    const char *s = separators;
    while (*s != ' ' && !memchr(line.at, *s, (size_t)(line.end - line.at)))
        s++;
    return *s;
}

ff_place ff_columns_place(const ff_table *table, size_t row, size_t column)
{
    const fe_columns *c = (const fe_columns *)(const void *)table;
    fe_field fields[FE_MOST_FIELDS], text = {NULL, NULL};
    const char *end, *begin;
    bool known = column < c->count && c->values[column];
    if (row >= c->rows)
        return known ? c->heads[column] : (ff_place){.source = &c->source};
    begin = fe_line_begin(&c->source, c->lines[row], &end);
    text = fe_field_trim(begin, end);
    if (known && fe_row_split(c, text, fields) == c->width)
        text = fields[c->fields[column]];
    return place_in(&c->source, c->lines[row], begin, text);
}
