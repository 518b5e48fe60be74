/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the result of a trade-off: error and cost of every candidate, and the Pareto fronts. */
#include "tradeoff.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

const study_outcome *study_tradeoff_outcome(const study_tradeoff *t, size_t point)
{
    return study_outcome_of(t->context, study_tradeoff_case(t, point, 0));
}

static accuracy_series series_of(const study_output *output)
{
    return (accuracy_series){output->rank, output->count, output->at, output->values, 0, false};
}

bool study_tradeoff_compare(const study_tradeoff *t, size_t a, size_t b, size_t output,
                            accuracy_difference *d)
{
    const study_output *answer = &study_tradeoff_outcome(t, a)->outputs[output];
    const study_output *reference = &study_tradeoff_outcome(t, b)->outputs[output];
    if (!answer->values || !reference->values || strcmp(answer->along, reference->along) != 0)
        return false;
    accuracy_series one = series_of(answer), other = series_of(reference);
    return accuracy_compare(&one, &other, d);
}

static json_t *processor(void)
{
    char line[256];
    json_t *name = NULL;
    FILE *stream = fopen("/proc/cpuinfo", "re");
    while (stream && !name && fgets(line, sizeof line, stream)) {
        const char *colon = strchr(line, ':');
        line[strcspn(line, "\n")] = '\0';
        if (!strncmp(line, "model name", 10) && colon)
            name = json_string(colon + 1 + strspn(colon + 1, " "));
    }
    if (stream)
        fclose(stream);
    return name ? name : json_string("unknown");
}

static json_t *today(void)
{
    char text[32] = "";
    time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc))
        strftime(text, sizeof text, "%Y-%m-%d", &utc);
    return json_string(text);
}

/* Processor time of a case: of the stages that the knobs touch, or of the whole run; NaN if it
   failed. */
static double work_of(const study_outcome *answer, bool whole)
{
    return whole && isfinite(answer->work) ? answer->processor + answer->saved : answer->work;
}

static json_t *cost_of(const study_tradeoff *t, size_t point, bool whole, double *median)
{
    double *all = memory_arena_alloc(&t->context->arena, t->repeats * sizeof *all);
    size_t count = 0;
    for (size_t i = 0; i < t->repeats; i++) {
        double work =
            work_of(study_outcome_of(t->context, study_tradeoff_case(t, point, i)), whole);
        if (isfinite(work))
            all[count++] = work;
    }
    memory_sort(all, count, sizeof *all);
    *median = count ? (all[(count - 1) / 2] + all[count / 2]) / 2 : (double)NAN;
    return count ? json_pack("{s:f, s:f, s:f, s:o, s:I}", "median", *median, "min", all[0], "max",
                             all[count - 1], "spread",
                             study_json_real((all[count - 1] - all[0]) / *median), "repeats",
                             (json_int_t)count)
                 : json_null();
}

/* Difference of the last two levels of the reference; smaller errors cannot be distinguished. */
static double floor_of(const study_tradeoff *t, size_t levels, size_t output)
{
    accuracy_difference d;
    bool known = levels > 1 && study_tradeoff_compare(t, levels - 2, levels - 1, output, &d);
    return known ? d.typical : 0;
}

/* The error stated by the answer itself: its output "film.h_min_error", else the quality line of
 * that name, which is relative; NaN if it has neither. */
static double stated_error(const study_tradeoff *t, size_t point, size_t output, bool absolute)
{
    const study_outcome *answer = study_tradeoff_outcome(t, point);
    const study_context *context = t->context;
    const size_t extra = t->count_count + output;
    const study_output *estimate = &answer->outputs[context->output_count + extra];
    accuracy_series own = series_of(&answer->outputs[output]);
    double largest;
    own.absolute = absolute;
    bool known = estimate->values && estimate->count == own.count;
    for (size_t i = 0; known && i < own.count; i++)
        if (isnan(estimate->values[i]))
            return NAN;
    if (known)
        return accuracy_relative(estimate->values, &own, &largest);
    const study_quality *line = study_line_of(answer, context->extras[extra]);
    return line && !absolute ? line->value : (double)NAN;
}

