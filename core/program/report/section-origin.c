/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The section on where the numbers come from. */
#include "page.h"

#include "../memory/memory.h"

#include <stdlib.h>
#include <string.h>

/* A page is sent to others, whom the folders of its author do not concern. */
static const char *without_folder(const char *text)
{
    return *text == '/' ? strrchr(text, '/') + 1 : text;
}

static void write_facts(report_page *page)
{
    const results_view *view = page->view;
    fputs("<table class=\"facts\"><tbody>\n", page->out);
    for (size_t i = 0; i < view->fact_count; i++) {
        report_print(page->out, "<tr><th scope=\"row\">%s</th><td>%s</td></tr>\n",
                     view->facts[i]->name, without_folder(view->facts[i]->text));
    }
    fputs("</tbody></table>\n", page->out);
}

static void write_stage(report_page *page, const results_view_stage *stage)
{
    FILE *out = page->out;
    report_print(out,
                 "<tr class=\"stage\"><th scope=\"row\">%s</th><td colspan=\"2\">%s %s "
                 "<small>plugin file %s</small></td></tr>\n",
                 stage->name, stage->model, stage->version, stage->build);
    for (size_t i = 0; i < stage->param_count; i++) {
        report_print(out, "<tr><td>%s</td><td>%s</td><td>%s</td></tr>\n", stage->params[i]->name,
                     without_folder(stage->params[i]->text),
                     without_folder(stage->params[i]->origin));
    }
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
        size_t said = 0;
        for (size_t i = 0; i < stage->param_count; i++) {
            const results_view_param *param = stage->params[i];
            char words[REPORT_TEXT_SIZE];
            if (!is_input(view, s, param))
                continue;
            if (said++ == 0)
                report_print(page->out, "<dt>%s <small>%s</small></dt><dd>", stage->name,
                             stage->model);
            report_print(page->out, "<span>%s <b>%s</b></span> ",
                         report_plain_name(param->name, words), without_folder(param->text));
        }
        fputs(said > 0 ? "</dd>\n" : "", page->out);
    }
    fputs("</dl>\n", page->out);
}

void report_write_origin(report_page *page)
{
    const results_view *view = page->view;
    FILE *out = page->out;
    fputs("<section><h2>Origin</h2>\n", out);
    write_facts(page);
    fprintf(out,
            "<details><summary>Models and parameters%s</summary>\n<div class=\"wide\"><table "
            "class=\"fixed\"><thead><tr><th>parameter</th><th>value</th><th>from</th></tr></"
            "thead><tbody>\n",
            view->study ? " of the first case" : "");
    for (size_t i = 0; i < view->stage_count; i++)
        write_stage(page, view->stages[i]);
    fputs("</tbody></table></div></details>\n<details><summary>Literature of the models"
          "</summary>\n<dl>\n",
          out);
    for (size_t i = 0; i < view->citation_count; i++) {
        report_print(out, "<dt>%s</dt><dd>%s<pre>%s</pre></dd>\n", view->citations[i]->model,
                     view->citations[i]->reference, view->citations[i]->bibtex);
    }
    fputs("</dl></details></section>\n", out);
}
