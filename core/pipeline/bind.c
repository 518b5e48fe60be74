/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters: what the file says, checked against the model's table. */
#include "build.h"

#include "../plugin/param.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One model's table against what one stage says. */
typedef struct binding {
    ff_build *b;
    ff_stage *stage;
    const ff_loaded *loaded;
    const char *id;
    bool chosen; /* the stage's model; else one that waits under `with` */
    ff_setting *settings;
    bool good;
} binding;

static const ff_node *look_up(const ff_node *map, const char *path)
{
    char word[96];
    while (map && map->kind == FF_MAP) {
        size_t length = strcspn(path, ".");
        snprintf(word, sizeof word, "%.*s", (int)length, path);
        map = ff_node_get(map, word);
        if (!path[length])
            return map;
        path += length + 1;
    }
    return NULL;
}

static const ff_node *model_set(const ff_stage *stage, const char *model)
{
    const ff_node *with = ff_node_get(stage->node, "with");
    return with ? ff_node_get(with, model) : NULL;
}

ff_setting ff_find_setting(const ff_stage *stage, const char *model, const char *path)
{
    const ff_node *own = look_up(stage->node, path);
    const ff_node *set = look_up(model_set(stage, model), path);
    ff_setting setting = {.node = own, .priority = own ? 2 * (uint64_t)own->rank + 1 : 0};
    if (set && (!own || 2 * (uint64_t)set->rank > setting.priority))
        setting = (ff_setting){.node = set, .priority = 2 * (uint64_t)set->rank};
    return setting;
}

static const char *kind_of(const ff_node *node)
{
    return node->kind == FF_SCALAR && !node->text[0] ? "nothing" : ff_kind_name(node->kind);
}

static bool is_wire(const ff_model *model, const char *name)
{
    size_t length = strlen(name);
    for (size_t i = 0; i < model->input_count; i++) {
        const char *row = ff_model_input(model, i)->name;
        if (strcspn(row, ".") == length && !strncmp(row, name, length))
            return true;
    }
    return false;
}

/* True when `path` is a map of parameters: "atlas" of "atlas.from". */
static bool is_map_of(const ff_model *model, const char *path)
{
    size_t length = strlen(path);
    for (size_t i = 0; i < model->param_count; i++) {
        const char *name = ff_model_param(model, i)->name;
        if (!strncmp(name, path, length) && name[length] == '.')
            return true;
    }
    return false;
}

/* The word the user may have meant, in `out`; "" when none is near. */
static void nearest_key(const ff_model *model, const char *path, char *out, size_t size)
{
    size_t count = 0;
    const char **names = ff_alloc((model->param_count + model->input_count + 2) * sizeof *names);
    char(*wires)[64] = ff_alloc(model->input_count * sizeof *wires);
    for (size_t i = 0; i < model->param_count; i++)
        names[count++] = ff_model_param(model, i)->name;
    for (size_t i = 0; i < model->input_count; i++) {
        const char *row = ff_model_input(model, i)->name;
        snprintf(wires[i], sizeof *wires, "%.*s", (int)strcspn(row, "."), row);
        names[count++] = wires[i];
    }
    names[count++] = "use";
    names[count++] = "with";
    const char *near = ff_nearest(path, names, count);
    snprintf(out, size, "%s", near && strcmp(near, path) != 0 ? near : "");
    if (!strchr(path, '.'))
        out[strcspn(out, ".")] = 0;
    free(wires);
    free(names);
}

/* Another model under `with` that has this parameter, or NULL. */
static const char *other_owner(const binding *k, const char *path)
{
    const ff_node *with = ff_node_get(k->stage->node, "with");
    const char *owner = NULL;
    ff_report *unheard = ff_report_new();
    for (size_t i = 0; with && with->kind == FF_MAP && i < with->count && !owner; i++) {
        if (!strcmp(with->keys[i], k->id))
            continue;
        const ff_loaded *other = ff_library_load(k->b->library, with->keys[i], FF_NOWHERE, unheard);
        if (other && ff_model_find_param(other->model, path) >= 0)
            owner = with->keys[i];
    }
    ff_report_free(unheard);
    return owner;
}

