/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A trade-off on the terminal and in files. */
#include "command.h"
#include "text.h"

#include "../value/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *text_of(const json_t *map, const char *key)
{
    const char *text = json_string_value(json_object_get(map, key));
    return text ? text : "";
}

static double number_of(const json_t *map, const char *key)
{
    return json_number_value(json_object_get(map, key));
}

/* The entry of the output's front for a candidate; NULL: it is not on it. */
static const json_t *on_front(const json_t *output, size_t candidate)
{
    size_t i;
    json_t *one;
    json_array_foreach(json_object_get(output, "front"), i,
                       one) if ((size_t)json_integer_value(json_object_get(one, "candidate")) ==
                                candidate) return one;
    return NULL;
}

/* Candidates by rising cost; those without one last. To be freed. */
static size_t *sort_by_cost(const json_t *candidates)
{
    size_t count = json_array_size(candidates);
    size_t *order = ff_alloc((count + 1) * sizeof *order);
    double *cost = ff_alloc((count + 1) * sizeof *cost);
    for (size_t i = 0; i < count; i++) {
        const json_t *seconds = json_object_get(json_array_get(candidates, i), "seconds");
        cost[i] = json_is_object(seconds) ? number_of(seconds, "median") : 1e300;
        size_t k = i;
        for (; k > 0 && cost[order[k - 1]] > cost[i]; k--)
            order[k] = order[k - 1];
        order[k] = i;
    }
    free(cost);
    return order;
}

/* {name: null} of every count that some candidate has. */
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

/* count: the one that has a column, or NULL. */
static void print_row(const json_t *candidate, const json_t *error, const json_t *place,
                      const char *count)
{
    const json_t *seconds = json_object_get(candidate, "seconds");
    double median = number_of(seconds, "median");
    double spread =
        median > 0 ? (number_of(seconds, "max") - number_of(seconds, "min")) / median : 0;
    char claim[64] = "";
    int column = printf("%c ", place ? '*' : ' ');
    if (json_is_object(error))
        column += printf("%8.3g %8.3g ", 100 * number_of(error, "largest"),
                         100 * number_of(error, "rms"));
    else
        column += printf("%8s %8s ", "-", "-");
    if (json_is_object(seconds))
        column += printf("%9.3g %6.0f ", median, 100 * spread);
    else
        column += printf("%9s %6s ", "-", "-");
    if (count && json_object_get(json_object_get(candidate, "counts"), count))
        column += printf("%8.0f ", number_of(json_object_get(candidate, "counts"), count));
    else if (count)
        column += printf("%8s ", "");
    if (json_object_get(error, "claimed"))
        snprintf(claim, sizeof claim, "%.3g%s", 100 * number_of(error, "claimed"),
                 !strcmp(text_of(error, "claim"), "kept")        ? ""
                 : !strcmp(text_of(error, "claim"), "too small") ? " (!)"
                                                                 : " (+)");
    column += printf("%11s  ", claim);
    const char *reason = text_of(candidate, "reason");
    char *text = ff_print_text("%s%s%s%s", text_of(candidate, "label"), *reason ? ": " : "", reason,
                               json_is_true(json_object_get(place, "knee")) ? "  <- knee" : "");
    ff_print_cut(text, column);
    free(text);
}

static void print_front(const json_t *candidates, const json_t *front)
{
    size_t i;
    json_t *one;
    puts("  what each step along the front buys:");
    json_array_foreach(front, i, one)
    {
        const json_t *at = json_array_get(
            candidates, (size_t)json_integer_value(json_object_get(one, "candidate")));
        char *text;
        if (i == 0)
            text = ff_print_text("%s: %.3g s, error %.3g %%", text_of(at, "label"),
                                 number_of(one, "seconds"), 100 * number_of(one, "error"));
        else
            text = ff_print_text("%s: %.3g times the cost, error divided by %.3g",
                                 text_of(at, "label"), number_of(one, "times_the_cost"),
                                 1 / number_of(one, "part_of_the_error"));
        printf("    ");
        ff_print_wrapped(text, 4, 6);
        free(text);
    }
}

static void print_reference(const json_t *reference)
{
    size_t i;
    json_t *level, *change;
    const char *output;
    json_array_foreach(json_object_get(reference, "levels"), i, level)
    {
        printf("reference %zu: %s, %.3g s", i, text_of(level, "label"),
               number_of(level, "seconds"));
        json_object_foreach(json_object_get(level, "change"), output, change)
            printf("; %s changed by %.2g %%", output, 100 * json_number_value(change));
        putchar('\n');
    }
}

