/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the sections of a study: each scalar over the varied values, the cases, and the failed
   cases. */
#include "page.h"

#include "../memory/memory.h"
#include "../results/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ROWS = 400, MOST_FAILED = 100 };

/* Writes each scalar as small tables, if the cases are a sweep that fits. The template draws the
 * figures. */
static void write_grids(report_page *page)
{
    const results_view *view = page->view;
    size_t varied = 0, length = 0;
    char *text = NULL;
    FILE *whole = page->out;
    if (!report_is_sweep(view))
        return;
    for (size_t d = 0; d < view->dimension_count; d++)
        varied += view->lengths[d] > 1;
    page->out = memory_require(open_memstream(&text, &length));
    for (size_t v = 0; v < view->variable_count; v++) {
        if (view->variables[v]->rank != 0)
            continue;
        report_scalar f = report_load_scalar(page, v);
        if (f.high > f.low) /* constant scalars are in the table of verdicts */
            report_write_grids(&f);
        free(f.values);
    }
    fclose(page->out);
    page->out = whole;
    if (length > 0) {
        report_print(page->out,
                     "<section><details%s><summary>Numbers over the varied values"
                     "</summary>\n",
                     varied > 2 ? " open" : "");
        fwrite(text, 1, length, page->out);
        fputs("</details></section>\n", page->out);
    }
    free(text);
}

/* Notes that a table has only the first rows. */
static void note_rest(report_page *page, size_t shown, size_t all)
{
    if (all > shown)
        fprintf(page->out, "<p class=\"note\">The first %zu of %zu; table.csv has them all.</p>\n",
                shown, all);
}

static void write_failed(report_page *page)
{
    const results_view *view = page->view;
    size_t failed = 0;
    json_t *rows = json_array();
    for (size_t c = 0; c < view->case_count; c++) {
        const results_view_case *of = view->cases[c];
        if (!strcmp(of->status, "ok") || !strcmp(of->status, "not run") || failed++ >= MOST_FAILED)
            continue;
        json_array_append_new(
            rows, json_pack("[I, o, o, o]", (json_int_t)c + 1, results_json_text(of->status),
                            results_json_text(of->reason), report_as("code", of->command)));
    }
    fputs(failed > 0 ? "<section><h2>Failed cases</h2>\n" : "", page->out);
    json_t *table = json_pack("{s:[s, s, s, s], s:o}", "head", "case", "status", "reason",
                              "command that repeats it", "rows", rows);
    if (failed > 0)
        report_put_table(page->out, table);
    else
        json_decref(table);
    note_rest(page, MOST_FAILED, failed);
    fputs(failed > 0 ? "</section>\n" : "", page->out);
}

/* Finds the columns of the table of cases that at least one case needs. */
typedef struct columns {
    bool limits, range;
} columns;

static json_t *case_row(report_page *page, size_t index, const columns *has)
{
    const results_view *view = page->view;
    const results_view_case *of = view->cases[index];
    char text[REPORT_TEXT_SIZE];
    json_t *row = json_pack("[I]", (json_int_t)index + 1);
    for (size_t a = 0; a < view->axis_count; a++) {
        const size_t point = results_view_point(view, index, view->axes[a]->dimension);
        json_array_append_new(row, results_json_text(report_axis_word(view->axes[a], point, text)));
    }
    json_array_append_new(row, results_json_text(of->status));
    json_array_append_new(row, report_badge(of->verdict));
    json_array_append_new(row, results_json_text(of->reasons));
    if (has->range)
        json_array_append_new(row, results_json_text(of->range));
    if (has->limits)
        json_array_append_new(row, report_standing_cell(view, index));
    for (size_t v = 0; v < view->variable_count; v++) {
        if (view->variables[v]->rank != 0)
            continue;
        ff_array array = report_load(page, (int)v, index);
        json_array_append_new(row,
                              report_value(view->variables[v]->output, view->variables[v]->unit,
                                           array.data ? array.data[0] : (double)NAN));
        report_release(page, &array);
    }
    return row;
}

static void write_table(report_page *page)
{
    const results_view *view = page->view;
    columns has = {false, false};
    json_t *rows = json_array(), *head = json_pack("[s]", "case");
    for (size_t c = 0; c < view->case_count; c++) {
        has.limits = has.limits || view->cases[c]->limit_count > 0;
        has.range = has.range || *view->cases[c]->range;
    }
    for (size_t a = 0; a < view->axis_count; a++)
        json_array_append_new(head, results_json_text(view->axes[a]->path));
    const char *const more[] = {"status", "verdict", "because of",
                                has.range ? "outside its range" : NULL,
                                has.limits ? "limits" : NULL};
    for (size_t i = 0; i < sizeof more / sizeof *more; i++)
        if (more[i])
            json_array_append_new(head, json_string(more[i]));
    for (size_t v = 0; v < view->variable_count; v++)
        if (view->variables[v]->rank == 0)
            json_array_append_new(
                head, json_pack("{s:o, s:o}", "cell", results_json_text(view->variables[v]->name),
                                "unit", results_json_text(view->variables[v]->unit)));
    for (size_t c = 0; c < view->case_count && c < MOST_ROWS; c++)
        json_array_append_new(rows, case_row(page, c, &has));
    fputs("<section><details><summary>All cases</summary>\n", page->out);
    report_put_table(page->out, json_pack("{s:o, s:o}", "head", head, "rows", rows));
    note_rest(page, MOST_ROWS, view->case_count);
    fputs("</details></section>\n", page->out);
}

/* Writes the figures and tables that a trade-off or a stability map has described. */
static void write_figures(report_page *page)
{
    const results_view *view = page->view;
    size_t count = view->figures_count;
    if (count > 0)
        fputs("<section><h2>What the study shows</h2>\n", page->out);
    for (size_t i = 0; i < count; i++)
        report_put_figures(page->out, view->figures[i]->json);
    if (count > 0)
        fputs("</section>\n", page->out);
}

void report_write_study(report_page *page)
{
    if (!page->view->study)
        return;
    write_figures(page);
    fputs("<div class=\"chosen\" id=\"over\"></div>\n", page->out);
    write_grids(page);
    write_failed(page);
    write_table(page);
}
