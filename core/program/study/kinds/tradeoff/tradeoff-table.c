/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes a trade-off as tables and sentences. */
#include "tradeoff.h"

#include <string.h>

enum { SHOWN = STUDY_ON_TERMINAL | STUDY_ON_PAGE };

/* The columns of a table under construction. */
typedef struct columns {
    study_column *all;
    size_t count;
} columns;

static void add(columns *c, study_column column)
{
    c->all[c->count++] = column;
}

static columns new_columns(study_context *context, size_t most)
{
    return (columns){memory_arena_alloc(&context->arena, most * sizeof(study_column)), 0};
}

/* Sorts candidates by rising cost, with those without a cost last. */
static json_t *sort_by_cost(const json_t *candidates)
{
    json_t *sorted = json_array();
    for (size_t i = 0; i < json_array_size(candidates); i++) {
        json_t *one = json_array_get(candidates, i);
        double cost = study_number_of(json_object_get(one, "seconds"), "median");
        size_t k = json_array_size(sorted);
        for (; k > 0; k--) {
            const json_t *before = json_object_get(json_array_get(sorted, k - 1), "seconds");
            if (!(study_number_of(before, "median") > cost) &&
                (json_is_object(before) || !(cost > 0)))
                break;
        }
        json_array_insert(sorted, k, one);
    }
    return sorted;
}

/* Returns {name: null} for every count that at least one candidate has. */
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

static void add_file(study_answer *answer, const json_t *result)
{
    json_t *candidates = json_object_get(result, "candidates"), *one;
    json_t *outputs = json_object_get(result, "outputs"), *names = names_of_counts(candidates);
    study_context *context = answer->context;
    columns c = new_columns(context, 8 + json_object_size(names) + 5 * json_object_size(outputs));
    const char *name;
    add(&c, (study_column){.of = {"label"}, .name = "candidate", .quoted = true});
    add(&c, (study_column){.of = {"status"}, .name = "status"});
    add(&c, (study_column){.of = {"seconds", "median"}, .name = "cost [s]"});
    add(&c, (study_column){.of = {"seconds", "min"}, .name = "cost_min [s]"});
    add(&c, (study_column){.of = {"seconds", "max"}, .name = "cost_max [s]"});
    add(&c, (study_column){.of = {"seconds", "repeats"}, .name = "repeats"});
    add(&c, (study_column){.of = {"whole", "median"}, .name = "whole run [s]"});
    json_object_foreach(names, name, one)
    {
        const char *kept = study_context_format(context, "%s", name);
        add(&c, (study_column){.of = {"counts", kept}, .name = kept});
    }
    json_object_foreach(outputs, name, one)
    {
        static const char *const members[][2] = {{"error", "%s error"},
                                                 {"largest", "%s largest"},
                                                 {"stated", "%s stated"},
                                                 {"front", "%s front"},
                                                 {"over_front", "%s cost_over_front"}};
        for (size_t k = 0; k < 5; k++)
            add(&c, (study_column){.of = {"errors", name, members[k][0]},
                                   .name = study_context_format(context, members[k][1], name)});
    }
    add(&c, (study_column){.of = {"reason"}, .name = "reason", .quoted = true});
    study_answer_add(answer, &(study_table){.columns = c.all,
                                            .column_count = c.count,
                                            .rows = json_incref(candidates),
                                            .forms = STUDY_IN_FILE});
    json_decref(names);
}

/* `count` is the name of the count with its own column, or NULL. */
static void add_candidates(study_answer *answer, const char *output, const json_t *of,
                           json_t *candidates, const char *count, json_t *figure)
{
    study_context *context = answer->context;
    columns c = new_columns(context, 11);
    const char *dot = count ? strrchr(count, '.') : NULL;
    const bool absolute = json_is_true(json_object_get(of, "absolute"));
    static const char *const errors[] = {"error", "largest", "stated"};
    add(&c, (study_column){
                .of = {"errors", output, "front"}, .head = "", .words = {"", "*"}, .width = 1});
    for (int k = 0; k < 3; k++)
        add(&c, (study_column){.of = {"errors", output, errors[k]},
                               .head = errors[k],
                               .unit = absolute ? "" : "%",
                               .factor = absolute ? 1 : 100,
                               .width = 8,
                               .digits = 3,
                               .missing = "-"});
    add(&c, (study_column){.of = {"seconds", "median"},
                           .head = "cost",
                           .unit = "s",
                           .width = 9,
                           .digits = 3,
                           .missing = "-"});
    add(&c, (study_column){.of = {"whole", "median"},
                           .head = "run",
                           .unit = "s",
                           .width = 9,
                           .digits = 3,
                           .missing = "-"});
    add(&c, (study_column){.of = {"seconds", "spread"},
                           .head = "spread",
                           .unit = "%",
                           .factor = 100,
                           .width = 6,
                           .fixed = true,
                           .missing = "-"});
    if (dot)
        add(&c, (study_column){.of = {"counts", count},
                               .head = study_context_format(context, "%.8s", dot + 1),
                               .width = 8,
                               .fixed = true});
    add(&c, (study_column){.of = {"label"}, .head = "", .before = "  "});
    add(&c, (study_column){.of = {"reason"}, .head = "", .before = ": "});
    add(&c, (study_column){.of = {"errors", output, "knee"},
                           .head = "",
                           .words = {"", "<- knee"},
                           .before = "  "});
    const double known = study_number_of(of, "reference_error");
    const char *title =
        absolute ? study_context_format(context,
                                        "%s, 0 in the reference: errors in SI, uncertain by %.2g",
                                        output, known)
                 : study_context_format(context, "%s, uncertain by %.2g %%", output, 100 * known);
    study_answer_add(answer, &(study_table){.title = title,
                                            .summary = "all candidates",
                                            .columns = c.all,
                                            .column_count = c.count,
                                            .rows = json_incref(candidates),
                                            .folded = true,
                                            .figure = figure,
                                            .forms = SHOWN});
}

