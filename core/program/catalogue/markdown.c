/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints the reference pages of models in Markdown, only from the models' tables. */
#include "catalogue.h"

#include <string.h>

/* Prints a cell. Characters that would end the cell or begin a tag are escaped. */
static void print_cell(const char *text)
{
    for (; *text; text++)
        if (*text == '<')
            printf("&lt;");
        else if (*text == '\n')
            printf(" ");
        else
            printf("%s%c", strchr("|*_`", *text) ? "\\" : "", *text);
    printf(" |");
}

static void print_heading(const char *title, const char *first)
{
    printf("\n## %s\n\n| %s | value | preset | limits | group (give at most one) | meaning |\n"
           "|---|---|---|---|---|---|\n",
           title, first);
}

/* Prints a row for a parameter, or for a column of a table. */
static void print_param(const ff_param *row)
{
    char type[400], limits[200];
    catalogue_print_type(row, type, sizeof type);
    catalogue_print_limits(row, limits, sizeof limits);
    printf("| `%s` | ", row->name);
    print_cell(type);
    printf(" ");
    print_cell(row->preset ? row->preset : row->flags & FF_REQUIRED ? "required" : "");
    printf(" ");
    print_cell(limits);
    printf(" ");
    print_cell(row->group ? row->group : "");
    printf(" ");
    if (row->instead)
        printf("(replaced by the wire `%s`) ", row->instead);
    print_cell(row->doc);
    printf("\n");
}

static void print_port(const ff_port *row, bool input)
{
    printf("| `%s` | ", row->name);
    print_cell(row->service ? row->service : row->unit);
    printf(" ");
    print_cell(row->service ? "a law" : row->dims);
    if (input) {
        printf(" ");
        print_cell(row->from ? row->from : "");
        printf(" ");
        print_cell(row->flags & FF_FEEDBACK   ? "feedback"
                   : row->flags & FF_OPTIONAL ? "optional"
                                              : "");
    }
    printf(" ");
    print_cell(row->doc);
    printf("\n");
}

static void print_page(const ff_model *model)
{
    printf("# %s\n\n%s\n", model->id, model->summary);
    if (model->param_count)
        print_heading("Parameters", "parameter");
    for (size_t i = 0; i < model->param_count; i++)
        print_param(ff_model_param(model, i));
    if (ff_model_columns(model))
        print_heading("Columns of its table", "column");
    for (size_t i = 0; i < ff_model_columns(model); i++)
        print_param(ff_model_column(model, i));
    if (model->input_count)
        printf("\n## Inputs\n\nAn input is written `wire.output`: the wire is a key of the stage; "
               "the output belongs to the stage that feeds it.\n\n"
               "| input | unit | over | from | | meaning |\n|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < model->input_count; i++)
        print_port(ff_model_input(model, i), true);
    if (model->output_count)
        printf("\n## Outputs\n\n| output | unit | over | meaning |\n|---|---|---|---|\n");
    for (size_t i = 0; i < model->output_count; i++)
        print_port(ff_model_output(model, i), false);
    printf("\n## Literature\n\n%s\n", *model->reference ? model->reference : "none");
    if (*model->bibtex)
        printf("\n```bibtex\n%s%s```\n", model->bibtex,
               model->bibtex[strlen(model->bibtex) - 1] == '\n' ? "" : "\n");
    printf("\nVersion %s, licence %s.\n", model->version, model->licence);
}

/* Prints a line of the list with a link to the page of the model. `previous` is the id before it,
   or NULL. */
static void print_line(const catalogue_entry *entry, const char *previous)
{
    const char *id = entry->id, *summary = entry->model ? entry->model->summary : entry->why;
    size_t kind = catalogue_kind_length(id);
    if (!previous)
        printf("# Models\n");
    if (!previous || strncmp(id, previous, kind + 1) != 0)
        printf("\n## %.*s\n\n", (int)kind, id);
    printf("- [%s](%s.md): %s\n", id, id, summary);
}

void catalogue_print_markdown(const catalogue *c, bool page)
{
    if (page)
        print_page(c->entries[0].model);
    for (size_t i = 0; !page && i < c->count; i++)
        print_line(&c->entries[i], i ? c->entries[i - 1].id : NULL);
}
