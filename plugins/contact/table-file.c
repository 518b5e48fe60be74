/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "table-file.h"

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MAX_ROWS = 1000000, MAX_LINES = 2 * MAX_ROWS, MAX_LINE = 4096 };

typedef struct unit {
    const char *name;
    double factor;
} unit;

static const unit times[] = {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"µs", 1e-6}, {NULL, 0}};
static const unit lengths[] = {{"mm", 1e-3}, {"m", 1}, {"um", 1e-6}, {"µm", 1e-6}, {NULL, 0}};
static const unit speeds[] = {{"m/s", 1}, {"mm/s", 1e-3}, {NULL, 0}};
static const unit loads[] = {{"N/mm", 1e3}, {"N/m", 1}, {"kN/m", 1e3}, {NULL, 0}};

static const struct {
    const char *name;
    const unit *units;
} columns[FF_COLUMNS] = {
    [FF_COLUMN_TIME] = {"time", times},           [FF_COLUMN_RADIUS] = {"radius", lengths},
    [FF_COLUMN_RADIUS_1] = {"radius_1", lengths}, [FF_COLUMN_RADIUS_2] = {"radius_2", lengths},
    [FF_COLUMN_SPEED_1] = {"speed_1", speeds},    [FF_COLUMN_SPEED_2] = {"speed_2", speeds},
    [FF_COLUMN_LOAD] = {"load_per_width", loads}, [FF_COLUMN_GAP] = {"gap", lengths},
};

typedef struct reader {
    const ff_host *host;
    const char *item;
    FILE *file;
    locale_t plain; /* decimal points, whatever the program's locale is */
    size_t line, room;
    char text[MAX_LINE];
    ff_table_file *table;
    size_t fields;
    int column[FF_COLUMNS]; /* of each field */
    double factor[FF_COLUMNS];
} reader;

const char *ff_table_column(int column)
{
    return columns[column].name;
}

static char *trim(char *text)
{
    text += strspn(text, " \t\r\n");
    size_t n = strlen(text);
    while (n > 0 && strchr(" \t\r\n", text[n - 1]))
        text[--n] = 0;
    return text;
}

/* The next line that says something; NULL at the end of the file or when *status tells why. */
static char *next_line(reader *r, ff_status *status)
{
    *status = FF_OK;
    while (fgets(r->text, sizeof r->text, r->file)) {
        r->line++;
        if (!strchr(r->text, '\n') && !feof(r->file))
            *status = ff_failf(r->host, FF_INVALID, r->item,
                               "line %zu is longer than %d characters or is no text", r->line,
                               MAX_LINE - 1);
        else if (r->line > MAX_LINES)
            *status = ff_failf(r->host, FF_INVALID, r->item, "the file has more than %d lines",
                               MAX_LINES);
        if (*status != FF_OK)
            return NULL;
        char *text = r->text;
        if (r->line == 1 && !strncmp(text, "\xef\xbb\xbf", 3)) /* byte order mark */
            text += 3;
        text = trim(text);
        if (*text && *text != '#')
            return text;
    }
    if (ferror(r->file))
        *status =
            ff_failf(r->host, FF_INVALID, r->item, "the file cannot be read: %s", strerror(errno));
    return NULL;
}

/* Cuts a line into at most FF_COLUMNS fields; one more tells that there are too many. */
static size_t split(char *text, char *field[FF_COLUMNS])
{
    size_t n = 0;
    for (; text && n < FF_COLUMNS; n++) {
        size_t length = strcspn(text, ",;\t");
        char *rest = text[length] ? text + length + 1 : NULL;
        text[length] = 0;
        field[n] = trim(text);
        text = rest;
    }
    return text ? n + 1 : n;
}

static ff_status read_unit(const reader *r, int column, const char *text, double *factor)
{
    const unit *units = columns[column].units;
    for (const unit *u = units; u->name; u++)
        if (!strcmp(u->name, text)) {
            *factor = u->factor;
            return FF_OK;
        }
    return ff_failf(r->host, FF_INVALID, r->item,
                    "line %zu: column %s has the unit \"%.40s\"; write, for example, \"%s [%s]\"",
                    r->line, columns[column].name, text, columns[column].name, units[0].name);
}

