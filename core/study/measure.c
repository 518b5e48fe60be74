/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * What a measured case says: the work of the stages in which cases differ, counts of work, the
 * error that its models claim, and the outputs that matter, with what they are plotted against.
 */
#include "private.h"

#include <math.h>
#include <sched.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

uint64_t ff_measure_print(uint64_t print, size_t repeat)
{
    print = ff_hash_text(print, "measured");
    return ff_hash(print, &repeat, sizeof repeat);
}

void ff_measure_pin(void)
{
    cpu_set_t set;
    int core = sched_getcpu();
    CPU_ZERO(&set);
    if (core < 0)
        return;
    CPU_SET((size_t)core, &set);
    sched_setaffinity(0, sizeof set, &set); /* without it, the spread shows more */
}

/* "stage.name": the stage of the pipeline that runs, or NULL, and the name behind the dot. */
static ff_stage *find_stage(const ff_pipeline *pipeline, const char *path, const char **name)
{
    size_t length = strcspn(path, ".");
    *name = path[length] ? path + length + 1 : "";
    for (size_t i = 0; i < pipeline->count; i++) {
        ff_stage *stage = &pipeline->stages[i];
        if (stage->needed && strlen(stage->name) == length && !strncmp(stage->name, path, length))
            return stage;
    }
    return NULL;
}

/* The result of that name; NULL: the model has none, or it is a service. */
static ff_result *find_result(const ff_stage *stage, const char *name)
{
    int output = ff_model_find_output(stage->loaded->model, name);
    ff_result *result = output < 0 ? NULL : &stage->results[output];
    return result && !result->row->service ? result : NULL;
}

/* How well a result serves as what `self` is plotted against: 0 not at all. */
static int rank_as_axis(const ff_measure *m, const ff_result *result, const ff_result *self)
{
    const char *dims = self->row->dims, *unit = result->row->unit, *name = result->row->name;
    if (result == self || result->row->service || !result->row->dims || !dims ||
        strcmp(result->row->dims, dims) != 0 || !*dims || strpbrk(dims, " "))
        return 0;
    if (m->along)
        return !strcmp(name, m->along) ? 4 : 0;
    return !strcmp(name, dims) ? 3 : !strcmp(unit, "rad") ? 2 : !strcmp(unit, "s") ? 1 : 0;
}

static char *name_of_claim(const ff_result *result)
{
    return ff_print_text("%s_error", result->row->name);
}

/* The estimates that the study names for an output; NULL: none. */
static const char *const *claims_of(const ff_measure *m, size_t output)
{
    return m->claims ? m->claims[output] : NULL;
}

/* The estimates that are results, one after the other; NULL behind the last. */
static ff_result *claimed_result(const ff_measure *m, const ff_stage *stage, size_t output,
                                 const ff_result *result, size_t i)
{
    ff_result *found = NULL;
    if (claims_of(m, output))
        for (size_t k = 0; claims_of(m, output)[k]; k++) {
            found = find_result(stage, claims_of(m, output)[k]);
            if (found && i-- == 0)
                return found;
        }
    else if (i == 0) {
        char *name = name_of_claim(result);
        found = find_result(stage, name);
        free(name);
        return found;
    }
    return NULL;
}

void ff_measure_want(const ff_measure *m, const ff_pipeline *pipeline)
{
    const char *name;
    for (size_t i = 0; i < m->output_count; i++) {
        const ff_stage *stage = find_stage(pipeline, m->request->items[i]->text, &name);
        const ff_result *self = stage ? find_result(stage, name) : NULL;
        for (size_t k = 0; self && k < stage->loaded->model->output_count; k++)
            if (rank_as_axis(m, &stage->results[k], self))
                stage->results[k].wanted = true;
        ff_result *claim;
        for (size_t k = 0; self && (claim = claimed_result(m, stage, i, self, k)); k++)
            claim->wanted = true;
    }
    for (size_t i = 0; i < m->count_count; i++) {
        const ff_stage *stage = find_stage(pipeline, m->counts[i], &name);
        ff_result *result = stage ? find_result(stage, name) : NULL;
        if (result)
            result->wanted = true;
    }
}

