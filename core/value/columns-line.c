/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "columns-read.h"

#include "text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* What parts the fields of a line; any blanks come last. */
static const char separators[] = ";,\t ";

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

ff_field ff_field_trim(const char *at, const char *end)
{
    while (at < end && is_blank(*at))
        at++;
    while (end > at && is_blank(end[-1]))
        end--;
    return (ff_field){at, end};
}

/* The stretch from `at` to `end` of the line that begins at `begin`. */
static ff_place place_in(const ff_source *source, uint32_t line, const char *begin, ff_field text)
{
    const char *stop = source->text + source->length;
    ff_place place = {.source = source, .line = line, .column = 1};
    uint32_t code;
    while (begin < text.at) {
        begin += ff_char_read(begin, stop, &code);
        place.column++;
    }
    for (; begin < text.end; place.width++)
        begin += ff_char_read(begin, stop, &code);
    return place;
}

ff_place ff_column_place(const ff_column_reader *r, ff_field text)
{
    return text.at ? place_in(&r->c->source, r->line, r->begin, text)
                   : (ff_place){.source = &r->c->source};
}

bool ff_column_refuse(const ff_column_reader *r, ff_field text, const char *hint,
                      const char *format, ...)
{
    char sentence[500];
    va_list args;
    va_start(args, format);
    vsnprintf(sentence, sizeof sentence, format, args);
    va_end(args);
    return ff_error(r->report, FF_EXIT_INPUT, ff_column_place(r, text), hint, "%s", sentence);
}

/* Between blanks, a name and its unit are one field: "time [s]". */
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

/* As spreadsheets and R write texts; a field within quotes holds no separator here. */
static ff_field unquote(ff_field field)
{
    bool quoted = field.end - field.at >= 2 && *field.at == '"' && field.end[-1] == '"';
    return quoted ? ff_field_trim(field.at + 1, field.end - 1) : field;
}

size_t ff_line_split(ff_field line, char separator, ff_field fields[FF_MOST_FIELDS])
{
    size_t count = 0;
    for (const char *at = line.at, *end;; at = end + 1) {
        while (separator == ' ' && at < line.end && is_blank(*at))
            at++;
        end = field_end(at, line.end, separator);
        if (count < FF_MOST_FIELDS)
            fields[count] = unquote(ff_field_trim(at, end));
        count++;
        if (end == line.end)
            return count;
    }
}

size_t ff_row_split(const ff_columns *c, ff_field line, ff_field fields[FF_MOST_FIELDS])
{
    bool parted =
        c->separator != ' ' && memchr(line.at, c->separator, (size_t)(line.end - line.at));
    for (const char *s = separators; *s && !parted; s++)
        if (ff_line_split(line, *s, fields) == c->width)
            return c->width;
    return ff_line_split(line, c->separator, fields);
}

char ff_line_separator(ff_field line)
{
    const char *s = separators;
    while (*s != ' ' && !memchr(line.at, *s, (size_t)(line.end - line.at)))
        s++;
    return *s;
}

ff_place ff_columns_place(const ff_columns *c, size_t row, size_t column)
{
    ff_field fields[FF_MOST_FIELDS], text = {NULL, NULL};
    const char *end, *begin;
    bool known = column < c->count && c->values[column];
    if (row >= c->rows)
        return known ? c->heads[column] : (ff_place){.source = &c->source};
    begin = ff_line_begin(&c->source, c->lines[row], &end);
    text = ff_field_trim(begin, end);
    if (known && ff_row_split(c, text, fields) == c->width)
        text = fields[c->fields[column]];
    return place_in(&c->source, c->lines[row], begin, text);
}
