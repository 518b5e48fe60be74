/* SPDX-License-Identifier: MIT */
/* Finds which stage feeds which inputs. */
#include "build.h"

#include "../plugin/param.h"

#include <stdio.h>
#include <string.h>

/* Compares the dimension names from the last to the first. An optional first dimension may be
   absent on either side; the rank of the data is checked when the stage runs. */
static bool dims_agree(const ff_dims *given, const ff_dims *taken)
{
    const ff_dims *longer = given->rank > taken->rank ? given : taken;
    const ff_dims *shorter = longer == given ? taken : given;
    if (longer->rank - shorter->rank > (longer->first_optional ? 1 : 0))
        return false;
    for (uint32_t i = 1; i <= shorter->rank; i++)
        if (strcmp(given->name[given->rank - i], taken->name[taken->rank - i]) != 0)
            return false;
    return true;
}

/* Compares the units, which were parsed when the models were loaded. */
static bool units_agree(const ff_port *given, const ff_port *taken)
{
    ff_unit one, other;
    char why[200];
    return ff_unit_parse(given->unit, &one, why, sizeof why) &&
           ff_unit_parse(taken->unit, &other, why, sizeof why) &&
           ff_unit_same_dimension(&one, &other);
}

/* Explains why output `output` of `from` cannot feed input `input` of `to`; NULL: it can. */
static const char *row_misfit(fe_build *b, const ff_loaded *to, size_t input, const ff_loaded *from,
                              size_t output)
{
    const ff_port *taken = ff_model_input(to->model, input);
    const ff_port *given = ff_model_output(from->model, output);
    if (!units_agree(given, taken))
        return fe_pipeline_print(b->pipeline, "gives \"%s\" in \"%s\", not in \"%s\"", given->name,
                                 given->unit, taken->unit);
    if (!dims_agree(&from->output_dims[output], &to->input_dims[input]))
        return fe_pipeline_print(b->pipeline, "gives \"%s\" along \"%s\", not along \"%s\"",
                                 given->name, given->dims, taken->dims);
    return NULL;
}

/* Whether the row is an optional further service on a wire that carries another service already,
   such as "rheology.at_pressure" on the wire "rheology". */
static bool is_further_service(const ff_port *row)
{
    return (row->flags & FF_OPTIONAL) && strchr(row->name, '.');
}

const char *fe_wire_misfit(fe_build *b, const ff_stage *stage, const char *wire,
                           const ff_loaded *from)
{
    const char *why = NULL;
    bool feeds = false;
    for (size_t i = 0; i < stage->loaded->model->input_count && !why; i++) {
        const ff_port *row = ff_model_input(stage->loaded->model, i);
        if (!fe_is_on_wire(row->name, wire))
            continue;
        int output = fe_find_offer(from, row);
        feeds = feeds || output >= 0;
        if (output < 0 && row->service && !is_further_service(row))
            why = fe_pipeline_print(b->pipeline, "does not offer the service %s", row->service);
        else if (output < 0 && !(row->flags & FF_OPTIONAL))
            why = fe_pipeline_print(b->pipeline, "does not offer \"%s\"", fe_output_name(row));
        else if (output >= 0 && !row->service)
            why = row_misfit(b, stage->loaded, i, from, (size_t)output);
    }
    return why || feeds ? why : "offers nothing that this wire carries";
}

/* Lists what the wire must carry: "time, load_per_width", or a service id; "": nothing. */
static const char *wire_needs(fe_build *b, const ff_stage *stage, const ff_wire *wire)
{
    const char *needs = "";
    for (size_t i = 0; i < stage->loaded->model->input_count; i++) {
        const ff_port *row = ff_model_input(stage->loaded->model, i);
        if (fe_is_on_wire(row->name, wire->name) && !(row->flags & FF_OPTIONAL))
            needs = fe_join(b->pipeline, needs, row->service ? row->service : fe_output_name(row));
    }
    return needs;
}

static bool is_of_kind(const char *id, const char *kinds)
{
    char kind[64];
    snprintf(kind, sizeof kind, "%.*s", (int)strcspn(id, "/"), id);
    return fe_word_find(kinds, kind) >= 0;
}

/* Connects a wire that the file gives. False if a required wire stays unconnected. */
static bool link_written(fe_build *b, const ff_stage *stage, ff_wire *wire, const ff_node *node)
{
    const char *path = fe_pipeline_print(b->pipeline, "%s.%s", stage->name, wire->name);
    wire->place = node->place;
    if (node->kind != FF_SCALAR || !node->text[0])
        return fe_expected(b, node, path, "the name of a stage");
    if (!strcmp(node->text, "none"))
        return !*wire_needs(b, stage, wire) ||
               ff_error(b->report, FF_FAULT_INPUT, node->place, NULL,
                        "%s: \"none\" is not possible, since %s requires this wire", path,
                        stage->use);
    ff_stage *from = fe_find_stage(b, node->text, node->place, path);
    if (!from)
        return false;
    wire->stage = (int)(from - b->pipeline->stages);
    if (!fe_load_stage(b, from))
        return false;
    const char *why = fe_wire_misfit(b, stage, wire->name, from->loaded);
    return !why || ff_error(b->report, FF_FAULT_INPUT, node->place, NULL,
                            "%s: the stage \"%s\" (%s) %s", path, from->name, from->use, why);
}