bool *ff_measure_fresh(const ff_measure *m, const ff_pipeline *pipeline)
{
    bool *fresh = ff_alloc((pipeline->count + 1) * sizeof *fresh);
    for (size_t i = 0; i < pipeline->count; i++) {
        size_t at = pipeline->order[i];
        const ff_stage *stage = &pipeline->stages[at];
        fresh[at] = m->all;
        for (size_t k = 0; k < m->knob_count; k++)
            fresh[at] = fresh[at] || !strcmp(m->knobs[k], stage->name);
        for (size_t k = 0; k < stage->wire_count; k++)
            fresh[at] = fresh[at] || (stage->wires[k].stage >= 0 && fresh[stage->wires[k].stage]);
    }
    return fresh;
}

static const ff_quality *find_line(const ff_stage *stage, const char *name)
{
    for (size_t i = 0; i < stage->quality_count; i++)
        if (!strcmp(stage->quality[i].name, name))
            return &stage->quality[i];
    return NULL;
}

static bool rises(const ff_result *result)
{
    for (size_t i = 1; i < result->count; i++)
        if (!(result->data[i] >= result->data[i - 1]))
            return false;
    return result->count > 1 && result->data[result->count - 1] > result->data[0];
}

static const ff_result *find_axis(const ff_measure *m, const ff_stage *stage, const ff_result *self)
{
    const ff_result *best = NULL;
    int rank = 0;
    for (size_t k = 0; k < stage->loaded->model->output_count; k++) {
        const ff_result *result = &stage->results[k];
        int here = result->data && result->rank == 1 && result->count == self->count
                       ? rank_as_axis(m, result, self)
                       : 0;
        if (here > rank && rises(result)) {
            rank = here;
            best = result;
        }
    }
    return best;
}

static double largest_of(const ff_result *result)
{
    double most = 0;
    for (size_t i = 0; i < result->count; i++)
        most = fmax(most, fabs(result->data[i]));
    return most;
}

/* What an error at a value is relative to: where a series is small, a tenth of its largest value. A
   friction that changes its sign has no error relative to its zero. */
static double scale_of(double value, double most, size_t rank)
{
    return fmax(rank ? fmax(fabs(value), 0.1 * most) : fabs(value), 1e-300);
}

/* The largest of an estimate in the unit of the result, over the scale of the result there. */
static double relative_claim(const ff_result *claim, const ff_result *result)
{
    double largest = 0, most = largest_of(result);
    if (claim->count != result->count || claim->rank != result->rank)
        return NAN;
    for (size_t i = 0; i < result->count; i++)
        largest =
            fmax(largest, fabs(claim->data[i]) / scale_of(result->data[i], most, result->rank));
    return largest;
}

/* Lines of quality that are named "<output>_..._error": shares of the output. */
static bool is_claim(const char *line, const char *output)
{
    size_t length = strlen(line), stem = strlen(output);
    return length > stem + 6 && !strncmp(line, output, stem) && line[stem] == '_' &&
           !strcmp(line + length - 6, "_error");
}

/* What the stage says of the error of an output, relative; NAN: nothing. */
static double find_claim(const ff_measure *m, const ff_stage *stage, size_t output,
                         const ff_result *result)
{
    double sum = 0;
    bool some = false;
    const ff_result *claim;
    for (size_t k = 0; (claim = claimed_result(m, stage, output, result, k)); k++)
        if (claim->data) {
            sum += relative_claim(claim, result);
            some = true;
        }
    if (some && !claims_of(m, output))
        return sum;
    for (size_t i = 0; i < stage->quality_count; i++) {
        const ff_quality *line = &stage->quality[i];
        bool named = !claims_of(m, output) && is_claim(line->name, result->row->name);
        for (size_t k = 0; claims_of(m, output) && claims_of(m, output)[k]; k++)
            named = named || !strcmp(claims_of(m, output)[k], line->name);
        if (named)
            sum += line->value;
        some = some || named;
    }
    return some ? sum : NAN;
}

