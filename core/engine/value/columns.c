/* SPDX-License-Identifier: MIT */
/* Reads a table of named columns with units from a CSV file. */
#include "columns-read.h"

#include "limits.h"
#include "memory.h"
#include "text.h"

#include <assert.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_BYTES = 1 << 27, MOST_ROWS = 2000000, MOST_ERRORS = 20 };

/* Stands for the whole file in errors that are not about one field. */
static const fe_field whole = {NULL, NULL};

static bool load(fe_column_reader *r, const char *path)
{
    ff_source *source = &r->c->source;
    struct stat about = {.st_size = 0};
    *source = (ff_source){.name = fe_copy_text(path, strlen(path)),
                          .directory = fe_copy_text(".", 1),
                          .text = fe_alloc(1),
                          .temporary = true};
    if (stat(path, &about) == 0 && !S_ISREG(about.st_mode))
        return fe_column_refuse(r, whole, NULL, "this is not a text file");
    if (about.st_size > MOST_BYTES)
        return fe_column_refuse(r, whole, NULL, "the file is larger than 128 MiB");
    size_t most = (size_t)about.st_size;
    /* allocated before the file is opened, so that a failure leaves no open file */
    source->text = fe_resize(source->text, most + 1);
    FILE *file = fopen(path, "rb");
    if (file)
        source->length = fread(source->text, 1, most, file);
    source->text[source->length] = 0;
    int failed = !file || ferror(file) ? errno : 0;
    if (file)
        fclose(file);
    errno = failed;
    return !failed ||
           fe_column_refuse(r, whole, NULL, "the file cannot be read: %s", fe_errno_text());
}

/* Drops a byte order mark and refuses zero bytes. CR ends a line if no line ends with LF. */
static bool check_text(fe_column_reader *r)
{
    ff_source *source = &r->c->source;
    if (source->length >= 3 && !memcmp(source->text, "\xEF\xBB\xBF", 3)) {
        source->length -= 3;
        memmove(source->text, source->text + 3, source->length + 1);
    }
    if (!memchr(source->text, '\n', source->length))
        for (char *at = source->text; (at = strchr(at, '\r'));)
            *at++ = '\n';
    const char *zero = memchr(source->text, 0, source->length);
    return !zero || ff_error(r->report, FF_FAULT_INPUT,
                             fe_place_of(source, (size_t)(zero - source->text), 0), NULL,
                             "this is not a text file: it has a zero byte here");
}

static void print_value(const fe_columns *c, size_t k, double si, char out[80])
{
    ff_quantity_print(si, &c->units[k], c->requested[k]->unit, out, 80);
}

static bool check_limits(const fe_column_reader *r, size_t k, double *si, fe_field text)
{
    char value[80], wanted[100];
    if (fe_limits_check(r->c->requested[k], &r->c->units[k], si, wanted) == 0)
        return true;
    print_value(r->c, k, *si, value);
    return fe_column_refuse(r, text, NULL, "%s must be %s, but is %s", r->c->requested[k]->name,
                            wanted, value);
}

/* Checks a number against the flags of its column. */
static bool check_flags(const fe_column_reader *r, size_t k, size_t row, fe_field text)
{
    const fe_columns *c = r->c;
    const ff_param *column = c->requested[k];
    double si = c->values[k][row];
    char value[80], before[80];
    if (column->flags & FF_WHOLE && si != floor(si))
        return fe_column_refuse(r, text, NULL, "%s must be a whole number", column->name);
    if (!(column->flags & FF_INCREASING) || row == 0 || !(si < c->values[k][row - 1]))
        return true;
    print_value(c, k, si, value);
    print_value(c, k, c->values[k][row - 1], before);
    return fe_column_refuse(r, text, NULL, "%s must not decrease, but %s follows %s", column->name,
                            value, before);
}

static bool read_number(fe_column_reader *r, size_t index, fe_field text, size_t row)
{
    assert(r->column_of[index] >= 0);
    fe_columns *c = r->c;
    size_t k = (size_t)r->column_of[index];
    const char *end = text.at, *name = c->requested[k]->name;
    double number = 0;
    int shown = (int)(text.end - text.at > 40 ? 40 : text.end - text.at);
    if (text.at == text.end)
        return fe_column_refuse(r, text, NULL, "%s has no number here", name);
    bool read = ff_number_parse(text.at, &number, &end);
    if (end != text.end || end == text.at)
        return fe_column_refuse(
            r, text,
            memchr(text.at, ',', (size_t)(text.end - text.at)) ? "write a decimal point" : NULL,
            "\"%.*s\" is not a number", shown, text.at);
    double si = ff_unit_to_si(&r->unit_of[index], number);
    c->values[k][row] = si;
    if (!read || !isfinite(si))
        return fe_column_refuse(r, text, NULL, "%.*s is out of range", shown, text.at);
    return check_limits(r, k, &c->values[k][row], text) && check_flags(r, k, row, text);
}

