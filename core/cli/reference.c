/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference page of a model in Markdown, made from its tables alone. */
#include "reference.h"
#include "text.h"

#include <string.h>

/* In a cell a bar would end it, and an angle bracket would begin a tag. */
static void print_cell(const char *text)
{
    for (; *text; text++)
        if (*text == '<')
            fputs("&lt;", stdout);
        else if (*text == '\n')
            putchar(' ');
        else
            printf("%s%c", strchr("|*_`", *text) ? "\\" : "", *text);
    fputs(" |", stdout);
}

static void print_param(const ff_param *row)
{
    char type[400], limits[200];
    ff_param_type_print(row, type, sizeof type);
    ff_param_limits_print(row, limits, sizeof limits);
    printf("| `%s` | ", row->name);
    print_cell(type);
    putchar(' ');
    print_cell(row->preset ? row->preset : row->flags & FF_REQUIRED ? "required" : "");
    putchar(' ');
    print_cell(limits);
    putchar(' ');
    print_cell(row->group ? row->group : "");
    putchar(' ');
    print_cell(row->doc);
    putchar('\n');
}

static void print_port(const ff_port *row, bool input)
{
    printf("| `%s` | ", row->name);
    print_cell(row->service ? row->service : row->unit);
    putchar(' ');
    print_cell(row->service ? "a law" : row->dims);
    if (input) {
        putchar(' ');
        print_cell(row->from ? row->from : "");
        putchar(' ');
        print_cell(row->flags & FF_OPTIONAL ? "optional" : "");
    }
    putchar(' ');
    print_cell(row->doc);
    putchar('\n');
}

void ff_print_reference(const ff_model *model)
{
    printf("# %s\n\n%s\n", model->id, model->summary);
    if (model->param_count)
        printf("\n## Parameters\n\n"
               "| parameter | write | preset | limits | only one of the group | meaning |\n"
               "|---|---|---|---|---|---|\n");
    for (size_t i = 0; i < model->param_count; i++)
        print_param(ff_model_param(model, i));
    if (model->input_count)
        printf(
            "\n## Inputs\n\nWritten `wire.output`: the wire is a key of the stage, the output is "
            "one of the stage that feeds it.\n\n"
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

void ff_print_reference_index(const char *id, const char *summary, const char *previous)
{
    size_t kind = strcspn(id, "/");
    if (!previous)
        printf("# Models\n");
    if (!previous || strncmp(id, previous, kind + 1) != 0)
        printf("\n## %.*s\n\n", (int)kind, id);
    printf("- [%s](%s.md): %s\n", id, id, summary);
}