static json_t *error_of(const study_tradeoff *t, size_t point, size_t reference, size_t output,
                        double *error)
{
    accuracy_difference d;
    *error = NAN;
    if (!study_tradeoff_compare(t, point, reference, output, &d))
        return json_null();
    *error = d.typical;
    return json_pack("{s:f, s:f, s:o}", "error", d.typical, "largest", d.largest, "stated",
                     study_json_real(stated_error(t, point, output, d.absolute)));
}

bool study_tradeoff_has_settled(const study_tradeoff *t, size_t level, size_t output)
{
    accuracy_difference d;
    return study_tradeoff_compare(t, level - 1, level, output, &d) &&
           d.typical <= (d.absolute ? 0 : t->accuracy / 10);
}

static json_t *describe_reference(const study_tradeoff *t, size_t levels)
{
    json_t *list = json_array(), *kept = json_array();
    for (size_t level = 0; level < levels; level++) {
        json_t *changes = json_object();
        for (size_t i = 0; level > 0 && i < t->context->output_count; i++) {
            const char *name = t->context->outputs[i]->text;
            accuracy_difference d = {.absolute = false};
            bool good = study_tradeoff_compare(t, level - 1, level, i, &d);
            json_object_set_new(changes, name,
                                json_pack("{s:o, s:b}", "by",
                                          study_json_real(good ? d.typical : (double)NAN),
                                          "absolute", (int)d.absolute));
            if (level == levels - 1 && !study_tradeoff_has_settled(t, level, i))
                json_array_append_new(kept, json_string(name));
        }
        json_array_append_new(
            list,
            json_pack("{s:s, s:o, s:o}", "label", t->points[level].label, "seconds",
                      study_json_real(study_tradeoff_outcome(t, level)->work), "change", changes));
    }
    const bool reached = levels > 1 && json_array_size(kept) == 0;
    return json_pack("{s:b, s:b, s:o, s:o}", "reached", (int)reached, "stalled", (int)t->stalled,
                     "unsettled", kept, "levels", list);
}

/* Describes the front and the cost and gain of each step along it; marks the errors on the front.
 */
static json_t *describe_front(const study_tradeoff *t, const double *cost, const double *error,
                              json_t *const *errors)
{
    size_t count = t->candidates;
    size_t *front = memory_arena_alloc(&t->context->arena, (count + 1) * sizeof *front);
    size_t length = study_front(cost, error, count, front);
    size_t knee = study_front_knee(cost, error, front, length);
    json_t *list = json_array();
    for (size_t c = 0; c < count; c++)
        if (json_is_object(errors[c]))
            json_object_set_new(errors[c], "front", json_false());
    for (size_t i = 0; i < length; i++) {
        json_t *one =
            json_pack("{s:I, s:f, s:f, s:b}", "candidate", (json_int_t)front[i], "seconds",
                      cost[front[i]], "error", error[front[i]], "knee", (int)(i == knee));
        if (i > 0)
            json_object_update_new(
                one, json_pack("{s:f, s:f}", "times_the_cost", cost[front[i]] / cost[front[i - 1]],
                               "part_of_the_error", error[front[i]] / error[front[i - 1]]));
        json_object_set_new(errors[front[i]], "front", json_true());
        json_object_set_new(errors[front[i]], "knee", json_boolean(i == knee));
        json_array_append_new(list, one);
    }
    return list;
}

/* A count of work, from a result or a quality line; NaN if the case has none. */
static double count_of(const study_tradeoff *t, const study_outcome *answer, size_t count)
{
    const study_output *result = &answer->outputs[t->context->output_count + count];
    const study_quality *line = study_line_of(answer, t->counts[count]);
    double sum = 0;
    for (size_t i = 0; result->values && i < result->count; i++)
        sum += result->values[i];
    return result->values ? sum : line ? line->value : (double)NAN;
}

