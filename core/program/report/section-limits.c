/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How the answers stand to the limits of the file. */
#include <flankfilm/engine.h>

#include "page.h"

#include <math.h>
#include <string.h>

/* The limit of an output in a case; NULL: there is none. */
static const results_view_limit *limit_of(const results_view *view, size_t variable, size_t index)
{
    const results_view_case *c = view->cases[index];
    for (size_t i = 0; i < c->limit_count; i++)
        if (!strcmp(c->limits[i]->output, view->variables[variable]->name))
            return c->limits[i];
    return NULL;
}

/* The first limit of an output that any case has. */
static const results_view_limit *any_limit(const results_view *view, size_t variable)
{
    const results_view_limit *limit = NULL;
    for (size_t c = 0; c < view->case_count && !limit; c++)
        limit = limit_of(view, variable, c);
    return limit;
}

const char *report_limit_asked(const results_view *view, size_t variable)
{
    const results_view_limit *limit = any_limit(view, variable);
    return limit ? limit->asked : NULL;
}

double report_limit_bound(const results_view *view, size_t variable)
{
    const results_view_limit *limit = any_limit(view, variable);
    ff_unit unit;
    double bound = NAN;
    char why[160];
    if (!limit || !ff_unit_parse(limit->unit, &unit, why, sizeof why) ||
        !ff_quantity_parse(limit->asked + strspn(limit->asked, "<>= "), &unit, limit->unit, &bound,
                           why, sizeof why))
        return NAN;
    return bound;
}

int32_t report_standing(const results_view *view, size_t index)
{
    const results_view_case *c = view->cases[index];
    int32_t worst = LIMITS_MET;
    for (size_t i = 0; i < c->limit_count; i++)
        worst = c->limits[i]->standing > worst ? c->limits[i]->standing : worst;
    return worst;
}

static const char *badge_of(int32_t standing)
{
    return standing == LIMITS_MET ? "good" : standing == LIMITS_WITHIN ? "doubtful" : "bad";
}

static void write_limit(report_page *page, const results_view_limit *limit)
{
    const char *dot = strchr(limit->output, '.');
    const char *name = dot ? dot + 1 : limit->output;
    char value[REPORT_TEXT_SIZE] = "not known", bar[REPORT_TEXT_SIZE];
    if (!isnan(limit->value))
        report_quantity_text(name, limit->unit, limit->value, value);
    report_print(page->out,
                 "<tr><td><code>%s</code></td><td class=\"number\">%s</td><td "
                 "class=\"number\">%s%s",
                 limit->output, limit->asked, limit->at_least ? "\u2265 " : "", value);
    if (limit->bar > 0) {
        report_bar_text(limit->unit, limit->bar, bar);
        report_print(page->out, " &#177; %s", bar);
    }
    report_print(page->out, "</td><td><span class=\"badge %s\">%s</span></td></tr>\n",
                 badge_of(limit->standing), limits_word((limits_standing)limit->standing));
}

void report_put_standing(report_page *page, size_t index)
{
    const results_view_case *c = page->view->cases[index];
    if (c->limit_count == 0)
        fputs("<td></td>", page->out);
    else
        report_print(page->out, "<td><span class=\"badge %s\">%s</span></td>",
                     badge_of(report_standing(page->view, index)), c->limits_text);
}

void report_write_limits(report_page *page)
{
    const results_view *view = page->view;
    size_t counts[LIMITS_STANDINGS] = {0}, cases = 0;
    for (size_t c = 0; c < view->case_count; c++) {
        cases += view->cases[c]->limit_count > 0;
        counts[report_standing(view, c)] += view->cases[c]->limit_count > 0;
    }
    if (cases == 0)
        return;
    if (view->study) {
        fprintf(page->out,
                "<p class=\"limits\">Of %zu cases %zu meet the limits of the file, %zu within "
                "their bars alone, and %zu miss one.</p>\n",
                cases, counts[LIMITS_MET], counts[LIMITS_WITHIN], counts[LIMITS_MISSED]);
        return;
    }
    fputs("<div class=\"wide\"><table class=\"limits\"><thead><tr><th>limit of</th><th>asked</th>"
          "<th>it is</th><th></th></tr></thead><tbody>\n",
          page->out);
    for (size_t i = 0; i < view->cases[0]->limit_count; i++)
        write_limit(page, view->cases[0]->limits[i]);
    fputs("</tbody></table></div>\n", page->out);
}
