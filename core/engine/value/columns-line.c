/* SPDX-License-Identifier: MIT */
/* Splits the lines of a table into fields. */
#include "columns-read.h"

#include "text.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Field separators in the order in which they are tried; " " stands for any number of blanks. */
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

/* Returns the place of a text within its line. */
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

static bool has(const char *at, const char *end, char c)
{
    return memchr(at, c, (size_t)(end - at));
}

/* Returns the character behind the quote that closes the quote at `at`. A doubled quote stands for
   one quote character and closes nothing. */
static const char *skip_quoted(const char *at, const char *end)
{
    for (at++; at < end; at++) {
        bool twice = at + 1 < end && at[1] == '"';
        if (*at == '"' && !twice)
            return at + 1;
        at += *at == '"';
    }
    return end;
}

/* Returns the first position of a character outside of quotes; `end`: there is none. */
static const char *find(const char *at, const char *end, char wanted)
{
    bool fresh = true; /* a quote here opens a quoted field */
    while (at < end) {
        bool quoted = fresh && *at == '"';
        if (!quoted && *at == wanted)
            return at;
        fresh = strchr(separators, *at);
        at = quoted ? skip_quoted(at, end) : at + 1;
    }
    return end;
}

/* Returns the end of a field. If blanks separate the fields, a name and its unit still form one
   field: "time [s]". */
static const char *field_end(const char *at, const char *end, char separator, bool quotes)
{
    if (separator != ' ' && quotes)
        return find(at, end, separator);
    if (separator != ' ') {
        const char *stop = memchr(at, separator, (size_t)(end - at));
        return stop ? stop : end;
    }
    if (at < end && *at == '"')
        at = skip_quoted(at, end);
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

/* Removes the quotes that spreadsheets and R write around texts. No text that the engine reads
   contains a quote. */
static fe_field unquote(fe_field field)
{
    bool quoted = field.end - field.at >= 2 && *field.at == '"' && field.end[-1] == '"';
    return quoted ? fe_field_trim(field.at + 1, field.end - 1) : field;
}

size_t fe_line_split(fe_field line, char separator, fe_field fields[FE_MOST_FIELDS])
{
    size_t count = 0;
    bool quotes = has(line.at, line.end, '"');
    for (const char *at = line.at, *end;; at = end + 1) {
        while (separator == ' ' && at < line.end && is_blank(*at))
            at++;
        end = field_end(at, line.end, separator, quotes);
        if (count < FE_MOST_FIELDS)
            fields[count] = unquote(fe_field_trim(at, end));
        count++;
        if (end == line.end)
            return count;
    }
}

bool fe_line_is_closed(const fe_column_reader *r, size_t count, const fe_field *fields)
{
    for (size_t i = 0; i < count && i < FE_MOST_FIELDS; i++) {
        const char *at = fields[i].at;
        if (fields[i].end - at > 1 && at[0] == '"' && at[1] != '"')
            return fe_column_refuse(r, fields[i],
                                    "a quote within quotes is written twice, and a field ends "
                                    "with its line",
                                    "this field begins with a quote, but does not end with it");
    }
    return true;
}

size_t fe_row_split(const fe_columns *c, fe_field line, fe_field fields[FE_MOST_FIELDS])
{
    bool parted = c->separator != ' ' && has(line.at, line.end, c->separator);
    for (const char *s = separators; *s && !parted; s++)
        if (fe_line_split(line, *s, fields) == c->width)
            return c->width;
    return fe_line_split(line, c->separator, fields);
}

char fe_line_separator(fe_field line)
{
    const char *s = separators;
    while (*s != ' ' && find(line.at, line.end, *s) == line.end)
        s++;
    return *s;
}

/* Finds the content of a field inside its quotes, and the column and width of the field in
   characters. */
static ff_field read_field(const char *begin, fe_field text, const char *end)
{
    ff_field field = {.at = text.at, .end = text.end, .column = 1};
    uint32_t code;
    for (const char *at = begin; at < text.at; field.column++)
        at += fe_char_read(at, end, &code);
    for (const char *at = text.at; at < text.end; field.width++)
        at += fe_char_read(at, end, &code);
    field.quoted = text.at < text.end && *text.at == '"';
    if (!field.quoted)
        return field;
    const char *at = ++field.at;
    while (at < text.end && (*at != '"' || (at + 1 < text.end && at[1] == '"')))
        at += 1 + (*at == '"');
    field.open = at + 1 != text.end;
    field.end = field.open ? text.end : at;
    return field;
}

size_t ff_fields_split(const char *begin, const char *end, char separator, size_t most,
                       ff_field *fields)
{
    size_t count = 0;
    bool quotes = has(begin, end, '"');
    for (const char *at = begin, *stop;; at = stop + 1, count++) {
        stop = separator ? field_end(at, end, separator, quotes) : end;
        if (count < most)
            fields[count] = read_field(begin, fe_field_trim(at, stop), end);
        if (stop == end)
            return count + 1;
    }
}

char ff_fields_separator(const char *begin, const char *end)
{
    char separator = fe_line_separator((fe_field){begin, end});
    return separator == ' ' ? '\0' : separator;
}

size_t ff_field_copy(const ff_field *field, char *out)
{
    size_t length = 0;
    for (const char *at = field->at; at < field->end; at++) {
        at += field->quoted && *at == '"' && at + 1 < field->end;
        out[length++] = *at;
    }
    out[length] = '\0';
    return length;
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
