/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints tables: HTML from the JSON description explained in page.h. */
#include "page.h"

#include "../results/json.h"
#include "../study/kinds/answer/text.h"

#include <math.h>
#include <string.h>

json_t *report_as(const char *kind, const char *text)
{
    return json_pack("{s:s, s:o}", "as", kind, "of", results_json_text(text));
}

json_t *report_badge(const char *verdict)
{
    char kind[40];
    snprintf(kind, sizeof kind, "badge %.20s", strcmp(verdict, "failed") ? verdict : "bad");
    return *verdict ? report_as(kind, verdict) : json_string("");
}

json_t *report_cell(const char *class, const char *text)
{
    return json_pack("{s:o, s:s}", "cell", results_json_text(text), "class", class);
}

json_t *report_head(const char *text)
{
    return json_pack("{s:o, s:b}", "cell", results_json_text(text), "head", 1);
}

json_t *report_value(const char *name, const char *si_unit, double si)
{
    char text[REPORT_TEXT_SIZE] = "";
    if (isfinite(si))
        report_quantity_text(name, si_unit, si, text);
    json_t *cell = report_cell("number", text);
    if (isfinite(si))
        json_object_set_new(cell, "si", json_real(si));
    return cell;
}

/* Writes the content of a cell: a text, a number, {"as", "of"}, or a list of these. */
static void put_part(FILE *out, const json_t *part)
{
    char text[REPORT_TEXT_SIZE];
    const char *kind = study_text_of(part, "as");
    const json_t *one;
    size_t i;
    json_array_foreach(part, i, one) put_part(out, one);
    if (json_is_string(part))
        report_put_text(out, json_string_value(part));
    else if (json_is_integer(part))
        fprintf(out, "%" JSON_INTEGER_FORMAT, json_integer_value(part));
    else if (json_is_number(part) || json_is_null(part))
        report_number_text(json_is_null(part) ? (double)NAN : json_number_value(part), text);
    if (json_is_real(part) || json_is_null(part))
        report_put_text(out, text);
    if (json_is_boolean(part))
        fputs(json_is_true(part) ? "true" : "false", out);
    if (!json_is_object(part))
        return;
    if (*kind == '#')
        report_print(out, "<a href=\"%s\">", kind);
    else if (!strncmp(kind, "badge ", 6))
        report_print(out, "<span class=\"%s\">", kind);
    else
        fprintf(out, "<%s>", kind);
    put_part(out, json_object_get(part, "of"));
    fprintf(out, "</%s>", *kind == '#' ? "a" : strncmp(kind, "badge ", 6) ? kind : "span");
}

void report_put_part(FILE *out, json_t *part)
{
    put_part(out, part);
    json_decref(part);
}

/* Writes a cell: its content, or an object with content and attributes. */
static void put_cell(FILE *out, const json_t *cell, bool above)
{
    const json_t *inside = json_object_get(cell, "cell"), *si = json_object_get(cell, "si"),
                 *share = json_object_get(cell, "share");
    const bool head = above || json_is_true(json_object_get(cell, "head"));
    const char *class = json_is_real(cell) ? "number" : study_text_of(cell, "class"),
               *unit = study_text_of(cell, "unit"), *title = study_text_of(cell, "title");
    const json_int_t span = json_integer_value(json_object_get(cell, "span"));
    fputs(!head ? "<td" : above ? "<th" : "<th scope=\"row\"", out);
    if (*class)
        report_print(out, " class=\"%s\"", class);
    if (json_is_number(si) || json_is_real(cell))
        fprintf(out, " data-v=\"%.9g\"", json_number_value(si ? si : cell));
    if (*unit)
        report_print(out, " data-unit=\"%s\"", unit);
    if (*title)
        report_print(out, " data-head=\"%s\"", title);
    if (span > 0)
        fprintf(out, " colspan=\"%d\"", (int)span);
    if (share)
        fprintf(out, " style=\"--s:%.0f%%\"", json_number_value(share));
    fputc('>', out);
    put_part(out, inside ? inside : cell);
    fputs(head ? "</th>" : "</td>", out);
}

void report_put_table(FILE *out, json_t *table)
{
    const json_t *rows = json_object_get(table, "rows"), *head = json_object_get(table, "head"),
                 *caption = json_object_get(table, "caption"), *row, *cell;
    const char *summary = study_text_of(table, "summary"), *class = study_text_of(table, "class");
    size_t i, k;
    if (*summary)
        report_print(out, "<details%s><summary>%s</summary>\n",
                     json_integer_value(json_object_get(table, "folded")) ? "" : " open", summary);
    report_print(
        out, *class ? "<div class=\"wide\"><table class=\"%s\">" : "<div class=\"wide\"><table>%s",
        class);
    if (caption)
        report_print(out, "<caption>%s</caption>", json_string_value(caption));
    fputs(head ? "<thead><tr>" : "", out);
    json_array_foreach(head, i, cell) put_cell(out, cell, true);
    fputs(head ? "</tr></thead><tbody>\n" : "<tbody>\n", out);
    json_array_foreach(rows, i, row)
    {
        const json_t *cells = json_is_object(row) ? json_object_get(row, "cells") : row;
        if (*study_text_of(row, "class"))
            report_print(out, "<tr class=\"%s\">", study_text_of(row, "class"));
        else
            fputs("<tr>", out);
        json_array_foreach(cells, k, cell) put_cell(out, cell, false);
        fputs("</tr>\n", out);
    }
    fputs(*summary ? "</tbody></table></div></details>\n" : "</tbody></table></div>\n", out);
    json_decref(table);
}
