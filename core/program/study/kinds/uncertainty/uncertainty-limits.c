/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds what limits an answer: the error of its grids and steps, the choice of its models, or its
   inputs. */
#include "uncertainty.h"

#include <math.h>
#include <string.h>

/* An error below a third of another one is neglected, since it adds only 5 % to it (sum of
 * squares). */
static const double negligible = 1 / 3.;

study_readable study_uncertainty_unit(const char *name, const json_t *of)
{
    const char *dot = strrchr(name, '.');
    double mean = study_number_of(json_object_get(of, "mean"), "value");
    return study_readable_output(dot ? dot + 1 : name, study_text_of(of, "unit"),
                                 isfinite(mean) ? fabs(mean) : 1);
}

/* "126.1 nm" */
static void print_number(const char *name, const json_t *output, double si,
                         char text[UNCERTAINTY_TEXT])
{
    study_readable unit = study_uncertainty_unit(name, output);
    study_quantity_text(si, &unit, 4, " ", text);
}

/* Adds the compared models with the difference of their answers, and those that could not be
   compared. Returns the largest difference and sets its model's name. */
static double add_models(const study_uncertainty *u, size_t output, double nominal, json_t *into,
                         const char **name)
{
    json_t *tried = json_object(), *failed = json_object();
    double largest = (double)NAN;
    for (size_t i = 0; i < u->model_count; i++) {
        size_t number = u->first_model + i;
        double off = study_uncertainty_value(u, number, output) / nominal - 1;
        const char *reason = study_outcome_of(u->context, number)->reason;
        if (!isfinite(off)) {
            json_object_set_new(failed, u->models[i].name,
                                json_string(*reason ? reason : "it does not have this output"));
            continue;
        }
        json_object_set_new(tried, u->models[i].name, json_real(off));
        if (!(fabs(off) <= largest)) {
            largest = fabs(off);
            *name = u->models[i].name;
        }
    }
    json_object_set_new(into, "models", tried);
    json_object_set_new(into, "not_compared", failed);
    return largest;
}

/* Returns the input that contributes most to the spread. */
static const char *largest_share(const json_t *of, double *share)
{
    json_t *shares = json_object_get(of, "shares"), *one;
    const char *name, *found = NULL;
    *share = -1;
    json_object_foreach(shares, name, one)
    {
        double total = study_number_of(json_object_get(one, "total"), "value");
        if (total > *share) {
            *share = total;
            found = name;
        }
    }
    return found;
}

/* `kelvin` is the error of a temperature, for which no relative error is stated; NaN for other
 * outputs. */
static void add_part(study_line *line, double part, double kelvin, const char *what,
                     const char *missing)
{
    if (isfinite(part) && isfinite(kelvin))
        study_line_add(line, "±%.2g K %s", part * fabs(kelvin), what);
    else if (isfinite(part))
        study_line_add(line, "±%.2g %% %s", 100 * part, what);
    else
        study_line_add(line, "%s", missing);
}

/* Half width of the middle 95 % of a normal variate, in standard deviations, so that the bar of the
   inputs has the same confidence as the numerical bar. */
static const double z95 = 1.959963984540054;

/* Relative error bar due to the inputs, with its 95 % interval; NaN if an end is not bounded. */
typedef struct input_bar {
    double value, low, high;
} input_bar;

static input_bar input_bar_of(const json_t *of)
{
    const json_t *deviation = json_object_get(of, "deviation");
    double by = z95 / fabs(study_number_of(json_object_get(of, "mean"), "value"));
    return (input_bar){study_number_of(deviation, "value") * by,
                       study_number_of(deviation, "low") * by,
                       study_number_of(deviation, "high") * by};
}

/* True if the samples cannot tell whether the spread due to the inputs or another bar is larger. */
static bool is_open(const input_bar *input, double bar)
{
    return input->value > 0 && isfinite(bar) && !(bar < input->low) && !(bar > input->high);
}

/* Names the inputs, the larger of the two other bars, and also the smaller one if it counts. */
static const char *open_advice(double numerical, double model, const input_bar *input)
{
    double least = negligible * fmax(numerical, model);
    bool by_grid = numerical > least && is_open(input, numerical);
    bool by_model = model > least && is_open(input, model);
    if (by_grid && by_model)
        return "the inputs, the choice of the model, and cells and steps may matter equally";
    if (by_grid)
        return "the inputs, and cells and steps, may matter equally";
    return numerical <= least ? "finer cells would change nothing; the inputs and the choice of "
                                "the model may matter equally"
                              : "the inputs and the choice of the model may matter equally";
}

/* Advises about the largest of the three bars. */
static const char *advice(double numerical, double model, const input_bar *input)
{
    double other = fmax(model, input->value); /* largest of the known bars */
    bool grid_is_nothing = numerical <= negligible * other;
    if (!(numerical > 0) && other <= 0)
        return "none of the three is known to change it";
    if (is_open(input, fmax(numerical, model)))
        return open_advice(numerical, model, input);
    if (numerical > other)
        return "finer cells and steps would help most";
    if (isnan(other))
        return "no bar to compare with";
    if (input->value >= model || isnan(model))
        return grid_is_nothing ? "finer cells would change nothing, better inputs would help"
                               : "better inputs would help most";
    return grid_is_nothing ? "finer cells would change nothing, the choice of the model matters"
                           : "the choice of the model matters most";
}

json_t *study_uncertainty_limits(const study_uncertainty *u, size_t output, const json_t *of)
{
    const char *name = u->context->outputs[output]->text, *model = "", *source;
    double nominal = study_uncertainty_value(u, u->nominal, output), share;
    double bar = study_uncertainty_value(u, u->measured, u->context->output_count + output);
    double numerical = fabs(bar / nominal);
    input_bar input = input_bar_of(of);
    json_t *limits = json_object();
    double by_model = add_models(u, output, nominal, limits, &model);
    char number[UNCERTAINTY_TEXT];
    study_line line = {0};
    const bool point = !strcmp(study_uncertainty_unit(name, of).unit, "degC");
    const double kelvin = point ? nominal : (double)NAN;
    print_number(name, of, nominal, number);
    study_line_add(&line, "%s %s: ", name, isfinite(nominal) ? number : "not known at the medians");
    add_part(&line, numerical, kelvin, "numerical, ", "numerical error not known, ");
    add_part(&line, by_model, kelvin, "model", "no other model compared");
    if (isfinite(by_model))
        study_line_add(&line, " (%s)", model);
    study_line_add(&line, ", ");
    add_part(&line, input.value, kelvin, "input", "spread of the inputs not known");
    if (isfinite(input.value) && (source = largest_share(of, &share)))
        study_line_add(&line, " (%s %.0f %% of it)", source, 100 * fmin(1, fmax(0, share)));
    study_line_add(&line, ": %s", advice(numerical, by_model, &input));
    json_object_set_new(limits, "medians", study_json_real(nominal));
    json_object_set_new(limits, "numerical", study_json_real(numerical));
    json_object_set_new(limits, "model", study_json_real(by_model));
    json_object_set_new(limits, "input", study_json_real(input.value));
    json_object_set_new(limits, "sentence", json_string(line.text));
    return limits;
}
