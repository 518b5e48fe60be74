/* SPDX-License-Identifier: MIT */
/* Reads the parameters of a stage from the file, by the table of its model. */
#include "build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The table of one model and the settings of one stage. */
typedef struct binding {
    fe_build *b;
    ff_stage *stage;
    const ff_loaded *loaded;
    const char *id;
    bool chosen; /* it is the stage's model; else another one under `with` */
    fe_setting *settings;
} binding;

/* "atlas" holds the parameter or wire "atlas.from". */
static bool is_map(const ff_model *model, const char *path)
{
    for (size_t i = 0; i < model->param_count; i++)
        if (fe_is_on_wire(ff_model_param(model, i)->name, path))
            return true;
    return false;
}

static bool is_wire(const ff_model *model, const char *path)
{
    for (size_t i = 0; i < model->input_count; i++)
        if (fe_is_on_wire(ff_model_input(model, i)->name, path))
            return !strchr(path, '.');
    return false;
}

/* '; did you mean "x"?' or "". */
static const char *nearest_key(binding *k, const char *path)
{
    const ff_model *model = k->loaded->model;
    const char **names = fe_alloc((model->param_count + model->input_count + 2) * sizeof *names);
    size_t count = 0;
    bool whole = strchr(path, '.') != NULL; /* else a key of the stage's own map */
    for (size_t i = 0; i < model->param_count + model->input_count; i++) {
        const char *name = i < model->param_count
                               ? ff_model_param(model, i)->name
                               : ff_model_input(model, i - model->param_count)->name;
        size_t length = whole && i < model->param_count ? strlen(name) : strcspn(name, ".");
        names[count++] = fe_pipeline_print(k->b->pipeline, "%.*s", (int)length, name);
    }
    names[count++] = "use";
    names[count++] = "with";
    const char *advice = fe_did_you_mean(k->b, path, names, count);
    fe_free(names);
    return advice;
}

/* Another model under `with` that has this parameter, or NULL. */
static const char *other_owner(const binding *k, const char *path)
{
    const ff_node *with = ff_node_get(k->stage->node, "with");
    const char *owner = NULL;
    ff_report *captured = ff_report_new();
    for (size_t i = 0; with && with->kind == FF_MAP && i < with->count && !owner; i++) {
        const ff_loaded *other = ff_engine_model(k->b->engine, with->keys[i], FF_NOWHERE, captured);
        if (other && other != k->loaded && ff_model_find_param(other->model, path) >= 0)
            owner = with->keys[i];
    }
    ff_report_free(captured);
    return owner;
}

static void refuse_key(binding *k, const char *path, ff_place place)
{
    const char *owner = other_owner(k, path), *hint = NULL, *advice = "";
    if (ff_model_find_param(k->loaded->model, path) >= 0)
        hint = fe_pipeline_print(k->b->pipeline,
                                 "the dot stands for a map within a map: %.*s: {%s: ...}",
                                 (int)strcspn(path, "."), path, strchr(path, '.') + 1);
    else if (owner)
        hint = fe_pipeline_print(k->b->pipeline,
                                 "%s has \"%s\": write it under \"with\", in the set of that model",
                                 owner, path);
    else
        advice = nearest_key(k, path);
    ff_error(k->b->report, FF_FAULT_INPUT, place, hint, "%s: unknown key \"%.80s\"%s%s%s",
             k->stage->name, path, *advice ? "" : " for ", *advice ? "" : k->id, advice);
}

/* `prefix` is "" or "atlas."; `own`: the map is the stage's own, which has `use` and `with`, too. A
   key with a dot is refused, since a dot stands for a map within a map. */
static void check_keys(binding *k, const ff_node *map, const char *prefix, bool own)
{
    const ff_model *model = k->loaded->model;
    for (size_t i = 0; i < map->count; i++) {
        const char *key = map->keys[i];
        const ff_node *value = map->items[i];
        const char *path = fe_pipeline_print(k->b->pipeline, "%s%s", prefix, key);
        bool plain = !strchr(key, '.');
        if (!strncmp(key, "x-", 2) || (own && (!strcmp(key, "use") || !strcmp(key, "with"))))
            continue;
        if (plain && (ff_model_find_param(model, path) >= 0 || is_wire(model, path)))
            continue;
        if (!plain || !is_map(model, path))
            refuse_key(k, path, map->key_places[i]);
        else if (value->kind != FF_MAP)
            fe_expected(k->b, value,
                        fe_pipeline_print(k->b->pipeline, "%s.%s", k->stage->name, path), "a map");
        else
            check_keys(k, value, fe_pipeline_print(k->b->pipeline, "%s.", path), false);
    }
}

