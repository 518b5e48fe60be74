/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "spectrum.h"

#include "../study/kinds/answer/number.h"
#include "../study/kinds/answer/text.h"
#include "../study/store/journal.h"
#include "../terminal/terminal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char cli_spectrum_files[] = "spectrum.json, spectrum.figure.json, ";

enum { TEXT = STUDY_QUANTITY_SIZE, NAME = 32, MEAN = 14, EXTREME = 23 }; /* columns */

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

/* The table of the page: a list of name, mean, lowest, highest and energy for each output. */
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
        json_array_append_new(rows, json_pack("[s, s, s, s, s]", name, mean, low, high, energy));
    }
    return rows;
}

static const char *cell_of(const json_t *row, size_t column)
{
    return json_string_value(json_array_get(row, column));
}

static void print_rows(const json_t *rows)
{
    size_t i;
    const json_t *row;
    printf("  %-*s %-*s %-*s %s\n", NAME, "", MEAN, "mean over time", EXTREME, "lowest", "highest");
    json_array_foreach(rows, i, row)
    {
        char line[5 * TEXT];
        snprintf(line, sizeof line, "%-*s %-*s %-*s %s", NAME, cell_of(row, 0), MEAN,
                 cell_of(row, 1), EXTREME, cell_of(row, 2), cell_of(row, 3));
        terminal_print_cut(line, printf("  "));
    }
    json_array_foreach(rows, i, row) if (*cell_of(row, 4))
        printf("  %s sums to %s\n", cell_of(row, 0), cell_of(row, 4));
}

static void print_below(const json_t *sums)
{
    size_t i;
    json_t *one;
    json_array_foreach(json_object_get(sums, "below"), i, one)
    {
        char limit[TEXT];
        const char *name = json_string_value(json_object_get(one, "output"));
        double value = study_number_of(one, "limit");
        write_number(value,
                     study_readable_output(last_word(name),
                                           json_string_value(json_object_get(one, "unit")),
                                           fabs(value)),
                     limit);
        printf("  %s is below %s for %.4g %% of the time, in %lld of %lld rows\n", name, limit,
               100 * study_number_of(one, "share"),
               (long long)json_integer_value(json_object_get(one, "rows")),
               (long long)json_integer_value(json_object_get(sums, "rows")));
    }
}

/* Prints which stages were evaluated once for several rows. */
static void print_stages(const json_t *sums)
{
    const char *name;
    json_t *of;
    json_object_foreach(json_object_get(sums, "stages"), name, of)
    {
        json_int_t computed = json_integer_value(json_object_get(of, "computed"));
        json_int_t reused = json_integer_value(json_object_get(of, "reused"));
        if (reused > 0)
            printf("  %s: %lld of %lld rows computed it, %lld took it over from a row with the "
                   "same inputs\n",
                   name, (long long)computed, (long long)(computed + reused), (long long)reused);
    }
}

/* Prints for how much of the time there are no numbers, and why. */
static void print_left_out(const json_t *sums)
{
    const json_t *refused = json_object_get(sums, "refused");
    double stated = study_number_of(sums, "stated"), share = study_number_of(refused, "share");
    double failed = study_number_of(sums, "missing") - share;
    json_int_t empty = json_integer_value(json_object_get(sums, "empty"));
    if (fabs(stated - 1) > 1e-9)
        printf("  the shares of the time sum to %.6g %%: each is taken as its part of that sum\n",
               100 * stated);
    if (empty > 0)
        printf("  %lld of %lld classes take no time: they are left out, and no row counts them\n",
               (long long)empty,
               (long long)(empty + json_integer_value(json_object_get(sums, "rows"))));
    if (share > 0)
        printf("  for %.3g %% of the time, in %lld of %lld rows, nothing can be computed, and the "
               "sums "
               "do not count it; row %lld: %s\n",
               100 * share, (long long)json_integer_value(json_object_get(refused, "rows")),
               (long long)json_integer_value(json_object_get(sums, "rows")),
               (long long)json_integer_value(json_object_get(refused, "row")),
               json_string_value(json_object_get(refused, "reason")));
    if (failed > 1e-12)
        printf("  rows of %.3g %% of the time gave no numbers: nothing above counts them\n",
               100 * failed);
}

