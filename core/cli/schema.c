/* SPDX-License-Identifier: GPL-3.0-or-later */
/* JSON Schema (draft-07) of the YAML files, made from the tables of all models that are there, so
   that an editor completes and checks what the program does. */
#include "command.h"
#include "json.h"
#include "text.h"

#include "../pipeline/tool.h"
#include "../plugin/param.h"
#include "../value/memory.h"

#include <flankfilm/study.h>

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* Parts may stand in included files: nothing is required here. "x-" keys are the user's own. */
static json_t *open_map(void)
{
    return json_pack("{s:s, s:b, s:{s:b}, s:{}}", "type", "object", "additionalProperties", 0,
                     "patternProperties", "^x-", 1, "properties");
}

static json_t *properties(json_t *map)
{
    return json_object_get(map, "properties");
}

static void set_limits(json_t *schema, const ff_param *row)
{
    bool open_low = row->flags & FF_MIN_OPEN, open_high = row->flags & FF_MAX_OPEN;
    if (!(row->min < row->max))
        return;
    if (row->min > -1e300)
        json_object_set_new(schema, open_low ? "exclusiveMinimum" : "minimum", json_real(row->min));
    if (row->max < 1e300)
        json_object_set_new(schema, open_high ? "exclusiveMaximum" : "maximum",
                            json_real(row->max));
}

/* What a text must look like: a number with its unit, or one of the words. */
static void set_pattern(json_t *schema, const ff_param *row, bool bare)
{
    const char *number = "[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?";
    char message[700], limits[200];
    char *pattern =
        ff_print_text("^(%s%s%s\\s*%s)$", row->choices ? row->choices : "", row->choices ? "|" : "",
                      number, bare ? ".*" : ".*[A-Za-zµμ°%].*");
    ff_param_expectation(row, message, sizeof message);
    ff_param_limits_print(row, limits, sizeof limits);
    if (*limits)
        snprintf(message + strlen(message), sizeof message - strlen(message), ", %s", limits);
    json_object_set_new(schema, "pattern", ff_json_text(pattern));
    json_object_set_new(schema, "patternErrorMessage", ff_json_text(message));
    free(pattern);
}

/* Keywords that are about texts do not touch numbers and lists, and the other way round. */
static json_t *number_schema(const ff_param *row, const char *type)
{
    bool bare = !row->unit[0] || !strcmp(row->unit, "1");
    json_t *schema = json_pack("{s:[s]}", "type", "string");
    if (bare) {
        json_array_append_new(json_object_get(schema, "type"), json_string(type));
        set_limits(schema, row);
    }
    set_pattern(schema, row, bare);
    return schema;
}

static json_t *list_schema(const ff_param *row)
{
    json_t *item = number_schema(row, row->flags & FF_WHOLE ? "integer" : "number");
    json_t *schema = json_deep_copy(item);
    json_array_append_new(json_object_get(schema, "type"), json_string("array"));
    json_object_set_new(schema, "items", item);
    if (row->min_count)
        json_object_set_new(schema, "minItems", json_integer(row->min_count));
    if (row->max_count)
        json_object_set_new(schema, "maxItems", json_integer(row->max_count));
    return schema;
}

static json_t *choice_schema(const ff_param *row)
{
    json_t *words = json_array();
    char word[64];
    for (size_t i = 0; ff_word_at(row->choices, i, word, sizeof word); i++)
        json_array_append_new(words, json_string(word));
    return json_pack("{s:o}", "enum", words);
}

static json_t *value_schema(const ff_param *row)
{
    switch (row->type) {
    case FF_REAL:
        return number_schema(row, "number");
    case FF_INT:
        return number_schema(row, "integer");
    case FF_BOOL:
        return json_pack("{s:s}", "type", "boolean");
    case FF_CHOICE:
        return choice_schema(row);
    case FF_REALS:
        return list_schema(row);
    case FF_TREE:
        return json_object();
    default:
        return json_pack("{s:[s, s]}", "type", "string", "number");
    }
}

