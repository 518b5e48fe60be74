/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The run: each needed stage once, in order, with what its consumers and the user want. */
#include "build.h"

#include "../plugin/environment.h"
#include "../plugin/guard.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct run {
    ff_pipeline *pipeline;
    const ff_watch *watch;
    ff_report *report;
} run;

/* The length that each named dimension has, as first seen. */
typedef struct lengths {
    struct {
        const char *dim, *row;
        size_t length;
    } seen[FF_MAX_RANK * 256];
    size_t count;
} lengths;

/* Enters one array; on a second length of a dimension its entry, else NULL. */
static const char *enter_lengths(lengths *all, const char *row, const ff_dims *dims, uint32_t rank,
                                 const size_t *shape, char *why, size_t why_size)
{
    uint32_t absent = dims->rank - rank;
    for (uint32_t i = 0; i < rank; i++) {
        const char *dim = dims->name[i + absent];
        size_t k = 0;
        while (k < all->count && strcmp(all->seen[k].dim, dim) != 0)
            k++;
        if (k == all->count) {
            all->seen[k].dim = dim;
            all->seen[k].row = row;
            all->seen[k].length = shape[i];
            all->count++;
        } else if (all->seen[k].length != shape[i]) {
            snprintf(why, why_size, "the dimension \"%s\" is %zu long in \"%s\", but %zu in \"%s\"",
                     dim, all->seen[k].length, all->seen[k].row, shape[i], row);
            return why;
        }
    }
    return NULL;
}

static bool fault(const run *r, const ff_stage *stage, const char *text)
{
    return ff_error(r->report, FF_EXIT_PLUGIN, stage->use_place, NULL, "%s: the plugin %s %s",
                    stage->name, stage->loaded->path, text);
}

/* Every wired stage has run; else its failure is known already. */
static bool inputs_ran(const run *r, const ff_stage *stage)
{
    for (size_t i = 0; i < stage->wire_count; i++)
        if (stage->wires[i].stage >= 0 && !r->pipeline->stages[stage->wires[i].stage].ran)
            return false;
    return true;
}

static bool check_input(const run *r, const ff_stage *stage, size_t index, const ff_result *given,
                        lengths *all)
{
    const ff_port *row = ff_model_input(stage->loaded->model, index);
    const ff_dims *dims = &stage->loaded->input_dims[index];
    const ff_wire *wire = ff_input_wire(stage, index);
    char why[256];
    if (given->rank > dims->rank || given->rank + dims->first_optional < dims->rank)
        return ff_error(r->report, FF_EXIT_INPUT, wire->place, NULL,
                        "%s.%s: %s gives \"%s\" with %u dimensions, but %s takes it along \"%s\"",
                        stage->name, row->name, r->pipeline->stages[wire->stage].name,
                        given->row->name, given->rank, stage->use, row->dims);
    if (enter_lengths(all, row->name, dims, given->rank, given->shape, why, sizeof why))
        return ff_error(r->report, FF_EXIT_INPUT, wire->place,
                        "the stages that feed these wires must belong together", "%s.%s: %s",
                        stage->name, wire->name, why);
    return true;
}

static bool gather_inputs(const run *r, const ff_stage *stage, ff_array *in, lengths *all)
{
    bool good = true;
    for (size_t i = 0; i < stage->loaded->model->input_count; i++) {
        const ff_result *given = ff_feeding_result(r->pipeline, stage, i);
        in[i] = (ff_array){.data = NULL};
        if (!given || !given->data)
            continue;
        good = check_input(r, stage, i, given, all) && good;
        in[i] = (ff_array){.data = given->data, .shape = given->shape, .rank = given->rank};
    }
    return good;
}

static uint64_t wanted_bits(const ff_stage *stage)
{
    uint64_t wanted = 0;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++)
        if (stage->results[i].wanted)
            wanted |= UINT64_C(1) << i;
    return wanted;
}

/* What was wanted is there, shapes agree, and all numbers are finite. */
static bool check_results(const run *r, const ff_stage *stage, lengths *all)
{
    char why[256], text[320];
    for (size_t i = 0; i < stage->loaded->model->output_count; i++) {
        const ff_result *result = &stage->results[i];
        if (result->wanted && !result->data) {
            snprintf(text, sizeof text, "did not give the output \"%s\"", result->row->name);
            return fault(r, stage, text);
        }
        if (!result->data)
            continue;
        if (enter_lengths(all, result->row->name, &stage->loaded->output_dims[i], result->rank,
                          result->shape, why, sizeof why)) {
            snprintf(text, sizeof text, "contradicts itself: %s", why);
            return fault(r, stage, text);
        }
        for (size_t k = 0; k < result->count; k++)
            if (!isfinite(result->data[k])) {
                snprintf(text, sizeof text, "gave %s at index %zu of the output \"%s\"",
                         isnan(result->data[k]) ? "no number (NaN)" : "an infinite number", k,
                         result->row->name);
                return fault(r, stage, text);
            }
    }
    return true;
}

