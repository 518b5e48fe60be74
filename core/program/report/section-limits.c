/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes whether the answers meet the limits of the file. */
#include <flankfilm/engine.h>

#include "page.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Returns the limit of an output in a case; NULL if there is none. */
static const results_view_limit *limit_of(const results_view *view, size_t variable, size_t index)
{
    const results_view_case *c = view->cases[index];
    for (size_t i = 0; i < c->limit_count; i++)
        if (!strcmp(c->limits[i]->output, view->variables[variable]->name))
            return c->limits[i];
    return NULL;
}

/* Returns the first limit of an output that any case has. */
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

static json_t *limit_row(const results_view_limit *limit)
{
    const char *dot = strchr(limit->output, '.');
    const char *name = dot ? dot + 1 : limit->output;
    char value[REPORT_TEXT_SIZE] = "not known", bar[REPORT_TEXT_SIZE] = "", badge[40];
    if (!isnan(limit->value))
        report_quantity_text(name, limit->unit, limit->value, value);
    if (limit->bar > 0)
        report_bar_text(limit->unit, limit->bar, bar);
    char *text = memory_print_text("%s%s%s%s", limit->at_least ? "\u2265 " : "", value,
                                   *bar ? " \u00b1 " : "", bar);
    snprintf(badge, sizeof badge, "badge %s", badge_of(limit->standing));
    json_t *row = json_pack("[o, o, o, o]", report_as("code", limit->output),
                            report_cell("number", limit->asked), report_cell("number", text),
                            report_as(badge, limits_word((limits_standing)limit->standing)));
    free(text);
    return row;
}

json_t *report_standing_cell(const results_view *view, size_t index)
{
    const results_view_case *c = view->cases[index];
    char badge[40];
    snprintf(badge, sizeof badge, "badge %s", badge_of(report_standing(view, index)));
    return c->limit_count ? report_as(badge, c->limits_text) : json_string("");
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
                "<p class=\"limits\">Of %zu cases, %zu meet the limits of the file, %zu meet them "
                "only within their error bars, and %zu miss one.</p>\n",
                cases, counts[LIMITS_MET], counts[LIMITS_WITHIN], counts[LIMITS_MISSED]);
        return;
    }
    json_t *rows = json_array();
    for (size_t i = 0; i < view->cases[0]->limit_count; i++)
        json_array_append_new(rows, limit_row(view->cases[0]->limits[i]));
    report_put_table(page->out, json_pack("{s:s, s:[s, s, s, s], s:o}", "class", "limits", "head",
                                          "limit of", "limit", "value", "", "rows", rows));
}
