/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The section on how far the numbers can be trusted. */
#include <flankfilm/engine.h>

#include "page.h"

#include "../memory/memory.h"
#include "../results/json.h"

#include <stdlib.h>
#include <string.h>

/* The guide's table of the meaning of doubts; names that begin with "_" are endings of line names.
 */
static const struct {
    const char *name, *text;
} doubts[] = {
#include "doubts.inc"
    {NULL, NULL}};

/* Returns the guide's sentences on a quality line; NULL if it has none. */
static const char *meaning_of(const char *name)
{
    const size_t length = strlen(name);
    for (size_t i = 0; doubts[i].name; i++) {
        const size_t own = strlen(doubts[i].name);
        if (*doubts[i].name == '_' ? length > own && !strcmp(name + length - own, doubts[i].name)
                                   : !strcmp(name, doubts[i].name))
            return doubts[i].text;
    }
    return NULL;
}

json_t *report_line_name(const results_view_quality *line)
{
    char *anchor = memory_print_text("#means-%s", line->name);
    json_t *name = line->verdict != FF_GOOD && meaning_of(line->name)
                       ? report_as(anchor, line->name)
                       : results_json_text(line->name);
    free(anchor);
    return name;
}

/* Writes the names of the lines to which a text belongs, each once. */
static void put_names(FILE *out, const report_check *checks, size_t count, const char *text)
{
    for (size_t k = 0; k < count; k++) {
        const results_view_quality *line = checks[k].line;
        bool printed = line->verdict == FF_GOOD || meaning_of(line->name) != text;
        for (size_t i = 0; i < k && !printed; i++)
            printed =
                checks[i].line->verdict != FF_GOOD && !strcmp(checks[i].line->name, line->name);
        if (!printed)
            report_print(out, "%s<span id=\"means-%s\">%s</span>", k ? ", " : "", line->name,
                         line->name);
    }
}

/* Writes the meanings of the lines that are not good, each sentence once. */
static void write_meanings(report_page *page, const report_check *checks, size_t count)
{
    const char **printed = memory_alloc((count + 1) * sizeof *printed);
    size_t count_printed = 0;
    for (size_t i = 0; i < count; i++) {
        const char *text =
            checks[i].line->verdict == FF_GOOD ? NULL : meaning_of(checks[i].line->name);
        size_t known = 0;
        while (text && known < count_printed && printed[known] != text)
            known++;
        if (!text || known < count_printed)
            continue;
        fputs(count_printed == 0
                  ? "<h3>What these doubts mean for you</h3>\n<dl class=\"meanings\">\n"
                  : "",
              page->out);
        printed[count_printed++] = text;
        fputs("<dt>", page->out);
        put_names(page->out, checks + i, count - i, text);
        report_print(page->out, "</dt><dd>%s</dd>\n", text);
    }
    fputs(count_printed > 0 ? "</dl>\n" : "", page->out);
    free(printed);
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

/* Returns a cell with a number; empty if a line has no limit. */
static json_t *number(double value)
{
    char text[REPORT_TEXT_SIZE];
    report_number_text(value, text);
    return report_cell("number", text);
}

static json_t *line_row(const results_view *view, const report_check *w)
{
    const results_view_quality *line = w->line;
    json_t *verdict = json_pack("[o]", report_badge(report_verdict_word(line))),
           *words = json_pack("[o]", results_json_text(line->text));
    if (view->study)
        json_array_append_new(verdict, json_sprintf(" in %zu of %zu cases, first in case %zu",
                                                    w->count, w->total, w->index + 1));
    if (*line->accepted) {
        json_array_append_new(words, json_string(" "));
        json_array_append_new(words, report_as("b", "Accepted:"));
        json_array_append_new(words, json_string(" "));
        json_array_append_new(words, results_json_text(line->accepted));
    }
    return json_pack("[o, o, o, o, o, o]", results_json_text(view->stages[line->stage]->name),
                     report_line_name(line), number(line->value), number(line->limit), verdict,
                     words);
}

void report_write_quality(report_page *page)
{
    size_t count;
    report_check *checks = report_find_checks(page->view, &count);
    json_t *rows = json_array();
    fputs("<section id=\"quality\"><h2>Quality of the numbers</h2>\n", page->out);
    write_meanings(page, checks, count);
    for (size_t i = 0; i < count; i++)
        json_array_append_new(rows, line_row(page->view, &checks[i]));
    free(checks);
    report_put_table(page->out,
                     json_pack("{s:s, s:i, s:[s, s, s, s, s, s], s:o}", "summary",
                               "What each stage checked", "folded", 1, "head", "stage", "check",
                               "value", "limit", "verdict", "in words", "rows", rows));
    fputs("</section>\n", page->out);
}
