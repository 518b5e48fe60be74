/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints a trade-off on the terminal and writes it as a table. */
#include "tradeoff.h"

#include <string.h>

/* Returns the entry for a candidate on the front of an output; NULL when it is not on the front. */
static const json_t *on_front(const json_t *output, size_t candidate)
{
    size_t i;
    json_t *one;
    json_array_foreach(json_object_get(output, "front"), i,
                       one) if ((size_t)json_integer_value(json_object_get(one, "candidate")) ==
                                candidate) return one;
    return NULL;
}

/* Sorts candidates by rising cost, with those without a cost last. */
static size_t *sort_by_cost(study_context *context, const json_t *candidates)
{
    size_t count = json_array_size(candidates);
    size_t *order = memory_arena_alloc(&context->arena, (count + 1) * sizeof *order);
    double *cost = memory_arena_alloc(&context->arena, (count + 1) * sizeof *cost);
    for (size_t i = 0; i < count; i++) {
        const json_t *seconds = json_object_get(json_array_get(candidates, i), "seconds");
        cost[i] = json_is_object(seconds) ? study_number_of(seconds, "median") : 1e300;
        size_t k = i;
        for (; k > 0 && cost[order[k - 1]] > cost[i]; k--)
            order[k] = order[k - 1];
        order[k] = i;
    }
    return order;
}

/* Returns {name: null} for every count that some candidate has. */
static json_t *names_of_counts(const json_t *candidates)
{
    json_t *names = json_object(), *candidate, *value;
    const char *name;
    size_t i;
    json_array_foreach(candidates, i, candidate)
        json_object_foreach(json_object_get(candidate, "counts"), name, value)
            json_object_set_new(names, name, json_null());
    return names;
}

/* Prints the row of a candidate; `count` names the count that has a column, or is NULL. */
static void print_row(study_context *context, const json_t *candidate, const json_t *error,
                      const json_t *place, const char *count)
{
    const json_t *seconds = json_object_get(candidate, "seconds");
    double median = study_number_of(seconds, "median");
    double spread =
        median > 0 ? (study_number_of(seconds, "max") - study_number_of(seconds, "min")) / median
                   : 0;
    study_line line = {0};
    study_line_add(&line, "%c ", place ? '*' : ' ');
    if (json_is_object(error))
        study_line_add(&line, "%8.3g %8.3g ", 100 * study_number_of(error, "largest"),
                       100 * study_number_of(error, "rms"));
    else
        study_line_add(&line, "%8s %8s ", "-", "-");
    if (json_is_object(seconds))
        study_line_add(&line, "%9.3g %6.0f ", median, 100 * spread);
    else
        study_line_add(&line, "%9s %6s ", "-", "-");
    if (count && json_object_get(json_object_get(candidate, "counts"), count))
        study_line_add(&line, "%8.0f ",
                       study_number_of(json_object_get(candidate, "counts"), count));
    else if (count)
        study_line_add(&line, "%8s ", "");
    study_line_add(&line, " ");
    const char *reason = study_text_of(candidate, "reason");
    study_line_add(&line, "%s%s%s%s", study_text_of(candidate, "label"), *reason ? ": " : "",
                   reason, json_is_true(json_object_get(place, "knee")) ? "  <- knee" : "");
    study_line_print(context, &line, 0);
}

static void print_front(study_context *context, const json_t *candidates, const json_t *front)
{
    study_line line = {0};
    size_t i;
    json_t *one;
    study_context_print_line(context, 0, "  what each step along the front buys:");
    json_array_foreach(front, i, one)
    {
        const json_t *at = json_array_get(
            candidates, (size_t)json_integer_value(json_object_get(one, "candidate")));
        if (i == 0)
            study_line_add(&line, "    %s: %.3g s, error %.3g %%", study_text_of(at, "label"),
                           study_number_of(one, "seconds"), 100 * study_number_of(one, "error"));
        else
            study_line_add(&line, "    %s: %.3g times the cost, error divided by %.3g",
                           study_text_of(at, "label"), study_number_of(one, "times_the_cost"),
                           1 / study_number_of(one, "part_of_the_error"));
        study_line_print(context, &line, 6);
    }
}

static void print_reference(study_context *context, const json_t *reference)
{
    study_line line = {0};
    size_t i;
    json_t *level, *change;
    const char *output;
    json_array_foreach(json_object_get(reference, "levels"), i, level)
    {
        study_line_add(&line, "reference %zu: %s, %.3g s", i, study_text_of(level, "label"),
                       study_number_of(level, "seconds"));
        json_object_foreach(json_object_get(level, "change"), output, change) study_line_add(
            &line, "; %s changed by %.2g %%", output, 100 * json_number_value(change));
        study_line_print(context, &line, -1);
    }
}

