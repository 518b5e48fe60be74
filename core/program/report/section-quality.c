/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The section on how far the numbers can be trusted. */
#include <flankfilm/engine.h>

#include "page.h"

#include "../memory/memory.h"

#include <stdlib.h>
#include <string.h>

static void put_number(FILE *out, double value)
{
    char text[REPORT_TEXT_SIZE];
    report_number_text(value, text);
    report_print(out, "<td class=\"number\">%s</td>", text);
}

const char *report_verdict_word(const results_view_quality *line)
{
    return line->range && line->verdict != FF_GOOD ? "range" : ff_verdict_name(line->verdict);
}

static report_check find_worst(const results_view *view, const results_view_quality *of)
{
    report_check found = {.line = NULL};
    for (size_t c = 0; c < view->case_count; c++)
        for (size_t i = 0; i < view->cases[c]->quality_count; i++) {
            const results_view_quality *line = view->cases[c]->quality[i];
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

report_check *report_find_checks(const results_view *view, size_t *count)
{
    size_t most = 0;
    report_check *checks = NULL;
    *count = 0;
    for (size_t c = 0; c < view->case_count; c++)
        for (size_t i = 0; i < view->cases[c]->quality_count; i++) {
            const results_view_quality *line = view->cases[c]->quality[i];
            size_t k = 0;
            while (k < *count && (checks[k].line->stage != line->stage ||
                                  strcmp(checks[k].line->name, line->name) != 0))
                k++;
            if (k < *count)
                continue;
            if (*count == most) {
                most = 2 * most + 32;
                checks = memory_resize(checks, most * sizeof *checks);
            }
            checks[(*count)++] = find_worst(view, line);
        }
    return checks;
}

static void write_line(report_page *page, const report_check *w)
{
    FILE *out = page->out;
    fputs("<tr>", out);
    report_put_cell(out, page->view->stages[w->line->stage]->name);
    report_put_cell(out, w->line->name);
    put_number(out, w->line->value);
    put_number(out, w->line->limit);
    fputs("<td>", out);
    report_put_badge(out, report_verdict_word(w->line));
    if (page->view->study)
        fprintf(out, " %zu of %zu, as in case %zu", w->count, w->total, w->index + 1);
    fputs("</td>", out);
    report_print(out, "<td>%s", w->line->text);
    if (*w->line->accepted)
        report_print(out, " <b>Accepted:</b> %s", w->line->accepted);
    fputs("</td>", out);
    fputs("</tr>\n", out);
}

void report_write_quality(report_page *page)
{
    size_t count;
    report_check *checks = report_find_checks(page->view, &count);
    fputs("<section id=\"quality\"><h2>Quality of the numbers</h2>\n<details><summary>What each "
          "stage checked</summary>\n<div class=\"wide\"><table><thead><tr><th>stage</th><th>check"
          "</th><th>value</th><th>limit</th><th>verdict</th><th>in words</th></tr></thead>"
          "<tbody>\n",
          page->out);
    for (size_t i = 0; i < count; i++)
        write_line(page, &checks[i]);
    free(checks);
    fputs("</tbody></table></div></details></section>\n", page->out);
}