static bool check_quality(const run *r, const ff_stage *stage)
{
    bool good = true;
    for (size_t i = 0; i < stage->quality_count; i++) {
        const ff_quality *line = &stage->quality[i];
        if (line->verdict == FF_BAD)
            good = ff_error(r->report, FF_EXIT_FAILED, stage->place, NULL,
                            "%s: its result cannot be trusted: %s is %.3g, held to %.3g%s%s",
                            stage->name, line->name, line->value, line->limit,
                            line->text ? ": " : "", line->text ? line->text : "");
    }
    return good;
}

static double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void call_evaluate(const run *r, ff_stage *stage, uint64_t wanted, const ff_array *in)
{
    ff_instance *instance = stage->instance;
    ff_environment environment;
    ff_environment_keep(&environment);
    ff_instance_hush(instance);
    instance->watch = r->watch;
    instance->evaluating = true;
    double start = seconds_now();
    ff_guard_mark mark = ff_guard_enter(stage->loaded->path, stage->name, "evaluate");
    stage->status = stage->loaded->model->evaluate(instance->self, wanted, in);
    ff_guard_leave(mark);
    stage->seconds += seconds_now() - start;
    instance->evaluating = false;
    instance->watch = NULL;
    const char *changed = ff_environment_restore(&environment);
    if (changed)
        ff_warn(r->report, stage->use_place,
                "%s: the plugin %s %s during evaluate; this was set back", stage->name,
                stage->loaded->path, changed);
}

/*
 * A model may refuse an output that its inputs do not allow. When nobody asked for that one by
 * name ("film.*") and no required input needs it, it is done without. True when there was one.
 */
static bool drop_refused(ff_stage *stage)
{
    const ff_instance *instance = stage->instance;
    int output = ff_model_find_output(stage->loaded->model, instance->item);
    if (stage->status != FF_UNSUPPORTED || instance->fault[0] || output < 0 ||
        !stage->results[output].wanted || (instance->demanded >> output & 1))
        return false;
    stage->results[output].wanted = stage->results[output].asked = false;
    return true;
}

/* False after an error. A stage that is needed for its service alone has nothing to compute. */
static bool evaluate(const run *r, ff_stage *stage, const ff_array *in, lengths *all)
{
    do {
        ff_forget_results(stage);
        uint64_t wanted = wanted_bits(stage);
        stage->status = FF_OK;
        if (wanted == 0)
            return true;
        call_evaluate(r, stage, wanted, in);
    } while (drop_refused(stage));
    return ff_judge(stage, "evaluate", stage->status, r->report) && check_results(r, stage, all);
}

static bool run_stage(const run *r, ff_stage *stage)
{
    lengths *all = ff_alloc(sizeof *all);
    ff_array *in = ff_alloc(stage->loaded->model->input_count * sizeof *in);
    bool good = gather_inputs(r, stage, in, all);
    if (good) {
        all->count = 0;
        stage->ran = evaluate(r, stage, in, all);
        good = check_quality(r, stage) && stage->ran;
    }
    free(in);
    free(all);
    return good;
}

bool ff_pipeline_run(ff_pipeline *pipeline, const ff_watch *watch, ff_report *report)
{
    run r = {.pipeline = pipeline, .watch = watch, .report = report};
    bool good = true;
    if (pipeline->memory->study.source)
        return ff_error(report, FF_EXIT_INPUT, pipeline->memory->study, NULL,
                        "study: studies are not in this version, which runs single cases");
    for (size_t i = 0; i < pipeline->count; i++) {
        pipeline->stages[i].ran = false;
        pipeline->stages[i].status = FF_OK;
        pipeline->stages[i].seconds = 0;
    }
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[pipeline->order[i]];
        if (!stage->needed)
            continue;
        if (!stage->instance->alive || !inputs_ran(&r, stage)) {
            good = false;
            continue;
        }
        good = run_stage(&r, stage) && good;
        if (stage->status == FF_STOPPED)
            return false;
    }
    return good;
}