void cli_spectrum_print(const json_t *sums)
{
    char time[TEXT];
    write_time(sums, time);
    printf("\nOver the spectrum: %lld rows%s%s\n",
           (long long)json_integer_value(json_object_get(sums, "rows")), *time ? ", " : "", time);
    json_t *rows = rows_of(sums);
    print_rows(rows);
    json_decref(rows);
    print_below(sums);
    print_stages(sums);
    print_left_out(sums);
    putchar('\n');
}

/* A row of a spectrum, for sorting by the value of an output. */
typedef struct step {
    double value, time;
} step;

/* For how much of the time an output is below a value. */
static json_t *curve_of(const study_run *run, const json_t *values, study_readable unit)
{
    const study_spectrum *s = run->study->spectrum;
    step *steps = memory_alloc((s->count + 1) * sizeof *steps);
    json_t *x = json_array(), *y = json_array();
    size_t count = 0;
    double whole = 0, time = 0;
    for (size_t i = 0; i < s->count; i++) {
        const json_t *value = json_array_get(values, i);
        if (!json_is_number(value))
            continue;
        steps[count++] = (step){json_number_value(value), s->times[i]};
        whole += s->times[i];
    }
    memory_sort(steps, count, sizeof *steps);
    for (size_t i = 0; i < count; i++)
        for (int end = 0; end < 2; end++) {
            time += end ? steps[i].time : 0;
            json_array_append_new(x, json_real(100 * time / whole));
            json_array_append_new(y, json_real(steps[i].value * unit.factor + unit.offset));
        }
    free(steps);
    return json_pack("{s:s, s:i, s:i, s:s, s:o, s:o}", "name", "", "colour", 0, "dash", 0, "style",
                     "line", "x", x, "y", y);
}

static json_t *figures_of(const study_run *run, const json_t *sums)
{
    json_t *all = json_array(), *of;
    const char *name;
    json_object_foreach(json_object_get(sums, "outputs"), name, of)
    {
        const json_t *values = json_object_get(of, "values");
        study_readable unit = unit_for(name, of);
        char label[160];
        snprintf(label, sizeof label, *unit.unit ? "%.100s (%.30s)" : "%.100s", last_word(name),
                 unit.unit);
        if (!values)
            continue;
        json_t *tables = json_array();
        if (json_array_size(all) == 0)
            json_array_append_new(tables,
                                  json_pack("{s:s, s:[s, s, s, s, s], s:o}", "summary",
                                            "over the spectrum", "head", "", "mean over time",
                                            "lowest", "highest", "energy", "rows", rows_of(sums)));
        json_array_append_new(
            all, json_pack("{s:s, s:s+, s:i, s:{s:s}, s:{s:s}, s:[], s:[o], s:o}", "sort", "curves",
                           "title", name, ": for how long it is below", "height", 260, "x", "label",
                           "time below (%)", "y", "label", label, "marks", "curves",
                           curve_of(run, values, unit), "tables", tables));
    }
    return all;
}

static bool write_json(const study_run *run, const char *name, const json_t *json,
                       ff_report *report)
{
    char *text = json_dumps(json, JSON_INDENT(1) | JSON_REAL_PRECISION(12));
    bool good =
        study_write_file(run->directory, name, text,
                         "the journal has all rows; the same command writes the file", report);
    free(text);
    return good;
}

bool cli_spectrum_sum(const study_run *run, json_t **sums, ff_report *report)
{
    *sums = study_spectrum_sums(run, run->keys, report);
    if (!*sums)
        return false;
    json_t *figures = figures_of(run, *sums);
    bool good = write_json(run, "spectrum.json", *sums, report) &&
                write_json(run, "spectrum.figure.json", figures, report);
    json_decref(figures);
    return good;
}
