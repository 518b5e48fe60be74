/* SPDX-License-Identifier: MIT */
/* The input and output arrays of a stage. Checks that their dimensions agree and that their numbers
   are finite. */
#include "build.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool fe_rank_fits(const ff_dims *dims, uint32_t rank)
{
    return rank <= dims->rank && rank + dims->first_optional >= dims->rank;
}

bool fe_enter_lengths(fe_lengths *all, const ff_model *model, const ff_port *row,
                      const ff_dims *dims, uint32_t rank, const size_t *shape, char *why,
                      size_t why_size)
{
    assert(fe_rank_fits(dims, rank));
    for (uint32_t i = 0; i < rank; i++) {
        const uint32_t at = i + dims->rank - rank;
        const char *dim = dims->name[at];
        size_t k = 0, length;
        const char *wire = fe_dim_wire(model, row, at, &length);
        while (k < all->count &&
               (strcmp(all->seen[k].dim, dim) != 0 || all->seen[k].wire_length != length ||
                strncmp(all->seen[k].wire, wire, length) != 0))
            k++;
        if (k == all->count) {
            all->seen = fe_resize(all->seen, (k + 1) * sizeof *all->seen);
            all->seen[k].wire = wire;
            all->seen[k].wire_length = length;
            all->seen[k].dim = dim;
            all->seen[k].row = row->name;
            all->seen[k].length = shape[i];
            all->count++;
        }
        if (all->seen[k].length == shape[i])
            continue;
        snprintf(why, why_size, "the dimension \"%s\" is %zu long in \"%s\", but %zu in \"%s\"",
                 dim, all->seen[k].length, all->seen[k].row, shape[i], row->name);
        return false;
    }
    return true;
}

static bool check_input(const ff_pipeline *pipeline, const ff_stage *stage, size_t input,
                        const ff_result *given, fe_lengths *all, ff_report *report)
{
    const ff_port *row = ff_model_input(stage->loaded->model, input);
    const ff_dims *dims = &stage->loaded->input_dims[input];
    const ff_wire *wire = fe_input_wire(stage, input);
    char why[256];
    if (!fe_rank_fits(dims, given->rank))
        return ff_error(report, FF_FAULT_INPUT, wire->place, NULL,
                        "%s.%s: %s gives \"%s\" with %u dimensions, but %s takes it along \"%s\"",
                        stage->name, row->name, pipeline->stages[wire->stage].name,
                        given->row->name, given->rank, stage->use, row->dims);
    return fe_enter_lengths(all, stage->loaded->model, row, dims, given->rank, given->shape, why,
                            sizeof why) ||
           ff_error(report, FF_FAULT_INPUT, wire->place,
                    "the stages that feed these wires must belong together", "%s.%s: %s",
                    stage->name, wire->name, why);
}

/* Takes the array of a feedback wire from the round before. If its lengths contradict the lengths
   on other wires, the array is left out, with an error that counts only in the last round. */
static void take_fed_back(const ff_pipeline *pipeline, const ff_stage *stage, size_t input,
                          fe_lengths *all, ff_array *in, ff_report *report)
{
    const ff_result *fed = &stage->instance->member->fed[input];
    size_t known = all->count;
    if (!fed->data)
        return;
    if (check_input(pipeline, stage, input, fed, all, report))
        *in = (ff_array){.data = fed->data, .shape = fed->shape, .rank = fed->rank};
    else
        all->count = known;
}

size_t fe_count(const ff_array *array)
{
    size_t count = array->data ? 1 : 0;
    for (uint32_t i = 0; array->data && i < array->rank; i++)
        count *= array->shape[i];
    return count;
}

static uint64_t sum_of(const ff_array *array)
{
    uint64_t sum = 0, word;
    for (size_t i = 0; i < fe_count(array); i++) {
        memcpy(&word, &array->data[i], sizeof word);
        sum = (sum ^ word ^ sum >> 32) * 0x9e3779b97f4a7c15;
    }
    return sum;
}

uint64_t *fe_sum_inputs(const ff_stage *stage, const ff_array *in)
{
    size_t count = stage->loaded->model->input_count;
    uint64_t *sums = fe_alloc(count * sizeof *sums);
    for (size_t i = 0; i < count; i++)
        sums[i] = sum_of(&in[i]);
    return sums;
}

