/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints a table on the terminal, with heads and units above columns of the necessary width. */
#include "answer.h"
#include "number.h"

#include "../../../memory/memory.h"

#include <stdlib.h>
#include <string.h>

enum { CELL = 600 };

static int width_of(const char *text)
{
    int width = 0;
    for (; *text; text++)
        width += ((unsigned char)*text & 0xc0) != 0x80;
    return width;
}

static void put_cell(const study_column *c, const json_t *row, char text[CELL])
{
    const json_t *value = study_column_of(c, row);
    double factor = c->factor != 0 ? c->factor : 1, number = factor * json_number_value(value);
    bool yes = json_is_true(value);
    if (json_is_boolean(value))
        snprintf(text, CELL, "%s", c->words[yes] ? c->words[yes] : yes ? "1" : "0");
    else if (json_is_number(value) && c->fixed)
        snprintf(text, CELL, "%.*f", c->digits, number);
    else if (json_is_number(value))
        study_number_text(number, c->digits ? c->digits : 4, " ", text);
    else
        snprintf(text, CELL, "%s",
                 json_is_string(value) ? json_string_value(value)
                 : c->missing          ? c->missing
                                       : "");
}

typedef struct line {
    char text[4000];
    size_t used;
    bool begun;
} line;

static void add_cell(line *l, const study_column *c, int width, const char *text)
{
    const char *before = !l->begun ? "" : *text && c->before ? c->before : c->before ? "" : " ";
    int pad = width - width_of(text), left = c->width < 0 ? 0 : pad, right = c->width < 0 ? pad : 0;
    int length = snprintf(l->text + l->used, sizeof l->text - l->used, "%s%*s%s%*s", before,
                          left > 0 ? left : 0, "", text, right > 0 ? right : 0, "");
    l->used += length > 0 ? (size_t)length : 0;
    if (l->used >= sizeof l->text)
        l->used = sizeof l->text - 1;
    l->begun = true;
}

static line begin_line(const study_table *table)
{
    line l = {.used = 0};
    l.used = (size_t)snprintf(l.text, sizeof l.text, "%*s", table->indent, "");
    return l;
}

static void end_line(const study_context *context, const study_table *table, line *l)
{
    while (l->used && l->text[l->used - 1] == ' ')
        l->used--;
    l->text[l->used] = '\0';
    study_context_print_line(context, table->whole ? -1 : 0, l->text);
}

static void print_heads(const study_context *context, const study_table *table, const int *widths,
                        bool units)
{
    line l = begin_line(table);
    bool any = false;
    for (size_t i = 0; i < table->column_count; i++) {
        const study_column *c = &table->columns[i];
        const char *text = units ? c->unit : c->head;
        if (!c->head)
            continue;
        any = any || (text && *text);
        add_cell(&l, c, widths[i], text ? text : "");
    }
    if (any)
        end_line(context, table, &l);
}

/* Returns the width of a column. A left-aligned column is as wide as its widest text. */
static int *widths_of(const study_table *table)
{
    int *widths = memory_alloc((table->column_count + 1) * sizeof *widths);
    char text[CELL];
    size_t k;
    const json_t *row;
    for (size_t i = 0; i < table->column_count; i++) {
        const study_column *c = &table->columns[i];
        widths[i] = c->width < 0 ? -c->width : c->width;
        if (c->width < 0 && c->head && width_of(c->head) > widths[i])
            widths[i] = width_of(c->head);
        json_array_foreach(table->rows, k, row)
        {
            put_cell(c, row, text);
            if (c->width < 0 && width_of(text) > widths[i])
                widths[i] = width_of(text);
        }
    }
    return widths;
}

void study_table_print(const study_context *context, const study_table *table)
{
    int *widths = widths_of(table);
    char text[CELL];
    size_t k;
    const json_t *row;
    if (table->title && json_array_size(table->rows))
        study_context_print_line(context, 0, table->title);
    for (int units = 0; units < 2 && json_array_size(table->rows); units++)
        print_heads(context, table, widths, units);
    json_array_foreach(table->rows, k, row)
    {
        line l = begin_line(table);
        for (size_t i = 0; i < table->column_count; i++) {
            put_cell(&table->columns[i], row, text);
            if (table->columns[i].head)
                add_cell(&l, &table->columns[i], widths[i], text);
        }
        end_line(context, table, &l);
    }
    free(widths);
}