static json_t *param_schema(const ff_param *row)
{
    json_t *schema = value_schema(row);
    char type[400];
    ff_param_type_print(row, type, sizeof type);
    char *text = ff_print_text("%s (%s%s%s)", row->doc, type, row->preset ? "; preset " : "",
                               row->preset ? row->preset : "");
    json_object_set_new(schema, "description", ff_json_text(text));
    free(text);
    return schema;
}

/* "atlas.from" is the key "from" of the map "atlas". */
static void add_param(json_t *map, const ff_param *row)
{
    const char *name = row->name, *dot;
    while ((dot = strchr(name, '.'))) {
        char *key = ff_copy_text(name, (size_t)(dot - name));
        if (!json_object_get(properties(map), key))
            json_object_set_new(properties(map), key, open_map());
        map = json_object_get(properties(map), key);
        free(key);
        name = dot + 1;
    }
    json_object_set_new(properties(map), name, param_schema(row));
}

static void add_wire(json_t *map, const ff_port *row)
{
    char *name = ff_copy_text(row->name, strcspn(row->name, "."));
    char *text = ff_print_text("the stage that feeds this one (%s)", row->from ? row->from : name);
    if (!json_object_get(properties(map), name))
        json_object_set_new(properties(map), name,
                            json_pack("{s:s, s:s}", "type", "string", "description", text));
    free(text);
    free(name);
}

static bool can_assess(const ff_model *model)
{
    return FF_HAS(model, assess) && model->assess;
}

/* stage: with what only stages have. */
static json_t *model_schema(const ff_model *model, bool stage)
{
    json_t *map = open_map();
    json_object_set_new(map, "description", ff_json_text(model->summary));
    for (size_t i = 0; i < model->param_count; i++)
        add_param(map, ff_model_param(model, i));
    if (!stage)
        return map;
    json_object_set_new(properties(map), "use", json_true());
    json_object_set_new(properties(map), "with", json_true());
    for (size_t i = 0; i < model->input_count; i++)
        add_wire(map, ff_model_input(model, i));
    for (const char *const *key = (const char *const[]){"accuracy", "only", "refine", NULL};
         can_assess(model) && *key; key++)
        json_object_set_new(properties(map), *key, json_true());
    return map;
}

/* KIND/auto, where a model of the kind can be chosen, once for the ids that stand together. */
static void add_auto(json_t *ids, const char *id)
{
    char *name = ff_print_text("%.*s/auto", (int)strcspn(id, "/"), id);
    size_t count = json_array_size(ids);
    bool known = false;
    for (size_t i = 0; i < count; i++)
        known = known || !strcmp(json_string_value(json_array_get(ids, i)), name);
    if (!known)
        json_array_append_new(ids, json_string(name));
    free(name);
}

/* Whether a stage can be fed by it: by data, or by a service that some model takes. Others serve
   the program. */
static bool can_feed(ff_library *library, const ff_model *model)
{
    size_t count;
    const char *const *all = ff_library_ids(library, &count);
    ff_report *silent = ff_report_new();
    bool found = false;
    for (size_t i = 0; i < model->output_count; i++)
        found = found || !ff_model_output(model, i)->service;
    for (size_t i = 0; i < count && !found; i++) {
        const ff_loaded *other = ff_library_load(library, all[i], FF_NOWHERE, silent);
        for (size_t k = 0; other && k < other->model->input_count; k++) {
            const char *service = ff_model_input(other->model, k)->service;
            found = found || (service && ff_find_service(model, service) >= 0);
        }
    }
    ff_report_free(silent);
    return found;
}

/* "#/definitions/kind.name", to be freed: not all editors read the "~1" that stands for "/". */
static char *place_of(const char *id)
{
    size_t kind = strcspn(id, "/");
    return ff_print_text("#/definitions/%.*s.%s", (int)kind, id, id + kind + 1);
}

