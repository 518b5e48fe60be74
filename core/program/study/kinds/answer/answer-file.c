/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a table as CSV, and describes it for the page. */
#include "answer.h"

#include "../../cases/csv.h"

#include <string.h>

const json_t *study_column_of(const study_column *column, const json_t *row)
{
    for (size_t i = 0; i < 3 && column->of[i]; i++)
        row = json_object_get(row, column->of[i]);
    return row;
}

static void put_cell(const study_table *table, const study_column *c, const json_t *row, FILE *out)
{
    const json_t *value = study_column_of(c, row);
    const char *text = json_string_value(value);
    bool yes = json_is_true(value);
    if (json_is_boolean(value))
        fputs(c->words[yes] ? c->words[yes] : yes ? "1" : "0", out);
    else if (json_is_number(value))
        fprintf(out, "%.*g", table->digits ? table->digits : 6, json_number_value(value));
    else if (text || c->quoted)
        study_csv_write(out, text ? text : "", text ? strlen(text) : 0, c->quoted);
}

void study_table_csv(const study_table *table, FILE *out)
{
    const char *comma = "";
    size_t k;
    const json_t *row;
    for (size_t i = 0; i < table->column_count; i++)
        if (table->columns[i].name) {
            fputs(comma, out);
            study_csv_write(out, table->columns[i].name, strlen(table->columns[i].name), false);
            comma = ",";
        }
    fputc('\n', out);
    json_array_foreach(table->rows, k, row)
    {
        comma = "";
        for (size_t i = 0; i < table->column_count; i++)
            if (table->columns[i].name) {
                fputs(comma, out);
                put_cell(table, &table->columns[i], row, out);
                comma = ",";
            }
        fputc('\n', out);
    }
}

static json_t *cell_of(const study_column *c, const json_t *row)
{
    const json_t *value = study_column_of(c, row);
    bool yes = json_is_true(value);
    if (json_is_number(value))
        return json_real((c->factor != 0 ? c->factor : 1) * json_number_value(value));
    if (json_is_boolean(value))
        return json_string(c->words[yes] ? c->words[yes] : yes ? "yes" : "no");
    if (json_is_string(value))
        return json_string(json_string_value(value));
    return c->missing ? json_null() : json_string("");
}

json_t *study_table_page(const study_table *table)
{
    json_t *head = json_array(), *rows = json_array();
    size_t k;
    const json_t *row;
    for (size_t i = 0; i < table->column_count; i++) {
        const study_column *c = &table->columns[i];
        if (c->head)
            json_array_append_new(head, c->unit && *c->unit
                                            ? json_sprintf("%s (%s)", c->head, c->unit)
                                            : json_string(c->head));
    }
    json_array_foreach(table->rows, k, row)
    {
        json_t *cells = json_array();
        for (size_t i = 0; i < table->column_count; i++)
            if (table->columns[i].head)
                json_array_append_new(cells, cell_of(&table->columns[i], row));
        json_array_append_new(rows, cells);
    }
    return json_pack("{s:s, s:o, s:o, s:i}", "summary",
                     table->summary ? table->summary
                     : table->title ? table->title
                                    : "",
                     "head", head, "rows", rows, "folded", (int)table->folded);
}
