/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "limits.h"

#include "../accuracy/lines.h"
#include "../run/run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct limit_range {
    double bound; /* in SI units */
    bool above;   /* whether numbers must be above the bound */
    bool equal;   /* whether numbers equal to the bound are allowed */
} limit_range;

static const ff_node *node_of(const ff_run *run)
{
    const ff_node *node = ff_node_get(ff_run_root(run), "limits");
    return node && node->kind == FF_MAP ? node : NULL;
}

/* Reports a limit that cannot be read. Returns false. */
static bool refuse(const ff_node *node, const char *path, ff_report *report)
{
    return ff_error(report, FF_FAULT_INPUT, node->place, NULL,
                    "limits.%s: expected \"> NUMBER UNIT\" or \"< NUMBER UNIT\" in quotes, or a "
                    "list of them",
                    path);
}

/* Reads "> 1.5 um" in the unit of the output. Returns false after an error. */
static bool read_limit(const ff_node *node, const char *path, const ff_port *output,
                       limit_range *limit, ff_report *report)
{
    const char *text = node->kind == FF_SCALAR ? node->text : "";
    if (*text != '<' && *text != '>')
        return refuse(node, path, report);
    *limit = (limit_range){.above = *text == '>', .equal = text[1] == '='};
    text += limit->equal ? 2 : 1;
    text += strspn(text, " ");
    const ff_param row = {.name = output->name,
                          .unit = output->unit,
                          .doc = output->doc,
                          .type = FF_REAL,
                          .flags = output->flags & FF_DIFFERENCE,
                          .min = -INFINITY,
                          .max = INFINITY};
    ff_node number = *node;
    ff_unit unit;
    ff_value value;
    char why[64], *name = memory_print_text("limits.%s", path);
    number.text = (char *)text;
    bool good = ff_unit_parse(row.unit, &unit, why, sizeof why) &&
                ff_param_read(&row, &unit, name, &number, &value, report);
    free(name);
    if (good) {
        limit->bound = value.real;
        ff_value_clear(&value);
    }
    return good;
}

/* Returns limit number i of an output, or NULL after the last. The limits are one node or a
   list. */
static const ff_node *limit_at(const ff_node *of, size_t i)
{
    if (of->kind != FF_SEQUENCE)
        return i == 0 ? of : NULL;
    return i < of->count ? of->items[i] : NULL;
}

bool limits_check(ff_run *run)
{
    const ff_node *node = node_of(run), *item;
    ff_report *report = ff_run_report(run);
    size_t errors = ff_report_errors(report);
    for (size_t i = 0; node && i < node->count; i++) {
        const ff_stage *stage;
        const ff_result *result = run_output(ff_run_pipeline(run), node->keys[i], &stage);
        limit_range unused;
        if (result && !limit_at(node->items[i], 0))
            refuse(node->items[i], node->keys[i], report);
        for (size_t k = 0; result && (item = limit_at(node->items[i], k)); k++)
            read_limit(item, node->keys[i], result->row, &unused, report);
    }
    return ff_report_errors(report) == errors;
}

char *limits_print_key(const ff_run *run)
{
    const ff_node *node = node_of(run), *item;
    ff_report *unused = ff_report_new(); /* limits_check has already reported limits that cannot
                                            be read */
    char *text = NULL;
    size_t length = 0;
    FILE *out = memory_require(open_memstream(&text, &length));
    for (size_t i = 0; node && i < node->count; i++) {
        const ff_stage *stage;
        const ff_pipeline *pipeline = ff_run_pipeline(run);
        const ff_result *result = pipeline ? run_output(pipeline, node->keys[i], &stage) : NULL;
        limit_range limit;
        for (size_t k = 0; (item = limit_at(node->items[i], k)); k++)
            if (result && read_limit(item, node->keys[i], result->row, &limit, unused))
                fprintf(out, "%s %c%s %.12g\n", node->keys[i], limit.above ? '>' : '<',
                        limit.equal ? "=" : "", limit.bound);
            else
                fprintf(out, "%s %s\n", node->keys[i], item->text ? item->text : "");
    }
    fclose(out);
    ff_report_free(unused);
    return text;
}

/* Returns the error of number k of an output, as measured or as estimated by the stage; NaN: not
   known. */
static double bar_of(const ff_stage *stage, const ff_result *result, size_t k,
                     const accuracy_record *errors)
{
    const accuracy_error *measured = accuracy_find(errors, result);
    const ff_result *estimate = accuracy_estimate_of(stage, result);
    if (measured && measured->bar)
        return measured->bar[k];
    if (estimate && (isfinite(estimate->data[k]) || accuracy_is_least(stage, result)))
        return fabs(estimate->data[k]);
    if (estimate)
        return NAN;
    const double share = accuracy_estimated_share(stage, result);
    return isinf(share) ? share : share * fabs(result->data[k]); /* also if the value is 0 */
}

/* Returns the distance of a number from the limit, positive on the allowed side. */
static double margin_of(const limit_range *limit, double value)
{
    return limit->above ? value - limit->bound : limit->bound - value;
}

/* Returns the standing of a number. A number of which only a lower bound is known never certainly
   meets an upper limit. */
static limits_standing stand(const limit_range *limit, double value, double bar, bool at_least)
{
    const double margin = margin_of(limit, value);
    if (!(margin > 0 || (margin == 0 && limit->equal)))
        return LIMITS_MISSED;
    if (at_least)
        return limit->above ? LIMITS_MET : LIMITS_WITHIN;
    return margin <= bar && bar > 0 ? LIMITS_WITHIN : LIMITS_MET;
}

