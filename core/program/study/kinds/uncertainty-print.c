/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Prints what an uncertainty study found, and writes it as a table. */
#include "uncertainty.h"

#include <math.h>
#include <string.h>

study_readable study_uncertainty_unit(const study_context *context, const char *name,
                                      const json_t *of)
{
    const char *dot = strrchr(name, '.');
    double mean = study_number_of(json_object_get(of, "mean"), "value");
    return context->run->readable(dot ? dot + 1 : name, study_text_of(of, "unit"),
                                  isfinite(mean) ? fabs(mean) : 1);
}

void study_uncertainty_number(const study_context *context, const char *name, const json_t *output,
                              double si, char text[UNCERTAINTY_TEXT])
{
    study_readable unit = study_uncertainty_unit(context, name, output);
    snprintf(text, UNCERTAINTY_TEXT, "%.4g%s%s", si * unit.factor + unit.offset,
             *unit.unit ? " " : "", unit.unit);
}

/* A line "what  value  low to high", times a factor and with an offset. */
static void print_estimate(study_context *context, const char *what, const json_t *e, double factor,
                           double offset, const char *unit)
{
    study_line line = {0};
    double value = study_number_of(e, "value"), low = study_number_of(e, "low"),
           high = study_number_of(e, "high");
    study_line_add(&line, "  %-28.60s", what);
    if (isfinite(value))
        study_line_add(&line, " %9.4g %-5s", value * factor + offset, unit);
    else
        study_line_add(&line, " %9s %-5s", "-", "");
    if (isfinite(low))
        study_line_add(&line, " %9.4g to", low * factor + offset);
    else
        study_line_add(&line, " %9s to", "?");
    if (isfinite(high))
        study_line_add(&line, " %.4g", high * factor + offset);
    else
        study_line_add(&line, " ?");
    study_line_print(context, &line, 0);
}

static void print_output(study_context *context, const char *name, const json_t *of)
{
    study_readable unit = study_uncertainty_unit(context, name, of);
    study_line line = {0};
    json_t *one;
    const char *input;
    size_t i;
    study_context_print_line(context, 0, "");
    study_line_add(&line, "%s, each with the interval that holds it with 95 %%", name);
    study_line_print(context, &line, 0);
    print_estimate(context, "mean", json_object_get(of, "mean"), unit.factor, unit.offset,
                   unit.unit);
    print_estimate(context, "standard deviation", json_object_get(of, "deviation"), unit.factor, 0,
                   strcmp(unit.unit, "degC") ? unit.unit : "K");
    json_array_foreach(json_object_get(of, "percentiles"), i, one)
    {
        char what[40];
        snprintf(what, sizeof what, "%.4g %% are below", 100 * study_number_of(one, "share"));
        print_estimate(context, what, one, unit.factor, unit.offset, unit.unit);
    }
    json_array_foreach(json_object_get(of, "words"), i, one)
    {
        char what[100];
        snprintf(what, sizeof what, "mean, %.40s: %.40s", study_text_of(one, "input"),
                 study_text_of(one, "word"));
        print_estimate(context, what, json_object_get(one, "mean"), unit.factor, unit.offset,
                       unit.unit);
    }
    json_object_foreach(json_object_get(of, "shares"), input, one)
    {
        char what[100];
        snprintf(what, sizeof what, "share of %.60s", input);
        if (json_object_get(one, "untold")) {
            study_line_add(&line, "  %-28.60s %s", what, study_text_of(one, "untold"));
            study_line_print(context, &line, 0);
        } else {
            print_estimate(context, what, json_object_get(one, "first"), 100, 0, "%");
        }
        print_estimate(context, "  with others", json_object_get(one, "total"), 100, 0, "%");
    }
    if (json_integer_value(json_object_get(of, "failed"))) {
        study_line_add(&line,
                       "%lld samples failed and are left out: where that hangs on the inputs, all "
                       "of the above is off",
                       (long long)json_integer_value(json_object_get(of, "failed")));
        study_line_print(context, &line, 2);
    }
}

