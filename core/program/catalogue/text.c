/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints the list of models, and the manual page of a model, for a terminal. */
#include "catalogue.h"

#include "../terminal/terminal.h"

#include <string.h>

enum { NAME = 24, LIST_NAME = 30 };

/* Prints a line of the list. The name of the kind precedes its first line. */
static void print_entry(const catalogue_entry *entry, const char *before)
{
    const char *id = entry->id;
    size_t kind = catalogue_kind_length(id);
    if (!before || strncmp(id, before, kind + 1) != 0)
        printf("%s%.*s\n", before ? "\n" : "", (int)kind, id);
    int column = printf("  %-*s %s", LIST_NAME, id, entry->model ? "" : "cannot be loaded: ");
    terminal_print_wrapped(entry->model ? entry->model->summary : entry->why, column,
                           LIST_NAME + 3);
}

static void print_indented(const char *text, int indent)
{
    printf("%*s", indent, "");
    terminal_print_wrapped(text, indent, indent);
}

/* Prints a parameter, or a column of a table. */
static void print_param(const ff_param *row)
{
    char type[400], limits[200];
    catalogue_print_type(row, type, sizeof type);
    catalogue_print_limits(row, limits, sizeof limits);
    printf("  %-*s %s", NAME, row->name, type);
    if (row->flags & FF_TUNABLE)
        printf(", tunable");
    if (row->flags & FF_REQUIRED)
        printf(", required");
    if (row->instead)
        printf("%s the wire %s", row->flags & FF_REQUIRED ? ", or" : ", replaced by", row->instead);
    if (row->preset)
        printf(", preset %s", row->preset);
    if (row->group)
        printf(", one of the group %s", row->group);
    if (row->flags & FF_INCREASING)
        printf(", never falls");
    if (*limits)
        printf("; %s", limits);
    printf("\n");
    print_indented(row->doc, NAME + 3);
}

static void print_port(const ff_port *row, bool input)
{
    printf("  %-*s ", NAME, row->name);
    if (row->service)
        printf("service %s", row->service);
    else
        printf("%s%s%s", row->unit, *row->dims ? " over " : "", row->dims);
    if (input && row->flags & FF_OPTIONAL)
        printf(row->flags & FF_FEEDBACK ? ", feedback" : ", optional");
    if (input && row->from)
        printf(", from %s", row->from);
    printf("\n");
    print_indented(row->doc, NAME + 3);
}

static void print_page(const catalogue_entry *entry)
{
    const ff_model *model = entry->model;
    printf("%s %s\n", model->id, model->version);
    print_indented(model->summary, 0);
    if (model->param_count)
        printf("\nparameters\n");
    for (size_t i = 0; i < model->param_count; i++)
        print_param(ff_model_param(model, i));
    if (ff_model_columns(model))
        printf("\ncolumns of its table, in any order and unit: \"NAME [UNIT]\"\n");
    for (size_t i = 0; i < ff_model_columns(model); i++)
        print_param(ff_model_column(model, i));
    if (model->input_count)
        printf("\ninputs (wire.output of the feeding stage)\n");
    for (size_t i = 0; i < model->input_count; i++)
        print_port(ff_model_input(model, i), true);
    if (model->output_count)
        printf("\noutputs\n");
    for (size_t i = 0; i < model->output_count; i++)
        print_port(ff_model_output(model, i), false);
    printf("\nreference\n");
    print_indented(model->reference, 2);
    printf("\nlicence  %s\nfile     %s\n", model->licence, entry->file);
}

/* Returns whether the model serves the program itself and cannot be a stage. */
static bool is_tool(const char *id)
{
    static const char *const kinds[] = {"conformance/", "executor/"};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (!strncmp(id, kinds[i], strlen(kinds[i])))
            return true;
    return false;
}

/* Lists the models that are tools, or the others, below the heading. */
static void print_list(const catalogue *c, bool tools, const char *heading)
{
    const char *before = NULL;
    for (size_t i = 0; i < c->count; i++) {
        if (is_tool(c->entries[i].id) != tools)
            continue;
        if (!before)
            fputs(heading, stdout);
        print_entry(&c->entries[i], before);
        before = c->entries[i].id;
    }
}

void catalogue_print_text(const catalogue *c, bool page)
{
    if (page)
        print_page(&c->entries[0]);
    if (!page) {
        print_list(c, false, "");
        print_list(c, true,
                   "\nNot for a pipeline: used by verify, --executor, export and --with\n");
    }
}