static ff_status read_title(reader *r, size_t field, char *title)
{
    char *bracket = strchr(title, '['), *end = bracket ? strchr(bracket, ']') : NULL;
    bool closed = !bracket || (end && !*trim(end + 1));
    const char *unit_text = "";
    if (bracket && closed) {
        *bracket = *end = 0;
        unit_text = trim(bracket + 1);
        title = trim(title);
    }
    for (int c = 0; c < FF_COLUMNS && closed; c++) {
        if (strcmp(title, columns[c].name) != 0)
            continue;
        for (size_t k = 0; k < field; k++)
            if (r->column[k] == c)
                return ff_failf(r->host, FF_INVALID, r->item, "line %zu: column %s is there twice",
                                r->line, title);
        r->column[field] = c;
        return read_unit(r, c, unit_text, &r->factor[field]);
    }
    return ff_failf(r->host, FF_INVALID, r->item,
                    "line %zu: no column is called \"%.40s\"; the header names time [s], radius "
                    "[mm] or radius_1 [mm] and radius_2 [mm], speed_1 [m/s], speed_2 [m/s], "
                    "load_per_width [N/mm], and may name gap [um]",
                    r->line, title);
}

static ff_status read_header(reader *r)
{
    ff_status status;
    char *field[FF_COLUMNS], *text = next_line(r, &status);
    if (!text)
        return status != FF_OK ? status
                               : ff_failf(r->host, FF_INVALID, r->item,
                                          "the file is empty; its first line names the columns");
    r->fields = split(text, field);
    if (r->fields > FF_COLUMNS)
        return ff_failf(r->host, FF_INVALID, r->item, "line %zu has more than %d columns", r->line,
                        FF_COLUMNS);
    for (size_t i = 0; i < r->fields && status == FF_OK; i++)
        status = read_title(r, i, field[i]);
    return status;
}

static bool grow(reader *r)
{
    size_t room = r->room ? 2 * r->room : 256;
    for (size_t i = 0; i < r->fields; i++) {
        double **column = &r->table->column[r->column[i]];
        double *larger = realloc(*column, room * sizeof **column);
        if (!larger)
            return false;
        *column = larger;
    }
    size_t *line = realloc(r->table->line, room * sizeof *line);
    if (!line)
        return false;
    r->table->line = line;
    r->room = room;
    return true;
}

static ff_status read_row(reader *r, char *text)
{
    char *field[FF_COLUMNS];
    size_t n = split(text, field), row = r->table->rows;
    if (n != r->fields)
        return ff_failf(r->host, FF_INVALID, r->item,
                        "line %zu has %zu columns%s, the header has %zu", r->line, n,
                        n > FF_COLUMNS ? " or more" : "", r->fields);
    if (row == MAX_ROWS)
        return ff_failf(r->host, FF_INVALID, r->item, "the table has more than %d rows", MAX_ROWS);
    if (row == r->room && !grow(r))
        return FF_NOMEM;
    for (size_t i = 0; i < n; i++) {
        char *end;
        double value = strtod_l(field[i], &end, r->plain) * r->factor[i];
        if (end == field[i] || *end || !isfinite(value))
            return ff_failf(r->host, FF_INVALID, r->item,
                            "line %zu, column %s: \"%.40s\" is not a finite number", r->line,
                            columns[r->column[i]].name, field[i]);
        r->table->column[r->column[i]][row] = value;
    }
    r->table->line[row] = r->line;
    r->table->rows++;
    return FF_OK;
}

static ff_status read_all(reader *r)
{
    char *text;
    ff_status status = read_header(r);
    while (status == FF_OK && (text = next_line(r, &status)))
        status = read_row(r, text);
    if (status == FF_OK && r->table->rows == 0)
        status = ff_failf(r->host, FF_INVALID, r->item, "the file holds no row of numbers");
    return status;
}

ff_status ff_table_file_read(const ff_host *host, const char *item, const char *path,
                             ff_table_file *table)
{
    struct stat about;
    ff_status status;
    reader r = {.host = host, .item = item, .table = table};
    *table = (ff_table_file){0};
    if (stat(path, &about) != 0 || !S_ISREG(about.st_mode))
        return ff_failf(host, FF_INVALID, item, "%s is not a file", path);
    r.plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!r.plain)
        return FF_NOMEM;
    r.file = fopen(path, "r");
    if (r.file) {
        status = read_all(&r);
        fclose(r.file);
    } else
        status = ff_failf(host, FF_INVALID, item, "%s cannot be opened: %s", path, strerror(errno));
    freelocale(r.plain);
    return status;
}

void ff_table_file_free(ff_table_file *table)
{
    for (int i = 0; i < FF_COLUMNS; i++)
        free(table->column[i]);
    free(table->line);
    *table = (ff_table_file){0};
}
