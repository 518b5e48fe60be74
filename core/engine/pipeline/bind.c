/* SPDX-License-Identifier: MIT */
/* Reads the parameters of a stage from the file, according to the parameter table of its model. */
#include "build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The parameter table of a model, and the settings of a stage for it. */
typedef struct binding {
    fe_build *b;
    ff_stage *stage;
    const ff_loaded *loaded;
    const char *id;
    bool chosen; /* true: the model in use; false: another model under `with` */
    fe_setting *settings;
    const ff_node *before; /* the model in use before a --set replaced it, for which the keys in
                              `left` were written */
    const char *left;      /* keys that were left out because the new model does not have them: 'x
                              (a.yaml:1:2), y' */
} binding;

/* Whether the path names a map of the model: "atlas" is the map of the parameter or wire
   "atlas.from". */
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
    bool whole = strchr(path, '.') != NULL; /* else it is a key of the stage's own map */
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

/* Returns another model under `with` that has this parameter, or NULL. */
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
        hint = fe_pipeline_print(k->b->pipeline, "write the dot as a nested map: %.*s: {%s: ...}",
                                 (int)strcspn(path, "."), path, strchr(path, '.') + 1);
    else if (owner)
        hint = fe_pipeline_print(k->b->pipeline,
                                 "%s has \"%s\": write it under \"with\", in the set of that model",
                                 owner, path);
    else
        advice = nearest_key(k, path);
    if (!hint && !*advice && strchr(path, ' '))
        hint = "a key ends with a colon and a blank, as in \"key: value\"";
    else if (!hint && !*advice)
        hint = fe_hint_of_key(k->b, k->stage, k->loaded->model, path);
    ff_error(k->b->report, FF_FAULT_INPUT, place, hint, "%s: unknown key \"%.80s\"%s%s%s",
             k->stage->name, path, *advice ? "" : " for ", *advice ? "" : k->id, advice);
}

/* Returns the model for which the key was written, if `use` has replaced that model since; *before
   is the old `use`. NULL: no replaced model has the path, so the key is either meant for the new
   model or a mistake. */
static const ff_loaded *owner_before(binding *k, const ff_node *node, const char *path,
                                     const ff_node **before)
{
    const ff_node *use = ff_node_get(k->stage->node, "use");
    ff_report *captured = ff_report_new();
    const ff_loaded *owner = NULL;
    for (; use && use->replaced && !owner; use = use->replaced) {
        *before = use->replaced;
        if (fe_latest_rank(node) >= use->rank || use->replaced->kind != FF_SCALAR)
            break;
        owner = ff_engine_model(k->b->engine, use->replaced->text, FF_NOWHERE, captured);
        if (owner && ff_model_find_param(owner->model, path) < 0 && !is_wire(owner->model, path) &&
            !is_map(owner->model, path))
            owner = NULL;
    }
    ff_report_free(captured);
    return owner;
}

static void leave_out(binding *k, const char *path, ff_place place, const ff_node *before)
{
    k->before = before;
    k->left = fe_join(k->b->pipeline, k->left ? k->left : "",
                      fe_pipeline_print(k->b->pipeline, "\"%s\" (%s)", path,
                                        fe_place_text(k->b->pipeline, place)));
}

/* Handles a key that the model does not have: leaves it out if it was written for a replaced model,
   refuses it otherwise. */
static void judge_key(binding *k, const char *path, const ff_node *value, ff_place place)
{
    const ff_node *before = NULL;
    if (k->chosen && owner_before(k, value, path, &before))
        leave_out(k, path, place, before);
    else
        refuse_key(k, path, place);
}

/* Leaves out a value that was written for a replaced model, if the new model has a parameter of the
   same name that cannot take the value, for example because its unit differs. */
static void leave_misfit(binding *k, size_t index)
{
    const ff_param *row = ff_model_param(k->loaded->model, index);
    const ff_node *node = k->settings[index].node, *before = NULL;
    const ff_loaded *owner = node ? owner_before(k, node, row->name, &before) : NULL;
    int old = owner ? ff_model_find_param(owner->model, row->name) : -1;
    if (old < 0)
        return;
    ff_report *now = ff_report_new(), *then = ff_report_new();
    ff_value value;
    if (ff_param_read(row, &k->loaded->param_units[index], row->name, node, &value, now))
        ff_value_clear(&value);
    if (ff_param_read(ff_model_param(owner->model, (size_t)old), &owner->param_units[old],
                      row->name, node, &value, then))
        ff_value_clear(&value);
    if (ff_report_errors(now) > 0 && ff_report_errors(then) == 0) {
        leave_out(k, row->name, node->place, before);
        k->settings[index] = (fe_setting){.wire = k->settings[index].wire};
    }
    ff_report_free(now);
    ff_report_free(then);
}