static json_t *describe_candidate(const study_tradeoff *t, size_t point, double *cost)
{
    const study_point *p = &t->points[point];
    const study_outcome *answer = study_tradeoff_outcome(t, point);
    json_t *set = json_object(), *record = json_object(), *assignments = json_array();
    json_t *counts = json_object();
    for (size_t k = 0; k < t->knob_count; k++) {
        if (!p->assignments[k])
            continue;
        json_object_set_new(set, t->knobs[k], json_string(p->values[k]));
        json_array_append_new(assignments, json_string(p->assignments[k]));
    }
    for (size_t i = 0; i < t->count_count; i++) {
        double count = count_of(t, answer, i);
        if (isfinite(count))
            json_object_set_new(counts, t->counts[i], json_real(count));
    }
    json_object_set_new(record, "label", json_string(p->label));
    json_object_set_new(record, "set", set);
    json_object_set_new(record, "assignments", assignments);
    json_object_set_new(record, "status", json_string(answer->status));
    if (*answer->reason)
        json_object_set_new(record, "reason", json_string(answer->reason));
    double whole;
    json_object_set_new(record, "seconds", cost_of(t, point, false, cost));
    json_object_set_new(record, "whole", cost_of(t, point, true, &whole));
    json_object_set_new(record, "shared_seconds", json_real(answer->shared));
    json_object_set_new(record, "counts", counts);
    json_object_set_new(record, "errors", json_object());
    return record;
}

/* Adds the errors of all candidates for an output, and returns the Pareto front of errors and
 * costs. */
static json_t *describe_output(const study_tradeoff *t, size_t levels, size_t output, json_t *list,
                               const double *cost)
{
    const char *name = t->context->outputs[output]->text;
    double floor = floor_of(t, levels, output);
    double *error = memory_arena_alloc(&t->context->arena, t->candidates * sizeof *error);
    json_t **errors = memory_arena_alloc(&t->context->arena, t->candidates * sizeof *errors);
    for (size_t c = 0; c < t->candidates; c++) {
        errors[c] = error_of(t, t->levels + c, levels - 1, output, &error[c]);
        json_object_set_new(json_object_get(json_array_get(list, c), "errors"), name, errors[c]);
        if (isfinite(error[c])) /* smaller errors cannot be distinguished */
            error[c] = fmax(error[c], fmax(floor, 1e-15));
    }
    json_t *front = describe_front(t, cost, error, errors);
    for (size_t c = 0; c < t->candidates; c++)
        if (json_is_object(errors[c]))
            json_object_set_new(errors[c], "over_front",
                                study_json_real(study_front_excess(cost, error, t->candidates, c)));
    accuracy_difference d;
    bool absolute = study_tradeoff_compare(t, levels - 1, levels - 1, output, &d) && d.absolute;
    return json_pack("{s:b, s:f, s:o}", "absolute", (int)absolute, "reference_error", floor,
                     "front", front);
}

json_t *study_tradeoff_result(const study_tradeoff *t, size_t levels)
{
    json_t *list = json_array(), *fronts = json_object();
    double *cost = memory_arena_alloc(&t->context->arena, t->candidates * sizeof *cost);
    for (size_t c = 0; c < t->candidates; c++)
        json_array_append_new(list, describe_candidate(t, t->levels + c, &cost[c]));
    for (size_t i = 0; i < t->context->output_count; i++)
        json_object_set_new(fronts, t->context->outputs[i]->text,
                            describe_output(t, levels, i, list, cost));
    return json_pack("{s:o, s:o, s:f, s:o, s:o, s:o}", "date", today(), "processor", processor(),
                     "accuracy", t->accuracy, "reference", describe_reference(t, levels),
                     "candidates", list, "outputs", fronts);
}
