/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "rows.h"

#include "csv.h"
#include "spectrum.h"
#include "yaml.h"

#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_ROWS = 1000000, LONGEST_ROW = 1 << 20, MOST_ERRORS = 20, BLOCK = 1 << 16 };

typedef struct column {
    size_t varied; /* index of the path; SIZE_MAX: a column of the user's own, or the duration of
                      the row */
    bool time;
    char *unit; /* the unit for numbers without one, or "" */
} column;

struct study_rows {
    study_definition *study;
    study_csv table;
    column *columns;
    size_t column_count;
    size_t room;
    /* these members are used only for standard input */
    bool streams, ended, cut;
    char **texts; /* texts of the rows, for other processes */
    char *buffer;
    size_t length, taken;
};

static ff_place place_of(const study_rows *rows, const study_csv_field *f)
{
    return (ff_place){&rows->table.source, rows->table.line, f ? f->column : 1, f ? f->width : 0};
}

static bool refuse(const study_rows *rows, const study_csv_field *f, ff_report *report,
                   const char *hint, const char *text)
{
    return ff_error(report, FF_FAULT_INPUT, place_of(rows, f), hint, "%s", text);
}

/* Splits "duty.torque [N m]" into path and unit. */
static bool read_head(study_rows *rows, study_csv_field *f, column *c, ff_report *report)
{
    char why[200];
    ff_unit parsed;
    c->varied = SIZE_MAX;
    c->unit = memory_copy_text("", 0);
    if (!strncmp(f->text, "x-", 2))
        return true;
    const char *unit = study_csv_unit(f);
    if (!unit)
        return refuse(rows, f, report, "write duty.torque [N m]",
                      "expected a path, and a unit in brackets");
    free(c->unit);
    c->unit = memory_copy_text(unit, strlen(unit));
    if (*unit && !ff_unit_parse(unit, &parsed, why, sizeof why))
        return ff_error(report, FF_FAULT_INPUT, place_of(rows, f), NULL, "the unit \"%.40s\" %s",
                        unit, why);
    return (*f->text && !strchr(f->text, '=')) ||
           refuse(rows, f, report, "a path as for --set, such as duty.torque",
                  "a column needs a name");
}

static bool add_column(study_rows *rows, study_csv_field *f, column *c, ff_report *report)
{
    study_definition *study = rows->study;
    if (!read_head(rows, f, c, report))
        return false;
    if (!strncmp(f->text, "x-", 2))
        return true;
    c->time = !strcmp(f->text, study_time_name);
    if (c->time && rows->streams)
        return refuse(rows, f, report, "write the rows to a file",
                      "time: results of rows from standard input are not summed");
    for (size_t i = 0; c->time && i < rows->column_count; i++)
        if (rows->columns[i].time)
            return refuse(rows, f, report, NULL, "time has two columns");
    if (c->time)
        return true;
    for (size_t k = 0; k < study->varied_count; k++)
        if (!strcmp(study->varied[k].path, f->text))
            return ff_error(report, FF_FAULT_INPUT, place_of(rows, f), NULL,
                            "%.200s has two columns", f->text);
    c->varied = study->varied_count++;
    study->varied[c->varied] =
        (study_varied){.path = memory_arena_text(&study->arena, f->text, strlen(f->text)),
                       .place = rows->streams ? FF_NOWHERE : place_of(rows, f),
                       .axis = 0};
    return true;
}

/* Reads the columns from the line that was split. */
static bool read_heads(study_rows *rows, ff_report *report)
{
    size_t errors = ff_report_errors(report);
    study_csv *l = &rows->table;
    if (l->fault)
        refuse(rows, &l->fields[l->count - 1], report, NULL, l->fault);
    else if (l->count > STUDY_CSV_FIELDS)
        refuse(rows, NULL, report, NULL, "there are more than 1000 columns");
    rows->columns = memory_alloc(l->count * sizeof *rows->columns);
    rows->study->varied =
        memory_arena_alloc(&rows->study->arena, l->count * sizeof *rows->study->varied);
    for (size_t i = 0; ff_report_errors(report) == errors && i < l->count;
         i++, rows->column_count++)
        add_column(rows, &l->fields[i], &rows->columns[i], report);
    return ff_report_errors(report) == errors &&
           (rows->study->varied_count > 0 ||
            refuse(rows, NULL, report, NULL, "no column names a path of the pipeline"));
}

