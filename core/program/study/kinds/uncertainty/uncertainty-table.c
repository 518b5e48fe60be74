/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the findings of an uncertainty study as tables of statistics and sentences. */
#include "uncertainty.h"

#include <math.h>
#include <string.h>

enum { IN_FILE = STUDY_IN_FILE, SHOWN = STUDY_ON_TERMINAL | STUDY_ON_PAGE };

static const study_column statistics[] = {
    {.of = {"output"}, .name = "output", .quoted = true},
    {.of = {"statistic"}, .name = "statistic", .quoted = true},
    {.of = {"value"}, .name = "value"},
    {.of = {"low"}, .name = "low"},
    {.of = {"high"}, .name = "high"},
    {.of = {"unit"}, .name = "unit"},
    {.of = {"shown", "what"}, .head = "", .width = -28},
    {.of = {"shown", "value"}, .head = "", .width = 9, .missing = "-"},
    {.of = {"shown", "unit"}, .head = "", .width = -5},
    {.of = {"shown", "interval"}, .head = ""},
};

static const study_column levels[] = {
    {.of = {"name"}, .head = "level", .width = -22},
    {.of = {"cost"}, .head = "cost", .unit = "%", .width = 6, .digits = 3, .factor = 100},
    {.of = {"correlation"}, .head = "correlation", .width = 12, .digits = 5, .fixed = true},
    {.of = {"samples"}, .head = "samples", .width = 8, .fixed = true},
    {.of = {"remark"}, .head = "", .before = ", "},
};

/* Adds a statistic with its names in the file and on the terminal, in SI and in a readable unit. */
typedef struct statistic {
    const char *output, *name, *what, *unit;
    const json_t *of;
    study_readable readable;
} statistic;

static json_t *interval_of(const json_t *e, study_readable as)
{
    char from[STUDY_NUMBER_SIZE] = "?", to[STUDY_NUMBER_SIZE] = "?";
    double low = study_number_of(e, "low"), high = study_number_of(e, "high");
    if (isfinite(low))
        study_number_text(low * as.factor + as.offset, 4, " ", from);
    if (isfinite(high))
        study_number_text(high * as.factor + as.offset, 4, " ", to);
    return json_sprintf("%9s to %s", from, to);
}

static json_t *row_of(const statistic *s)
{
    double value = study_number_of(s->of, "value");
    json_t *shown = json_pack("{s:s, s:o, s:s, s:o}", "what", s->what, "value",
                              study_json_real(value * s->readable.factor + s->readable.offset),
                              "unit", isfinite(value) ? s->readable.unit : "", "interval",
                              interval_of(s->of, s->readable));
    json_t *row = json_pack("{s:s, s:s, s:s, s:o}", "output", s->output, "statistic", s->name,
                            "unit", s->unit, "shown", shown);
    for (const char *const *key = (const char *const[]){"value", "low", "high", NULL}; *key; key++)
        json_object_set(row, *key, json_object_get(s->of, *key));
    return row;
}

/* Adds the shares of an input in the variance: alone, and together with other inputs. */
static void add_shares(json_t *rows, const char *output, const char *input, const json_t *share)
{
    char first[200], total[200], what[100];
    const study_readable percent = {100, 0, "%"};
    snprintf(first, sizeof first, "first index of %.150s", input);
    snprintf(total, sizeof total, "total index of %.150s", input);
    snprintf(what, sizeof what, "share of %.60s", input);
    json_t *alone =
        row_of(&(statistic){output, first, what, "1", json_object_get(share, "first"), percent});
    json_t *untold = json_object_get(share, "untold"), *shown = json_object_get(alone, "shown");
    if (untold) {
        json_object_set(shown, "value", untold);
        json_object_del(shown, "interval");
    }
    json_array_append_new(rows, alone);
    json_array_append_new(rows, row_of(&(statistic){output, total, "  with others", "1",
                                                    json_object_get(share, "total"), percent}));
}

static json_t *rows_of(const char *name, const json_t *of)
{
    study_readable unit = study_uncertainty_unit(name, of), spread = unit;
    const char *si = study_text_of(of, "unit"), *input;
    json_t *rows = json_array(), *one;
    size_t i;
    spread.offset = 0;
    spread.unit = strcmp(unit.unit, "degC") ? unit.unit : "K";
    json_array_append_new(
        rows, row_of(&(statistic){name, "mean", "mean", si, json_object_get(of, "mean"), unit}));
    json_array_append_new(rows,
                          row_of(&(statistic){name, "standard deviation", "standard deviation", si,
                                              json_object_get(of, "deviation"), spread}));
    json_array_foreach(json_object_get(of, "percentiles"), i, one)
    {
        char share[40], what[40];
        snprintf(share, sizeof share, "%.6g %%", 100 * study_number_of(one, "share"));
        snprintf(what, sizeof what, "%.4g %% are below", 100 * study_number_of(one, "share"));
        json_array_append_new(rows, row_of(&(statistic){name, share, what, si, one, unit}));
    }
    json_array_foreach(json_object_get(of, "words"), i, one)
    {
        char what[200];
        snprintf(what, sizeof what, "mean, %.80s: %.80s", study_text_of(one, "input"),
                 study_text_of(one, "word"));
        json_array_append_new(
            rows, row_of(&(statistic){name, what, what, si, json_object_get(one, "mean"), unit}));
    }
    json_object_foreach(json_object_get(of, "shares"), input, one)
        add_shares(rows, name, input, one);
    return rows;
}

static void add_statistics(study_answer *answer, const char *title, const char *summary,
                           json_t *rows, json_t *figure, unsigned forms)
{
    study_answer_add(answer, &(study_table){.title = title,
                                            .summary = summary,
                                            .columns = statistics,
                                            .column_count = sizeof statistics / sizeof *statistics,
                                            .rows = rows,
                                            .forms = forms,
                                            .digits = 9,
                                            .indent = 2,
                                            .figure = figure});
}

