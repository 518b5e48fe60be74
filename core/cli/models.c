/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The models: a list, and the manual page that a model's tables make. */
#include "command.h"
#include "json.h"
#include "reference.h"
#include "text.h"

#include <string.h>

enum { NAME = 24, LIST_NAME = 30 };

static bool is_of_kind(const char *id, const char *kind)
{
    size_t length = strlen(kind);
    return strncmp(id, kind, length) == 0 && id[length] == '/';
}

/* A model that cannot be loaded is listed with the reason. */
static json_t *list_entry(ff_library *library, const char *id)
{
    ff_report *report = ff_report_new();
    const ff_loaded *loaded = ff_library_load(library, id, FF_NOWHERE, report);
    json_t *entry = json_pack("{s:s}", "id", id);
    if (loaded) {
        json_object_set_new(entry, "version", ff_json_text(loaded->model->version));
        json_object_set_new(entry, "summary", ff_json_text(loaded->model->summary));
        json_object_set_new(entry, "file", ff_json_text(loaded->path));
    }
    for (size_t i = 0; !loaded && i < ff_report_count(report); i++)
        if (ff_report_at(report, i)->severity == FF_ERROR)
            json_object_set_new(entry, "error", ff_json_text(ff_report_at(report, i)->text));
    ff_report_free(report);
    return entry;
}

/* Below the name of its kind, which the first model of a kind prints. */
static void print_entry(const json_t *entry, const json_t *previous, bool markdown)
{
    const char *id = json_string_value(json_object_get(entry, "id"));
    const char *before = json_string_value(json_object_get(previous, "id"));
    const char *error = json_string_value(json_object_get(entry, "error"));
    if (markdown) {
        const char *summary = json_string_value(json_object_get(entry, "summary"));
        ff_print_reference_index(id, summary ? summary : error, before);
        return;
    }
    size_t kind = strcspn(id, "/");
    if (!before || strncmp(id, before, kind + 1) != 0)
        printf("%s%.*s\n", before ? "\n" : "", (int)kind, id);
    int column = printf("  %-*s %s", LIST_NAME, id, error ? "cannot be loaded: " : "");
    ff_print_wrapped(error ? error : json_string_value(json_object_get(entry, "summary")), column,
                     LIST_NAME + 3);
}

/* All models, or those of one kind. */
static void list(ff_library *library, const ff_options *options)
{
    const char *kind = options->operand;
    bool json = options->json;
    size_t count = 0;
    const char *const *ids = ff_library_ids(library, &count);
    json_t *models = json_array();
    for (size_t i = 0; i < count; i++)
        if (!kind || is_of_kind(ids[i], kind))
            json_array_append_new(models, list_entry(library, ids[i]));
    for (size_t i = 0; !json && i < json_array_size(models); i++)
        print_entry(json_array_get(models, i), i ? json_array_get(models, i - 1) : NULL,
                    options->markdown);
    if (!json && json_array_size(models) == 0)
        printf("no models found; name their directory with --plugin-path\n");
    json_t *answer = ff_json_answer("ok", FF_EXIT_OK, NULL);
    json_object_set_new(answer, "models", models);
    if (json)
        ff_json_print(answer);
    else
        json_decref(answer);
}

static void print_indented(const char *text, int indent)
{
    printf("%*s", indent, "");
    ff_print_wrapped(text, indent, indent);
}

static void print_param(const ff_param *row)
{
    char type[400], limits[200];
    ff_param_type_print(row, type, sizeof type);
    ff_param_limits_print(row, limits, sizeof limits);
    printf("  %-*s %s", NAME, row->name, type);
    if (row->flags & FF_REQUIRED)
        printf(", required");
    if (row->preset)
        printf(", preset %s", row->preset);
    if (row->group)
        printf(", one of the group %s", row->group);
    if (*limits)
        printf("; %s", limits);
    putchar('\n');
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
        printf(", optional");
    if (input && row->from)
        printf(", from %s", row->from);
    putchar('\n');
    print_indented(row->doc, NAME + 3);
}