static void warn_of_left(binding *k)
{
    if (k->left)
        ff_warn(k->b->report, k->stage->use_place,
                "%s: %s cannot take values that are written for %s (%s), so they are left out: %s",
                k->stage->name, k->id, k->before->text,
                fe_place_text(k->b->pipeline, k->before->place), k->left);
}

/* Checks the keys of a map. `prefix` is "" or "atlas."; `own` marks the stage's own map, which also
   has `use` and `with`. A key with a dot is refused, since a dot stands for a nested map. */
static void check_keys(binding *k, const ff_node *map, const char *prefix, bool own)
{
    const ff_model *model = k->loaded->model;
    for (size_t i = 0; i < map->count; i++) {
        const char *key = map->keys[i];
        const ff_node *value = map->items[i];
        const char *path = fe_pipeline_print(k->b->pipeline, "%s%s", prefix, key);
        bool plain = !strchr(key, '.');
        if (!strncmp(key, "x-", 2) || (own && (!strcmp(key, "use") || !strcmp(key, "with"))) ||
            fe_is_removed(value))
            continue;
        if (plain && (ff_model_find_param(model, path) >= 0 || is_wire(model, path)))
            continue;
        if (!plain || !is_map(model, path))
            judge_key(k, path, value, map->key_places[i]);
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

/* Whether the stage at the other end of the wire feeds the input that replaces the parameter. */
static bool replaces(const binding *k, const ff_param *row, const ff_wire *wire,
                     const ff_port *input)
{
    return wire->stage >= 0 && fe_is_on_wire(input->name, wire->name) &&
           fe_is_on_wire(input->name, row->instead) &&
           (input->service ||
            fe_find_offer(k->b->pipeline->stages[wire->stage].loaded, input) >= 0);
}

/* Returns the connected wire that replaces the parameter; NULL: none. */
static const ff_wire *find_replacing(const binding *k, const ff_param *row)
{
    const ff_model *model = k->loaded->model;
    for (size_t w = 0; row->instead && w < k->stage->wire_count; w++)
        for (size_t i = 0; i < model->input_count; i++)
            if (replaces(k, row, &k->stage->wires[w], ff_model_input(model, i)))
                return &k->stage->wires[w];
    return NULL;
}

/* Refuses a parameter that is given although a connected wire replaces it. */
static void settle_replaced(binding *k, const ff_param *row, const fe_setting *setting)
{
    const ff_wire *wire = setting->wire;
    const ff_stage *from = &k->b->pipeline->stages[wire->stage];
    if (setting->node)
        ff_error(k->b->report, FF_FAULT_INPUT, setting->node->place,
                 fe_pipeline_print(k->b->pipeline,
                                   "remove \"%s\", or leave the wire unconnected: %s: none",
                                   row->name, wire->name),
                 "%s.%s: the stage \"%s\" gives this value, too, by the wire \"%s\" (%s)",
                 k->stage->name, row->name, from->name, wire->name,
                 fe_place_text(k->b->pipeline, wire->automatic ? from->place : wire->place));
}

/* Whether a wire replaces the parameter, or would replace it if the model under `with` were in
   use. */
static bool may_be_replaced(const binding *k, size_t index)
{
    return k->settings[index].wire ||
           (!k->chosen && ff_model_param(k->loaded->model, index)->instead);
}

/* Whether two given members of a group contradict each other. Two members in files do, but the
   stage's own key replaces a member in a set under `with`. An assignment replaces a member in a
   file. */
static bool contradict(const binding *k, const fe_setting *a, const fe_setting *b)
{
    const uint64_t later = a->priority > b->priority ? a->priority : b->priority;
    return later / 2 <= k->b->file_rank ? a->priority % 2 == b->priority % 2
                                        : a->priority == b->priority;
}

static bool is_later(const fe_setting *a, const fe_setting *b)
{
    const ff_place *at = &a->node->place, *other = &b->node->place;
    if (a->priority != b->priority)
        return a->priority > b->priority;
    return at->line != other->line ? at->line > other->line : at->column > other->column;
}

static void refuse_both(const binding *k, const fe_setting *one, const fe_setting *other)
{
    const ff_model *model = k->loaded->model;
    ff_pipeline *pipeline = k->b->pipeline;
    const fe_setting *last = is_later(one, other) ? one : other;
    const fe_setting *first = last == one ? other : one;
    const char *name = ff_model_param(model, (size_t)(last - k->settings))->name;
    const char *with = ff_model_param(model, (size_t)(first - k->settings))->name;
    ff_error(k->b->report, FF_FAULT_INPUT, last->node->place,
             first->priority == last->priority
                 ? NULL
                 : fe_pipeline_print(pipeline,
                                     "an empty value removes that of an included file: %s:", with),
             "%s: only one of \"%s\" (%s) and \"%s\" (%s) may be given", k->stage->name, with,
             fe_place_text(pipeline, first->node->place), name,
             fe_place_text(pipeline, last->node->place));
}

/* Keeps the group member that the latest layer gives, unless two members contradict each other. */
static void settle_group(binding *k, const ff_param *row)
{
    const ff_model *model = k->loaded->model;
    const char *names = "", *instead = "";
    bool required = false, preset = false;
    const fe_setting *given = NULL;
    for (size_t i = 0; i < model->param_count; i++)
        if (same_group(row, ff_model_param(model, i)) && k->settings[i].node &&
            (!given || k->settings[i].priority > given->priority))
            given = &k->settings[i];
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
        if (setting == given || !setting->node)
            continue;
        if (contradict(k, setting, given))
            refuse_both(k, setting, given);
        setting->node = NULL;
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

/* Reads all settings of one model. For a model under `with` that is not in use, the stage's own
   keys count as given but are not read, since they are meant for the model in use. */
static void bind_model(binding *k)
{
    const ff_model *model = k->loaded->model;
    const ff_node *set = fe_model_set(k->stage, k->id);
    k->settings = fe_alloc(model->param_count * sizeof *k->settings);
    if (k->chosen)
        check_keys(k, k->stage->node, "", true);
    if (set && set->kind == FF_MAP)
        check_keys(k, set, "", false);
    for (size_t i = 0; i < model->param_count; i++) {
        k->settings[i] = fe_find_setting(k->stage, k->id, ff_model_param(model, i)->name);
        k->settings[i].wire = find_replacing(k, ff_model_param(model, i));
        if (k->chosen)
            leave_misfit(k, i);
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
    warn_of_left(k);
    fe_free(k->settings);
}

/* Loads a model named under `with`. If it is not installed, the run continues without it and a
   warning is given. */
static const ff_loaded *load_offered(fe_build *b, const char *id, ff_place place)
{
    ff_report *captured = ff_report_new();
    const ff_loaded *loaded = ff_engine_model(b->engine, id, place, captured);
    for (size_t i = 0; i < ff_report_count(captured); i++) {
        const ff_message *m = ff_report_at(captured, i);
        if (b->everything)
            fe_hand_on(m, b->report);
        else
            ff_warn(b->report, m->place, "%s", m->text);
    }
    ff_report_free(captured);
    return loaded;
}

/* Checks the form of `with`, and the parameter sets of the models that are not in use, since the
   next --set may choose one of them. */
static void check_sets(fe_build *b, ff_stage *stage)
{
    const ff_node *with = ff_node_get(stage->node, "with");
    if (with && with->kind != FF_MAP)
        fe_expected(b, with, fe_pipeline_print(b->pipeline, "%s.with", stage->name),
                    "a map from models to their parameters");
    for (size_t i = 0; with && with->kind == FF_MAP && i < with->count; i++) {
        const char *id = with->keys[i];
        const ff_node *set = with->items[i];
        bool empty = set->kind == FF_SCALAR && !*set->text; /* {} */
        if (!strncmp(id, "x-", 2))
            continue;
        if (set->kind != FF_MAP && !empty) {
            fe_expected(b, set, fe_pipeline_print(b->pipeline, "%s.with.%s", stage->name, id),
                        "a map of parameters");
        } else if (strcmp(id, stage->use) != 0) {
            binding k = {.b = b, .stage = stage, .id = id};
            k.loaded = load_offered(b, id, with->key_places[i]);
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
    check_sets(b, stage);
}