static bool refuse_none(fe_build *b, const ff_stage *stage, const ff_wire *wire, const char *kinds,
                        const char *why_not)
{
    const char *needs = wire_needs(b, stage, wire), *installed = "";
    size_t count;
    const char *const *ids = ff_engine_ids(b->engine, &count);
    if (!*needs)
        return true;
    for (size_t i = 0; i < count; i++)
        if (is_of_kind(ids[i], kinds))
            installed = fe_join(b->pipeline, installed, ids[i]);
    const char *hint = *installed
                           ? fe_pipeline_print(b->pipeline, "models of that kind: %s", installed)
                           : "no model of that kind is installed";
    if (!why_not)
        why_not = fe_pipeline_print(b->pipeline, "no stage is of the kind %s", kinds);
    return ff_error(b->report, FF_FAULT_INPUT, stage->place, hint,
                    "%s: nothing feeds its wire \"%s\" (%s): %s", stage->name, wire->name, needs,
                    why_not);
}

static bool is_kind_installed(fe_build *b, const char *use)
{
    char kind[64];
    size_t count;
    const char *const *ids = ff_engine_ids(b->engine, &count);
    snprintf(kind, sizeof kind, "%.*s", (int)strcspn(use, "/"), use);
    for (size_t i = 0; i < count; i++)
        if (is_of_kind(ids[i], kind))
            return true;
    return false;
}

/* Whether some stage has no model or an unknown kind, which is already reported. If so, a wire
   without a source is no error of its own, since that stage may be the source. */
static bool is_some_kind_unknown(fe_build *b)
{
    bool some = false;
    for (size_t i = 0; i < b->pipeline->count; i++) {
        ff_stage *stage = &b->pipeline->stages[i];
        if (!stage->use || (!stage->loaded && !is_kind_installed(b, stage->use)))
            some = !fe_load_stage(b, stage) || some;
    }
    return some;
}

/* Connects the only stage that can feed the wire, among the wire's kinds; false after an error. */
static bool link_automatic(fe_build *b, const ff_stage *stage, ff_wire *wire, const char *kinds)
{
    const char *fitting = "", *why_not = NULL;
    size_t count = 0;
    bool known = true;
    wire->automatic = true;
    wire->place = stage->place;
    for (size_t i = 0; i < b->pipeline->count; i++) {
        ff_stage *from = &b->pipeline->stages[i];
        if (from == stage || !from->use || !is_of_kind(from->use, kinds))
            continue;
        known = fe_load_stage(b, from) && known;
        const char *why = from->loaded ? fe_wire_misfit(b, stage, wire->name, from->loaded) : "";
        if (why) {
            why_not = fe_pipeline_print(b->pipeline, "the stage \"%s\" (%s) %s", from->name,
                                        from->use, why);
        } else {
            count++;
            wire->stage = (int)i;
            fitting = fe_join(b->pipeline, fitting, from->name);
        }
    }
    if (known && count == 0 && *wire_needs(b, stage, wire) && is_some_kind_unknown(b))
        return false;
    if (known && count == 0)
        return refuse_none(b, stage, wire, kinds, why_not);
    if (known && count == 1)
        return true;
    wire->stage = -1;
    return known &&
           ff_error(b->report, FF_FAULT_INPUT, stage->place,
                    fe_pipeline_print(b->pipeline,
                                      "add the line \"%s: %.*s\" to %s, or name another "
                                      "of them",
                                      wire->name, (int)strcspn(fitting, ","), fitting, stage->name),
                    "%s: several stages can feed its wire \"%s\": %s", stage->name, wire->name,
                    fitting);
}

/* Creates a wire for each prefix before the dot in the names of input rows, and finds the stage
   that feeds it. */
static void link_stage(fe_build *b, ff_stage *stage)
{
    const ff_model *model = stage->loaded->model;
    stage->wires =
        fe_arena_alloc(&b->pipeline->memory->arena, model->input_count * sizeof *stage->wires);
    for (size_t i = 0; i < model->input_count; i++) {
        const ff_port *row = ff_model_input(model, i);
        size_t known = 0;
        while (known < stage->wire_count && !fe_is_on_wire(row->name, stage->wires[known].name))
            known++;
        if (known < stage->wire_count)
            continue;
        ff_wire *wire = &stage->wires[stage->wire_count++];
        snprintf(wire->name, sizeof wire->name, "%.*s", (int)strcspn(row->name, "."), row->name);
        wire->stage = -1;
        const ff_node *node = fe_find_setting(stage, stage->use, wire->name).node;
        wire->feedback = row->flags & FF_FEEDBACK;
        wire->place = stage->place;
        bool good = node ? link_written(b, stage, wire, node)
                    : wire->feedback
                        ? true
                        : link_automatic(b, stage, wire, row->from ? row->from : wire->name);
        stage->instance->broken = stage->instance->broken || !good;
    }
}