/* Makes room for the row with that number. */
static void make_room(study_rows *rows, size_t index)
{
    study_definition *study = rows->study;
    if (index < rows->room)
        return;
    size_t was = rows->room, room = rows->room = was * 2 > index ? was * 2 : index + 64;
    for (size_t k = 0; k < study->varied_count; k++) {
        study_varied *v = &study->varied[k];
        v->assignments = memory_resize(v->assignments, room * sizeof *v->assignments);
        v->places = memory_resize(v->places, room * sizeof *v->places);
        for (size_t i = was; i < room; i++)
            v->assignments[i] = "";
    }
    if (rows->streams) {
        rows->texts = memory_resize(rows->texts, room * sizeof *rows->texts);
        memset(rows->texts + was, 0, (room - was) * sizeof *rows->texts);
    }
}

/* Returns the value of a field, with the unit of its column if it has none, to be freed. */
static char *value_of(const column *c, const study_csv_field *f)
{
    const char *end;
    double number;
    bool bare = *c->unit && ff_number_parse(f->text, &number, &end) && !*end;
    return memory_print_text("%s%s%s", f->text, bare ? " " : "", bare ? c->unit : "");
}

/* Returns the assignment of a field. The path of a file is made relative to the table. */
static const char *assignment_of(const study_rows *rows, const column *c, const study_csv_field *f)
{
    const char *path = rows->study->varied[c->varied].path;
    char *value, *text;
    if (!strcmp(path, "include")) {
        value = ff_path_beside(rows->table.source.directory, f->text);
        text = study_yaml_assignment(path,
                                     &(ff_node){.kind = FF_SCALAR, .text = value, .quoted = true});
        ff_free(value);
    } else {
        value = value_of(c, f);
        text = memory_print_text("%s=%s", path, value);
        free(value);
    }
    return memory_arena_take(&rows->study->arena, text);
}

/* Reads the duration of the row. *empty: it is 0, so the row is not a case. */
static bool take_time(const study_rows *rows, bool *empty, ff_report *report)
{
    const study_csv *l = &rows->table;
    for (size_t i = 0; !l->fault && l->count == rows->column_count && i < l->count; i++) {
        if (!rows->columns[i].time)
            continue;
        char *text = value_of(&rows->columns[i], &l->fields[i]);
        bool good =
            study_spectrum_add(rows->study, text, place_of(rows, &l->fields[i]), empty, report);
        free(text);
        return good;
    }
    return true;
}

/* Whether the fields of the line form a case; says why not if there is a report. */
static bool check_row(const study_rows *rows, ff_report *report)
{
    char why[120];
    const study_csv *l = &rows->table;
    bool many = l->count > rows->column_count;
    const study_csv_field *f = l->fault ? &l->fields[l->count - 1]
                               : many   ? &l->fields[rows->column_count]
                                        : NULL;
    if (!l->fault && l->count == rows->column_count)
        return true;
    if (l->fault)
        snprintf(why, sizeof why, "%s", l->fault);
    else
        snprintf(why, sizeof why, "it has %zu fields, and the first line names %zu columns",
                 l->count, rows->column_count);
    return report &&
           ff_error(report, FF_FAULT_INPUT, rows->streams ? FF_NOWHERE : place_of(rows, f),
                    l->fault ? NULL : "write a field that contains the separator in quotes", "%s",
                    why);
}

/* Stores the assignments of the line as the row with that number, or no assignments if the line is
   not a case. */
