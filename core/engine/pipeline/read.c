/* SPDX-License-Identifier: MIT */
/* Reads the top-level keys of a file, and the names and models of its stages. */
#include "build.h"

#include "../value/tree.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_STAGES = 1000, LONGEST_NAME = 64 };

ff_stage *fe_find_stage(fe_build *b, const char *name, ff_place place, const char *where)
{
    ff_pipeline *pipeline = b->pipeline;
    for (size_t i = 0; i < pipeline->count; i++)
        if (!strcmp(pipeline->stages[i].name, name))
            return &pipeline->stages[i];
    const char **names = fe_alloc(pipeline->count * sizeof *names);
    for (size_t i = 0; i < pipeline->count; i++)
        names[i] = pipeline->stages[i].name;
    ff_error(b->report, FF_FAULT_INPUT, place, NULL, "%s: there is no stage \"%.80s\"%s", where,
             name, fe_did_you_mean(b, name, names, pipeline->count));
    fe_free(names);
    return NULL;
}

ff_stage *ff_stage_of(const ff_pipeline *pipeline, const char *path, const char **name)
{
    size_t length = strcspn(path, ".");
    *name = path[length] ? path + length + 1 : "";
    for (size_t i = 0; i < pipeline->count; i++)
        if (strlen(pipeline->stages[i].name) == length &&
            !strncmp(pipeline->stages[i].name, path, length))
            return &pipeline->stages[i];
    return NULL;
}

/* False, with an error, if the stages stand under a misspelt key. */
static bool check_top_keys(fe_build *b, const ff_node *root)
{
    bool good = true;
    const char *const *known = ff_file_keys();
    size_t count = 0;
    while (known[count])
        count++;
    for (size_t i = 0; i < root->count; i++) {
        const char *key = root->keys[i];
        const char *near = ff_nearest(key, known, count);
        if (!strncmp(key, "x-", 2) || (near && !strcmp(near, key)))
            continue;
        ff_error(b->report, FF_FAULT_INPUT, root->key_places[i],
                 "keys of your own begin with \"x-\"; stages belong under \"pipeline\"",
                 "unknown key \"%.80s\"%s", key, fe_did_you_mean(b, key, known, count));
        good = good && !(near && !strcmp(near, "pipeline"));
    }
    return good;
}

static void check_format(fe_build *b, const ff_node *root)
{
    const ff_node *format = ff_node_get(root, "format");
    if (!format)
        ff_error(b->report, FF_FAULT_INPUT, root->place,
                 "write the line \"format: " FE_FORMAT "\" at its top",
                 "the file does not state its format");
    else if (format->kind != FF_SCALAR)
        fe_expected(b, format, "format", FE_FORMAT);
    else
        fe_check_format(b->report, format);
}

static void read_title(fe_build *b, const ff_node *root)
{
    const ff_node *title = ff_node_get(root, "title");
    if (title && title->kind != FF_SCALAR)
        fe_expected(b, title, "title", "a text");
    else if (title)
        b->pipeline->title = fe_pipeline_print(b->pipeline, "%s", title->text);
}

static bool check_name(fe_build *b, const char *name, ff_place place)
{
    static const char digits[] = "0123456789-";
    static const char letters[] = "0123456789-"
                                  "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";
    size_t length = strlen(name);
    for (const char *const *key = ff_file_keys(); *key; key++)
        if (!strcmp(name, *key))
            return ff_error(b->report, FF_FAULT_INPUT, place, NULL,
                            "a stage cannot be called \"%s\": --set %s means the key of that "
                            "name at the top of the file",
                            name, name);
    if (!strcmp(name, "none"))
        return ff_error(b->report, FF_FAULT_INPUT, place, NULL,
                        "a stage cannot be called \"none\": the word leaves a wire unconnected");
    if (length > 0 && length < LONGEST_NAME && !strchr(digits, name[0]) &&
        strspn(name, letters) == length)
        return true;
    const char *dot = strchr(name, '.'), *hint = NULL;
    if (dot)
        hint = fe_pipeline_print(b->pipeline,
                                 "a path is for --set; in a file, write %.*s: {%.80s: ...}",
                                 (int)(dot - name), name, dot + 1);
    return ff_error(
        b->report, FF_FAULT_INPUT, place, hint,
        "\"%.80s\" is not a stage name: it needs a letter, then letters, digits, \"_\" and "
        "\"-\", fewer than %d",
        name, LONGEST_NAME);
}