static void refuse_key(binding *k, const char *path, ff_place place)
{
    const char *owner = other_owner(k, path);
    char hint[256] = "";
    if (owner)
        snprintf(hint, sizeof hint,
                 "%s has \"%s\": write it under \"with\", in the set of that model", owner, path);
    char near[96];
    if (ff_model_find_param(k->loaded->model, path) >= 0)
        snprintf(hint, sizeof hint, "the dot stands for a map within a map: %.*s: {%s: ...}",
                 (int)strcspn(path, "."), path, strchr(path, '.') + 1);
    nearest_key(k->loaded->model, path, near, sizeof near);
    k->good = false;
    if (near[0] && !owner)
        ff_error(k->b->report, FF_EXIT_INPUT, place, NULL,
                 "%s: unknown key \"%.80s\"; did you mean \"%s\"?", k->stage->name, path, near);
    else
        ff_error(k->b->report, FF_EXIT_INPUT, place, hint[0] ? hint : NULL,
                 "%s: unknown key \"%.80s\" for %s", k->stage->name, path, k->id);
}

/* One key: a parameter, a wire, or a map of parameters. `path` is its full name; `plain`: the key
   itself has no dot, which stands for a map within a map. */
static void check_key(binding *k, const char *path, ff_place place, const ff_node *value,
                      bool plain);

/* `prefix` is "" or "atlas."; `own`: the stage's map itself, which has `use` and `with`, too. */
static void check_keys(binding *k, const ff_node *map, const char *prefix, bool own)
{
    for (size_t i = 0; i < map->count; i++) {
        char *path = ff_print_text("%s%s", prefix, map->keys[i]);
        const char *key = path + strlen(prefix);
        if (strncmp(key, "x-", 2) != 0 && !(own && (!strcmp(key, "use") || !strcmp(key, "with"))))
            check_key(k, path, map->key_places[i], map->items[i], !strchr(key, '.'));
        free(path);
    }
}

static void check_key(binding *k, const char *path, ff_place place, const ff_node *value,
                      bool plain)
{
    const ff_model *model = k->loaded->model;
    if (plain && (ff_model_find_param(model, path) >= 0 || is_wire(model, path)))
        return;
    if (!plain || !is_map_of(model, path)) {
        refuse_key(k, path, place);
    } else if (value->kind != FF_MAP) {
        k->good = ff_error(k->b->report, FF_EXIT_INPUT, value->place, NULL,
                           "%s.%s: expected a map, found %s", k->stage->name, path, kind_of(value));
    } else {
        char *prefix = ff_print_text("%s.", path);
        check_keys(k, value, prefix, false);
        free(prefix);
    }
}

static bool same_group(const ff_param *a, const ff_param *b)
{
    return a->group && b->group && !strcmp(a->group, b->group);
}

/* Of the members of the row's group that are given, those of the latest layer stay. */
static void settle_group(binding *k, size_t row)
{
    const ff_model *model = k->loaded->model;
    const ff_param *param = ff_model_param(model, row);
    for (size_t i = 0; i < model->param_count; i++) {
        const ff_param *other = ff_model_param(model, i);
        ff_setting *mine = &k->settings[row], *its = &k->settings[i];
        if (i == row || !mine->node || !its->node || !same_group(param, other))
            continue;
        if (its->priority < mine->priority)
            its->node = NULL;
        else if (its->priority > mine->priority)
            mine->node = NULL;
        else if (i > row)
            k->good = ff_error(k->b->report, FF_EXIT_INPUT, its->node->place, NULL,
                               "%s: only one of \"%s\" and \"%s\" may be given", k->stage->name,
                               param->name, other->name);
    }
}

/* What the group of a row holds: a member that is given or preset, one that is required. */
static bool group_has(const binding *k, const ff_param *row, bool given, bool preset, bool required)
{
    for (size_t i = 0; i < k->loaded->model->param_count; i++) {
        const ff_param *other = ff_model_param(k->loaded->model, i);
        if (!same_group(row, other))
            continue;
        if ((given && k->settings[i].node) || (preset && other->preset) ||
            (required && (other->flags & FF_REQUIRED)))
            return true;
    }
    return false;
}

static void refuse_missing_group(binding *k, const ff_param *row)
{
    char names[256] = "";
    for (size_t i = 0; i < k->loaded->model->param_count; i++) {
        const ff_param *other = ff_model_param(k->loaded->model, i);
        size_t used = strlen(names);
        if (same_group(row, other))
            snprintf(names + used, sizeof names - used, "%s\"%s\"", used ? ", " : "", other->name);
    }
    k->good = ff_error(k->b->report, FF_EXIT_INPUT, k->stage->place, NULL,
                       "%s (%s): one of %s must be given", k->stage->name, k->id, names);
}

