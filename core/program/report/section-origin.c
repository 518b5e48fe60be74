/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The section on where the numbers come from. */
#include "page.h"

#include "../memory/memory.h"
#include "../results/json.h"

#include <stdlib.h>
#include <string.h>

/* Removes the folder from a path: a page is sent to others, who have no use for the author's
 * folders. */
static const char *without_folder(const char *text)
{
    return *text == '/' ? strrchr(text, '/') + 1 : text;
}

static void write_facts(report_page *page)
{
    const results_view *view = page->view;
    json_t *rows = json_array();
    for (size_t i = 0; i < view->fact_count; i++)
        json_array_append_new(rows,
                              json_pack("[o, o]", report_head(view->facts[i]->name),
                                        results_json_text(without_folder(view->facts[i]->text))));
    report_put_table(page->out, json_pack("{s:s, s:o}", "class", "facts", "rows", rows));
}

static void add_stage(json_t *rows, const results_view_stage *stage)
{
    char *file = memory_print_text("plugin file %s", stage->build);
    json_array_append_new(rows, json_pack("{s:s, s:[o, {s:[o, s, o, s, o], s:i}]}", "class",
                                          "stage", "cells", report_head(stage->name), "cell",
                                          results_json_text(stage->model), " ",
                                          results_json_text(stage->version), " ",
                                          report_as("small", file), "span", 2));
    free(file);
    for (size_t i = 0; i < stage->param_count; i++)
        json_array_append_new(
            rows, json_pack("[o, o, o]", results_json_text(stage->params[i]->name),
                            results_json_text(without_folder(stage->params[i]->text)),
                            results_json_text(without_folder(stage->params[i]->origin))));
}

/* Whether the user has given a parameter, and no axis of a study changes it. */
static bool is_input(const results_view *view, size_t stage, const results_view_param *param)
{
    char *path = memory_print_text("%s.%s", view->stages[stage]->name, param->name);
    bool given = strcmp(param->origin, "preset") != 0 && strncmp(param->text, "by the wire ", 12);
    for (size_t a = 0; a < view->axis_count; a++)
        given = given && strcmp(view->axes[a]->path, path) != 0;
    free(path);
    return given;
}

void report_write_inputs(report_page *page)
{
    const results_view *view = page->view;
    fputs("<dl class=\"inputs\">\n", page->out);
    for (size_t s = 0; s < view->stage_count; s++) {
        const results_view_stage *stage = view->stages[s];
        size_t printed = 0;
        for (size_t i = 0; i < stage->param_count; i++) {
            const results_view_param *param = stage->params[i];
            char words[REPORT_TEXT_SIZE];
            if (!is_input(view, s, param))
                continue;
            if (printed++ == 0)
                report_print(page->out, "<dt>%s <small>%s</small></dt><dd>", stage->name,
                             stage->model);
            report_print(page->out, "<span>%s <b>%s</b></span> ",
                         report_plain_name(param->name, words), without_folder(param->text));
        }
        fputs(printed > 0 ? "</dd>\n" : "", page->out);
    }
    fputs("</dl>\n", page->out);
}

void report_write_origin(report_page *page)
{
    const results_view *view = page->view;
    FILE *out = page->out;
    fputs("<section><h2>Origin</h2>\n", out);
    write_facts(page);
    json_t *rows = json_array();
    for (size_t i = 0; i < view->stage_count; i++)
        add_stage(rows, view->stages[i]);
    report_put_table(out, json_pack("{s:s+, s:i, s:s, s:[s, s, s], s:o}", "summary",
                                    "Models and parameters",
                                    view->study ? " of the first case" : "", "folded", 1, "class",
                                    "fixed", "head", "parameter", "value", "from", "rows", rows));
    fputs("<details><summary>Literature of the models</summary>\n<dl>\n", out);
    for (size_t i = 0; i < view->citation_count; i++) {
        report_print(out, "<dt>%s</dt><dd>%s<pre>%s</pre></dd>\n", view->citations[i]->model,
                     view->citations[i]->reference, view->citations[i]->bibtex);
    }
    fputs("</dl></details></section>\n", out);
}
