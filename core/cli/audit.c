/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An audit on the terminal and in files. */
#include "command.h"
#include "text.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NAME = 30, COLUMN = 10, FEW_CASES = 3 };

static const char *text_of(const json_t *map, const char *key)
{
    const char *text = json_string_value(json_object_get(map, key));
    return text ? text : "";
}

static double number_of(const json_t *map, const char *key)
{
    const json_t *value = json_object_get(map, key);
    return json_is_number(value) ? json_number_value(value) : NAN;
}

static double mean_of(const json_t *output, const char *key)
{
    return number_of(json_object_get(output, key), "mean");
}

static double unsure_of(const json_t *output)
{
    return number_of(json_object_get(output, "inputs"), "uncertainty");
}

static void print_percent(double share)
{
    char text[32] = "-";
    if (isfinite(share))
        snprintf(text, sizeof text, "%.2g %%", 100 * share);
    printf(" %*s", COLUMN, text);
}

static void print_head(void)
{
    printf("  %-*s %*s %*s %*s %*s %*s  verdict\n", NAME, "relative, on the mean of a series",
           COLUMN - 4, "promised", COLUMN, "observed", COLUMN, "numerical", COLUMN, "model form",
           COLUMN, "inputs");
}

static void print_row(const char *name, const double *numbers, const char *verdict)
{
    printf("  %-*s", NAME, name);
    for (size_t i = 0; i < 5; i++)
        print_percent(numbers[i]);
    printf("  %s\n", verdict);
}

static bool is_bent(const json_t *inputs, const char *path)
{
    size_t i;
    json_t *one;
    json_array_foreach(json_object_get(inputs, "bent"), i,
                       one) if (!strcmp(json_string_value(one), path)) return true;
    return false;
}

/* What each input contributes to the square; (!) where a straight line tells little. */
static void print_inputs(const json_t *inputs)
{
    const char *path, *gap = "";
    json_t *share;
    char *all = ff_print_text("%s", "");
    json_object_foreach(json_object_get(inputs, "shares"), path, share)
    {
        char *longer =
            ff_print_text("%s%s%s %.3g %%%s", all, gap, path, 100 * json_number_value(share),
                          is_bent(inputs, path) ? " (!)" : "");
        free(all);
        all = longer;
        gap = ", ";
    }
    if (*all)
        ff_print_wrapped(all, printf("    of inputs: "), 6);
    free(all);
}

static void print_output(const json_t *output)
{
    const double own[] = {number_of(output, "promised"), mean_of(output, "observed"),
                          mean_of(output, "numerical"), mean_of(output, "model_form"),
                          unsure_of(output)};
    const char *stage;
    json_t *part;
    print_row(text_of(output, "output"), own, text_of(output, "verdict"));
    json_object_foreach(json_object_get(output, "from"), stage, part)
    {
        const double theirs[] = {NAN, mean_of(part, "observed"), mean_of(part, "numerical"),
                                 mean_of(part, "model_form"), NAN};
        char *name = ff_print_text("  through %s", stage);
        print_row(name, theirs, "");
        free(name);
    }
    print_inputs(json_object_get(output, "inputs"));
}

/* "; finer: 0.4 %, cells 640", or with counts that were doubled. */
static void put_finer(FILE *out, const json_t *stage)
{
    const json_t *finer = json_object_get(stage, "finer");
    const char *param;
    json_t *value;
    if (!json_is_object(finer))
        return;
    if (json_object_size(json_object_get(stage, "doubled")))
        fputs("; finer: its counts twice as large", out);
    else if (json_object_size(json_object_get(finer, "settings")))
        fprintf(out, "; finer: %.2g %%", 100 * number_of(finer, "promised"));
    else
        fputs("; it has nothing finer", out);
    json_object_foreach(json_object_get(stage, "doubled"), param, value)
        fprintf(out, ", %s %lld", param, (long long)json_integer_value(value));
    json_object_foreach(json_object_get(finer, "settings"), param, value)
        fprintf(out, ", %s %s", param, json_string_value(value));
}