static void print_page(const ff_loaded *loaded)
{
    const ff_model *model = loaded->model;
    printf("%s %s\n", model->id, model->version);
    print_indented(model->summary, 0);
    if (model->param_count)
        printf("\nparameters\n");
    for (size_t i = 0; i < model->param_count; i++)
        print_param(ff_model_param(model, i));
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
    printf("\nlicence  %s\nfile     %s\n", model->licence, loaded->path);
}

static json_t *json_limits(double low, double high)
{
    return low < high ? json_pack("[o, o]", ff_json_real(low), ff_json_real(high)) : json_null();
}

static json_t *json_param(const ff_param *row)
{
    char type[400];
    ff_param_type_print(row, type, sizeof type);
    json_t *entry =
        json_pack("{s:s, s:s, s:s, s:s, s:b}", "name", row->name, "type", ff_param_type_name(row),
                  "unit", row->unit, "doc", row->doc, "required", row->flags & FF_REQUIRED);
    json_object_set_new(entry, "preset", ff_json_text(row->preset));
    json_object_set_new(entry, "choices", ff_json_text(row->choices));
    json_object_set_new(entry, "group", ff_json_text(row->group));
    json_object_set_new(entry, "limits", json_limits(row->min, row->max));
    json_object_set_new(entry, "calibrated", json_limits(row->low, row->high));
    json_object_set_new(entry, "expects", ff_json_text(type));
    return entry;
}

static json_t *json_port(const ff_port *row, bool input)
{
    json_t *entry = json_pack("{s:s, s:o, s:o, s:o, s:s}", "name", row->name, "unit",
                              ff_json_text(row->unit), "dims", ff_json_text(row->dims), "service",
                              ff_json_text(row->service), "doc", row->doc);
    if (input) {
        json_object_set_new(entry, "optional", json_boolean(row->flags & FF_OPTIONAL));
        json_object_set_new(entry, "from", ff_json_text(row->from));
    }
    return entry;
}

static void print_json_page(const ff_loaded *loaded)
{
    const ff_model *model = loaded->model;
    json_t *answer = ff_json_answer("ok", FF_EXIT_OK, NULL);
    json_t *params = json_array(), *inputs = json_array(), *outputs = json_array();
    for (size_t i = 0; i < model->param_count; i++)
        json_array_append_new(params, json_param(ff_model_param(model, i)));
    for (size_t i = 0; i < model->input_count; i++)
        json_array_append_new(inputs, json_port(ff_model_input(model, i), true));
    for (size_t i = 0; i < model->output_count; i++)
        json_array_append_new(outputs, json_port(ff_model_output(model, i), false));
    json_object_set_new(answer, "id", ff_json_text(model->id));
    json_object_set_new(answer, "version", ff_json_text(model->version));
    json_object_set_new(answer, "summary", ff_json_text(model->summary));
    json_object_set_new(answer, "parameters", params);
    json_object_set_new(answer, "inputs", inputs);
    json_object_set_new(answer, "outputs", outputs);
    json_object_set_new(answer, "reference", ff_json_text(model->reference));
    json_object_set_new(answer, "bibtex", ff_json_text(model->bibtex));
    json_object_set_new(answer, "licence", ff_json_text(model->licence));
    json_object_set_new(answer, "file", ff_json_text(loaded->path));
    ff_json_print(answer);
}

static int describe(ff_library *library, const ff_options *options)
{
    ff_report *report = ff_report_new();
    const ff_loaded *loaded = ff_library_load(library, options->operand, FF_NOWHERE, report);
    int code = FF_EXIT_OK;
    if (!loaded)
        code = ff_refuse(report, options, "flankfilm models lists what there is");
    else if (options->json)
        print_json_page(loaded);
    else if (options->markdown)
        ff_print_reference(loaded->model);
    else
        print_page(loaded);
    ff_report_free(report);
    return code;
}

int ff_models(const ff_options *options)
{
    ff_library *library = ff_library_new(options->plugin_paths, options->plugin_path_count);
    size_t count = 0;
    const char *const *ids = ff_library_ids(library, &count);
    bool all = !options->operand;
    int code = FF_EXIT_OK;
    for (size_t i = 0; i < count && !all; i++)
        all = is_of_kind(ids[i], options->operand);
    if (all)
        list(library, options);
    else
        code = describe(library, options);
    ff_library_free(library);
    return code;
}