static void take_row(study_rows *rows, size_t index)
{
    const study_csv *l = &rows->table;
    make_room(rows, index);
    for (size_t i = 0; !l->fault && l->count == rows->column_count && i < l->count; i++) {
        const column *c = &rows->columns[i];
        const study_csv_field *f = &l->fields[i];
        if (c->varied == SIZE_MAX)
            continue;
        study_varied *v = &rows->study->varied[c->varied];
        v->places[index] = (study_place){l->line, f->column, f->width};
        v->assignments[index] = *f->text || f->quoted ? assignment_of(rows, c, f) : "";
    }
}

static study_rows *rows_new(study_definition *study)
{
    study_rows *rows = memory_alloc(sizeof *rows);
    *rows = (study_rows){.study = study};
    study->rows = rows;
    study->points = memory_arena_alloc(&study->arena, sizeof *study->points);
    study->points[0] = 0;
    study->axis_count = study->followed = study->direction = 1;
    return rows;
}

void study_rows_free(study_rows *rows)
{
    if (!rows)
        return;
    for (size_t k = 0; k < rows->study->varied_count; k++) {
        free(rows->study->varied[k].assignments);
        free(rows->study->varied[k].places);
    }
    for (size_t i = 0; i < rows->column_count; i++)
        free(rows->columns[i].unit);
    for (size_t i = 0; rows->texts && i < rows->room; i++)
        free(rows->texts[i]);
    free(rows->columns);
    free(rows->texts);
    free(rows->buffer);
    study_csv_close(&rows->table);
    free(rows);
}

static bool add_row(study_rows *rows, ff_report *report)
{
    study_definition *study = rows->study;
    bool empty = false;
    if (study->count == MOST_ROWS)
        return refuse(rows, NULL, report, NULL, "at most 1000000 cases are possible");
    if (check_row(rows, report))
        take_time(rows, &empty, report);
    if (!empty)
        take_row(rows, study->count++);
    study->points[0] = study->count;
    return true;
}

/* Reads the lines of the file, and reports all errors up to a limit. */
static bool read_lines(study_rows *rows, ff_report *report)
{
    size_t errors = ff_report_errors(report);
    bool good = true;
    while (good && study_csv_next(&rows->table)) {
        good = rows->columns ? add_row(rows, report) : read_heads(rows, report);
        good = good && ff_report_errors(report) < errors + MOST_ERRORS;
    }
    return ff_report_errors(report) == errors;
}

static bool read_table(study_definition *study, const ff_node *node, ff_report *report)
{
    char *path = ff_path_beside(node->place.source->directory, node->text);
    study_rows *rows = rows_new(study);
    const char *why = study_csv_open(&rows->table, path);
    bool good = why ? ff_error(report, FF_FAULT_INPUT, node->place, NULL,
                               "study: cases: %.300s: %s", path, why)
                    : read_lines(rows, report);
    if (good && study->count == 0)
        good = ff_error(report, FF_FAULT_INPUT, node->place,
                        "the first line names paths, each further line is a case",
                        study->spectrum ? "study: cases: all rows of %.300s have the time 0"
                                        : "study: cases: %.300s has no case",
                        path);
    ff_free(path);
    return good;
}

/* Returns whether the node is "-". In `--set study.cases=-` without quotes, YAML reads it as a list
   with an empty item. */
static bool is_dash(const ff_node *node)
{
    const ff_node *only = node->kind == FF_SEQUENCE && node->count == 1 ? node->items[0] : NULL;
    return node->kind == FF_SCALAR ? !strcmp(node->text, "-")
                                   : only && only->kind == FF_SCALAR && !*only->text;
}

bool study_rows_read(study_definition *study, const ff_node *node, ff_report *report)
{
    if (!is_dash(node) && (node->kind != FF_SCALAR || !*node->text))
        return ff_error(report, FF_FAULT_INPUT, node->place,
                        "write cases: cases.csv, cases: \"-\" for standard input, or a list of "
                        "rows: - {duty.torque: 250 N m}",
                        "study: cases: expected the name of a file or a list of rows");
    if (!is_dash(node))
        return read_table(study, node, report);
    study_rows *rows = rows_new(study);
    rows->table.source = (ff_source){.name = memory_copy_text("standard input", 14),
                                     .text = memory_copy_text("", 0),
                                     .directory = memory_copy_text(".", 1)};
    rows->streams = study->streams = true;
    return true;
}