static json_t *real(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *list_of(const ff_result *result)
{
    json_t *list = json_array();
    for (size_t i = 0; i < result->count; i++)
        json_array_append_new(list, real(result->data[i]));
    return list;
}

/* {output: {unit, values, along, at}}, the last two of a series that is plotted against another. */
static json_t *collect(const ff_measure *m, const ff_pipeline *pipeline, json_t *claims)
{
    json_t *all = json_object();
    const char *name;
    for (size_t i = 0; i < m->output_count; i++) {
        const char *path = m->request->items[i]->text;
        const ff_stage *stage = find_stage(pipeline, path, &name);
        const ff_result *result = stage ? find_result(stage, name) : NULL;
        if (!result || !result->data)
            continue;
        const ff_result *axis = result->rank == 1 ? find_axis(m, stage, result) : NULL;
        json_t *one = json_pack("{s:s, s:i, s:o}", "unit", result->row->unit, "rank",
                                (int)result->rank, "values", list_of(result));
        if (axis)
            json_object_update_new(
                one, json_pack("{s:s, s:o}", "along", axis->row->name, "at", list_of(axis)));
        json_object_set_new(all, path, one);
        double claim = find_claim(m, stage, i, result);
        if (isfinite(claim))
            json_object_set_new(claims, path, json_real(claim));
    }
    return all;
}

static json_t *collect_counts(const ff_measure *m, const ff_pipeline *pipeline)
{
    json_t *counts = json_object();
    const char *name;
    for (size_t i = 0; i < m->count_count; i++) {
        const ff_stage *stage = find_stage(pipeline, m->counts[i], &name);
        const ff_result *result = stage ? find_result(stage, name) : NULL;
        const ff_quality *line = stage ? find_line(stage, name) : NULL;
        double sum = 0;
        for (size_t k = 0; result && result->data && k < result->count; k++)
            sum += result->data[k];
        if ((result && result->data) || line)
            json_object_set_new(counts, m->counts[i],
                                real(result && result->data ? sum : line->value));
    }
    return counts;
}

/* The line in the journal is what makes it valid. */
static bool write_values(const json_t *values, const char *directory, const char *key,
                         ff_report *report)
{
    char *folder = ff_print_text("%s/values", directory), *name = ff_print_text("%s.json", key);
    char *text = json_dumps(values, JSON_COMPACT | JSON_REAL_PRECISION(17));
    mkdir(folder, 0777); /* it may be there */
    bool good = text && ff_put_file(folder, name, text, NULL, report);
    free(folder);
    free(name);
    free(text);
    return good;
}

bool ff_measure_record(const ff_case *c, const ff_campaign *campaign, size_t index, json_t *record)
{
    const ff_measure *m = campaign->study->measure;
    const ff_pipeline *pipeline = c->pipeline;
    bool *fresh = ff_measure_fresh(m, pipeline);
    json_t *claims = json_object(), *work = json_object();
    json_t *values = collect(m, pipeline, claims);
    for (size_t i = 0; i < pipeline->count; i++)
        if (fresh[i] && pipeline->stages[i].ran)
            json_object_set_new(work, pipeline->stages[i].name,
                                json_real(pipeline->stages[i].work));
    json_object_set_new(record, "measured",
                        json_pack("{s:o, s:o, s:o}", "work", work, "counts",
                                  collect_counts(m, pipeline), "claims", claims));
    free(fresh);
    bool written =
        m->repeat[index] > 0 || write_values(values, campaign->directory, c->key, c->report);
    json_decref(values);
    return written;
}

json_t *ff_measure_values(const char *directory, const char *key)
{
    char *path = ff_print_text("%s/values/%s.json", directory, key);
    json_t *values = json_load_file(path, 0, NULL);
    free(path);
    return values;
}
