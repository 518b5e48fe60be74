/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The list of models, and the manual page that a model's tables make, for a terminal. */
#include "print.h"

#include <string.h>

enum { NAME = 24, LIST_NAME = 30 };

const char catalogue_id[] = "catalogue/text";
const char catalogue_summary[] = "models for a terminal: the list, or a page about one";

/* Below the name of its kind, which the first model of a kind prints. */
static void print_entry(const ff_catalogue *c, const ff_catalogue_entry *entry, const char *before)
{
    const char *id = entry->id;
    size_t kind = kind_length(id);
    if (!before || strncmp(id, before, kind + 1) != 0)
        put(c, "%s%.*s\n", before ? "\n" : "", (int)kind, id);
    int column = put(c, "  %-*s %s", LIST_NAME, id, entry->model ? "" : "cannot be loaded: ");
    c->wrap(c->ctx, entry->model ? entry->model->summary : entry->why, column, LIST_NAME + 3);
}

static void print_indented(const ff_catalogue *c, const char *text, int indent)
{
    put(c, "%*s", indent, "");
    c->wrap(c->ctx, text, indent, indent);
}

static void print_param(const ff_catalogue *c, const ff_param *row)
{
    char type[400], limits[200];
    type_print(row, type, sizeof type);
    limits_print(row, limits, sizeof limits);
    put(c, "  %-*s %s", NAME, row->name, type);
    if (row->flags & FF_REQUIRED)
        put(c, ", required");
    if (row->preset)
        put(c, ", preset %s", row->preset);
    if (row->group)
        put(c, ", one of the group %s", row->group);
    if (*limits)
        put(c, "; %s", limits);
    put(c, "\n");
    print_indented(c, row->doc, NAME + 3);
}

static void print_column(const ff_catalogue *c, const ff_param *row)
{
    char limits[200];
    limits_print(row, limits, sizeof limits);
    put(c, "  %-*s %s", NAME, row->name, row->unit);
    if (row->flags & FF_REQUIRED && !row->group)
        put(c, ", required");
    if (row->group)
        put(c, ", one of the group %s", row->group);
    if (row->flags & FF_INCREASING)
        put(c, ", never falls");
    if (*limits)
        put(c, "; %s", limits);
    put(c, "\n");
    print_indented(c, row->doc, NAME + 3);
}

static void print_port(const ff_catalogue *c, const ff_port *row, bool input)
{
    put(c, "  %-*s ", NAME, row->name);
    if (row->service)
        put(c, "service %s", row->service);
    else
        put(c, "%s%s%s", row->unit, *row->dims ? " over " : "", row->dims);
    if (input && row->flags & FF_OPTIONAL)
        put(c, ", optional");
    if (input && row->from)
        put(c, ", from %s", row->from);
    put(c, "\n");
    print_indented(c, row->doc, NAME + 3);
}

static void print_page(const ff_catalogue *c)
{
    const ff_catalogue_entry *entry = c->entries[0];
    const ff_model *model = entry->model;
    put(c, "%s %s\n", model->id, model->version);
    print_indented(c, model->summary, 0);
    if (model->param_count)
        put(c, "\nparameters\n");
    for (size_t i = 0; i < model->param_count; i++)
        print_param(c, ff_model_param(model, i));
    if (ff_model_columns(model))
        put(c, "\ncolumns of its table, in any order and unit: \"NAME [UNIT]\"\n");
    for (size_t i = 0; i < ff_model_columns(model); i++)
        print_column(c, ff_model_column(model, i));
    if (model->input_count)
        put(c, "\ninputs (wire.output of the feeding stage)\n");
    for (size_t i = 0; i < model->input_count; i++)
        print_port(c, ff_model_input(model, i), true);
    if (model->output_count)
        put(c, "\noutputs\n");
    for (size_t i = 0; i < model->output_count; i++)
        print_port(c, ff_model_output(model, i), false);
    put(c, "\nreference\n");
    print_indented(c, model->reference, 2);
    put(c, "\nlicence  %s\nfile     %s\n", model->licence, entry->file);
}

ff_status catalogue_print(void *self, const ff_catalogue *c)
{
    (void)self;
    if (c->page)
        print_page(c);
    for (size_t i = 0; !c->page && i < c->entry_count; i++)
        print_entry(c, c->entries[i], i ? c->entries[i - 1]->id : NULL);
    return FF_OK;
}
