/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "csv.h"

#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MAX_ROWS = 100000, MAX_LINES = 2 * MAX_ROWS, MAX_LINE = 4096, MAX_FIELDS = 16 };

static const char separators[] = ",;\t";

typedef struct unit {
    const char *name;
    double factor;
} unit;

static const unit number_units[] = {{"", 1}, {"1", 1}, {"-", 1}, {NULL, 0}};
static const unit stiffness_units[] = {{"N/m", 1},    {"kN/m", 1e3},      {"N/mm", 1e3},
                                       {"MN/m", 1e6}, {"kN/mm", 1e6},     {"N/um", 1e6},
                                       {"N/µm", 1e6}, {"N/\u03bcm", 1e6}, {NULL, 0}};
static const unit length_units[] = {{"m", 1},          {"mm", 1e-3}, {"um", 1e-6}, {"µm", 1e-6},
                                    {"\u03bcm", 1e-6}, {"nm", 1e-9}, {NULL, 0}};

static const struct {
    const char *name, *example;
    const unit *units;
} columns[FF_COLUMNS] = {
    [FF_COLUMN_PHASE] = {"phase", "phase", number_units},
    [FF_COLUMN_STIFFNESS] = {"stiffness", "stiffness [N/m]", stiffness_units},
    [FF_COLUMN_ERROR] = {"transmission_error", "transmission_error [um]", length_units},
    [FF_COLUMN_LOADED_ERROR] = {"loaded_transmission_error", "loaded_transmission_error [um]",
                                length_units},
    [FF_COLUMN_SHARE] = {"load_share", "load_share", number_units},
};

typedef struct reader {
    const ff_host *host;
    const char *item;
    FILE *file;
    locale_t plain; /* decimal points, whatever the program's locale is */
    size_t line;
    char text[MAX_LINE];
    ff_csv *csv;
    size_t capacity;
    size_t fields;
    int column[MAX_FIELDS]; /* of each field */
    double factor[MAX_FIELDS];
} reader;

static char *trim(char *text)
{
    text += strspn(text, " \t\r\n");
    size_t n = strlen(text);
    while (n > 0 && strchr(" \t\r\n", text[n - 1]))
        text[--n] = 0;
    return text;
}

/* The next line that says something. False at the end of the file, or when *status tells why. */
static bool next_line(reader *r, ff_status *status)
{
    *status = FF_OK;
    while (fgets(r->text, sizeof r->text, r->file)) {
        r->line++;
        if (r->line > MAX_LINES) {
            *status = ff_failf(r->host, FF_INVALID, r->item, "the file has more than %d lines",
                               MAX_LINES);
            return false;
        }
        if (!strchr(r->text, '\n') && !feof(r->file)) {
            *status = ff_failf(r->host, FF_INVALID, r->item,
                               "line %zu is longer than %d characters or is no text", r->line,
                               MAX_LINE - 1);
            return false;
        }
        char *text = r->text;
        if (r->line == 1 && !strncmp(text, "\xef\xbb\xbf", 3)) /* byte order mark */
            text += 3;
        text = trim(text);
        if (*text && *text != '#') {
            memmove(r->text, text, strlen(text) + 1);
            return true;
        }
    }
    if (ferror(r->file))
        *status =
            ff_failf(r->host, FF_INVALID, r->item, "the file cannot be read: %s", strerror(errno));
    return false;
}

/* Cuts the line into its fields; their number, or 0 after a failure. */
static size_t split(reader *r, char *field[MAX_FIELDS])
{
    size_t n = 0;
    for (char *at = r->text; at; n++) {
        size_t length = strcspn(at, separators);
        char *rest = at[length] ? at + length + 1 : NULL;
        if (n == MAX_FIELDS) {
            ff_failf(r->host, FF_INVALID, r->item, "line %zu has more than %d columns", r->line,
                     MAX_FIELDS);
            return 0;
        }
        at[length] = 0;
        field[n] = trim(at);
        at = rest;
    }
    return n;
}

static ff_status read_unit(reader *r, size_t field, const char *text)
{
    int column = r->column[field];
    for (const unit *u = columns[column].units; u->name; u++)
        if (!strcmp(u->name, text)) {
            r->factor[field] = u->factor;
            return FF_OK;
        }
    return ff_failf(r->host, FF_INVALID, r->item,
                    "line %zu: column %s has the unit \"%.40s\"; write, for example, \"%s\"",
                    r->line, columns[column].name, text, columns[column].example);
}

