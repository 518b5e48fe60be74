/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bound.h"
#include "command.h"
#include "json.h"
#include "wrap.h"

#include <string.h>

enum { NAME = 24, LIST_NAME = 30 };

static const char *or_empty(const char *text)
{
    return text ? text : "";
}

static bool is_of_kind(const char *id, const char *kind)
{
    size_t length = strlen(kind);
    return strncmp(id, kind, length) == 0 && id[length] == '/';
}

static const char *first_error(const ff_report *report)
{
    for (size_t i = 0; i < ff_report_count(report); i++)
        if (ff_report_at(report, i)->severity == FF_ERROR)
            return ff_report_at(report, i)->text;
    return "it cannot be loaded";
}

static json_t *json_entry(const char *id, const ff_loaded *loaded, const ff_report *report)
{
    json_t *entry = json_object();
    json_object_set_new(entry, "id", ff_json_text(id));
    if (loaded) {
        json_object_set_new(entry, "version", ff_json_text(loaded->model->version));
        json_object_set_new(entry, "summary", ff_json_text(loaded->model->summary));
        json_object_set_new(entry, "file", ff_json_text(loaded->path));
    } else {
        json_object_set_new(entry, "error", ff_json_text(first_error(report)));
    }
    return entry;
}

static void print_entry(const char *id, const char *previous, const ff_loaded *loaded,
                        const ff_report *report)
{
    int kind = (int)strcspn(id, "/");
    if (!previous || strncmp(id, previous, (size_t)kind + 1) != 0)
        printf("%s%.*s\n", previous ? "\n" : "", kind, id);
    int column = printf("  %-*s ", LIST_NAME, id);
    if (loaded) {
        ff_print_wrapped(stdout, or_empty(loaded->model->summary), column, LIST_NAME + 3);
    } else {
        column += printf("cannot be loaded: ");
        ff_print_wrapped(stdout, first_error(report), column, LIST_NAME + 3);
    }
}

/* All models, or those of one kind. A model that cannot be loaded is listed with the reason. */
static int list(ff_library *library, const char *kind, bool json)
{
    size_t count = 0;
    const char *const *ids = ff_library_ids(library, &count);
    const char *previous = NULL;
    json_t *models = json_array();
    for (size_t i = 0; i < count; i++) {
        if (kind && !is_of_kind(ids[i], kind))
            continue;
        ff_report *report = ff_report_new();
        const ff_loaded *loaded = ff_library_load(library, ids[i], FF_NOWHERE, report);
        if (json)
            json_array_append_new(models, json_entry(ids[i], loaded, report));
        else
            print_entry(ids[i], previous, loaded, report);
        previous = ids[i];
        ff_report_free(report);
    }
    if (json) {
        json_t *answer = ff_json_answer("ok", FF_EXIT_OK);
        json_object_set(answer, "models", models);
        ff_json_print(answer, stdout);
    } else if (!previous) {
        printf("no models found; name their directory with --plugin-path\n");
    }
    json_decref(models);
    return FF_EXIT_OK;
}

static void print_indented(const char *text, int indent)
{
    printf("%*s", indent, "");
    ff_print_wrapped(stdout, text, indent, indent);
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
    print_indented(or_empty(row->doc), NAME + 3);
}

static void print_port(const ff_port *row, bool input)
{
    printf("  %-*s ", NAME, row->name);
    if (row->service)
        printf("service %s", row->service);
    else
        printf("%s%s%s", row->unit, *or_empty(row->dims) ? " over " : "", or_empty(row->dims));
    if (input && row->flags & FF_OPTIONAL)
        printf(", optional");
    if (input && row->from)
        printf(", from %s", row->from);
    putchar('\n');
    print_indented(or_empty(row->doc), NAME + 3);
}

static void describe(const ff_loaded *loaded)
{
    const ff_model *model = loaded->model;
    printf("%s %s\n", model->id, or_empty(model->version));
    print_indented(or_empty(model->summary), 0);
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
    print_indented(or_empty(model->reference), 2);
    printf("\nlicence  %s\nfile     %s\n", or_empty(model->licence), loaded->path);
}

static json_t *json_limits(double low, double high)
{
    return low < high ? json_pack("[o, o]", ff_json_real(low), ff_json_real(high)) : json_null();
}

static json_t *json_param(const ff_param *row)
{
    char type[400];
    ff_param_type_print(row, type, sizeof type);
    json_t *entry = json_object();
    json_object_set_new(entry, "name", ff_json_text(row->name));
    json_object_set_new(entry, "type", ff_json_text(ff_param_type_name(row)));
    json_object_set_new(entry, "unit", ff_json_text(row->unit));
    json_object_set_new(entry, "doc", ff_json_text(row->doc));
    json_object_set_new(entry, "required", json_boolean(row->flags & FF_REQUIRED));
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
    json_t *entry = json_object();
    json_object_set_new(entry, "name", ff_json_text(row->name));
    json_object_set_new(entry, "unit", ff_json_text(row->unit));
    json_object_set_new(entry, "dims", ff_json_text(row->dims));
    json_object_set_new(entry, "service", ff_json_text(row->service));
    json_object_set_new(entry, "doc", ff_json_text(row->doc));
    if (input) {
        json_object_set_new(entry, "optional", json_boolean(row->flags & FF_OPTIONAL));
        json_object_set_new(entry, "from", ff_json_text(row->from));
    }
    return entry;
}

static void describe_json(const ff_loaded *loaded)
{
    const ff_model *model = loaded->model;
    json_t *answer = ff_json_answer("ok", FF_EXIT_OK);
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
    ff_json_print(answer, stdout);
}

static int inspect(ff_library *library, const ff_options *options)
{
    ff_report *report = ff_report_new();
    const ff_loaded *loaded = ff_library_load(library, options->operand, FF_NOWHERE, report);
    int code = FF_EXIT_OK;
    if (!loaded)
        code = ff_refuse(report, options, "flankfilm models lists what there is");
    else if (options->json)
        describe_json(loaded);
    else
        describe(loaded);
    ff_report_free(report);
    return code;
}

static bool is_kind(ff_library *library, const char *word)
{
    size_t count = 0;
    const char *const *ids = ff_library_ids(library, &count);
    for (size_t i = 0; i < count; i++)
        if (is_of_kind(ids[i], word))
            return true;
    return false;
}

int ff_models(const ff_options *options)
{
    ff_library *library = ff_library_new(options->plugin_paths, options->plugin_path_count);
    const char *word = options->operand;
    int code;
    if (!word || is_kind(library, word))
        code = list(library, word, options->json);
    else
        code = inspect(library, options);
    ff_library_free(library);
    return code;
}
