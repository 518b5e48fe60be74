/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Makes the JSON Schema (draft-07) of the YAML files from the tables of all installed models, so
   that an editor completes and checks the keys and values that the program accepts. */
#include "catalogue.h"

#include "../study/kinds/kinds.h"

#include <stdlib.h>
#include <string.h>

/* Makes a map without required keys, since an included file may have them. "x-" keys are the
 * user's own. */
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

/* Requires that a text is a number with its unit, or one of the words. */
static void set_pattern(json_t *schema, const ff_param *row, bool bare)
{
    const char *number = "[-+]?([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][-+]?[0-9]+)?";
    char message[700], limits[200];
    ff_param_expectation(row, message, sizeof message);
    catalogue_print_limits(row, limits, sizeof limits);
    json_object_set_new(schema, "pattern",
                        json_sprintf("^(%s%s%s\\s*%s)$", row->choices ? row->choices : "",
                                     row->choices ? "|" : "", number,
                                     bare ? ".*" : ".*[A-Za-zµμ°%].*"));
    json_object_set_new(schema, "patternErrorMessage",
                        json_sprintf("%s%s%s", message, *limits ? ", " : "", limits));
}

/* Makes one schema for texts, numbers and lists: each keyword applies to only one of these
   types. */
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

static json_t *list_choices(const ff_param *row)
{
    json_t *words = json_array();
    char word[64];
    for (size_t i = 0; ff_word_at(row->choices, i, word, sizeof word); i++)
        json_array_append_new(words, json_string(word));
    return words;
}

static json_t *text_schema(const ff_param *row)
{
    json_t *schema = json_pack("{s:[s, s]}", "type", "string", "number");
    if (row->choices)
        json_object_set_new(schema, "examples", list_choices(row));
    return schema;
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
        return json_pack("{s:o}", "enum", list_choices(row));
    case FF_REALS:
        return list_schema(row);
    default:
        return text_schema(row);
    }
}

static json_t *param_schema(const ff_param *row)
{
    json_t *schema = value_schema(row);
    char type[400];
    catalogue_print_type(row, type, sizeof type);
    json_object_set_new(schema, "description",
                        json_sprintf("%s (%s%s%s%s%s)", row->doc, type,
                                     row->preset ? "; preset " : "", row->preset ? row->preset : "",
                                     row->instead ? "; replaced by the wire " : "",
                                     row->instead ? row->instead : ""));
    return schema;
}

