/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An audit on the terminal and in files. */
#include "audit.h"

enum { NAME = 30, COLUMN = 10, FEW_CASES = 3 };

static double mean_of(const json_t *output, const char *key)
{
    return study_number_of(json_object_get(output, key), "mean");
}

static double unsure_of(const json_t *output)
{
    return study_number_of(json_object_get(output, "inputs"), "uncertainty");
}

static void put_percent(study_line *line, double share)
{
    char text[32] = "-";
    if (isfinite(share))
        snprintf(text, sizeof text, "%.2g %%", 100 * share);
    study_put(line, " %*s", COLUMN, text);
}

static void print_head(const ff_study_desk *desk)
{
    study_line line = {0};
    study_put(&line, "  %-*s %*s %*s %*s %*s %*s  verdict", NAME,
              "relative, on the mean of a series", COLUMN - 4, "promised", COLUMN, "observed",
              COLUMN, "numerical", COLUMN, "model form", COLUMN, "inputs");
    study_tell(desk, &line, -1);
}

static void print_row(const ff_study_desk *desk, const char *name, const double *numbers,
                      const char *verdict)
{
    study_line line = {0};
    study_put(&line, "  %-*s", NAME, name);
    for (size_t i = 0; i < 5; i++)
        put_percent(&line, numbers[i]);
    study_put(&line, "  %s", verdict);
    study_tell(desk, &line, -1);
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
static void print_inputs(const ff_study_desk *desk, const json_t *inputs)
{
    const char *path, *gap = "    of inputs: ";
    json_t *share;
    study_line line = {0};
    json_object_foreach(json_object_get(inputs, "shares"), path, share)
    {
        study_put(&line, "%s%s %.3g %%%s", gap, path, 100 * json_number_value(share),
                  is_bent(inputs, path) ? " (!)" : "");
        gap = ", ";
    }
    if (line.used)
        study_tell(desk, &line, 6);
}

static void print_output(const ff_study_desk *desk, const json_t *output)
{
    const double own[] = {study_number_of(output, "promised"), mean_of(output, "observed"),
                          mean_of(output, "numerical"), mean_of(output, "model_form"),
                          unsure_of(output)};
    const char *stage;
    json_t *part;
    print_row(desk, study_text_of(output, "output"), own, study_text_of(output, "verdict"));
    json_object_foreach(json_object_get(output, "from"), stage, part)
    {
        const double theirs[] = {NAN, mean_of(part, "observed"), mean_of(part, "numerical"),
                                 mean_of(part, "model_form"), NAN};
        print_row(desk, study_keep(desk, "  through %s", stage), theirs, "");
    }
    print_inputs(desk, json_object_get(output, "inputs"));
}

/* "; finer: 0.4 %, cells 640", or with counts that were doubled. */
static void put_finer(study_line *line, const json_t *stage)
{
    const json_t *finer = json_object_get(stage, "finer");
    const char *param;
    json_t *value;
    if (!json_is_object(finer))
        return;
    if (json_object_size(json_object_get(stage, "doubled")))
        study_put(line, "; finer: its counts twice as large");
    else if (json_object_size(json_object_get(finer, "settings")))
        study_put(line, "; finer: %.3g %%", 100 * study_number_of(finer, "promised"));
    else
        study_put(line, "; it has nothing finer");
    json_object_foreach(json_object_get(stage, "doubled"), param, value)
        study_put(line, ", %s %lld", param, (long long)json_integer_value(value));
    json_object_foreach(json_object_get(finer, "settings"), param, value)
        study_put(line, ", %s %s", param, json_string_value(value));
}

static void print_stage(const ff_study_desk *desk, const char *name, const json_t *stage)
{
    const char *model = study_text_of(stage, "model");
    const char *exact = study_text_of(json_object_get(stage, "exact"), "model");
    study_line line = {0};
    study_put(&line, "  %s: %s promises %.3g %%", name, model,
              100 * study_number_of(stage, "promised"));
    put_finer(&line, stage);
    if (*exact && strcmp(exact, model) != 0)
        study_put(&line, "; most exact: %s", exact);
    study_tell(desk, &line, 4);
}

static void print_case(const ff_study_desk *desk, const json_t *one)
{
    const char *path, *name, *gap = ": ";
    json_t *value, *output;
    size_t i;
    study_line line = {0};
    study_put(&line, "case %lld", (long long)json_integer_value(json_object_get(one, "case")));
    json_object_foreach(json_object_get(one, "set"), path, value)
    {
        study_put(&line, "%s%s %s", gap, path, json_string_value(value));
        gap = ", ";
    }
    desk->say(desk->ctx, 0, "");
    study_tell(desk, &line, 2);
    json_object_foreach(json_object_get(one, "stages"), name, value) print_stage(desk, name, value);
    json_array_foreach(json_object_get(one, "failures"), i, value)
    {
        study_put(&line, "  %s", study_text_of(value, "reason"));
        study_tell(desk, &line, 4);
    }
    if (json_array_size(json_object_get(one, "outputs")))
        print_head(desk);
    json_array_foreach(json_object_get(one, "outputs"), i, output) print_output(desk, output);
}

static bool is_remarkable(const json_t *one)
{
    size_t i;
    json_t *output;
    bool remarkable = json_array_size(json_object_get(one, "failures")) > 0;
    json_array_foreach(json_object_get(one, "outputs"), i, output)
    {
        const char *verdict = study_text_of(output, "verdict");
        remarkable = remarkable || (*verdict && strcmp(verdict, "kept") != 0);
    }
    return remarkable;
}

/* The largest over all audited cases, which need not be of one case. */
static void print_largest(const ff_study_desk *desk, const json_t *cases)
{
    json_t *names = json_object(), *one, *output, *none;
    const char *name;
    size_t i, k;
    json_array_foreach(cases, i, one) json_array_foreach(json_object_get(one, "outputs"), k, output)
        json_object_set_new(names, study_text_of(output, "output"), json_null());
    desk->say(desk->ctx, 0, "");
    desk->say(desk->ctx, 0, "the largest of all these cases");
    print_head(desk);
    json_object_foreach(names, name, none)
    {
        double most[5] = {NAN, NAN, NAN, NAN, NAN};
        json_array_foreach(cases, i, one)
            json_array_foreach(json_object_get(one, "outputs"), k, output)
        {
            if (strcmp(study_text_of(output, "output"), name) != 0)
                continue;
            most[0] = fmax(most[0], study_number_of(output, "promised"));
            most[1] = fmax(most[1], mean_of(output, "observed"));
            most[2] = fmax(most[2], mean_of(output, "numerical"));
            most[3] = fmax(most[3], mean_of(output, "model_form"));
            most[4] = fmax(most[4], unsure_of(output));
        }
        print_row(desk, name, most, "");
    }
    json_decref(names);
}

static void print_summary(const ff_study_desk *desk, const json_t *result)
{
    const json_t *summary = json_object_get(result, "summary");
    const json_t *verdicts = json_object_get(summary, "verdicts");
    const json_t *worst = json_object_get(summary, "worst"), *count;
    const char *verdict;
    long long total = 0;
    study_line line = {0};
    json_object_foreach((json_t *)(size_t)verdicts, verdict, count) total +=
        json_integer_value(count);
    study_put(&line, "%lld of %lld outputs within their promise",
              (long long)study_number_of(verdicts, "kept"), total);
    json_object_foreach((json_t *)(size_t)verdicts, verdict,
                        count) if (json_integer_value(count) && strcmp(verdict, "kept") != 0)
        study_put(&line, ", %lld %s", (long long)json_integer_value(count), verdict);
    if (json_is_object(worst))
        study_put(&line, "; the worst is %s of case %lld, with %.2g times its promise",
                  study_text_of(worst, "output"), (long long)study_number_of(worst, "case"),
                  study_number_of(worst, "times_promised"));
    desk->say(desk->ctx, 0, "");
    study_tell(desk, &line, -1);
    if (study_number_of(verdicts, "broken") > 0)
        desk->say(desk->ctx, -1,
                  "a promise is broken that is missed by more than twice: a defect of the model, "
                  "please report it");
    if (study_number_of(verdicts, "unchecked") > 0)
        desk->say(desk->ctx, -1, "unchecked: no model of the kind promises half the error or less");
}

static bool has_input(const json_t *cases, const char *path)
{
    json_t *one, *output;
    size_t i, k;
    json_array_foreach(cases, i, one) json_array_foreach(
        json_object_get(one, "outputs"), k,
        output) if (json_object_get(json_object_get(json_object_get(output, "inputs"), "by"),
                                    path)) return true;
    return false;
}

static void print_note(const ff_study_desk *desk, const json_t *result)
{
    json_t *inputs = json_object_get(result, "inputs"), *width;
    const char *path;
    json_object_foreach(inputs, path, width)
    {
        if (!has_input(json_object_get(result, "cases"), path))
            desk->say(desk->ctx, -1,
                      study_keep(desk, "%s: no audited case was varied in it", path));
    }
    if (json_object_size(inputs) == 0)
        return;
    desk->say(desk->ctx, -1,
              "inputs: standard uncertainty, first order, by central differences of one such "
              "uncertainty");
    desk->say(desk->ctx, -1,
              "each; the root of the sum of squares, as for inputs that do not depend on each "
              "other; (!): not");
    desk->say(desk->ctx, -1, "to be told by first order, the two sides differ by more than twice");
}

void study_audit_print(const ff_study_desk *desk, const json_t *result)
{
    const json_t *cases = json_object_get(result, "cases");
    json_t *one;
    study_line line = {0};
    size_t i, shown = 0, count = json_array_size(cases);
    study_put(
        &line, "audit: %zu of %lld cases (every %lld, seed %lld), each chosen stage a level finer",
        count, (long long)study_number_of(result, "of"),
        (long long)study_number_of(result, "every"), (long long)study_number_of(result, "seed"));
    study_tell(desk, &line, -1);
    json_array_foreach(cases, i, one) if (count <= FEW_CASES || is_remarkable(one))
    {
        if (shown++ < 3 * FEW_CASES)
            print_case(desk, one);
    }
    if (shown > 3 * FEW_CASES) {
        desk->say(desk->ctx, 0, "");
        study_put(&line, "%zu more such cases stand in audit.csv", shown - 3 * FEW_CASES);
        study_tell(desk, &line, 0);
    }
    if (count > 1)
        print_largest(desk, cases);
    print_summary(desk, result);
    print_note(desk, result);
    desk->say(desk->ctx, 0, "");
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
        put_number(out, study_number_of(json_object_get(part, keys[i]), "mean"));
        put_number(out, study_number_of(json_object_get(part, keys[i]), "largest"));
    }
}