bool fe_check_inputs(const ff_stage *stage, const ff_array *in, const uint64_t *sums,
                     ff_report *report)
{
    char what[256];
    for (size_t i = 0; i < stage->loaded->model->input_count; i++) {
        const char *name = ff_model_input(stage->loaded->model, i)->name;
        const char *where = in[i].data ? ff_guarded_breach(in[i].data, fe_count(&in[i])) : NULL;
        if (where)
            snprintf(what, sizeof what, "wrote %s the array of its input \"%s\"", where, name);
        else if (sums[i] != sum_of(&in[i]))
            snprintf(what, sizeof what, "changed its input \"%s\"", name);
        else
            continue;
        return fe_shared_fault(stage, report, what);
    }
    return true;
}

bool fe_gather_inputs(const ff_pipeline *pipeline, const ff_stage *stage, ff_array *in,
                      ff_report *report)
{
    fe_lengths all = {.count = 0};
    bool good = true;
    for (size_t i = 0; i < stage->wire_count; i++)
        if (stage->wires[i].stage >= 0 && !stage->wires[i].closes &&
            !pipeline->stages[stage->wires[i].stage].ran)
            return false;
    for (size_t i = 0; i < stage->loaded->model->input_count; i++) {
        const ff_result *given = ff_feeding_result(pipeline, stage, i);
        if (!given || !given->data || fe_is_fed_back(stage, i))
            continue;
        good = check_input(pipeline, stage, i, given, &all, report) && good;
        in[i] = (ff_array){.data = given->data, .shape = given->shape, .rank = given->rank};
    }
    for (size_t i = 0; i < stage->loaded->model->input_count; i++)
        if (stage->instance->member)
            take_fed_back(pipeline, stage, i, &all, &in[i], report);
    fe_free(all.seen);
    return good;
}

void fe_drop_untouched(ff_stage *stage)
{
    const ff_model *model = stage->loaded->model;
    for (size_t i = 0; i < model->output_count && model->abi_minor >= 3; i++) {
        ff_result *result = &stage->results[i];
        bool untouched = false;
        for (size_t k = 0; !result->wanted && result->data && k < result->count; k++)
            untouched = untouched || isnan(result->data[k]);
        if (!untouched)
            continue;
        ff_guarded_free(result->data, result->count);
        result->data = NULL;
    }
}

/* Whether the output may be infinite, as an unknown error estimate is. */
static bool may_be_infinite(const ff_port *row)
{
    static const char ending[] = "_error";
    size_t length = strlen(row->name), end = strlen(ending);
    return length > end && !strcmp(row->name + length - end, ending);
}

/* Whether an output is unusable; `why` then completes 'the plugin ...'. */
static bool is_faulty(const ff_stage *stage, size_t output, fe_lengths *all, char *why, size_t size)
{
    const ff_result *result = &stage->results[output];
    const char *name = result->row->name;
    char clash[256];
    if (!result->data) {
        snprintf(why, size, "did not give the output \"%s\"", name);
        return result->wanted;
    }
    if (!fe_enter_lengths(all, stage->loaded->model, result->row,
                          &stage->loaded->output_dims[output], result->rank, result->shape, clash,
                          sizeof clash)) {
        snprintf(why, size, "contradicts itself: %s", clash);
        return true;
    }
    for (size_t k = 0; k < result->count; k++) {
        if (isfinite(result->data[k]) || (result->data[k] > 0 && may_be_infinite(result->row)))
            continue;
        snprintf(why, size, "gave %s at index %zu of the output \"%s\"",
                 isnan(result->data[k]) ? "NaN" : "an infinite number", k, name);
        return true;
    }
    return false;
}

/* Records the lengths of the inputs, which also apply to an output along "gear.station". */
static void enter_inputs(const ff_stage *stage, const ff_array *in, fe_lengths *all)
{
    const ff_model *model = stage->loaded->model;
    char why[256];
    for (size_t i = 0; in && model->abi_minor >= 3 && i < model->input_count; i++)
        if (in[i].data)
            fe_enter_lengths(all, model, ff_model_input(model, i), &stage->loaded->input_dims[i],
                             in[i].rank, in[i].shape, why, sizeof why);
}

bool fe_check_results(const ff_stage *stage, const ff_array *in, ff_report *report)
{
    fe_lengths all = {.count = 0};
    char why[320];
    bool good = true;
    enter_inputs(stage, in, &all);
    for (size_t i = 0; i < stage->loaded->model->output_count && good; i++)
        if (is_faulty(stage, i, &all, why, sizeof why))
            good = fe_plugin_fault(stage, report, why);
    fe_free(all.seen);
    return good;
}