/* Takes the next line from the buffer. Returns NULL if it is not complete yet. */
static char *take_line(study_rows *rows)
{
    const char *from = rows->buffer ? rows->buffer + rows->taken : "";
    size_t left = rows->length - rows->taken;
    const char *end = left ? memchr(from, '\n', left) : NULL;
    if (!end && !(rows->ended && left))
        return NULL;
    size_t length = end ? (size_t)(end - from) : left;
    char *text = memory_copy_text(from, length);
    for (size_t i = 0; i < length; i++)
        /* a zero byte is replaced by a byte that no value may contain */
        text[i] = text[i] ? text[i] : '\1';
    rows->taken += length + (end != NULL);
    rows->table.line++;
    return text;
}

static void fill_buffer(study_rows *rows)
{
    size_t left = rows->length - rows->taken;
    if (rows->taken)
        memmove(rows->buffer, rows->buffer + rows->taken, left);
    rows->length = left;
    rows->taken = 0;
    rows->buffer = memory_resize(rows->buffer, left + BLOCK);
    ssize_t got = read(STUDY_ROWS_FD, rows->buffer + left, BLOCK);
    rows->length += got > 0 ? (size_t)got : 0;
    rows->cut = rows->length > LONGEST_ROW + BLOCK && !memchr(rows->buffer, '\n', rows->length);
    rows->length = rows->cut ? 0 : rows->length;
    rows->ended = got == 0 || (got < 0 && errno != EINTR && errno != EAGAIN) || rows->cut;
}

static bool has_come(int milliseconds)
{
    struct pollfd polled = {.fd = STUDY_ROWS_FD, .events = POLLIN};
    return poll(&polled, 1, milliseconds) > 0;
}

bool study_rows_begin(study_rows *rows, ff_report *report)
{
    for (;;) {
        char *text = take_line(rows);
        bool marked = text && rows->table.line == 1 && !strncmp(text, "\xef\xbb\xbf", 3);
        const char *first = text && marked ? text + 3 : text;
        bool found = first && !study_csv_is_silent(first, strlen(first));
        if (found)
            study_csv_split(&rows->table, first, strlen(first));
        bool good = found && read_heads(rows, report);
        free(text);
        if (found)
            return good;
        if (!text && rows->ended)
            return ff_error(report, FF_FAULT_INPUT, FF_NOWHERE,
                            "the first line names paths, each further line is a case",
                            "study: cases: standard input ended before its first line");
        if (!text && has_come(-1))
            fill_buffer(rows);
    }
}

int study_rows_next(study_rows *rows)
{
    study_definition *study = rows->study;
    for (;;) {
        char *text = take_line(rows);
        if (text && !study_csv_is_silent(text, strlen(text)) && study->count < MOST_ROWS) {
            study_rows_put(rows, study->count, text);
            free(text);
            return 1;
        }
        free(text);
        if (text)
            continue;
        if (rows->ended)
            return -1;
        if (!has_come(0))
            return 0;
        fill_buffer(rows);
    }
}

void study_rows_wait(void)
{
    has_come(-1);
}

bool study_rows_ended(const study_rows *rows)
{
    return rows->ended && rows->taken == rows->length;
}

const char *study_rows_text(const study_rows *rows, size_t index)
{
    return rows->texts[index];
}

void study_rows_put(study_rows *rows, size_t index, const char *text)
{
    study_csv_split(&rows->table, text, strlen(text));
    take_row(rows, index);
    free(rows->texts[index]);
    rows->texts[index] = memory_copy_text(text, strlen(text));
    if (index >= rows->study->count)
        rows->study->points[0] = rows->study->count = index + 1;
}

bool study_rows_check(study_rows *rows, size_t index, ff_report *report)
{
    study_csv_split(&rows->table, rows->texts[index], strlen(rows->texts[index]));
    return check_row(rows, report);
}

bool study_rows_are_cut(const study_rows *rows)
{
    return rows->cut;
}