/* A row for each output of each case and each stage that its error is from, and each input. */
static void put_rows(FILE *out, const json_t *one, const json_t *output)
{
    long long number = (long long)json_integer_value(json_object_get(one, "case"));
    const char *name = study_text_of(output, "output"), *from;
    json_t *part, *value;
    char stage[100];
    snprintf(stage, sizeof stage, "%.*s", (int)strcspn(name, "."), name);
    const json_t *choice = json_object_get(json_object_get(one, "stages"), stage);
    fprintf(out, "%lld,%s,%s,%s", number, name, stage, study_text_of(choice, "model"));
    put_number(out, study_number_of(output, "promised"));
    put_errors(out, output);
    put_number(out, unsure_of(output));
    fprintf(out, ",%s\n", study_text_of(output, "verdict"));
    json_object_foreach(json_object_get(output, "from"), from, part)
    {
        choice = json_object_get(json_object_get(one, "stages"), from);
        fprintf(out, "%lld,%s,%s,%s,", number, name, from, study_text_of(choice, "model"));
        put_errors(out, part);
        fputs(",,\n", out);
    }
    json_object_foreach(json_object_get(json_object_get(output, "inputs"), "by"), from, value)
        fprintf(out, "%lld,%s,%s,,,,,,,,,%.6g,\n", number, name, from, json_number_value(value));
}

void study_audit_table(const json_t *result, FILE *out)
{
    json_t *one, *output;
    size_t i, k;
    fputs("case,output,from,model,promised,observed mean,observed largest,numerical mean,"
          "numerical largest,model form mean,model form largest,input uncertainty,verdict\n",
          out);
    json_array_foreach(json_object_get(result, "cases"), i, one)
        json_array_foreach(json_object_get(one, "outputs"), k, output) put_rows(out, one, output);
}