static void print_head(study_context *context, const char *output, double floor, const char *count,
                       bool rms)
{
    const char *dot = count ? strchr(count, '.') : NULL;
    char work[16] = "";
    if (dot)
        snprintf(work, sizeof work, " %8.8s", dot + 1);
    study_line line = {0};
    study_context_print_line(context, 0, "");
    study_line_add(&line, "%s, known to %.2g %%%s", output, 100 * floor,
                   rms ? ", judged by rms" : "");
    study_line_print(context, &line, 0);
    study_line_add(&line, "  %8s %8s %9s %6s%s", "error", "rms", "cost", "spread", work);
    study_line_print(context, &line, 0);
    study_line_add(&line, "  %8s %8s %9s %6s", "%", "%", "s", "%");
    study_line_print(context, &line, 0);
}

void study_tradeoff_print(study_context *context, const json_t *result)
{
    study_line line = {0};
    const json_t *candidates = json_object_get(result, "candidates");
    const json_t *reference = json_object_get(result, "reference");
    const char *output;
    json_t *one;
    size_t *order = sort_by_cost(context, candidates);
    json_t *names = names_of_counts(candidates);
    const char *count = json_object_iter_key(json_object_iter(names));
    print_reference(context, reference);
    if (!json_is_true(json_object_get(reference, "reached")))
        study_line_add(&line,
                       "it changes by more than a tenth of the smallest error sought, %.3g %%",
                       100 * study_number_of(result, "accuracy"));
    if (line.used)
        study_line_print(context, &line, 2);
    json_object_foreach(json_object_get(result, "outputs"), output, one)
    {
        print_head(context, output, study_number_of(one, "reference_error"), count,
                   !strcmp(study_text_of(one, "judge"), "rms"));
        for (size_t i = 0; i < json_array_size(candidates); i++) {
            const json_t *candidate = json_array_get(candidates, order[i]);
            print_row(context, candidate,
                      json_object_get(json_object_get(candidate, "errors"), output),
                      on_front(one, order[i]), count);
        }
        print_front(context, candidates, json_object_get(one, "front"));
    }
    study_context_print_line(context, 0, "");
    study_context_print_line(context, 0, "* on the front");
    study_context_print_line(context, 0, "");
    json_decref(names);
}

static void put_number(FILE *out, const json_t *number)
{
    fputc(',', out);
    if (json_is_number(number))
        fprintf(out, "%.6g", json_number_value(number));
}

static void put_error(FILE *out, const json_t *error, bool front)
{
    put_number(out, json_object_get(error, "largest"));
    put_number(out, json_object_get(error, "rms"));
    fprintf(out, ",%d", front);
    put_number(out, json_object_get(error, "over_front"));
}

void study_tradeoff_table(const json_t *result, FILE *out)
{
    json_t *candidates = json_object_get(result, "candidates"), *candidate, *one;
    json_t *outputs = json_object_get(result, "outputs"), *names = names_of_counts(candidates);
    const char *name;
    size_t i;
    fputs("candidate,status,cost [s],cost_min [s],cost_max [s],repeats", out);
    json_object_foreach(names, name, one) fprintf(out, ",%s", name);
    json_object_foreach(outputs, name, one)
        fprintf(out, ",%s error,%s rms,%s front,%s cost_over_front", name, name, name, name);
    fputs(",reason\n", out);
    json_array_foreach(candidates, i, candidate)
    {
        const json_t *seconds = json_object_get(candidate, "seconds");
        study_write_cell(out, study_text_of(candidate, "label"));
        fprintf(out, ",%s", study_text_of(candidate, "status"));
        put_number(out, json_object_get(seconds, "median"));
        put_number(out, json_object_get(seconds, "min"));
        put_number(out, json_object_get(seconds, "max"));
        put_number(out, json_object_get(seconds, "repeats"));
        json_object_foreach(names, name, one)
            put_number(out, json_object_get(json_object_get(candidate, "counts"), name));
        json_object_foreach(outputs, name, one)
            put_error(out, json_object_get(json_object_get(candidate, "errors"), name),
                      on_front(one, i) != NULL);
        fputc(',', out);
        study_write_cell(out, study_text_of(candidate, "reason"));
        fputc('\n', out);
    }
    json_decref(names);
}