static void print_head(const char *output, double floor, const char *count)
{
    const char *dot = count ? strchr(count, '.') : NULL;
    char work[16] = "";
    if (dot)
        snprintf(work, sizeof work, " %8.8s", dot + 1);
    printf("\n%s, known to %.2g %%\n  %8s %8s %9s %6s%s %11s\n  %8s %8s %9s %6s%*s %11s\n", output,
           100 * floor, "error", "rms", "cost", "spread", work, "claimed", "%", "%", "s", "%",
           (int)strlen(work), "", "%");
}

void ff_tradeoff_print(const json_t *result)
{
    const json_t *candidates = json_object_get(result, "candidates");
    const json_t *reference = json_object_get(result, "reference");
    const char *output;
    json_t *one;
    size_t *order = sort_by_cost(candidates);
    json_t *names = names_of_counts(candidates);
    const char *count = json_object_iter_key(json_object_iter(names));
    print_reference(reference);
    if (!json_is_true(json_object_get(reference, "reached")))
        printf("it changes by more than a tenth of the smallest error sought, %.3g %%\n",
               100 * number_of(result, "accuracy"));
    json_object_foreach(json_object_get(result, "outputs"), output, one)
    {
        print_head(output, number_of(one, "reference_error"), count);
        for (size_t i = 0; i < json_array_size(candidates); i++) {
            const json_t *candidate = json_array_get(candidates, order[i]);
            print_row(candidate, json_object_get(json_object_get(candidate, "errors"), output),
                      on_front(one, order[i]), count);
        }
        print_front(candidates, json_object_get(one, "front"));
    }
    puts(
        "\n* on the front; (!) the model claimed less than a third of its error, (+) more than ten "
        "times\n");
    json_decref(names);
    free(order);
}

static void put_quoted(FILE *out, const char *text)
{
    fputc('"', out);
    for (; *text; text++)
        fputs(*text == '"' ? "\"\"" : (char[]){*text, 0}, out);
    fputc('"', out);
}

static void put_number(FILE *out, const json_t *number)
{
    fputc(',', out);
    if (json_is_number(number))
        fprintf(out, "%.6g", json_number_value(number));
}

static void put_error(FILE *out, const json_t *error, bool front)
{
    for (const char *const *key = (const char *const[]){"largest", "rms", "claimed", NULL}; *key;
         key++)
        put_number(out, json_object_get(error, *key));
    fprintf(out, ",%s,%d", text_of(error, "claim"), front);
    put_number(out, json_object_get(error, "over_front"));
}

static void put_table(const json_t *result, FILE *out)
{
    json_t *candidates = json_object_get(result, "candidates"), *candidate, *one;
    json_t *outputs = json_object_get(result, "outputs"), *names = names_of_counts(candidates);
    const char *name;
    size_t i;
    fputs("candidate,status,cost [s],cost_min [s],cost_max [s],repeats", out);
    json_object_foreach(names, name, one) fprintf(out, ",%s", name);
    json_object_foreach(outputs, name, one)
        fprintf(out, ",%s error,%s rms,%s claimed,%s claim,%s front,%s cost_over_front", name, name,
                name, name, name, name);
    fputs(",reason\n", out);
    json_array_foreach(candidates, i, candidate)
    {
        const json_t *seconds = json_object_get(candidate, "seconds");
        put_quoted(out, text_of(candidate, "label"));
        fprintf(out, ",%s", text_of(candidate, "status"));
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
        put_quoted(out, text_of(candidate, "reason"));
        fputc('\n', out);
    }
    json_decref(names);
}

static void put_json(const json_t *result, FILE *out)
{
    json_dumpf(result, out, JSON_INDENT(1) | JSON_REAL_PRECISION(6));
    fputc('\n', out);
}

/* The file is there whole, or as it was. */
static bool write_file(const json_t *result, const char *directory, const char *name,
                       void (*put)(const json_t *, FILE *), ff_report *report)
{
    char *path = ff_print_text("%s/%s", directory, name), *part = ff_print_text("%s.part", path);
    FILE *out = fopen(part, "we");
    bool good = out != NULL;
    if (out) {
        put(result, out);
        good = !ferror(out);
        good = fclose(out) == 0 && good;
    }
    good = good && rename(part, path) == 0;
    if (!good)
        ff_error(report, FF_EXIT_FAILED, FF_NOWHERE,
                 "the journal has all cases; the same command writes the file",
                 "%s could not be written: %s", path, strerror(errno));
    free(path);
    free(part);
    return good;
}

bool ff_tradeoff_write(const json_t *result, const char *directory, ff_report *report)
{
    return write_file(result, directory, "tradeoff.json", put_json, report) &&
           write_file(result, directory, "tradeoff.csv", put_table, report) &&
           write_file(result, directory, "tradeoff.svg", ff_tradeoff_draw, report);
}