static void print_levels(study_context *context, const json_t *result)
{
    json_t *level;
    const json_t *gain = json_object_get(result, "gain");
    study_line line = {0};
    size_t i;
    if (!gain)
        return;
    study_context_print_line(context, 0, "");
    study_context_print_line(context, 0, "  level                     cost  correlation  samples");
    json_array_foreach(json_object_get(result, "levels"), i, level)
    {
        study_line_add(&line, "  %-22.40s %6.3g %% %12.5f %8lld%s", study_text_of(level, "name"),
                       100 * study_number_of(level, "cost"), study_number_of(level, "correlation"),
                       (long long)json_integer_value(json_object_get(level, "samples")),
                       json_is_true(json_object_get(level, "stated")) || i == 0 ? ""
                                                                                : ", measured");
        double found =
            study_number_of(level, "seconds") /
            study_number_of(json_array_get(json_object_get(result, "levels"), 0), "seconds");
        if (json_is_true(json_object_get(level, "stated")) && i > 0 && isfinite(found))
            study_line_add(&line, ", %.3g %% found", 100 * found);
        study_line_print(context, &line, 0);
    }
    study_line_add(&line,
                   "the mean is known as from %.7g plain samples; %.3g times cheaper than they "
                   "would be, pilot included (%.3g predicted from it)",
                   round(study_number_of(gain, "plain")), study_number_of(gain, "found"),
                   study_number_of(gain, "predicted"));
    study_line_print(context, &line, 2);
}

void study_uncertainty_print(study_context *context, const json_t *result)
{
    json_t *of;
    const char *name, *model;
    json_object_foreach((json_t *)(size_t)json_object_get(result, "outputs"), name, of)
        print_output(context, name, of);
    if (json_object_size(json_object_get(result, "conditions")))
        study_context_print_line(context, 0, "");
    json_object_foreach(json_object_get(result, "conditions"), name, of)
        print_estimate(context, name, of, 100, 0, "%");
    print_levels(context, result);
    study_context_print_line(context, 0, "");
    json_object_foreach(json_object_get(result, "outputs"), name, of)
    {
        const json_t *limits = json_object_get(of, "limits");
        json_t *reason;
        study_context_print_line(context, 2, study_text_of(limits, "sentence"));
        json_object_foreach(json_object_get(limits, "not_compared"), model, reason)
        {
            study_line line = {0};
            study_line_add(&line, "  not compared: %s: %s", model, json_string_value(reason));
            study_line_print(context, &line, 4);
        }
    }
    study_context_print_line(context, 0, "");
}

static void put_row(FILE *out, const char *name, const char *what, const json_t *e,
                    const char *unit)
{
    study_write_cell(out, name);
    fputc(',', out);
    study_write_cell(out, what);
    for (const char *const *key = (const char *const[]){"value", "low", "high", NULL}; *key; key++)
        if (json_is_number(json_object_get(e, *key)))
            fprintf(out, ",%.9g", study_number_of(e, *key));
        else
            fputc(',', out);
    fprintf(out, ",%s\n", unit);
}

void study_uncertainty_table(const study_context *context, const json_t *result, FILE *out)
{
    json_t *of, *one;
    const char *name, *input;
    size_t i;
    (void)context;
    fputs("output,statistic,value,low,high,unit\n", out);
    json_object_foreach((json_t *)(size_t)json_object_get(result, "outputs"), name, of)
    {
        const char *unit = study_text_of(of, "unit");
        put_row(out, name, "mean", json_object_get(of, "mean"), unit);
        put_row(out, name, "standard deviation", json_object_get(of, "deviation"), unit);
        json_array_foreach(json_object_get(of, "percentiles"), i, one)
        {
            char what[40];
            snprintf(what, sizeof what, "%.6g %%", 100 * study_number_of(one, "share"));
            put_row(out, name, what, one, unit);
        }
        json_array_foreach(json_object_get(of, "words"), i, one)
        {
            char what[200];
            snprintf(what, sizeof what, "mean, %.80s: %.80s", study_text_of(one, "input"),
                     study_text_of(one, "word"));
            put_row(out, name, what, json_object_get(one, "mean"), unit);
        }
        json_object_foreach(json_object_get(of, "shares"), input, one)
        {
            char what[200];
            snprintf(what, sizeof what, "first index of %.150s", input);
            put_row(out, name, what, json_object_get(one, "first"), "1");
            snprintf(what, sizeof what, "total index of %.150s", input);
            put_row(out, name, what, json_object_get(one, "total"), "1");
        }
    }
    json_object_foreach(json_object_get(result, "conditions"), name, of)
        put_row(out, name, "probability", of, "1");
}
