/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference pages of the models in Markdown, made from their tables alone. */
#include "print.h"

#include <string.h>

const char catalogue_id[] = "catalogue/markdown";
const char catalogue_summary[] = "models as pages in Markdown: the list, or a page about one";

/* In a cell a bar would end it, and an angle bracket would begin a tag. */
static void print_cell(const ff_catalogue *c, const char *text)
{
    for (; *text; text++)
        if (*text == '<')
            put(c, "&lt;");
        else if (*text == '\n')
            put(c, " ");
        else
            put(c, "%s%c", strchr("|*_`", *text) ? "\\" : "", *text);
    put(c, " |");
}

static void print_param(const ff_catalogue *c, const ff_param *row)
{
    char type[400], limits[200];
    type_print(row, type, sizeof type);
    limits_print(row, limits, sizeof limits);
    put(c, "| `%s` | ", row->name);
    print_cell(c, type);
    put(c, " ");
    print_cell(c, row->preset ? row->preset : row->flags & FF_REQUIRED ? "required" : "");
    put(c, " ");
    print_cell(c, limits);
    put(c, " ");
    print_cell(c, row->group ? row->group : "");
    put(c, " ");
    print_cell(c, row->doc);
    put(c, "\n");
}

static void print_column(const ff_catalogue *c, const ff_param *row)
{
    char limits[200];
    limits_print(row, limits, sizeof limits);
    put(c, "| `%s` | ", row->name);
    print_cell(c, row->unit);
    put(c, " ");
    print_cell(c, limits);
    put(c, " ");
    print_cell(c, row->group ? row->group : row->flags & FF_REQUIRED ? "required" : "");
    put(c, " ");
    print_cell(c, row->doc);
    put(c, "\n");
}

static void print_port(const ff_catalogue *c, const ff_port *row, bool input)
{
    put(c, "| `%s` | ", row->name);
    print_cell(c, row->service ? row->service : row->unit);
    put(c, " ");
    print_cell(c, row->service ? "a law" : row->dims);
    if (input) {
        put(c, " ");
        print_cell(c, row->from ? row->from : "");
        put(c, " ");
        print_cell(c, row->flags & FF_OPTIONAL ? "optional" : "");
    }
    put(c, " ");
    print_cell(c, row->doc);
    put(c, "\n");
}

static void print_page(const ff_catalogue *c, const ff_model *model)
{
    put(c, "# %s\n\n%s\n", model->id, model->summary);
    if (model->param_count)
        put(c, "\n## Parameters\n\n"
               "| parameter | write | preset | limits | only one of the group | meaning |\n"
               "|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < model->param_count; i++)
        print_param(c, ff_model_param(model, i));
    if (ff_model_columns(model))
        put(c, "\n## Columns of its table\n\n"
               "| column | unit | limits | required, or one of the group | meaning |\n"
               "|---|---|---|---|---|\n");
    for (size_t i = 0; i < ff_model_columns(model); i++)
        print_column(c, ff_model_column(model, i));
    if (model->input_count)
        put(c,
            "\n## Inputs\n\nWritten `wire.output`: the wire is a key of the stage, the output is "
            "one of the stage that feeds it.\n\n"
            "| input | unit | over | from | | meaning |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < model->input_count; i++)
        print_port(c, ff_model_input(model, i), true);
    if (model->output_count)
        put(c, "\n## Outputs\n\n| output | unit | over | meaning |\n|---|---|---|---|\n");
    for (size_t i = 0; i < model->output_count; i++)
        print_port(c, ff_model_output(model, i), false);
    put(c, "\n## Literature\n\n%s\n", *model->reference ? model->reference : "none");
    if (*model->bibtex)
        put(c, "\n```bibtex\n%s%s```\n", model->bibtex,
            model->bibtex[strlen(model->bibtex) - 1] == '\n' ? "" : "\n");
    put(c, "\nVersion %s, licence %s.\n", model->version, model->licence);
}

/* A line of the list that leads to the pages; previous: the id before it, or NULL. */
static void print_line(const ff_catalogue *c, const ff_catalogue_entry *entry, const char *previous)
{
    const char *id = entry->id, *summary = entry->model ? entry->model->summary : entry->why;
    size_t kind = kind_length(id);
    if (!previous)
        put(c, "# Models\n");
    if (!previous || strncmp(id, previous, kind + 1) != 0)
        put(c, "\n## %.*s\n\n", (int)kind, id);
    put(c, "- [%s](%s.md): %s\n", id, id, summary);
}

ff_status catalogue_print(void *self, const ff_catalogue *c)
{
    (void)self;
    if (c->page)
        print_page(c, c->entries[0]->model);
    for (size_t i = 0; !c->page && i < c->entry_count; i++)
        print_line(c, c->entries[i], i ? c->entries[i - 1]->id : NULL);
    return FF_OK;
}