static void print_stage(const char *name, const json_t *stage)
{
    const char *model = text_of(stage, "model");
    const char *exact = text_of(json_object_get(stage, "exact"), "model");
    char *text = NULL;
    size_t length = 0;
    FILE *out = open_memstream(&text, &length);
    if (!out)
        abort();
    fprintf(out, "%s promises %.2g %%", model, 100 * number_of(stage, "promised"));
    put_finer(out, stage);
    if (*exact && strcmp(exact, model) != 0)
        fprintf(out, "; most exact: %s", exact);
    fclose(out);
    ff_print_wrapped(text, printf("  %s: ", name), 4);
    free(text);
}

static void print_case(const json_t *one)
{
    const char *path, *name;
    json_t *value, *output;
    size_t i;
    char *head =
        ff_print_text("case %lld", (long long)json_integer_value(json_object_get(one, "case")));
    const char *gap = ": ";
    json_object_foreach(json_object_get(one, "set"), path, value)
    {
        char *longer = ff_print_text("%s%s%s %s", head, gap, path, json_string_value(value));
        free(head);
        head = longer;
        gap = ", ";
    }
    putchar('\n');
    ff_print_wrapped(head, 0, 2);
    free(head);
    json_object_foreach(json_object_get(one, "stages"), name, value) print_stage(name, value);
    json_array_foreach(json_object_get(one, "failures"), i, value)
    {
        printf("  ");
        ff_print_wrapped(text_of(value, "reason"), 2, 4);
    }
    if (json_array_size(json_object_get(one, "outputs")))
        print_head();
    json_array_foreach(json_object_get(one, "outputs"), i, output) print_output(output);
}

static bool is_remarkable(const json_t *one)
{
    size_t i;
    json_t *output;
    bool remarkable = json_array_size(json_object_get(one, "failures")) > 0;
    json_array_foreach(json_object_get(one, "outputs"), i, output)
    {
        const char *verdict = text_of(output, "verdict");
        remarkable = remarkable || (*verdict && strcmp(verdict, "kept") != 0);
    }
    return remarkable;
}

/* The largest over all audited cases, which need not be of one case. */
static void print_largest(const json_t *cases)
{
    json_t *names = json_object(), *one, *output, *none;
    const char *name;
    size_t i, k;
    json_array_foreach(cases, i, one) json_array_foreach(json_object_get(one, "outputs"), k, output)
        json_object_set_new(names, text_of(output, "output"), json_null());
    puts("\nthe largest of all these cases");
    print_head();
    json_object_foreach(names, name, none)
    {
        double most[5] = {NAN, NAN, NAN, NAN, NAN};
        json_array_foreach(cases, i, one)
            json_array_foreach(json_object_get(one, "outputs"), k, output)
        {
            if (strcmp(text_of(output, "output"), name) != 0)
                continue;
            most[0] = fmax(most[0], number_of(output, "promised"));
            most[1] = fmax(most[1], mean_of(output, "observed"));
            most[2] = fmax(most[2], mean_of(output, "numerical"));
            most[3] = fmax(most[3], mean_of(output, "model_form"));
            most[4] = fmax(most[4], unsure_of(output));
        }
        print_row(name, most, "");
    }
    json_decref(names);
}

static void print_summary(const json_t *result)
{
    const json_t *summary = json_object_get(result, "summary");
    const json_t *verdicts = json_object_get(summary, "verdicts");
    const json_t *worst = json_object_get(summary, "worst"), *count;
    const char *verdict;
    long long total = 0;
    json_object_foreach((json_t *)(size_t)verdicts, verdict, count) total +=
        json_integer_value(count);
    printf("\n%lld of %lld outputs within their promise", (long long)number_of(verdicts, "kept"),
           total);
    json_object_foreach((json_t *)(size_t)verdicts, verdict,
                        count) if (json_integer_value(count) && strcmp(verdict, "kept") != 0)
        printf(", %lld %s", (long long)json_integer_value(count), verdict);
    if (json_is_object(worst))
        printf("; the worst is %s of case %lld, with %.2g times its promise",
               text_of(worst, "output"), (long long)number_of(worst, "case"),
               number_of(worst, "times_promised"));
    putchar('\n');
    if (number_of(verdicts, "broken") > 0)
        puts("a promise is broken that is missed by more than twice: a defect of the model, please "
             "report it");
    if (number_of(verdicts, "unchecked") > 0)
        puts("unchecked: no model of the kind promises half the error or less");
}