/* Draws an output: its histogram, which is returned, and the share of each input. */
static json_t *draw(study_answer *answer, const char *name, const json_t *of)
{
    const char *dot = strrchr(name, '.');
    const study_readable unit = study_uncertainty_unit(name, of);
    json_t *shares = json_object_get(of, "shares"),
           *histogram = study_answer_draw(
               answer,
               json_pack("{s:s, s:s+, s:s, s:s, s:f, s:f, s:O, s:O}", "sort", "histogram", "title",
                         name, ": spread by the inputs", "name", dot ? dot + 1 : name, "unit",
                         unit.unit, "factor", unit.factor, "offset", unit.offset, "percentiles",
                         json_object_get(of, "percentiles"), "histogram",
                         json_object_get(of, "histogram")));
    if (json_object_size(shares))
        study_answer_draw(answer,
                          json_pack("{s:s, s:s++, s:O}", "sort", "shares", "title", name,
                                    ": share of its variance, by ",
                                    study_text_of(answer->value, "shares_by"), "shares", shares));
    return histogram;
}

/* Draws the three error bars of all outputs. */
static void draw_limits(study_answer *answer, json_t *outputs)
{
    json_t *bars = json_object(), *of;
    const char *name;
    json_object_foreach(outputs, name, of)
        json_object_set(bars, name, json_object_get(of, "limits"));
    study_answer_draw(answer, json_pack("{s:s, s:s, s:o}", "sort", "limits", "title",
                                        "What limits each output", "outputs", bars));
}

static void add_output(study_answer *answer, const char *name, const json_t *of, json_t *all)
{
    study_context *context = answer->context;
    json_int_t failed = json_integer_value(json_object_get(of, "failed"));
    json_t *rows = rows_of(name, of);
    json_array_extend(all, rows);
    study_context_print_line(context, 0, "");
    const char *title =
        study_context_format(context, "%s, each with its 95 %% confidence interval", name);
    add_statistics(answer, title, study_text_of(json_object_get(of, "limits"), "sentence"), rows,
                   draw(answer, name, of), SHOWN);
    if (failed)
        study_answer_say(answer, SHOWN, 2,
                         "%lld samples failed and are left out: if failing depends on the inputs, "
                         "all results above are biased",
                         (long long)failed);
}

static void add_conditions(study_answer *answer, const json_t *conditions, json_t *all)
{
    json_t *rows = json_array(), *of;
    const char *name;
    json_object_foreach((json_t *)(size_t)conditions, name, of) json_array_append_new(
        rows, row_of(&(statistic){name, "probability", name, "1", of, {100, 0, "%"}}));
    json_array_extend(all, rows);
    if (json_array_size(rows))
        study_context_print_line(answer->context, 0, "");
    add_statistics(answer, NULL, "probabilities", rows, NULL, SHOWN);
}

/* Returns the cost of a level: as stated in the file and as observed, or as measured by the pilot.
 */
static json_t *remark_of(const json_t *level, const json_t *first)
{
    double found = study_number_of(level, "seconds") / study_number_of(first, "seconds");
    if (level == first)
        return NULL;
    if (!json_is_true(json_object_get(level, "stated")))
        return json_string("measured");
    return isfinite(found) ? json_sprintf("%.3g %% found", 100 * found) : NULL;
}

static void add_levels(study_answer *answer, const json_t *result)
{
    const json_t *gain = json_object_get(result, "gain"), *all = json_object_get(result, "levels");
    json_t *rows = json_array(), *level;
    size_t i;
    json_array_foreach(all, i, level)
    {
        json_t *row = json_copy(level), *remark = remark_of(level, json_array_get(all, 0));
        if (remark)
            json_object_set_new(row, "remark", remark);
        json_array_append_new(rows, row);
    }
    study_context_print_line(answer->context, 0, "");
    study_answer_add(answer, &(study_table){.summary = "the ladder",
                                            .columns = levels,
                                            .column_count = sizeof levels / sizeof *levels,
                                            .rows = rows,
                                            .indent = 2,
                                            .forms = SHOWN});
    study_answer_say(answer, SHOWN, 2,
                     "the mean is as accurate as from %.7g plain samples, and %.3g times cheaper, "
                     "pilot included (predicted from the pilot: %.3g)",
                     round(study_number_of(gain, "plain")), study_number_of(gain, "found"),
                     study_number_of(gain, "predicted"));
}

static void add_limits(study_answer *answer, const json_t *limits)
{
    json_t *reason;
    const char *model;
    study_answer_say(answer, STUDY_ON_TERMINAL, 2, "%s", study_text_of(limits, "sentence"));
    json_object_foreach(json_object_get(limits, "not_compared"), model, reason) study_answer_say(
        answer, SHOWN, 4, "  not compared: %s: %s", model, json_string_value(reason));
}

void study_uncertainty_reduce(void *study, study_answer *answer)
{
    json_t *result = answer->value = study_uncertainty_result(study), *all = json_array(), *of;
    const char *name;
    answer->digits = 9;
    draw_limits(answer, json_object_get(result, "outputs"));
    json_object_foreach(json_object_get(result, "outputs"), name, of)
        add_output(answer, name, of, all);
    add_conditions(answer, json_object_get(result, "conditions"), all);
    add_statistics(answer, NULL, NULL, all, NULL, IN_FILE);
    if (json_object_get(result, "gain"))
        add_levels(answer, result);
    study_context_print_line(answer->context, 0, "");
    json_object_foreach(json_object_get(result, "outputs"), name, of)
        add_limits(answer, json_object_get(of, "limits"));
    study_context_print_line(answer->context, 0, "");
}
