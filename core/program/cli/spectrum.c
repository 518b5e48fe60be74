/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "spectrum.h"

#include "../study/cases/spectrum.h"
#include "../study/kinds/answer/answer.h"
#include "../study/kinds/answer/number.h"
#include "../study/kinds/answer/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT = STUDY_QUANTITY_SIZE, BOTH = STUDY_ON_TERMINAL | STUDY_ON_PAGE };

static const study_column columns[] = {
    {.of = {"output"}, .name = "output", .head = "", .width = -1},
    {.of = {"unit"}, .name = "unit"},
    {.of = {"mean"}, .name = "mean"},
    {.of = {"lowest"}, .name = "lowest"},
    {.of = {"lowest_row"}, .name = "lowest_row"},
    {.of = {"highest"}, .name = "highest"},
    {.of = {"highest_row"}, .name = "highest_row"},
    {.of = {"energy"}, .name = "energy [J]"},
    {.of = {"in words", "mean"}, .head = "mean over time", .width = -1},
    {.of = {"in words", "lowest"}, .head = "lowest", .width = -1},
    {.of = {"in words", "highest"}, .head = "highest", .width = -1},
    {.of = {"in words", "energy"}, .head = "energy", .width = -1},
};

static const char *last_word(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot ? dot + 1 : path;
}

static study_readable unit_for(const char *name, const json_t *of)
{
    double most = fmax(fabs(study_number_of(of, "lowest")), fabs(study_number_of(of, "highest")));
    return study_readable_output(last_word(name), json_string_value(json_object_get(of, "unit")),
                                 most);
}

static void write_number(double si, study_readable unit, char out[TEXT])
{
    study_quantity_text(si, &unit, 4, " ", out);
    if (!isfinite(si))
        strcpy(out, "-");
}

/* "0.2341 um in row 7" */
static void write_extreme(const json_t *of, const char *key, study_readable unit, char out[TEXT])
{
    char member[32];
    snprintf(member, sizeof member, "%s_row", key);
    write_number(study_number_of(of, key), unit, out);
    size_t length = strlen(out);
    snprintf(out + length, TEXT - length, " in row %lld",
             (long long)json_integer_value(json_object_get(of, member)));
}

static void write_energy(double joule, char out[TEXT])
{
    if (!isfinite(joule))
        *out = '\0';
    else if (fabs(joule) < 3.6e6)
        write_number(joule, (study_readable){1e-3, 0, "kJ"}, out);
    else
        write_number(joule, (study_readable){1 / 3.6e6, 0, "kWh"}, out);
}

static void write_time(const json_t *sums, char out[TEXT])
{
    double time = study_number_of(sums, "time");
    bool shares = !strcmp(json_string_value(json_object_get(sums, "unit")), "1");
    if (shares)
        *out = '\0';
    else if (time < 3600)
        write_number(time, (study_readable){1, 0, "s"}, out);
    else
        write_number(time, (study_readable){1.0 / 3600, 0, "h"}, out);
}

/* Returns {output, unit, mean, lowest, highest, ... in words} of each output. */
static json_t *rows_of(const json_t *sums)
{
    json_t *rows = json_array(), *of;
    const char *name;
    json_object_foreach(json_object_get(sums, "outputs"), name, of)
    {
        char mean[TEXT], low[TEXT], high[TEXT], energy[TEXT];
        study_readable unit = unit_for(name, of);
        write_number(study_number_of(of, "mean"), unit, mean);
        write_extreme(of, "lowest", unit, low);
        write_extreme(of, "highest", unit, high);
        write_energy(study_number_of(of, "energy"), energy);
        json_t *row = json_copy(of);
        json_object_del(row, "values");
        json_object_set_new(row, "output", json_string(name));
        json_object_set_new(row, "in words",
                            json_pack("{s:s, s:s, s:s, s:s}", "mean", mean, "lowest", low,
                                      "highest", high, "energy", energy));
        json_array_append_new(rows, row);
    }
    return rows;
}

static long long integer_of(const json_t *map, const char *key)
{
    return (long long)json_integer_value(json_object_get(map, key));
}

static void print_below(study_answer *answer, const json_t *sums)
{
    size_t i;
    json_t *one;
    json_array_foreach(json_object_get(sums, "below"), i, one)
    {
        char limit[TEXT];
        const char *name = study_text_of(one, "output");
        double value = study_number_of(one, "limit");
        write_number(
            value, study_readable_output(last_word(name), study_text_of(one, "unit"), fabs(value)),
            limit);
        study_answer_say(answer, BOTH, 4,
                         "  %s is below %s for %.4g %% of the time, in %lld of %lld rows", name,
                         limit, 100 * study_number_of(one, "share"), integer_of(one, "rows"),
                         integer_of(sums, "rows"));
    }
}