/* Reports a stage without `use`; its name may be misspelt, as in a --set. */
static void refuse_unused(fe_build *b, const ff_stage *stage, const ff_node *map)
{
    const char **others = fe_alloc(map->count * sizeof *others), *list = "";
    size_t count = 0;
    for (size_t i = 0; i < map->count; i++)
        if (ff_node_get(map->items[i], "use")) {
            others[count++] = map->keys[i];
            list = fe_join(b->pipeline, list, map->keys[i]);
        }
    const char *near = fe_did_you_mean(b, stage->name, others, count);
    const char *hint =
        *near || !*list
            ? "add use: KIND/MODEL"
            : fe_pipeline_print(b->pipeline, "add use: KIND/MODEL, or name one of the stages %s",
                                list);
    ff_error(b->report, FF_FAULT_INPUT, stage->place, hint,
             "%s: the stage does not say which model it uses%s", stage->name, near);
    fe_free(others);
}

static void read_use(fe_build *b, ff_stage *stage, const ff_node *map)
{
    const ff_node *node = stage->node, *use = ff_node_get(node, "use");
    stage->use_place = use ? use->place : stage->place;
    if (node->kind != FF_MAP)
        ff_error(b->report, FF_FAULT_INPUT, node->place,
                 "write for example NAME: {use: KIND/MODEL}",
                 "%s: expected a map that says which model it uses, found %s", stage->name,
                 fe_found(node));
    else if (!use)
        refuse_unused(b, stage, map);
    else if (use->kind != FF_SCALAR || !use->text[0])
        fe_expected(b, use, fe_pipeline_print(b->pipeline, "%s.use", stage->name),
                    "a model such as KIND/MODEL");
    else
        stage->use = use->text;
}

static void read_stage(fe_build *b, const ff_node *map, size_t index)
{
    ff_pipeline *pipeline = b->pipeline;
    ff_stage *stage = &pipeline->stages[pipeline->count++];
    stage->name = fe_pipeline_print(pipeline, "%s", map->keys[index]);
    stage->place = map->key_places[index];
    stage->instance = fe_arena_alloc(&pipeline->memory->arena, sizeof *stage->instance);
    stage->node = map->items[index];
    stage->instance->stage = stage;
    read_use(b, stage, map);
}

bool fe_read_stages(fe_build *b, const ff_node *root)
{
    ff_pipeline *pipeline = b->pipeline;
    fe_arena *arena = &pipeline->memory->arena;
    const ff_node *map = ff_node_get(root, "pipeline");
    bool good = check_top_keys(b, root);
    check_format(b, root);
    read_title(b, root);
    if (!good)
        return false;
    if (!map)
        return ff_error(b->report, FF_FAULT_INPUT, root->place, NULL,
                        "the file has no \"pipeline\": a map from names to stages");
    if (map->kind != FF_MAP)
        return fe_expected(b, map, "pipeline", "a map from names to stages");
    if (map->count > MOST_STAGES)
        return ff_error(b->report, FF_FAULT_INPUT, map->place, NULL,
                        "pipeline: %zu stages; at most %d are possible", map->count, MOST_STAGES);
    pipeline->stages = fe_arena_alloc(arena, map->count * sizeof *pipeline->stages);
    pipeline->order = fe_arena_alloc(arena, map->count * sizeof *pipeline->order);
    for (size_t i = 0; i < map->count; i++)
        if (strncmp(map->keys[i], "x-", 2) != 0 && !fe_is_removed(map->items[i]) &&
            check_name(b, map->keys[i], map->key_places[i]))
            read_stage(b, map, i);
    if (pipeline->count == 0 && ff_report_errors(b->report) == 0)
        ff_error(b->report, FF_FAULT_INPUT, map->place, NULL, "pipeline: it has no stages");
    return pipeline->count > 0;
}