/* Judges all numbers of an output and keeps the one with the worst standing. */
static void judge(limits_row *row, const limit_range *limit, const accuracy_record *errors)
{
    const ff_result *result = &row->stage->results[row->output];
    const bool at_least = accuracy_is_least(row->stage, result);
    double least = INFINITY;
    row->standing = result->data && result->count > 0 ? LIMITS_MET : LIMITS_MISSED;
    row->value = row->bar = NAN;
    for (size_t k = 0; result->data && k < result->count; k++) {
        const double bar = bar_of(row->stage, result, k, errors);
        const limits_standing standing = stand(limit, result->data[k], bar, at_least);
        const double margin = margin_of(limit, result->data[k]);
        if (standing < row->standing ||
            (standing == row->standing && !(margin < least) && !isnan(margin)))
            continue;
        *row = (limits_row){row->stage, row->output,     row->name, row->asked,
                            standing,   result->data[k], bar};
        least = margin;
    }
}

limits_verdict limits_judge(const ff_run *run, const ff_pipeline *pipeline,
                            const accuracy_record *errors)
{
    const ff_node *node = node_of(run), *item;
    limits_verdict verdict = {.count = 0};
    ff_report *unused = ff_report_new();
    for (size_t i = 0; node && i < node->count; i++) {
        const ff_stage *stage;
        const ff_result *result = run_output(pipeline, node->keys[i], &stage);
        limit_range limit;
        for (size_t k = 0; result && (item = limit_at(node->items[i], k)); k++) {
            if (!read_limit(item, node->keys[i], result->row, &limit, unused))
                continue;
            verdict.rows = memory_resize(verdict.rows, (verdict.count + 1) * sizeof *verdict.rows);
            limits_row *row = &verdict.rows[verdict.count++];
            *row = (limits_row){.stage = stage,
                                .output = (size_t)(result - stage->results),
                                .name = memory_print_text("%s", node->keys[i]),
                                .asked = memory_print_text("%s", item->text)};
            judge(row, &limit, errors);
            if (row->standing > verdict.worst)
                verdict.worst = row->standing;
        }
    }
    ff_report_free(unused);
    return verdict;
}

void limits_free(limits_verdict *verdict)
{
    for (size_t i = 0; i < verdict->count; i++) {
        free(verdict->rows[i].name);
        free(verdict->rows[i].asked);
    }
    free(verdict->rows);
    *verdict = (limits_verdict){.count = 0};
}

const char *limits_word(limits_standing standing)
{
    static const char *const words[LIMITS_STANDINGS] = {"met", "met within its bar", "missed"};
    return words[standing];
}

limits_standing limits_standing_of(const char *word)
{
    size_t s = 0;
    while (s < LIMITS_MISSED && (!word || strcmp(word, limits_word((limits_standing)s)) != 0))
        s++;
    return (limits_standing)s;
}

static json_t *number_or_null(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

json_t *limits_json(const limits_verdict *verdict)
{
    json_t *list = json_array();
    for (size_t i = 0; i < verdict->count; i++) {
        const limits_row *row = &verdict->rows[i];
        json_array_append_new(
            list, json_pack("{s:s, s:s, s:s, s:o, s:o, s:b, s:s}", "output", row->name, "asked",
                            row->asked, "standing", limits_word(row->standing), "value",
                            number_or_null(row->value), "bar", number_or_null(row->bar), "at_least",
                            isinf(row->bar), "unit", row->stage->results[row->output].row->unit));
    }
    return list;
}

static limits_standing standing_in(const json_t *entry)
{
    return limits_standing_of(json_string_value(json_object_get(entry, "standing")));
}

limits_standing limits_worst(const json_t *list)
{
    limits_standing worst = LIMITS_MET;
    const json_t *entry;
    size_t i;
    json_array_foreach(list, i, entry)
    {
        if (standing_in(entry) > worst)
            worst = standing_in(entry);
    }
    return worst;
}

char *limits_text(const json_t *list)
{
    const limits_standing worst = limits_worst(list);
    const json_t *entry;
    size_t i;
    char *text = memory_print_text("%s", json_array_size(list) ? limits_word(worst) : "");
    const char *between = ": ";
    json_array_foreach(list, i, entry)
    {
        const char *name = json_string_value(json_object_get(entry, "output")),
                   *bound = json_string_value(json_object_get(entry, "asked"));
        if (worst == LIMITS_MET || standing_in(entry) != worst)
            continue;
        memory_add_text(&text, "%s%s %s", between, name ? name : "", bound ? bound : "");
        between = ", ";
    }
    return text;
}

char *limits_sentence(const limits_verdict *verdict)
{
    size_t counts[LIMITS_STANDINGS] = {0};
    for (size_t i = 0; i < verdict->count; i++)
        counts[verdict->rows[i].standing]++;
    if (verdict->count == 0)
        return memory_print_text("%s", "");
    char *text =
        memory_print_text("of %zu limit%s ", verdict->count, verdict->count == 1 ? "" : "s");
    const char *between = "";
    for (size_t s = LIMITS_STANDINGS; s-- > 0;) {
        if (!counts[s])
            continue;
        memory_add_text(&text, "%s%zu %s", between, counts[s], limits_word((limits_standing)s));
        between = ", ";
    }
    return text;
}
