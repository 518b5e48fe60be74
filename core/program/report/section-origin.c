/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How far the numbers can be trusted, and where they come from. */
#include "page.h"

#include "../../engine/pipeline/pipeline.h"
#include "../../engine/value/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void put_cell(FILE *out, const char *text)
{
    fputs("<td>", out);
    report_put_text(out, text);
    fputs("</td>", out);
}

static void put_number(FILE *out, double value)
{
    char text[REPORT_TEXT_SIZE];
    report_number_text(value, text);
    fprintf(out, "<td class=\"number\">%s</td>", text);
}

/* The worst of the lines of one name over all cases, and how often it is so bad. */
typedef struct worst {
    const ff_view_quality *line;
    size_t index, count, total;
} worst;

static worst find_worst(const ff_view *view, const ff_view_quality *of)
{
    worst found = {.line = NULL};
    for (size_t c = 0; c < view->case_count; c++)
        for (size_t i = 0; i < view->cases[c]->quality_count; i++) {
            const ff_view_quality *line = view->cases[c]->quality[i];
            if (line->stage != of->stage || strcmp(line->name, of->name) != 0)
                continue;
            found.total++;
            if (!found.line || line->verdict > found.line->verdict) {
                found.line = line;
                found.index = c;
                found.count = 0;
            }
            found.count += line->verdict == found.line->verdict;
        }
    return found;
}

static void write_line(report_page *page, const worst *w)
{
    FILE *out = page->out;
    const char *verdict = fe_verdict_name(w->line->verdict);
    fputs("<tr>", out);
    put_cell(out, page->view->stages[w->line->stage]->name);
    put_cell(out, w->line->name);
    put_number(out, w->line->value);
    put_number(out, w->line->limit);
    fprintf(out, "<td><span class=\"badge %s\">%s</span>", verdict, verdict);
    if (page->view->study)
        fprintf(out, " %zu of %zu, as in case %zu", w->count, w->total, w->index + 1);
    fputs("</td>", out);
    put_cell(out, w->line->text);
    fputs("</tr>\n", out);
}

/* Each line of any case once, in the order of the first case that has it. */
void report_write_quality(report_page *page)
{
    const ff_view *view = page->view;
    size_t known = 0, most = 0;
    const ff_view_quality **lines = NULL;
    fputs("<section id=\"quality\"><h2>Quality of the numbers</h2>\n<details><summary>What each "
          "stage checked</summary>\n<div class=\"wide\"><table><thead><tr><th>stage</th><th>check"
          "</th><th>value</th><th>limit</th><th>verdict</th><th>in words</th></tr></thead>"
          "<tbody>\n",
          page->out);
    for (size_t c = 0; c < view->case_count; c++)
        for (size_t i = 0; i < view->cases[c]->quality_count; i++) {
            const ff_view_quality *line = view->cases[c]->quality[i];
            size_t k = 0;
            while (k < known &&
                   (lines[k]->stage != line->stage || strcmp(lines[k]->name, line->name) != 0))
                k++;
            if (k < known)
                continue;
            if (known == most) {
                most = 2 * most + 32;
                lines = fe_resize(lines, most * sizeof *lines);
            }
            lines[known++] = line;
            worst w = find_worst(view, line);
            write_line(page, &w);
        }
    free(lines);
    fputs("</tbody></table></div></details></section>\n", page->out);
}

static void write_facts(report_page *page)
{
    const ff_view *view = page->view;
    fputs("<table><tbody>\n", page->out);
    for (size_t i = 0; i < view->fact_count; i++) {
        fputs("<tr><th scope=\"row\">", page->out);
        report_put_text(page->out, view->facts[i]->name);
        fputs("</th>", page->out);
        put_cell(page->out, view->facts[i]->text);
        fputs("</tr>\n", page->out);
    }
    fputs("</tbody></table>\n", page->out);
}

static void write_stage(report_page *page, const ff_view_stage *stage)
{
    FILE *out = page->out;
    fputs("<tr class=\"stage\"><th scope=\"row\">", out);
    report_put_text(out, stage->name);
    fputs("</th><td colspan=\"2\">", out);
    report_put_text(out, stage->model);
    fputs(" ", out);
    report_put_text(out, stage->version);
    fputs(" <small>plugin file ", out);
    report_put_text(out, stage->build);
    fputs("</small></td></tr>\n", out);
    for (size_t i = 0; i < stage->param_count; i++) {
        fputs("<tr>", out);
        put_cell(out, stage->params[i]->name);
        put_cell(out, stage->params[i]->text);
        put_cell(out, stage->params[i]->origin);
        fputs("</tr>\n", out);
    }
}

void report_write_origin(report_page *page)
{
    const ff_view *view = page->view;
    FILE *out = page->out;
    fputs("<section><h2>Origin</h2>\n", out);
    write_facts(page);
    fprintf(out,
            "<details><summary>Models and parameters%s</summary>\n<div class=\"wide\"><table>"
            "<thead><tr><th>parameter</th><th>value</th><th>from</th></tr></thead><tbody>\n",
            view->study ? " of the first case" : "");
    for (size_t i = 0; i < view->stage_count; i++)
        write_stage(page, view->stages[i]);
    fputs("</tbody></table></div></details>\n<details><summary>Literature of the models"
          "</summary>\n<dl>\n",
          out);
    for (size_t i = 0; i < view->citation_count; i++) {
        fputs("<dt>", out);
        report_put_text(out, view->citations[i]->model);
        fputs("</dt><dd>", out);
        report_put_text(out, view->citations[i]->reference);
        fputs("<pre>", out);
        report_put_text(out, view->citations[i]->bibtex);
        fputs("</pre></dd>\n", out);
    }
    fputs("</dl></details></section>\n", out);
}
