/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "columns.h"

#include "../value/memory.h"
#include "../value/text.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FIELDS = 100, MOST_BYTES = 1 << 24, NO_COLUMN = -1 };

/* Where the reading stands. */
typedef struct reader {
    ff_columns *c;
    ff_report *report;
    char separator; /* ' ': any blanks */
    size_t fields;
    int column_of[MOST_FIELDS]; /* rank of the column that was asked for, or NO_COLUMN */
    ff_unit unit_of[MOST_FIELDS];
    uint32_t line;
    const char *begin; /* of the line */
    size_t room;
} reader;

/* A field of a line, without the blanks around it. */
typedef struct field {
    const char *at, *end;
} field;

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

static field trim(const char *at, const char *end)
{
    while (at < end && is_blank(*at))
        at++;
    while (end > at && is_blank(end[-1]))
        end--;
    return (field){at, end};
}

static ff_place place_at(const reader *r, const char *at, const char *end)
{
    const char *stop = r->c->source.text + r->c->source.length, *line = r->begin;
    ff_place place = {.source = &r->c->source, .line = r->line, .column = 1};
    uint32_t code;
    while (line < at) {
        line += ff_char_read(line, stop, &code);
        place.column++;
    }
    for (; line < end; place.width++)
        line += ff_char_read(line, stop, &code);
    return place;
}

static size_t split(const reader *r, const char *at, const char *end, field fields[MOST_FIELDS])
{
    size_t count = 0;
    field line = trim(at, end);
    for (at = line.at; at <= line.end && count < MOST_FIELDS;) {
        const char *stop = at;
        int depth = 0;
        for (; stop < line.end; stop++) {
            depth += (*stop == '[') - (*stop == ']');
            bool here = r->separator == ' ' ? is_blank(*stop) && depth <= 0 : *stop == r->separator;
            /* the blank between a name and its unit */
            if (here && r->separator == ' ' && trim(stop, line.end).at[0] == '[')
                continue;
            if (here)
                break;
        }
        fields[count++] = trim(at, stop);
        at = stop + 1;
        while (r->separator == ' ' && at < line.end && is_blank(*at))
            at++;
        if (stop == line.end)
            break;
    }
    return count;
}

static bool load(ff_columns *c, const char *path, ff_report *report)
{
    FILE *file = fopen(path, "rb");
    c->source.name = ff_copy_text(path, strlen(path));
    c->source.directory = ff_copy_text(".", 1);
    c->source.text = ff_alloc(1);
    errno = file ? 0 : errno;
    for (size_t got = 1; file && got && c->source.length <= MOST_BYTES; c->source.length += got) {
        enum { PART = 1 << 16 };
        c->source.text = ff_resize(c->source.text, c->source.length + PART + 1);
        got = fread(c->source.text + c->source.length, 1, PART, file);
        c->source.text[c->source.length + got] = 0;
    }
    bool good = file && !ferror(file);
    if (!good)
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "\"%s\" cannot be read: %s", path,
                 strerror(errno));
    else if (c->source.length > MOST_BYTES || memchr(c->source.text, 0, c->source.length))
        good = ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL,
                        "\"%s\" is no table of numbers: it has %s", path,
                        c->source.length > MOST_BYTES ? "more than 16 MiB" : "a zero byte");
    if (file)
        fclose(file);
    if (!strncmp(c->source.text, "\xEF\xBB\xBF", 3))
        memcpy(c->source.text, "   ", 3); /* a byte order mark */
    return good;
}

static int find(const ff_columns *c, const char *name)
{
    for (size_t k = 0; k < c->count; k++)
        if (!strcmp(c->asked[k]->name, name))
            return (int)k;
    return NO_COLUMN;
}

static const char *near_name(const ff_columns *c, const char *name)
{
    const char *names[MOST_FIELDS];
    for (size_t k = 0; k < c->count; k++)
        names[k] = c->asked[k]->name;
    return ff_nearest(name, names, c->count);
}