void fe_link_from(fe_build *b, ff_stage *stage)
{
    if (stage->wires || !fe_load_stage(b, stage))
        return;
    link_stage(b, stage);
    for (size_t i = 0; i < stage->wire_count; i++)
        if (stage->wires[i].stage >= 0)
            fe_link_from(b, &b->pipeline->stages[stage->wires[i].stage]);
}

/* The stage whose output determines the points of a dimension. */
typedef struct fe_origin {
    const ff_stage *stage;
    bool known; /* false if the model was built for an interface before version 1.3, in which a
                   dimension does not name its wire */
} fe_origin;

static int find_dim(const ff_dims *dims, const char *name)
{
    for (uint32_t i = 0; i < dims->rank; i++)
        if (!strcmp(dims->name[i], name))
            return (int)i;
    return -1;
}

/* Returns an input on this wire that has the dimension and is not fed back by a later stage of a
   loop, so that it also has a value in the first round; -1: none. */
static int find_bringer(const ff_pipeline *pipeline, const ff_stage *stage, const char *wire,
                        size_t length, const char *dim)
{
    const ff_loaded *loaded = stage->loaded;
    for (size_t i = 0; i < loaded->model->input_count; i++) {
        const char *name = ff_model_input(loaded->model, i)->name;
        if (strcspn(name, ".") == length && !strncmp(name, wire, length) &&
            find_dim(&loaded->input_dims[i], dim) >= 0 && !fe_is_fed_back(stage, i) &&
            ff_feeding_result(pipeline, stage, i))
            return (int)i;
    }
    return -1;
}

/* Finds the origin of a dimension of the output that feeds an input. */
static fe_origin origin_of(const ff_pipeline *pipeline, const ff_stage *stage, size_t input,
                           const char *dim)
{
    for (size_t steps = 0; steps < pipeline->count; steps++) {
        const ff_result *given = ff_feeding_result(pipeline, stage, input);
        const ff_stage *from = &pipeline->stages[fe_input_wire(stage, input)->stage];
        const int at = find_dim(&from->loaded->output_dims[given - from->results], dim);
        size_t length;
        if (at < 0) /* the optional first dimension is absent here */
            break;
        const char *wire = fe_dim_wire(from->loaded->model, given->row, (uint32_t)at, &length);
        if (length == 0)
            return (fe_origin){.stage = from, .known = from->loaded->model->abi_minor >= 3};
        const int next = find_bringer(pipeline, from, wire, length, dim);
        if (next < 0)
            break;
        stage = from;
        input = (size_t)next;
    }
    return (fe_origin){.known = false};
}

/* Checks dimension number `at` of input `i`. A dimension may name another wire of the stage: the
   points of the input must then come from the stage that feeds this other wire. */
static bool check_dim(fe_build *b, const ff_stage *stage, size_t i, uint32_t at)
{
    const ff_loaded *loaded = stage->loaded;
    const ff_port *row = ff_model_input(loaded->model, i);
    const char *dim = loaded->input_dims[i].name[at];
    size_t length;
    const char *wire = fe_dim_wire(loaded->model, row, at, &length);
    const int k = find_bringer(b->pipeline, stage, wire, length, dim);
    if (k < 0)
        return true;
    const fe_origin here = origin_of(b->pipeline, stage, i, dim),
                    there = origin_of(b->pipeline, stage, (size_t)k, dim);
    if (!here.known || !there.known || here.stage == there.stage)
        return true;
    return ff_error(
        b->report, FF_FAULT_INPUT, fe_input_wire(stage, i)->place,
        fe_pipeline_print(b->pipeline,
                          "if the output that feeds it has the points of \"%s\", the model of that "
                          "output must declare the dimension as \"WIRE.%s\", where WIRE is its "
                          "wire to \"%s\"",
                          there.stage->name, dim, there.stage->name),
        "%s.%s is fed along \"%s\" of the stage \"%s\", but %s requires \"%s\" of the stage \"%s\"",
        stage->name, row->name, dim, here.stage->name, stage->use, dim, there.stage->name);
}

void fe_check_dims(fe_build *b)
{
    for (size_t s = 0; s < b->pipeline->count; s++) {
        ff_stage *stage = &b->pipeline->stages[s];
        const ff_loaded *loaded = stage->needed ? stage->loaded : NULL;
        const ff_wire *told = NULL;
        for (size_t i = 0; loaded && i < loaded->model->input_count; i++) {
            bool good = true;
            const bool fed = ff_feeding_result(b->pipeline, stage, i) && !fe_is_fed_back(stage, i);
            const ff_wire *wire = fe_input_wire(stage, i);
            for (uint32_t at = 0; fed && wire != told && at < loaded->input_dims[i].rank; at++)
                good = good && check_dim(b, stage, i, at);
            told = good ? told : wire;
            stage->instance->broken = stage->instance->broken || !good;
        }
    }
}