static bool same_group(const ff_param *a, const ff_param *b)
{
    return a->group && b->group && !strcmp(a->group, b->group);
}

/* The connected wire that replaces the parameter; NULL: none. */
static const ff_wire *find_replacing(const binding *k, const ff_param *row)
{
    for (size_t i = 0; row->instead && i < k->stage->wire_count; i++)
        if (!strcmp(k->stage->wires[i].name, row->instead) && k->stage->wires[i].stage >= 0)
            return &k->stage->wires[i];
    return NULL;
}

/* A parameter that a connected wire replaces must not be given. */
static void settle_replaced(binding *k, const ff_param *row, const fe_setting *setting)
{
    const ff_wire *wire = setting->wire;
    const ff_stage *from = &k->b->pipeline->stages[wire->stage];
    char origin[512];
    ff_bound_origin(&(ff_bound){.place = wire->automatic ? from->place : wire->place}, origin,
                    sizeof origin);
    if (setting->node)
        ff_error(k->b->report, FF_FAULT_INPUT, setting->node->place,
                 fe_pipeline_print(k->b->pipeline,
                                   "leave \"%s\" out, or leave the wire unconnected: %s: none",
                                   row->name, wire->name),
                 "%s.%s: the stage \"%s\" gives this by the wire \"%s\" (%s), so that it stands "
                 "in two places",
                 k->stage->name, row->name, from->name, wire->name, origin);
}

/* A wire takes the place of the parameter, or would once the model under `with` is chosen. */
static bool may_be_replaced(const binding *k, size_t index)
{
    return k->settings[index].wire ||
           (!k->chosen && ff_model_param(k->loaded->model, index)->instead);
}

/* Of the given members of a group, the one of the latest layer stays; two in it are an error. */
static void settle_group(binding *k, const ff_param *row)
{
    const ff_model *model = k->loaded->model;
    const char *names = "", *given = NULL, *instead = "";
    bool required = false, preset = false;
    uint64_t latest = 0;
    for (size_t i = 0; i < model->param_count; i++)
        if (same_group(row, ff_model_param(model, i)) && k->settings[i].priority > latest)
            latest = k->settings[i].priority;
    for (size_t i = 0; i < model->param_count; i++) {
        const ff_param *member = ff_model_param(model, i);
        fe_setting *setting = &k->settings[i];
        if (!same_group(row, member))
            continue;
        names = fe_pipeline_print(k->b->pipeline, "%s%s\"%s\"", names, *names ? ", " : "",
                                  member->name);
        required = required || (member->flags & FF_REQUIRED && !may_be_replaced(k, i));
        preset = preset || member->preset;
        if (member->instead)
            instead = fe_pipeline_print(k->b->pipeline, ", or the wire \"%s\"", member->instead);
        if (setting->priority < latest)
            setting->node = NULL;
        if (setting->node && given)
            ff_error(k->b->report, FF_FAULT_INPUT, setting->node->place, NULL,
                     "%s: only one of \"%s\" and \"%s\" may be given", k->stage->name, given,
                     member->name);
        else if (setting->node)
            given = member->name;
    }
    for (size_t i = 0; given && i < model->param_count; i++)
        k->settings[i].displaced |= same_group(row, ff_model_param(model, i));
    if (required && !preset && !given)
        ff_error(k->b->report, FF_FAULT_INPUT, k->stage->place, NULL,
                 "%s (%s): one of %s must be given%s", k->stage->name, k->id, names, instead);
}