/* "pressure [GPa]" */
static bool read_head(reader *r, size_t index, field head)
{
    ff_columns *c = r->c;
    const char *open = memchr(head.at, '[', (size_t)(head.end - head.at));
    field name = trim(head.at, open ? open : head.end);
    char word[80], unit[80] = "", why[200];
    ff_place place = place_at(r, head.at, head.end);
    snprintf(word, sizeof word, "%.*s", (int)(name.end - name.at), name.at);
    int k = r->column_of[index] = find(c, word);
    if (k == NO_COLUMN) {
        const char *near = near_name(c, word);
        ff_warn(r->report, place, "the column \"%s\" is not used%s%s%s", word,
                near ? "; did you mean \"" : "", near ? near : "", near ? "\"?" : "");
        return true;
    }
    if (c->values[k])
        return ff_error(r->report, FF_EXIT_INPUT, place, NULL, "the column \"%s\" comes twice",
                        word);
    c->values[k] = ff_alloc(sizeof(double));
    c->heads[k] = place;
    if (open && head.end[-1] == ']') {
        field inside = trim(open + 1, head.end - 1);
        snprintf(unit, sizeof unit, "%.*s", (int)(inside.end - inside.at), inside.at);
    }
    if (!*unit && !ff_unit_is_dimensionless(&c->units[k]))
        return ff_error(r->report, FF_EXIT_INPUT, place, NULL,
                        "the column \"%s\" needs its unit in brackets, such as \"%s [%s]\"", word,
                        word, c->asked[k]->unit);
    if (!ff_unit_parse(unit, &r->unit_of[index], why, sizeof why))
        return ff_error(r->report, FF_EXIT_INPUT, place, NULL, "the unit \"%s\" %s", unit, why);
    return ff_unit_same_dimension(&r->unit_of[index], &c->units[k]) ||
           ff_error(r->report, FF_EXIT_INPUT, place, NULL,
                    "the column \"%s\" is in \"%s\", but should be in %s or the like", word, unit,
                    c->asked[k]->unit);
}

/* What must be there is, and of a group one column at most. */
static bool check_heads(const reader *r)
{
    const ff_columns *c = r->c;
    bool good = true;
    for (size_t k = 0; k < c->count; k++) {
        const ff_param *row = c->asked[k];
        if (!c->values[k] && row->flags & FF_REQUIRED)
            good =
                ff_error(r->report, FF_EXIT_INPUT, place_at(r, r->begin, r->begin), NULL,
                         "the column \"%s [%s]\" is missing: %s", row->name, row->unit, row->doc);
        for (size_t i = 0; i < k && row->group && c->values[k]; i++)
            if (c->values[i] && c->asked[i]->group && !strcmp(c->asked[i]->group, row->group))
                good = ff_error(r->report, FF_EXIT_INPUT, c->heads[k], NULL,
                                "the columns \"%s\" and \"%s\" exclude each other",
                                c->asked[i]->name, row->name);
    }
    return good;
}

static bool read_header(reader *r, const char *at, const char *end)
{
    field fields[MOST_FIELDS];
    static const char separators[] = ";,\t";
    r->separator = ' ';
    for (const char *s = separators; *s && r->separator == ' '; s++)
        if (memchr(at, *s, (size_t)(end - at)))
            r->separator = *s;
    r->fields = split(r, at, end, fields);
    bool good = true;
    for (size_t i = 0; i < r->fields; i++)
        good = read_head(r, i, fields[i]) && good;
    return check_heads(r) && good;
}

/* Inside the physical limits of the column. */
static bool check_limits(const reader *r, size_t k, double si, ff_place place)
{
    const ff_param *row = r->c->asked[k];
    double number = ff_unit_from_si(&r->c->units[k], si);
    bool limited = row->min < row->max;
    bool low = limited && (row->flags & FF_MIN_OPEN ? number <= row->min : number < row->min);
    bool high = limited && (row->flags & FF_MAX_OPEN ? number >= row->max : number > row->max);
    return (!low && !high) || ff_error(r->report, FF_EXIT_INPUT, place, NULL,
                                       "%s must be %s %g %s, but is %g %s", row->name,
                                       low ? row->flags & FF_MIN_OPEN ? "above" : "at least"
                                       : row->flags & FF_MAX_OPEN ? "below"
                                                                  : "at most",
                                       low ? row->min : row->max, row->unit, number, row->unit);
}