/* Adds a parameter. "atlas.from" is the key "from" of the map "atlas". */
static void add_param(json_t *map, const ff_param *row)
{
    const char *name = row->name, *dot;
    while ((dot = strchr(name, '.'))) {
        char *key = memory_print_text("%.*s", (int)(dot - name), name);
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
    char *name = memory_print_text("%.*s", (int)strcspn(row->name, "."), row->name);
    if (!json_object_get(properties(map), name))
        json_object_set_new(properties(map), name,
                            json_pack("{s:s, s:o}", "type", "string", "description",
                                      json_sprintf("the stage that feeds this one (%s)",
                                                   row->from ? row->from : name)));
    free(name);
}

static json_t *model_schema(const ff_model *model)
{
    json_t *map = open_map();
    json_object_set_new(map, "description", json_string(model->summary));
    for (size_t i = 0; i < model->param_count; i++)
        add_param(map, ff_model_param(model, i));
    json_object_set_new(properties(map), "use", json_true());
    json_object_set_new(properties(map), "with", json_true());
    for (size_t i = 0; i < model->input_count; i++)
        add_wire(map, ff_model_input(model, i));
    if (ff_model_cost(model) > 0)
        json_object_set_new(properties(map), "reference", json_true());
    return map;
}

/* Adds the id KIND/auto once, if the program can choose among the models of the kind. */
static void add_auto(json_t *ids, const char *id)
{
    char *name = memory_print_text("%.*s/auto", (int)catalogue_kind_length(id), id);
    size_t count = json_array_size(ids);
    bool known = false;
    for (size_t i = 0; i < count; i++)
        known = known || !strcmp(json_string_value(json_array_get(ids, i)), name);
    if (!known)
        json_array_append_new(ids, json_string(name));
    free(name);
}

/* Returns whether the model can feed a stage, by data or by a service that some model uses. Other
   models serve the program itself, and files do not name them. */
static bool can_feed(const catalogue *c, const ff_model *model)
{
    for (size_t i = 0; i < model->output_count; i++)
        if (!ff_model_output(model, i)->service)
            return true;
    for (size_t i = 0; i < c->count; i++) {
        const ff_model *other = c->entries[i].model;
        for (size_t k = 0; other && k < other->input_count; k++) {
            const char *service = ff_model_input(other, k)->service;
            if (service && ff_model_find_service(model, service) >= 0)
                return true;
        }
    }
    return false;
}

/* Returns "#/definitions/kind.name", to be freed. The "/" is replaced, since some editors do not
   decode its escape "~1". */
static char *place_of(const char *id)
{
    size_t kind = catalogue_kind_length(id);
    return memory_print_text("#/definitions/%.*s.%s", (int)kind, id, id + kind + 1);
}

/* Makes the schema of a stage: the keys of the model that its `use` names, and sets under
 * `with`. */
static json_t *stage_schema(const catalogue *c, json_t *definitions)
{
    json_t *ids = json_array(), *cases = json_array(), *with = open_map();
    for (size_t i = 0; i < c->count; i++) {
        const catalogue_entry *entry = &c->entries[i];
        if (!entry->model || !can_feed(c, entry->model))
            continue;
        char *place = place_of(entry->id);
        json_object_set_new(definitions, strrchr(place, '/') + 1, model_schema(entry->model));
        json_object_set_new(properties(with), entry->id, json_pack("{s:s}", "$ref", place));
        json_array_append_new(ids, json_string(entry->id));
        if (ff_model_cost(entry->model) > 0)
            add_auto(ids, entry->id);
        json_array_append_new(cases, json_pack("{s:{s:{s:{s:s}}, s:[s]}, s:{s:s}}", "if",
                                               "properties", "use", "const", entry->id, "required",
                                               "use", "then", "$ref", place));
        free(place);
    }
    return json_pack("{s:s, s:{s:{s:s, s:o}, s:o}, s:o}", "type", "object", "properties", "use",
                     "description", "the model, kind/name", "enum", ids, "with", with, "allOf",
                     cases);
}

/* Makes the keys of a kind of study. Keys that the kind parses itself have no type. */
static json_t *kind_schema(const study_kind *kind)
{
    json_t *map = open_map();
    json_object_set_new(map, "description", json_string(kind->summary));
    for (size_t i = 0; i < kind->key_count; i++) {
        const ff_param *key = &kind->keys[i];
        if (key->type)
            add_param(map, key);
        else
            json_object_set_new(properties(map), key->name,
                                json_pack("{s:s}", "description", key->doc));
    }
    return map;
}

/* Makes the schema of a study: its own keys and those of its kinds. */
static json_t *study_schema(void)
{
    json_t *map = open_map();
    for (const char *const *key = study_keys; *key; key++)
        json_object_set_new(properties(map), *key, json_true());
    for (const study_kind *const *kind = study_kinds; *kind; kind++)
        json_object_set_new(properties(map), (*kind)->name, kind_schema(*kind));
    return map;
}

static json_t *feedback_schema(void)
{
    size_t count;
    const ff_param *rows = ff_feedback_rows(&count);
    json_t *map = open_map();
    json_object_set_new(map, "description",
                        json_string("how to iterate loops that feedback wires close"));
    for (size_t i = 0; i < count; i++)
        add_param(map, &rows[i]);
    return map;
}

static json_t *whole_schema(const catalogue *c, const char *version)
{
    json_t *schema = open_map(), *definitions = json_object(), *top = properties(schema);
    json_object_set_new(definitions, "stage", stage_schema(c, definitions));
    json_object_set_new(schema, "$schema", json_string("http://json-schema.org/draft-07/schema#"));
    json_object_set_new(schema, "title", json_sprintf("flankfilm %s", version));
    json_object_set_new(schema, "definitions", definitions);
    for (const char *const *key = ff_file_keys(); *key; key++)
        json_object_set_new(top, *key, json_true());
    json_object_set_new(top, "format", json_pack("{s:i}", "const", 2));
    json_object_set_new(top, "title", json_pack("{s:s}", "type", "string"));
    for (const char *const *key = (const char *const[]){"include", "outputs", NULL}; *key; key++)
        json_object_set_new(
            top, *key,
            json_pack("{s:[s, s], s:{s:s}}", "type", "array", "string", "items", "type", "string"));
    json_object_set_new(top, "accuracy",
                        json_pack("{s:[s, s], s:s, s:{s:s}}", "type", "string", "object",
                                  "description",
                                  "largest error of all requested outputs, \"2 %\", or a map with "
                                  "that of each output; \"measured\" only measures the errors",
                                  "additionalProperties", "type", "string"));
    json_object_set_new(
        top, "limits",
        json_pack("{s:s, s:s, s:{s:[s, s]}}", "type", "object", "description",
                  "limits of outputs: \"> 1.5\", \"<= 120 degC\", or a list of these",
                  "additionalProperties", "type", "string", "array"));
    json_object_set_new(top, "accept",
                        json_pack("{s:s, s:s, s:{s:s}}", "type", "object", "description",
                                  "why the doubt of a quality line, STAGE.LINE, is no problem",
                                  "additionalProperties", "type", "string"));
    json_object_set_new(top, "study", study_schema());
    json_object_set_new(top, "feedback", feedback_schema());
    json_object_set_new(top, "pipeline",
                        json_pack("{s:s, s:{s:b}, s:{s:s}}", "type", "object", "patternProperties",
                                  "^x-", 1, "additionalProperties", "$ref", "#/definitions/stage"));
    return schema;
}

void catalogue_print_schema(const catalogue *c, const char *version, FILE *out)
{
    catalogue_print_value(whole_schema(c, version), JSON_INDENT(1), out);
}
