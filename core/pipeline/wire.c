/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Wires: which stage feeds which inputs. */
#include "build.h"

#include "../plugin/param.h"

#include <stdio.h>
#include <string.h>

static size_t wire_length(const ff_port *row)
{
    return strcspn(row->name, ".");
}

static bool is_on_wire(const ff_port *row, const char *wire)
{
    size_t length = wire_length(row);
    return strlen(wire) == length && !strncmp(row->name, wire, length);
}

const ff_wire *ff_input_wire(const ff_stage *stage, size_t input)
{
    const ff_port *row = ff_model_input(stage->loaded->model, input);
    size_t i = 0;
    while (!is_on_wire(row, stage->wires[i].name))
        i++;
    return &stage->wires[i];
}

int ff_find_service(const ff_loaded *from, const char *service)
{
    for (size_t i = 0; i < from->model->output_count; i++) {
        const ff_port *row = ff_model_output(from->model, i);
        if (row->service && !strcmp(row->service, service))
            return (int)i;
    }
    return -1;
}

ff_result *ff_feeding_result(const ff_pipeline *pipeline, const ff_stage *stage, size_t input)
{
    const ff_port *row = ff_model_input(stage->loaded->model, input);
    const ff_wire *wire = ff_input_wire(stage, input);
    if (row->service || wire->stage < 0)
        return NULL;
    ff_stage *from = &pipeline->stages[wire->stage];
    int output =
        from->loaded ? ff_model_find_output(from->loaded->model, strchr(row->name, '.') + 1) : -1;
    return output < 0 || from->results[output].row->service ? NULL : &from->results[output];
}

/* Names agree from the last one on; an optional first dimension may be absent on either side, and
   the run sees whether it is. */
static bool dims_agree(const ff_dims *given, const ff_dims *taken)
{
    uint32_t most = given->rank > taken->rank ? given->rank : taken->rank;
    const ff_dims *longer = given->rank > taken->rank ? given : taken;
    uint32_t common = given->rank < taken->rank ? given->rank : taken->rank;
    if (most - common > 1 || (most - common == 1 && !longer->first_optional))
        return false;
    for (uint32_t i = 1; i <= common; i++)
        if (strcmp(given->name[given->rank - i], taken->name[taken->rank - i]) != 0)
            return false;
    return true;
}

/* What keeps `from` from feeding one input row, to complete 'the stage ...'. */
static bool row_fits(const ff_stage *stage, size_t input, const ff_loaded *from, char *why,
                     size_t size)
{
    const ff_port *row = ff_model_input(stage->loaded->model, input);
    if (row->service) {
        snprintf(why, size, "does not offer the service %s", row->service);
        return ff_find_service(from, row->service) >= 0;
    }
    const char *name = strchr(row->name, '.') + 1;
    int output = ff_model_find_output(from->model, name);
    const ff_port *given = output < 0 ? NULL : ff_model_output(from->model, (size_t)output);
    if (!given || given->service) {
        snprintf(why, size, "does not offer \"%s\"", name);
        return (row->flags & FF_OPTIONAL) != 0;
    }
    if (!ff_unit_same_dimension(&from->output_units[output], &stage->loaded->input_units[input])) {
        snprintf(why, size, "gives \"%s\" in \"%s\", not in \"%s\"", name, given->unit, row->unit);
        return false;
    }
    snprintf(why, size, "gives \"%s\" along \"%s\", not along \"%s\"", name, given->dims,
             row->dims);
    return dims_agree(&from->output_dims[output], &stage->loaded->input_dims[input]);
}

/* All that is required on the wire, and at least something. */
static bool stage_fits(const ff_stage *stage, const ff_wire *wire, const ff_loaded *from, char *why,
                       size_t size)
{
    bool feeds = false;
    for (size_t i = 0; i < stage->loaded->model->input_count; i++) {
        const ff_port *row = ff_model_input(stage->loaded->model, i);
        if (!is_on_wire(row, wire->name))
            continue;
        if (!row_fits(stage, i, from, why, size))
            return false;
        feeds = feeds || row->service ||
                ff_model_find_output(from->model, strchr(row->name, '.') + 1) >= 0;
    }
    if (!feeds)
        snprintf(why, size, "offers nothing that this wire carries");
    return feeds;
}