/* A stage: what its `use` says, and the sets under `with`. */
static json_t *stage_schema(ff_library *library, json_t *definitions, ff_report *report)
{
    json_t *ids = json_array(), *cases = json_array(), *with = open_map(), *tools = open_map();
    size_t count = 0;
    const char *const *all = ff_library_ids(library, &count);
    for (size_t i = 0; i < count; i++) {
        const ff_loaded *loaded = ff_library_load(library, all[i], FF_NOWHERE, report);
        if (!loaded)
            continue;
        bool feeds = can_feed(library, loaded->model);
        char *place = place_of(all[i]);
        json_object_set_new(definitions, strrchr(place, '/') + 1,
                            model_schema(loaded->model, feeds));
        json_object_set_new(properties(feeds ? with : tools), all[i],
                            json_pack("{s:s}", "$ref", place));
        if (feeds)
            json_array_append_new(ids, json_string(all[i]));
        if (feeds && can_assess(loaded->model))
            add_auto(ids, all[i]);
        if (feeds)
            json_array_append_new(cases, json_pack("{s:{s:{s:{s:s}}, s:[s]}, s:{s:s}}", "if",
                                                   "properties", "use", "const", all[i], "required",
                                                   "use", "then", "$ref", place));
        free(place);
    }
    json_object_set_new(definitions, "tool", tools);
    return json_pack("{s:s, s:{s:{s:s, s:o}, s:o}, s:o}", "type", "object", "properties", "use",
                     "description", "the model, kind/name", "enum", ids, "with", with, "allOf",
                     cases);
}

/* Words of its own, and the models that drive a study. */
static json_t *study_schema(ff_library *library)
{
    json_t *map = open_map();
    size_t count;
    const char *const *all = ff_library_ids(library, &count);
    ff_report *silent = ff_report_new();
    for (const char *const *key = ff_study_keys; *key; key++)
        json_object_set_new(properties(map), *key, json_true());
    for (size_t i = 0; i < count; i++) {
        const ff_loaded *loaded = ff_library_load(library, all[i], FF_NOWHERE, silent);
        char *place = place_of(all[i]);
        if (loaded && ff_find_service(loaded->model, FF_STUDY_ID) >= 0)
            json_object_set_new(properties(map), strchr(all[i], '/') + 1,
                                json_pack("{s:s}", "$ref", place));
        free(place);
    }
    ff_report_free(silent);
    return map;
}

static json_t *whole_schema(ff_library *library, ff_report *report)
{
    json_t *schema = open_map(), *definitions = json_object(), *top = properties(schema);
    json_object_set_new(definitions, "stage", stage_schema(library, definitions, report));
    json_object_set_new(schema, "$schema", json_string("http://json-schema.org/draft-07/schema#"));
    json_object_set_new(schema, "title", json_string("flankfilm " FF_VERSION));
    json_object_set_new(schema, "definitions", definitions);
    for (const char *const *key = ff_pipeline_top_keys; *key; key++)
        json_object_set_new(top, *key, json_true());
    json_object_set_new(top, "format", json_pack("{s:i}", "const", 1));
    json_object_set_new(top, "title", json_pack("{s:s}", "type", "string"));
    for (const char *const *key = (const char *const[]){"include", "outputs", NULL}; *key; key++)
        json_object_set_new(
            top, *key,
            json_pack("{s:[s, s], s:{s:s}}", "type", "array", "string", "items", "type", "string"));
    json_object_set_new(top, "study", study_schema(library));
    json_object_set_new(top, "pipeline",
                        json_pack("{s:s, s:{s:b}, s:{s:s}}", "type", "object", "patternProperties",
                                  "^x-", 1, "additionalProperties", "$ref", "#/definitions/stage"));
    return schema;
}

int ff_schema(const ff_options *options)
{
    ff_report *report = ff_report_new();
    ff_library *library = ff_library_new(options->plugin_paths, options->plugin_path_count);
    json_t *schema = whole_schema(library, report);
    const size_t flags = JSON_INDENT(1) | JSON_REAL_PRECISION(FF_JSON_DIGITS);
    int code = FF_EXIT_OK;
    if (options->operand && json_dump_file(schema, options->operand, flags) != 0)
        ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL, "%s cannot be written: %s",
                 options->operand, strerror(errno));
    else if (!options->operand && json_dumpf(schema, stdout, flags) == 0)
        putchar('\n');
    if (ff_report_errors(report)) {
        ff_report_print(report, stderr, ff_colour(stderr));
        code = ff_report_exit_code(report);
    }
    json_decref(schema);
    ff_library_free(library);
    ff_report_free(report);
    return code;
}
