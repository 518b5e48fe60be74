/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sections of a study: each scalar over what is varied, the cases, and those that failed. */
#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_ROWS = 400, MOST_FAILED = 100 };

/* Writes each scalar as small tables, if the cases are a sweep that has room in them: the template
   draws what a figure can hold. */
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
        if (f.high > f.low) /* the table of verdicts has the constants */
            report_write_grids(&f);
        free(f.values);
    }
    fclose(page->out);
    page->out = whole;
    if (length > 0) {
        report_print(page->out,
                     "<section><details%s><summary>In numbers, over what is varied"
                     "</summary>\n",
                     varied > 2 ? " open" : "");
        fwrite(text, 1, length, page->out);
        fputs("</details></section>\n", page->out);
    }
    free(text);
}

static void write_failed(report_page *page)
{
    const results_view *view = page->view;
    size_t failed = 0;
    for (size_t c = 0; c < view->case_count; c++) {
        const results_view_case *of = view->cases[c];
        if (!strcmp(of->status, "ok") || !strcmp(of->status, "not run"))
            continue;
        if (failed++ == 0)
            fputs("<section><h2>Failed cases</h2>\n<div class=\"wide\"><table><thead><tr><th>case"
                  "</th><th>status</th><th>reason</th><th>repeat it</th></tr></thead><tbody>\n",
                  page->out);
        if (failed > MOST_FAILED)
            continue;
        fprintf(page->out, "<tr><td>%zu</td><td>", c + 1);
        report_print(page->out, "%s</td><td>%s</td><td><code>%s</code></td></tr>\n", of->status,
                     of->reason, of->command);
    }
    if (failed > 0)
        fputs("</tbody></table></div>\n", page->out);
    if (failed > MOST_FAILED)
        fprintf(page->out, "<p class=\"note\">The first %d of %zu; table.csv has them all.</p>\n",
                MOST_FAILED, failed);
    if (failed > 0)
        fputs("</section>\n", page->out);
}

/* Columns of the table of cases that some case needs. */
typedef struct columns {
    bool limits, range;
} columns;

static void write_table_row(report_page *page, size_t index, const columns *has)
{
    const results_view *view = page->view;
    char text[REPORT_TEXT_SIZE];
    fprintf(page->out, "<tr><td>%zu</td>", index + 1);
    for (size_t a = 0; a < view->axis_count; a++) {
        report_print(page->out, "<td>%s</td>",
                     report_axis_word(view->axes[a],
                                      results_view_point(view, index, view->axes[a]->dimension),
                                      text));
    }
    report_print(page->out, "<td>%s</td><td>", view->cases[index]->status);
    report_put_badge(page->out, view->cases[index]->verdict);
    report_print(page->out, "</td><td>%s</td>", view->cases[index]->reasons);
    if (has->range)
        report_put_cell(page->out, view->cases[index]->range);
    if (has->limits)
        report_put_standing(page, index);
    for (size_t v = 0; v < view->variable_count; v++) {
        if (view->variables[v]->rank != 0)
            continue;
        ff_array array = report_load(page, (int)v, index);
        report_put_value(page->out, view->variables[v]->output, view->variables[v]->unit,
                         array.data ? array.data[0] : (double)NAN);
        report_release(page, &array);
    }
    fputs("</tr>\n", page->out);
}

static void write_table(report_page *page)
{
    const results_view *view = page->view;
    columns has = {false, false};
    for (size_t c = 0; c < view->case_count; c++) {
        has.limits = has.limits || view->cases[c]->limit_count > 0;
        has.range = has.range || *view->cases[c]->range;
    }
    fprintf(page->out, "<section><details><summary>All cases</summary>\n<div class=\"wide\"><table>"
                       "<thead><tr><th>case</th>");
    for (size_t a = 0; a < view->axis_count; a++) {
        report_print(page->out, "<th>%s</th>", view->axes[a]->path);
    }
    fprintf(page->out, "<th>status</th><th>verdict</th><th>because of</th>%s%s",
            has.range ? "<th>outside of its range</th>" : "", has.limits ? "<th>limits</th>" : "");
    for (size_t v = 0; v < view->variable_count; v++)
        if (view->variables[v]->rank == 0)
            report_print(page->out, "<th data-unit=\"%s\">%s</th>", view->variables[v]->unit,
                         view->variables[v]->name);
    fputs("</tr></thead><tbody>\n", page->out);
    for (size_t c = 0; c < view->case_count && c < MOST_ROWS; c++)
        write_table_row(page, c, &has);
    fputs("</tbody></table></div>\n", page->out);
    if (view->case_count > MOST_ROWS)
        fprintf(page->out, "<p class=\"note\">The first %d of %zu; table.csv has them all.</p>\n",
                MOST_ROWS, view->case_count);
    fputs("</details></section>\n", page->out);
}

/* Writes what a trade-off or a map of stability has described. */
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