static bool read_number(reader *r, size_t index, field text, size_t row)
{
    ff_columns *c = r->c;
    char word[64];
    const char *end = word;
    double number = 0;
    size_t k = (size_t)r->column_of[index];
    ff_place place = place_at(r, text.at, text.end);
    snprintf(word, sizeof word, "%.*s", (int)(text.end - text.at), text.at);
    c->places[row * c->count + k] = place;
    if (!*word)
        return ff_error(r->report, FF_EXIT_INPUT, place, NULL, "%s has no number here",
                        c->asked[k]->name);
    if (!ff_number_parse(word, &number, &end) || *end)
        return ff_error(r->report, FF_EXIT_INPUT, place,
                        strchr(word, ',') ? "write a decimal point" : NULL, "\"%s\" is no number",
                        word);
    double si = ff_unit_to_si(&r->unit_of[index], number);
    c->values[k][row] = si;
    return (isfinite(si) ||
            ff_error(r->report, FF_EXIT_INPUT, place, NULL, "%s is out of range", word)) &&
           check_limits(r, k, si, place);
}

static bool read_row(reader *r, const char *at, const char *end)
{
    ff_columns *c = r->c;
    field fields[MOST_FIELDS];
    size_t count = split(r, at, end, fields), row = c->rows++;
    if (count != r->fields)
        return ff_error(r->report, FF_EXIT_INPUT, place_at(r, at, trim(at, end).end), NULL,
                        "%zu field%s in this line, but %zu in the header", count,
                        count == 1 ? "" : "s", r->fields);
    if (c->rows > r->room) {
        r->room = 2 * c->rows + 30;
        for (size_t k = 0; k < c->count; k++)
            if (c->values[k])
                c->values[k] = ff_resize(c->values[k], r->room * sizeof(double));
        c->places = ff_resize(c->places, r->room * c->count * sizeof *c->places);
    }
    bool good = true;
    for (size_t i = 0; i < count; i++)
        if (r->column_of[i] != NO_COLUMN)
            good = read_number(r, i, fields[i], row) && good;
    return good;
}

bool ff_columns_read(ff_columns *c, const char *path, const ff_param *rows, size_t count,
                     size_t stride, ff_report *report)
{
    reader r = {.c = c, .report = report};
    char why[200];
    *c = (ff_columns){.count = count};
    c->asked = ff_alloc(count * sizeof *c->asked);
    c->units = ff_alloc(count * sizeof *c->units);
    c->values = ff_alloc(count * sizeof *c->values);
    c->heads = ff_alloc(count * sizeof *c->heads);
    for (size_t k = 0; k < count; k++) {
        c->asked[k] = (const ff_param *)(const void *)((const char *)rows + k * stride);
        if (!ff_unit_parse(c->asked[k]->unit, &c->units[k], why, sizeof why))
            return ff_error(report, FF_EXIT_PLUGIN, FF_NOWHERE, NULL,
                            "the fitter gives its column \"%s\" the unit \"%s\", which %s",
                            c->asked[k]->name, c->asked[k]->unit, why);
    }
    bool good = load(c, path, report), headed = false;
    const char *stop = c->source.text + c->source.length;
    for (const char *at = c->source.text, *end; good && at < stop; at = end + 1) {
        end = memchr(at, '\n', (size_t)(stop - at));
        end = end ? end : stop;
        r.line++;
        r.begin = at;
        field line = trim(at, end);
        if (line.at == line.end || *line.at == '#')
            continue;
        if (headed)
            read_row(&r, line.at, line.end);
        else
            good = headed = read_header(&r, line.at, line.end);
    }
    if (good && c->rows == 0)
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "\"%s\" has no %s", path,
                 headed ? "rows of numbers below its header" : "header and no numbers");
    return good && ff_report_errors(report) == 0;
}

ff_place ff_columns_place(const ff_columns *c, size_t row, size_t column)
{
    if (row < c->rows && column < c->count && c->values[column])
        return c->places[row * c->count + column];
    if (row < c->rows)
        for (size_t k = 0; k < c->count; k++)
            if (c->values[k])
                return (ff_place){
                    .source = &c->source, .line = c->places[row * c->count + k].line, .column = 1};
    if (column < c->count && c->values[column])
        return c->heads[column];
    return (ff_place){.source = &c->source};
}

void ff_columns_free(ff_columns *c)
{
    for (size_t k = 0; k < c->count; k++)
        free(c->values[k]);
    free(c->asked);
    free(c->units);
    free(c->values);
    free(c->places);
    free(c->heads);
    free(c->source.name);
    free(c->source.text);
    free(c->source.directory);
    *c = (ff_columns){.count = 0};
}