static void settle_row(binding *k, size_t index)
{
    const ff_param *row = ff_model_param(k->loaded->model, index);
    size_t first = 0;
    while (row->group && !same_group(row, ff_model_param(k->loaded->model, first)))
        first++;
    if (row->group && first == index)
        settle_group(k, row);
    if (k->settings[index].wire)
        settle_replaced(k, row, &k->settings[index]);
    if (row->group || !(row->flags & FF_REQUIRED) || k->settings[index].node ||
        may_be_replaced(k, index))
        return;
    char wanted[640];
    const char *either = "";
    ff_param_expectation(row, wanted, sizeof wanted);
    if (row->instead)
        either = fe_pipeline_print(k->b->pipeline, ", or %s: STAGE", row->instead);
    ff_error(k->b->report, FF_FAULT_INPUT, k->stage->place,
             fe_pipeline_print(k->b->pipeline, "%s: %s%s", row->name, wanted, either),
             "%s (%s): \"%s\"%s%s%s is missing: %s", k->stage->name, k->id, row->name,
             row->instead ? " or the wire \"" : "", row->instead ? row->instead : "",
             row->instead ? "\"" : "", row->doc);
}

static ff_bound bind_row(binding *k, size_t index)
{
    const ff_param *row = ff_model_param(k->loaded->model, index);
    const ff_unit *unit = &k->loaded->param_units[index];
    const ff_node *node = k->settings[index].node;
    ff_bound bound = {.row = row, .wire = k->settings[index].wire};
    char name[192];
    snprintf(name, sizeof name, "%s.%s", k->stage->name, row->name);
    if (node) {
        bound.place = node->place;
        bound.present = ff_param_read(row, unit, name, node, &bound.value, k->b->report);
    } else if (row->preset && !k->settings[index].displaced && !bound.wire) {
        bound.present = ff_param_read_preset(row, unit, name, &bound.value, k->b->report);
    }
    return bound;
}

/* Reads all settings of one model. For another model under `with`, the keys of the stage itself
   count as given, but are not read: they are for the model in use. */
static void bind_model(binding *k)
{
    const ff_model *model = k->loaded->model;
    const ff_node *set = fe_model_set(k->stage, k->id);
    k->settings = fe_alloc(model->param_count * sizeof *k->settings);
    if (k->chosen && !k->stage->instance->candidate) /* its stage has checked them */
        check_keys(k, k->stage->node, "", true);
    if (set && set->kind == FF_MAP)
        check_keys(k, set, "", false);
    for (size_t i = 0; i < model->param_count; i++) {
        k->settings[i] = fe_find_setting(k->stage, k->id, ff_model_param(model, i)->name);
        k->settings[i].wire = find_replacing(k, ff_model_param(model, i));
    }
    for (size_t i = 0; i < model->param_count; i++)
        settle_row(k, i);
    for (size_t i = 0; i < model->param_count; i++) {
        if (k->chosen) {
            k->stage->params[i] = bind_row(k, i);
        } else if ((k->settings[i].node = fe_find_node(set, ff_model_param(model, i)->name))) {
            ff_bound unused = bind_row(k, i);
            ff_value_clear(&unused.value);
        }
    }
    fe_free(k->settings);
}

/* Checks the form of `with` and, when everything is checked, the sets of the other models. */
static void check_sets(fe_build *b, ff_stage *stage)
{
    const ff_node *with = ff_node_get(stage->node, "with");
    if (with && with->kind != FF_MAP)
        fe_expected(b, with, fe_pipeline_print(b->pipeline, "%s.with", stage->name),
                    "a map from models to their parameters");
    for (size_t i = 0; with && with->kind == FF_MAP && i < with->count; i++) {
        const char *id = with->keys[i];
        if (!strncmp(id, "x-", 2))
            continue;
        if (with->items[i]->kind != FF_MAP) {
            fe_expected(b, with->items[i],
                        fe_pipeline_print(b->pipeline, "%s.with.%s", stage->name, id),
                        "a map of parameters");
        } else if (b->everything && strcmp(id, stage->use) != 0) {
            binding k = {.b = b, .stage = stage, .id = id};
            k.loaded = ff_engine_model(b->engine, id, with->key_places[i], b->report);
            if (k.loaded)
                bind_model(&k);
        }
    }
}

void fe_bind_stage(fe_build *b, ff_stage *stage)
{
    size_t count = stage->loaded->model->param_count, errors = ff_report_errors(b->report);
    binding k = {.b = b, .stage = stage, .loaded = stage->loaded, .id = stage->use, .chosen = true};
    stage->params = fe_arena_alloc(&b->pipeline->memory->arena, count * sizeof *stage->params);
    bind_model(&k);
    if (ff_report_errors(b->report) > errors)
        stage->instance->broken = true;
    if (!stage->instance->candidate)
        check_sets(b, stage);
}