static void make_room(fe_column_reader *r)
{
    fe_columns *c = r->c;
    if (c->rows < r->room)
        return;
    r->room = 2 * c->rows + 64;
    for (size_t k = 0; k < c->count; k++)
        if (c->values[k])
            c->values[k] = fe_resize(c->values[k], r->room * sizeof *c->values[k]);
    c->lines = fe_resize(c->lines, r->room * sizeof *c->lines);
}

/* Reads a row. False if there is no point in reading further rows. */
static bool read_row(fe_column_reader *r, fe_field line)
{
    fe_columns *c = r->c;
    fe_field fields[FE_MOST_FIELDS];
    if (c->rows == r->most)
        return fe_column_refuse(r, line, NULL, "the table has more than %zu rows", r->most);
    size_t count = fe_row_split(c, line, fields), row = c->rows;
    make_room(r);
    c->lines[c->rows++] = r->line;
    for (size_t k = 0; k < c->count; k++)
        if (c->values[k])
            c->values[k][row] = 0; /* value until the field is read */
    if (!fe_line_is_closed(r, count, fields))
        return true;
    if (count != c->width)
        fe_column_refuse(r, line, NULL, "%zu field%s in this line, but %zu in the header", count,
                         count == 1 ? "" : "s", c->width);
    for (size_t i = 0; i < count && count == c->width; i++)
        if (r->column_of[i] != FE_NO_COLUMN)
            read_number(r, i, fields[i], row);
    return true;
}

static bool take_rows(fe_column_reader *r, const ff_param *rows, size_t count, size_t stride)
{
    fe_columns *c = r->c;
    char why[200];
    c->count = count;
    c->requested = fe_alloc(count * sizeof *c->requested);
    c->units = fe_alloc(count * sizeof *c->units);
    c->values = fe_alloc(count * sizeof *c->values);
    c->heads = fe_alloc(count * sizeof *c->heads);
    c->fields = fe_alloc(count * sizeof *c->fields);
    r->most = MOST_ROWS;
    for (size_t k = 0; k < count; k++) {
        const ff_param *row = (const ff_param *)(const void *)((const char *)rows + k * stride);
        c->requested[k] = row;
        if (row->max_count > 0 && row->max_count < r->most)
            r->most = row->max_count;
        if (!ff_unit_parse(row->unit, &c->units[k], why, sizeof why))
            return ff_error(r->report, FF_FAULT_PLUGIN, FF_NOWHERE, NULL,
                            "the requested column \"%s\": the unit \"%s\" %s", row->name, row->unit,
                            why);
    }
    return true;
}

static bool check_count(const fe_column_reader *r)
{
    const fe_columns *c = r->c;
    bool good = true;
    if (c->width == 0)
        return fe_column_refuse(r, whole, NULL,
                                "the file has no header and no numbers; its first line names the "
                                "columns");
    if (c->rows == 0)
        return fe_column_refuse(r, whole, NULL, "the file has no rows of numbers below its header");
    for (size_t k = 0; k < c->count && good; k++)
        if (c->values[k] && c->rows < c->requested[k]->min_count)
            good = fe_column_refuse(r, whole, NULL, "the table must have at least %u rows",
                                    c->requested[k]->min_count);
    return good;
}

static bool read_columns(fe_column_reader *r, const char *path)
{
    const ff_source *source = &r->c->source;
    if (!load(r, path) || !check_text(r))
        return false;
    const char *stop = source->text + source->length;
    size_t before = ff_report_errors(r->report);
    bool good = true;
    for (const char *at = source->text, *end; good && at < stop; at = end + 1) {
        end = memchr(at, '\n', (size_t)(stop - at));
        end = end ? end : stop;
        r->line++;
        r->begin = at;
        fe_field line = fe_field_trim(at, end);
        if (line.at == line.end || *line.at == '#')
            continue;
        good = r->c->width ? read_row(r, line) : fe_column_heads_read(r, line);
        good = good && ff_report_errors(r->report) < before + MOST_ERRORS;
    }
    return good && check_count(r) && ff_report_errors(r->report) == before;
}

const ff_table *ff_columns_read(const char *path, const ff_param *rows, size_t count, size_t stride,
                                ff_report *report)
{
    fe_columns *c = fe_alloc(sizeof *c);
    fe_column_reader r = {.c = c, .report = report};
    bool good = take_rows(&r, rows, count, stride) && read_columns(&r, path);
    c->table = (ff_table){.size = sizeof c->table,
                          .row_count = c->rows,
                          .columns = (const double *const *)c->values,
                          .lines = c->lines};
    if (good)
        return &c->table;
    ff_columns_free(&c->table);
    return NULL;
}

void ff_columns_free(const ff_table *table)
{
    fe_columns *c = (fe_columns *)(uintptr_t)table;
    if (!c)
        return;
    for (size_t k = 0; k < c->count; k++)
        fe_free(c->values[k]);
    fe_free(c->requested);
    fe_free(c->units);
    fe_free(c->values);
    fe_free(c->lines);
    fe_free(c->heads);
    fe_free(c->fields);
    fe_free(c->source.name);
    fe_free(c->source.text);
    fe_free(c->source.directory);
    fe_free(c);
}