static bool is_optional(const ff_stage *stage, const char *wire)
{
    for (size_t i = 0; i < stage->loaded->model->input_count; i++) {
        const ff_port *row = ff_model_input(stage->loaded->model, i);
        if (is_on_wire(row, wire) && !(row->flags & FF_OPTIONAL))
            return false;
    }
    return true;
}

/* The kinds that a wire is fed from when the file does not say more: "stiffness|dynamics". */
static const char *wire_kinds(const ff_stage *stage, const ff_wire *wire)
{
    for (size_t i = 0; i < stage->loaded->model->input_count; i++) {
        const ff_port *row = ff_model_input(stage->loaded->model, i);
        if (is_on_wire(row, wire->name) && row->from)
            return row->from;
    }
    return wire->name;
}

static bool is_of_kind(const ff_stage *stage, const char *kinds)
{
    char kind[64];
    if (!stage->use)
        return false;
    snprintf(kind, sizeof kind, "%.*s", (int)strcspn(stage->use, "/"), stage->use);
    return ff_word_find(kinds, kind) >= 0;
}

/* Appends to a list in a buffer, ", " between; "..." stands for what has no room. */
static void list_add(char *list, size_t size, const char *text)
{
    static const char more[] = ", ...";
    size_t used = strlen(list), room = size - used;
    if (used >= sizeof more && !strcmp(list + used - 5, more))
        return;
    bool fits = strlen(text) + sizeof more + 2 < room;
    if (fits || room > sizeof more)
        snprintf(list + used, room, "%s%s", fits && used ? ", " : "", fits ? text : more);
}

/* What the wire asks for, to read: "time, load_per_width" or a service's id. */
static void wire_needs(const ff_stage *stage, const ff_wire *wire, char *list, size_t size)
{
    list[0] = 0;
    for (size_t i = 0; i < stage->loaded->model->input_count; i++) {
        const ff_port *row = ff_model_input(stage->loaded->model, i);
        if (is_on_wire(row, wire->name) && !(row->flags & FF_OPTIONAL))
            list_add(list, size, row->service ? row->service : strchr(row->name, '.') + 1);
    }
}

static void link_written(ff_build *b, ff_stage *stage, ff_wire *wire, const ff_node *node)
{
    ff_pipeline *pipeline = b->pipeline;
    char why[256];
    wire->place = node->place;
    stage->instance->broken = true;
    if (node->kind != FF_SCALAR || !node->text[0]) {
        ff_error(b->report, FF_EXIT_INPUT, node->place, NULL,
                 "%s.%s: expected the name of a stage, found %s", stage->name, wire->name,
                 node->kind == FF_SCALAR ? "nothing" : ff_kind_name(node->kind));
        return;
    }
    if (!strcmp(node->text, "none")) {
        stage->instance->broken = !is_optional(stage, wire->name);
        if (stage->instance->broken)
            ff_error(b->report, FF_EXIT_INPUT, node->place, NULL,
                     "%s.%s: \"none\" is not possible, since %s cannot do without it", stage->name,
                     wire->name, stage->use);
        return;
    }
    int index = ff_find_stage(pipeline, node->text, strlen(node->text));
    if (index < 0) {
        const char *near = ff_nearest_stage(pipeline, node->text);
        ff_error(b->report, FF_EXIT_INPUT, node->place, NULL,
                 near ? "%s.%s: there is no stage \"%.80s\"; did you mean \"%s\"?"
                      : "%s.%s: there is no stage \"%.80s\"",
                 stage->name, wire->name, node->text, near);
        return;
    }
    wire->stage = index;
    ff_stage *from = &pipeline->stages[index];
    if (!ff_load_stage(b, from))
        return;
    stage->instance->broken = false;
    if (!stage_fits(stage, wire, from->loaded, why, sizeof why)) {
        stage->instance->broken = true;
        ff_error(b->report, FF_EXIT_INPUT, node->place, NULL, "%s.%s: the stage \"%s\" (%s) %s",
                 stage->name, wire->name, from->name, from->use, why);
    }
}

/* What the search for a feeding stage found. */
typedef struct search {
    size_t fitting;
    int stage;         /* the last that fits */
    bool unknown;      /* a model could not be loaded: no telling */
    char names[256];   /* of those that fit */
    char why_not[448]; /* of the last that does not: 'the stage "x" ...' */
} search;