static void check_required(binding *k, size_t index)
{
    const ff_param *row = ff_model_param(k->loaded->model, index);
    if (row->group) {
        bool first = true;
        for (size_t i = 0; i < index; i++)
            first = first && !same_group(row, ff_model_param(k->loaded->model, i));
        if (first && group_has(k, row, false, false, true) && !group_has(k, row, true, true, false))
            refuse_missing_group(k, row);
    } else if ((row->flags & FF_REQUIRED) && !k->settings[index].node) {
        char wanted[640], hint[768];
        ff_param_expectation(row, wanted, sizeof wanted);
        snprintf(hint, sizeof hint, "%s: %s", row->name, wanted);
        k->good =
            ff_error(k->b->report, FF_EXIT_INPUT, k->stage->place, hint,
                     "%s (%s): \"%s\" is missing: %s", k->stage->name, k->id, row->name, row->doc);
    }
}

static void bind_row(binding *k, size_t index)
{
    const ff_param *row = ff_model_param(k->loaded->model, index);
    const ff_unit *unit = &k->loaded->param_units[index];
    const ff_node *node = k->settings[index].node;
    ff_bound bound = {.row = row};
    char name[192];
    snprintf(name, sizeof name, "%s.%s", k->stage->name, row->name);
    if (node) {
        bound.place = node->place;
        bound.present = ff_param_read(row, unit, name, node, &bound.value, k->b->report);
        k->good = k->good && bound.present;
    } else if (row->preset && !group_has(k, row, true, false, false)) {
        bound.present = ff_param_read_preset(row, unit, name, &bound.value, k->b->report);
    }
    if (k->chosen)
        k->stage->params[index] = bound;
    else
        ff_value_clear(&bound.value);
}

/* All settings of one model. For one that waits under `with`, the stage's own keys count as given
   but are not read: they are meant for the model that is chosen. */
static bool bind_model(binding *k)
{
    const ff_model *model = k->loaded->model;
    const ff_node *set = model_set(k->stage, k->id);
    k->good = true;
    k->settings = ff_alloc(model->param_count * sizeof *k->settings);
    if (k->chosen)
        check_keys(k, k->stage->node, "", true);
    if (set && set->kind == FF_MAP)
        check_keys(k, set, "", false);
    for (size_t i = 0; i < model->param_count; i++)
        k->settings[i] = ff_find_setting(k->stage, k->id, ff_model_param(model, i)->name);
    for (size_t i = 0; i < model->param_count; i++)
        settle_group(k, i);
    for (size_t i = 0; i < model->param_count; i++)
        check_required(k, i);
    for (size_t i = 0; i < model->param_count; i++) {
        if (!k->chosen)
            k->settings[i].node = look_up(set, ff_model_param(model, i)->name);
        if (k->chosen || k->settings[i].node)
            bind_row(k, i);
    }
    free(k->settings);
    return k->good;
}

/* The shape of `with`; in a check of everything, the sets of the models that are not chosen. */
static void check_sets(ff_build *b, ff_stage *stage)
{
    const ff_node *with = ff_node_get(stage->node, "with");
    if (!with)
        return;
    if (with->kind != FF_MAP) {
        stage->instance->broken = true;
        ff_error(b->report, FF_EXIT_INPUT, with->place, NULL,
                 "%s.with: expected a map from models to their parameters, found %s", stage->name,
                 kind_of(with));
        return;
    }
    for (size_t i = 0; i < with->count; i++) {
        const ff_node *set = with->items[i];
        if (!strncmp(with->keys[i], "x-", 2))
            continue;
        if (set->kind != FF_MAP) {
            stage->instance->broken = true;
            ff_error(b->report, FF_EXIT_INPUT, set->place, NULL,
                     "%s.with.%s: expected a map of parameters, found %s", stage->name,
                     with->keys[i], kind_of(set));
            continue;
        }
        if (!b->everything || !strcmp(with->keys[i], stage->use))
            continue;
        const ff_loaded *other =
            ff_library_load(b->library, with->keys[i], with->key_places[i], b->report);
        binding k = {.b = b, .stage = stage, .loaded = other, .id = with->keys[i]};
        if (other)
            bind_model(&k);
    }
}

void ff_bind_stage(ff_build *b, ff_stage *stage)
{
    const ff_model *model = stage->loaded->model;
    stage->params =
        ff_arena_alloc(&b->pipeline->memory->arena, model->param_count * sizeof *stage->params);
    binding k = {.b = b, .stage = stage, .loaded = stage->loaded, .id = stage->use, .chosen = true};
    if (!bind_model(&k))
        stage->instance->broken = true;
    check_sets(b, stage);
}