/* Prints which stages were evaluated once for several rows. */
static void print_stages(study_answer *answer, const json_t *sums)
{
    const char *name;
    json_t *of;
    json_object_foreach(json_object_get(sums, "stages"), name, of)
    {
        const long long computed = integer_of(of, "computed"), reused = integer_of(of, "reused");
        if (reused > 0)
            study_answer_say(answer, STUDY_ON_TERMINAL, 4,
                             "  %s: computed in %lld of %lld rows; %lld reused the result of a row "
                             "with the same inputs",
                             name, computed, computed + reused, reused);
    }
}

/* Prints for how much of the time there are no results, and why. */
static void print_left_out(study_answer *answer, const json_t *sums)
{
    const json_t *refused = json_object_get(sums, "refused");
    double stated = study_number_of(sums, "stated"), share = study_number_of(refused, "share");
    double failed = study_number_of(sums, "missing") - share;
    const long long empty = integer_of(sums, "empty"), rows = integer_of(sums, "rows");
    if (fabs(stated - 1) > 1e-9)
        study_answer_say(answer, BOTH, 4,
                         "  the shares of the time sum to %.6g %%: each is taken relative to "
                         "that sum",
                         100 * stated);
    if (empty > 0)
        study_answer_say(answer, BOTH, 4,
                         "  %lld of %lld classes take no time and are left out, and no row "
                         "counts them",
                         empty, empty + rows);
    if (share > 0)
        study_answer_say(answer, BOTH, 4,
                         "  for %.3g %% of the time, in %lld of %lld rows, nothing can be "
                         "computed; the sums leave this time out; row %lld: %s",
                         100 * share, integer_of(refused, "rows"), rows, integer_of(refused, "row"),
                         study_text_of(refused, "reason"));
    if (failed > 1e-12)
        study_answer_say(
            answer, BOTH, 4,
            "  rows with %.3g %% of the time gave no results and are not counted above",
            100 * failed);
}

/* Draws for each output how long it is below a value; returns the first drawing, or NULL. */
static json_t *draw(study_answer *answer, const study_run *run, const json_t *sums)
{
    const study_spectrum *s = run->study->spectrum;
    json_t *first = NULL, *of, *times = json_array();
    const char *name;
    for (size_t i = 0; i < s->count; i++)
        json_array_append_new(times, json_real(s->times[i]));
    json_object_foreach(json_object_get(sums, "outputs"), name, of)
    {
        json_t *values = json_object_get(of, "values");
        const study_readable unit = unit_for(name, of);
        if (!values)
            continue;
        json_t *made = study_answer_draw(
            answer, json_pack("{s:s, s:s+, s:s, s:s, s:f, s:f, s:O, s:O}", "sort", "durations",
                              "title", name, ": share of the time below a value", "name",
                              last_word(name), "unit", unit.unit, "factor", unit.factor, "offset",
                              unit.offset, "values", values, "times", times));
        first = first ? first : made;
    }
    json_decref(times);
    return first;
}

bool cli_spectrum_sum(const study_run *run, study_context *context)
{
    char time[TEXT];
    json_t *sums = study_spectrum_sums(run, run->keys, context->report);
    if (!sums)
        return false;
    context->name = "spectrum";
    context->run = run;
    study_answer answer = {.context = context, .file = "spectrum", .value = sums, .digits = 12};
    write_time(sums, time);
    study_answer_say(&answer, STUDY_ON_TERMINAL, 0, "%s", "");
    study_answer_say(&answer, STUDY_ON_TERMINAL, 0, "Over the spectrum: %lld rows%s%s",
                     integer_of(sums, "rows"), *time ? ", " : "", time);
    study_answer_add(&answer, &(study_table){.summary = "over the spectrum",
                                             .columns = columns,
                                             .column_count = sizeof columns / sizeof *columns,
                                             .rows = rows_of(sums),
                                             .forms = STUDY_IN_FILE | BOTH,
                                             .digits = 12,
                                             .indent = 2,
                                             .figure = draw(&answer, run, sums)});
    print_below(&answer, sums);
    print_stages(&answer, sums);
    print_left_out(&answer, sums);
    study_answer_say(&answer, STUDY_ON_TERMINAL, 0, "%s", "");
    study_answer_close(&answer);
    return study_context_write(context, run->directory);
}
