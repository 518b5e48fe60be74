/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes HTML from a description in JSON of a study or a comparison: its drawings, sentences and
 * tables. Only the drawings need scripts. */
#include "page.h"

#include "../study/kinds/answer/text.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

static void put_cell(FILE *out, const json_t *cell)
{
    char text[REPORT_TEXT_SIZE];
    if (json_is_number(cell)) {
        report_number_text(json_number_value(cell), text);
        fprintf(out, "<td class=\"number\" data-v=\"%.9g\">", json_number_value(cell));
        report_print(out, "%s</td>", text);
    } else if (json_is_boolean(cell)) {
        report_put_cell(out, json_is_true(cell) ? "true" : "false");
    } else {
        report_put_cell(out, json_is_string(cell) ? json_string_value(cell) : "\u2013");
    }
}

static void put_table(FILE *out, const json_t *table)
{
    const json_t *rows = json_object_get(table, "rows"), *row, *cell;
    size_t i, k;
    if (json_array_size(rows) == 0)
        return;
    report_print(out, "<details%s><summary>%s</summary>\n<div class=\"wide\"><table><thead><tr>",
                 json_integer_value(json_object_get(table, "folded")) ? "" : " open",
                 study_text_of(table, "summary"));
    json_array_foreach(json_object_get(table, "head"), i, cell)
        report_print(out, "<th>%s</th>", json_is_string(cell) ? json_string_value(cell) : "");
    fputs("</tr></thead><tbody>\n", out);
    json_array_foreach(rows, i, row)
    {
        fputs("<tr>", out);
        json_array_foreach(row, k, cell) put_cell(out, cell);
        fputs("</tr>\n", out);
    }
    fputs("</tbody></table></div></details>\n", out);
}

void report_put_json(FILE *out, json_t *value)
{
    char *text = json_dumps(value, JSON_COMPACT | JSON_ENCODE_ANY | JSON_REAL_PRECISION(9));
    for (const char *at = text; at && *at; at++)
        if (*at == '<')
            fputs("\\u003c", out);
        else
            fputc(*at, out);
    free(text);
    json_decref(value);
}

static void put_figure(FILE *out, json_t *figure)
{
    json_t *words = json_incref(json_object_get(figure, "words")),
           *tables = json_incref(json_object_get(figure, "tables")), *one;
    const bool drawn = strcmp(study_text_of(figure, "sort"), "tables") != 0;
    size_t i;
    json_object_del(figure, "words");
    json_object_del(figure, "tables");
    if (drawn) {
        report_print(out,
                     "<figure class=\"%s\"><figcaption><span>%s</span></figcaption><script "
                     "type=\"application/json\">",
                     study_text_of(figure, "class"), study_text_of(figure, "title"));
        report_put_json(out, json_incref(figure));
        fputs("</script>\n", out);
    } else {
        fputs("<div>\n", out);
    }
    json_array_foreach(words, i, one)
        report_print(out, "<p>%s</p>\n", json_is_string(one) ? json_string_value(one) : "");
    json_array_foreach(tables, i, one) put_table(out, one);
    fputs(drawn ? "</figure>\n" : "</div>\n", out);
    json_decref(words);
    json_decref(tables);
}

void report_put_figures(FILE *out, const char *json)
{
    json_t *figures = json_loads(json, 0, NULL), *figure;
    size_t i;
    fputs("<div class=\"figures drawn\">\n", out);
    json_array_foreach(figures, i, figure) if (json_is_object(figure)) put_figure(out, figure);
    fputs("</div>\n", out);
    json_decref(figures);
}