static void look_for(ff_build *b, ff_stage *stage, const ff_wire *wire, const char *kinds,
                     search *found)
{
    char why[256];
    for (size_t i = 0; i < b->pipeline->count; i++) {
        ff_stage *from = &b->pipeline->stages[i];
        if (from == stage || !is_of_kind(from, kinds))
            continue;
        if (!ff_load_stage(b, from))
            found->unknown = true;
        else if (stage_fits(stage, wire, from->loaded, why, sizeof why)) {
            found->fitting++;
            found->stage = (int)i;
            list_add(found->names, sizeof found->names, from->name);
        } else
            snprintf(found->why_not, sizeof found->why_not, "the stage \"%.64s\" (%.64s) %s",
                     from->name, from->use, why);
    }
}

static void installed_of_kind(ff_build *b, const char *kinds, char *list, size_t size)
{
    size_t count;
    const char *const *ids = ff_library_ids(b->library, &count);
    list[0] = 0;
    for (size_t i = 0; i < count; i++) {
        char kind[64];
        snprintf(kind, sizeof kind, "%.*s", (int)strcspn(ids[i], "/"), ids[i]);
        if (ff_word_find(kinds, kind) >= 0)
            list_add(list, size, ids[i]);
    }
}

static void refuse_none(ff_build *b, ff_stage *stage, const ff_wire *wire, const char *kinds,
                        const search *found)
{
    char needs[256], installed[512], hint[640];
    wire_needs(stage, wire, needs, sizeof needs);
    installed_of_kind(b, kinds, installed, sizeof installed);
    if (installed[0])
        snprintf(hint, sizeof hint, "models of that kind: %s", installed);
    else
        snprintf(hint, sizeof hint, "no model of that kind is installed");
    ff_error(b->report, FF_EXIT_INPUT, stage->place, hint,
             "%s: nothing feeds its wire \"%s\" (%s): %s%s", stage->name, wire->name, needs,
             found->why_not[0] ? found->why_not : "no stage is of the kind ",
             found->why_not[0] ? "" : kinds);
}

static void link_automatic(ff_build *b, ff_stage *stage, ff_wire *wire)
{
    const char *kinds = wire_kinds(stage, wire);
    search found = {.stage = -1};
    wire->automatic = true;
    wire->place = stage->place;
    look_for(b, stage, wire, kinds, &found);
    if (found.unknown) {
        stage->instance->broken = true;
    } else if (found.fitting == 1) {
        wire->stage = found.stage;
    } else if (found.fitting > 1) {
        char hint[256];
        snprintf(hint, sizeof hint, "add the line \"%s: %.*s\" to %s, or name another of them",
                 wire->name, (int)strcspn(found.names, ","), found.names, stage->name);
        stage->instance->broken = true;
        ff_error(b->report, FF_EXIT_INPUT, stage->place, hint,
                 "%s: several stages can feed its wire \"%s\": %s", stage->name, wire->name,
                 found.names);
    } else if (!is_optional(stage, wire->name)) {
        stage->instance->broken = true;
        refuse_none(b, stage, wire, kinds, &found);
    }
}

/* One wire for each word before the dot in the names of the input rows. */
static void make_wires(ff_build *b, ff_stage *stage)
{
    const ff_model *model = stage->loaded->model;
    stage->wires =
        ff_arena_alloc(&b->pipeline->memory->arena, model->input_count * sizeof *stage->wires);
    for (size_t i = 0; i < model->input_count; i++) {
        const ff_port *row = ff_model_input(model, i);
        size_t known = 0;
        while (known < stage->wire_count && !is_on_wire(row, stage->wires[known].name))
            known++;
        if (known < stage->wire_count)
            continue;
        ff_wire *wire = &stage->wires[stage->wire_count++];
        snprintf(wire->name, sizeof wire->name, "%.*s", (int)wire_length(row), row->name);
        wire->stage = -1;
    }
}

void ff_link_stage(ff_build *b, ff_stage *stage)
{
    bool broken = stage->instance->broken;
    make_wires(b, stage);
    for (size_t i = 0; i < stage->wire_count; i++) {
        ff_wire *wire = &stage->wires[i];
        ff_setting setting = ff_find_setting(stage, stage->use, wire->name);
        stage->instance->broken = false;
        if (setting.node)
            link_written(b, stage, wire, setting.node);
        else
            link_automatic(b, stage, wire);
        broken = broken || stage->instance->broken;
    }
    stage->instance->broken = broken;
}
