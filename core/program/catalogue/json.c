/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints models as one JSON object. */
#include "catalogue.h"

#include "../results/json.h"
#include "../study/store/journal.h"
#include "../terminal/answer.h"

#include <math.h>

/* Lists a model. If it cannot be loaded, the entry contains the reason. */
static json_t *list_entry(const catalogue_entry *entry)
{
    json_t *object = json_pack("{s:s}", "id", entry->id);
    if (entry->model) {
        json_object_set_new(object, "version", results_json_text(entry->model->version));
        json_object_set_new(object, "summary", results_json_text(entry->model->summary));
        json_object_set_new(object, "file", results_json_text(entry->file));
    } else {
        json_object_set_new(object, "error", results_json_text(entry->why));
    }
    return object;
}

static json_t *json_limits(double low, double high)
{
    return low < high ? json_pack("[o, o]", study_json_real(low), study_json_real(high))
                      : json_null();
}

static json_t *json_param(const ff_param *row)
{
    char type[400];
    catalogue_print_type(row, type, sizeof type);
    json_t *entry =
        json_pack("{s:s, s:s, s:s, s:s, s:b, s:b}", "name", row->name, "type",
                  catalogue_type_name(row), "unit", row->unit, "doc", row->doc, "required",
                  row->flags & FF_REQUIRED, "tunable", row->flags & FF_TUNABLE);
    json_object_set_new(entry, "preset", results_json_text(row->preset));
    json_object_set_new(entry, "choices", results_json_text(row->choices));
    json_object_set_new(entry, "group", results_json_text(row->group));
    json_object_set_new(entry, "limits", json_limits(row->min, row->max));
    json_object_set_new(entry, "calibrated", json_limits(row->low, row->high));
    if (row->instead)
        json_object_set_new(entry, "instead", results_json_text(row->instead));
    json_object_set_new(entry, "expects", results_json_text(type));
    return entry;
}

static json_t *json_port(const ff_port *row, bool input)
{
    json_t *entry = json_pack("{s:s, s:o, s:o, s:o, s:s}", "name", row->name, "unit",
                              results_json_text(row->unit), "dims", results_json_text(row->dims),
                              "service", results_json_text(row->service), "doc", row->doc);
    if (input) {
        json_object_set_new(entry, "optional", json_boolean(row->flags & FF_OPTIONAL));
        if (row->flags & FF_FEEDBACK)
            json_object_set_new(entry, "feedback", json_true());
        json_object_set_new(entry, "from", results_json_text(row->from));
    }
    return entry;
}

static void add_page(json_t *answer, const catalogue_entry *entry)
{
    const ff_model *model = entry->model;
    json_t *params = json_array(), *inputs = json_array(), *outputs = json_array();
    json_t *columns = json_array();
    for (size_t i = 0; i < model->param_count; i++)
        json_array_append_new(params, json_param(ff_model_param(model, i)));
    for (size_t i = 0; i < ff_model_columns(model); i++)
        json_array_append_new(columns, json_param(ff_model_column(model, i)));
    for (size_t i = 0; i < model->input_count; i++)
        json_array_append_new(inputs, json_port(ff_model_input(model, i), true));
    for (size_t i = 0; i < model->output_count; i++)
        json_array_append_new(outputs, json_port(ff_model_output(model, i), false));
    json_object_set_new(answer, "id", results_json_text(model->id));
    json_object_set_new(answer, "version", results_json_text(model->version));
    json_object_set_new(answer, "summary", results_json_text(model->summary));
    json_object_set_new(answer, "parameters", params);
    json_object_set_new(answer, "columns", columns);
    json_object_set_new(answer, "inputs", inputs);
    json_object_set_new(answer, "outputs", outputs);
    json_object_set_new(answer, "reference", results_json_text(model->reference));
    json_object_set_new(answer, "bibtex", results_json_text(model->bibtex));
    json_object_set_new(answer, "licence", results_json_text(model->licence));
    json_object_set_new(answer, "file", results_json_text(entry->file));
}

void catalogue_print_json(const catalogue *c, bool page, const char *version)
{
    json_t *answer = json_pack("{s:s, s:s, s:i}", "flankfilm", version, "status", "ok", "exit", 0);
    json_t *models = json_array();
    for (size_t i = 0; !page && i < c->count; i++)
        json_array_append_new(models, list_entry(&c->entries[i]));
    if (page)
        add_page(answer, &c->entries[0]);
    else
        json_object_set(answer, "models", models);
    json_decref(models);
    catalogue_print_value(answer, JSON_COMPACT, terminal_answer());
    fputc('\n', terminal_answer());
}