void ff_audit_print(const json_t *result)
{
    const json_t *cases = json_object_get(result, "cases");
    json_t *one;
    size_t i, shown = 0, count = json_array_size(cases);
    printf("audit: %zu of %lld cases (every %lld, seed %lld), each chosen stage a level finer\n",
           count, (long long)number_of(result, "of"), (long long)number_of(result, "every"),
           (long long)number_of(result, "seed"));
    json_array_foreach(cases, i, one) if (count <= FEW_CASES || is_remarkable(one))
    {
        if (shown++ < 3 * FEW_CASES)
            print_case(one);
    }
    if (shown > 3 * FEW_CASES)
        printf("\n%zu more such cases stand in audit.csv\n", shown - 3 * FEW_CASES);
    if (count > 1)
        print_largest(cases);
    print_summary(result);
    if (json_object_size(json_object_get(result, "inputs")))
        puts(
            "inputs: standard uncertainty, first order, by central differences of one such "
            "uncertainty\neach; the root of the sum of squares, as for inputs that do not depend "
            "on each other; (!): not\nto be told by first order, the two sides differ by more than "
            "twice");
    putchar('\n');
}

static void put_number(FILE *out, double value)
{
    fputc(',', out);
    if (isfinite(value))
        fprintf(out, "%.6g", value);
}

static void put_errors(FILE *out, const json_t *part)
{
    static const char *const keys[] = {"observed", "numerical", "model_form"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        put_number(out, number_of(json_object_get(part, keys[i]), "mean"));
        put_number(out, number_of(json_object_get(part, keys[i]), "largest"));
    }
}

/* A row for each output of each case and each stage that its error is from, and each input. */
static void put_rows(FILE *out, const json_t *one, const json_t *output)
{
    long long number = (long long)json_integer_value(json_object_get(one, "case"));
    const char *name = text_of(output, "output"), *from;
    json_t *part, *value;
    char *stage = ff_print_text("%.*s", (int)strcspn(name, "."), name);
    const json_t *choice = json_object_get(json_object_get(one, "stages"), stage);
    fprintf(out, "%lld,%s,%s,%s", number, name, stage, text_of(choice, "model"));
    put_number(out, number_of(output, "promised"));
    put_errors(out, output);
    put_number(out, unsure_of(output));
    fprintf(out, ",%s\n", text_of(output, "verdict"));
    json_object_foreach(json_object_get(output, "from"), from, part)
    {
        choice = json_object_get(json_object_get(one, "stages"), from);
        fprintf(out, "%lld,%s,%s,%s,", number, name, from, text_of(choice, "model"));
        put_errors(out, part);
        fputs(",,\n", out);
    }
    json_object_foreach(json_object_get(json_object_get(output, "inputs"), "by"), from, value)
        fprintf(out, "%lld,%s,%s,,,,,,,,,%.6g,\n", number, name, from, json_number_value(value));
    free(stage);
}

static void put_table(const json_t *result, FILE *out)
{
    json_t *one, *output;
    size_t i, k;
    fputs("case,output,from,model,promised,observed mean,observed largest,numerical mean,"
          "numerical largest,model form mean,model form largest,input uncertainty,verdict\n",
          out);
    json_array_foreach(json_object_get(result, "cases"), i, one)
        json_array_foreach(json_object_get(one, "outputs"), k, output) put_rows(out, one, output);
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

bool ff_audit_write(const json_t *result, const char *directory, ff_report *report)
{
    return write_file(result, directory, "audit.json", put_json, report) &&
           write_file(result, directory, "audit.csv", put_table, report) &&
           write_file(result, directory, "audit.svg", ff_audit_draw, report);
}
