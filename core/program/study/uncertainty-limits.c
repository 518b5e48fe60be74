/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What limits an answer: the error of its grids and steps, the choice of its models, or its inputs.
 */
#include "uncertainty.h"

#include <math.h>
#include <string.h>

/* Where the error of the grid is a third of another, they add up to 5 % more than that one. */
static const double counts_for_nothing = 1 / 3.;

/* Adds the models that were compared, each with how far its answer is off, and those that could not
   be; returns the largest, and sets the name of that one. */
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
                                json_string(*reason ? reason : "it does not give this output"));
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

/* The input without which most of the spread would be missing. */
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

static void add_part(study_line *line, double part, const char *what, const char *missing)
{
    if (isfinite(part))
        study_line_add(line, "±%.2g %% %s", 100 * part, what);
    else
        study_line_add(line, "%s", missing);
}

/* Says what to do about the largest of the three. */
static const char *advice(double numerical, double model, double input)
{
    double other = fmax(model, input); /* of those that are known */
    bool grid_is_nothing = numerical <= counts_for_nothing * other;
    if (!(numerical > 0) && other <= 0)
        return "none of these is known to move it";
    if (numerical > other)
        return "finer cells and steps would help most";
    if (isnan(other))
        return "nothing to compare with";
    if (input >= model || isnan(model))
        return grid_is_nothing ? "finer cells would change nothing, better inputs would"
                               : "better inputs would help most";
    return grid_is_nothing ? "finer cells would change nothing, the choice of the model does"
                           : "the choice of the model matters most";
}

json_t *study_uncertainty_limits(const study_uncertainty *u, size_t output, const json_t *of)
{
    const char *name = u->context->outputs[output]->text, *model = "", *source;
    double nominal = study_uncertainty_value(u, u->nominal, output), share;
    double bar = study_uncertainty_value(u, u->measured, u->context->output_count + output);
    double numerical = fabs(bar / nominal);
    double input = study_number_of(json_object_get(of, "deviation"), "value") /
                   fabs(study_number_of(json_object_get(of, "mean"), "value"));
    json_t *limits = json_object();
    double by_model = add_models(u, output, nominal, limits, &model);
    char number[UNCERTAINTY_TEXT];
    study_line line = {0};
    study_uncertainty_number(u->context, name, of, nominal, number);
    study_line_add(&line, "%s %s: ", name, isfinite(nominal) ? number : "not known at the medians");
    add_part(&line, numerical, "numerical, ", "numerical error not known, ");
    add_part(&line, by_model, "model", "no other model compared");
    if (isfinite(by_model))
        study_line_add(&line, " (%s)", model);
    study_line_add(&line, ", ");
    add_part(&line, input, "input", "spread of the inputs not known");
    if (isfinite(input) && (source = largest_share(of, &share)))
        study_line_add(&line, " (%s %.0f %% of it)", source, 100 * fmin(1, fmax(0, share)));
    study_line_add(&line, ": %s", advice(numerical, by_model, input));
    json_object_set_new(limits, "medians", study_json_real(nominal));
    json_object_set_new(limits, "numerical", study_json_real(numerical));
    json_object_set_new(limits, "model", study_json_real(by_model));
    json_object_set_new(limits, "input", study_json_real(input));
    json_object_set_new(limits, "sentence", json_string(line.text));
    return limits;
}