static ff_status read_title(reader *r, size_t field, char *title)
{
    char *bracket = strchr(title, '['), *unit_text = title + strlen(title);
    if (bracket) {
        char *end = strchr(bracket, ']');
        if (!end || *trim(end + 1))
            return ff_failf(r->host, FF_INVALID, r->item,
                            "line %zu: a unit stands in brackets at the end, as in "
                            "\"stiffness [N/m]\"",
                            r->line);
        *bracket = *end = 0;
        unit_text = trim(bracket + 1);
        title = trim(title);
    }
    for (int c = 0; c < FF_COLUMNS; c++) {
        if (strcmp(title, columns[c].name) != 0)
            continue;
        for (size_t k = 0; k < field; k++)
            if (r->column[k] == c)
                return ff_failf(r->host, FF_INVALID, r->item, "line %zu: column %s is there twice",
                                r->line, title);
        r->column[field] = c;
        return read_unit(r, field, unit_text);
    }
    return ff_failf(r->host, FF_INVALID, r->item,
                    "line %zu: no column is called \"%.40s\"; the header names phase, stiffness, "
                    "transmission_error, loaded_transmission_error or load_share",
                    r->line, title);
}

static ff_status read_header(reader *r)
{
    ff_status status;
    char *field[MAX_FIELDS];
    if (!next_line(r, &status))
        return status != FF_OK ? status
                               : ff_failf(r->host, FF_INVALID, r->item,
                                          "the file is empty; its first line names the columns");
    r->fields = split(r, field);
    if (r->fields == 0)
        return FF_INVALID;
    for (size_t i = 0; i < r->fields; i++)
        if ((status = read_title(r, i, field[i])) != FF_OK)
            return status;
    return FF_OK;
}

static bool grow(reader *r)
{
    size_t capacity = r->capacity ? 2 * r->capacity : 256;
    for (size_t i = 0; i < r->fields; i++) {
        double **column = &r->csv->column[r->column[i]];
        double *larger = realloc(*column, capacity * sizeof **column);
        if (!larger)
            return false;
        *column = larger;
    }
    size_t *line = realloc(r->csv->line, capacity * sizeof *line);
    if (!line)
        return false;
    r->csv->line = line;
    r->capacity = capacity;
    return true;
}

static ff_status read_row(reader *r)
{
    char *field[MAX_FIELDS];
    size_t n = split(r, field), row = r->csv->rows;
    if (n == 0)
        return FF_INVALID;
    if (n != r->fields)
        return ff_failf(r->host, FF_INVALID, r->item,
                        "line %zu has %zu columns, the header has %zu", r->line, n, r->fields);
    if (row == MAX_ROWS)
        return ff_failf(r->host, FF_INVALID, r->item, "the table has more than %d rows", MAX_ROWS);
    if (row == r->capacity && !grow(r))
        return ff_failf(r->host, FF_NOMEM, r->item, "out of memory at line %zu", r->line);
    for (size_t i = 0; i < n; i++) {
        char *end;
        double number = strtod_l(field[i], &end, r->plain);
        double value = number * r->factor[i];
        if (end == field[i] || *end || !isfinite(value))
            return ff_failf(r->host, FF_INVALID, r->item,
                            "line %zu, column %s: \"%.40s\" is not a finite number", r->line,
                            columns[r->column[i]].name, field[i]);
        r->csv->column[r->column[i]][row] = value;
    }
    r->csv->line[row] = r->line;
    r->csv->rows++;
    return FF_OK;
}

static ff_status read_all(reader *r)
{
    ff_status status = read_header(r);
    while (status == FF_OK && next_line(r, &status))
        status = read_row(r);
    if (status == FF_OK && r->csv->rows == 0)
        status = ff_failf(r->host, FF_INVALID, r->item, "the file holds no row of numbers");
    return status;
}

ff_status ff_csv_read(const ff_host *host, const char *item, const char *path, ff_csv *csv)
{
    reader r = {.host = host, .item = item, .csv = csv};
    struct stat about;
    ff_status status;
    *csv = (ff_csv){0};
    if (stat(path, &about) != 0 || !S_ISREG(about.st_mode))
        return ff_failf(host, FF_INVALID, item, "%s is not a file", path);
    r.plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!r.plain)
        return ff_failf(host, FF_NOMEM, item, "out of memory");
    r.file = fopen(path, "r");
    if (r.file) {
        status = read_all(&r);
        fclose(r.file);
    } else
        status = ff_failf(host, FF_INVALID, item, "%s cannot be opened: %s", path, strerror(errno));
    freelocale(r.plain);
    return status;
}

void ff_csv_free(ff_csv *csv)
{
    for (int i = 0; i < FF_COLUMNS; i++)
        free(csv->column[i]);
    free(csv->line);
    *csv = (ff_csv){0};
}