static void add_front(study_answer *answer, const json_t *candidates, const json_t *of,
                      json_t *figure)
{
    const bool absolute = json_is_true(json_object_get(of, "absolute"));
    const json_t *front = json_object_get(of, "front");
    columns c = new_columns(answer->context, 6);
    add(&c, (study_column){.of = {"rank"}, .head = "", .width = 3});
    add(&c, (study_column){.of = {"label"}, .head = "on the front", .width = -12});
    add(&c,
        (study_column){.of = {"seconds"}, .head = "cost", .unit = "s", .width = 9, .digits = 3});
    add(&c, (study_column){.of = {"error"},
                           .head = "error",
                           .unit = absolute ? "" : "%",
                           .factor = absolute ? 1 : 100,
                           .width = 8,
                           .digits = 3});
    add(&c,
        (study_column){.of = {"bought"}, .head = "compared with the one above", .before = "  "});
    add(&c, (study_column){.of = {"knee"}, .head = "", .words = {"", "knee"}, .before = "  "});
    json_t *rows = json_array(), *one;
    size_t i;
    json_array_foreach(front, i, one)
    {
        json_int_t candidate = json_integer_value(json_object_get(one, "candidate"));
        json_t *row = json_copy(one);
        json_object_set(row, "label",
                        json_object_get(json_array_get(candidates, (size_t)candidate), "label"));
        json_object_set_new(row, "rank", json_integer((json_int_t)i + 1));
        if (i > 0)
            json_object_set_new(row, "bought",
                                json_sprintf("%.3g times the cost, error divided by %.3g",
                                             study_number_of(one, "times_the_cost"),
                                             1 / study_number_of(one, "part_of_the_error")));
        json_array_append_new(rows, row);
    }
    study_answer_add(answer, &(study_table){.title = "the front",
                                            .whole = true,
                                            .columns = c.all,
                                            .column_count = c.count,
                                            .rows = rows,
                                            .figure = figure,
                                            .forms = SHOWN});
}

static void add_reference(study_answer *answer, const json_t *result)
{
    const json_t *reference = json_object_get(result, "reference");
    size_t i;
    json_t *level, *change;
    const char *output;
    json_array_foreach(json_object_get(reference, "levels"), i, level)
    {
        study_line line = {0};
        study_line_add(&line, "reference %zu: %s, %.3g s", i, study_text_of(level, "label"),
                       study_number_of(level, "seconds"));
        json_object_foreach(json_object_get(level, "change"), output, change)
        {
            const bool absolute = json_is_true(json_object_get(change, "absolute"));
            study_line_add(&line, "; %s changed by %.2g %s", output,
                           (absolute ? 1 : 100) * study_number_of(change, "by"),
                           absolute ? "in SI" : "%");
        }
        study_answer_say(answer, SHOWN, -1, "%s", line.text);
    }
    study_line kept = {0};
    json_array_foreach(json_object_get(reference, "unsettled"), i, level)
        study_line_add(&kept, "%s%s", i ? ", " : "", json_string_value(level));
    if (!json_is_true(json_object_get(reference, "reached")))
        study_answer_say(
            answer, SHOWN, 2,
            "it changes by more than a tenth of the smallest error of interest, %.3g %%%s%s%s",
            100 * study_number_of(result, "accuracy"), kept.used ? ": " : "",
            kept.used ? kept.text : "",
            json_is_true(json_object_get(reference, "stalled"))
                ? "; refinement does not reduce the change, so no finer level follows"
                : "");
}

/* Draws the error of an output against its cost. */
static json_t *draw(study_answer *answer, const json_t *candidates, const char *output, json_t *of)
{
    json_t *points = json_array(), *one;
    size_t i;
    json_array_foreach(candidates, i, one) json_array_append_new(
        points, json_pack("{s:O, s:O, s:O?}", "label", json_object_get(one, "label"), "seconds",
                          json_object_get(one, "seconds"), "error",
                          json_object_get(json_object_get(one, "errors"), output)));
    return study_answer_draw(answer,
                             json_pack("{s:s, s:s+, s:O, s:o}", "sort", "front", "title", output,
                                       ": error against cost", "output", of, "candidates", points));
}

void study_tradeoff_print(study_answer *answer)
{
    const json_t *result = answer->value, *candidates = json_object_get(result, "candidates");
    json_t *sorted = sort_by_cost(candidates), *names = names_of_counts(candidates), *of;
    const char *count = json_object_iter_key(json_object_iter(names)), *output;
    count = count ? study_context_format(answer->context, "%s", count) : NULL;
    add_reference(answer, result);
    json_object_foreach(json_object_get(result, "outputs"), output, of)
    {
        json_t *figure = draw(answer, candidates, output, of);
        study_context_print_line(answer->context, 0, "");
        add_candidates(answer, output, of, sorted, count, figure);
        add_front(answer, candidates, of, figure);
    }
    add_file(answer, result);
    study_context_print_line(answer->context, 0, "");
    study_context_print_line(answer->context, 0, "* on the front");
    study_context_print_line(answer->context, 0, "");
    json_decref(sorted);
    json_decref(names);
}
