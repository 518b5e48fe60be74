/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Computes the result of an uncertainty study from its cases. */
#include "uncertainty.h"

#include "../../../memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_BINS = 24 };

/* {value, low, high, error} */
static json_t *describe(estimate e)
{
    json_t *json = json_pack("{s:o, s:o, s:o}", "value", study_json_real(e.value), "low",
                             study_json_real(e.low), "high", study_json_real(e.high));
    if (isfinite(e.error))
        json_object_set_new(json, "error", json_real(e.error));
    return json;
}

/* Returns the values of an output, in memory of the context. */
static estimate_samples samples_of(const study_uncertainty *u, size_t output)
{
    memory_arena *arena = &u->context->arena;
    estimate_samples s = {.levels = u->plan.levels,
                          .inputs = u->aim == ESTIMATE_MEAN ? u->inputs.count : 0,
                          .input = u->shapes,
                          .numbers = u->numbers};
    for (size_t slot = 0; slot < s.levels; slot++) {
        double *values = memory_arena_alloc(arena, u->plan.count[slot] * sizeof *values);
        for (size_t i = 0; i < u->plan.count[slot]; i++)
            values[i] =
                study_uncertainty_value(u, study_uncertainty_sample_case(u, slot, i), output);
        s.count[slot] = u->plan.count[slot];
        s.values[slot] = values;
    }
    return s;
}

static json_t *histogram_of(const estimate_samples *s)
{
    double *values = memory_alloc((s->count[s->levels - 1] + 1) * sizeof *values);
    double low = INFINITY, high = -INFINITY, counts[MOST_BINS] = {0};
    size_t count = estimate_values(s, values), bins = (size_t)sqrt((double)count);
    bins = bins > MOST_BINS ? MOST_BINS : bins < 1 ? 1 : bins;
    for (size_t i = 0; i < count; i++) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    for (size_t i = 0; i < count; i++) {
        double at = high > low ? (values[i] - low) / (high - low) * (double)bins : 0;
        counts[at < (double)bins ? (size_t)at : bins - 1]++;
    }
    json_t *list = json_array();
    for (size_t k = 0; k < bins; k++)
        json_array_append_new(list, json_real(count ? counts[k] / (double)count : 0));
    free(values);
    return json_pack("{s:o, s:o, s:o}", "from", study_json_real(low), "to", study_json_real(high),
                     "shares", list);
}

/* Returns the name of a group of inputs: "torque + speed". */
static const char *name_of_group(const study_uncertainty *u, size_t group)
{
    const char *text = NULL;
    for (size_t k = 0; k < u->inputs.count; k++)
        if (u->inputs.all[k].group == group)
            text = text ? study_context_format(u->context, "%s + %s", text, u->inputs.all[k].name)
                        : u->inputs.all[k].name;
    return text;
}

static size_t last_level(const study_uncertainty *u)
{
    return u->plan.level[u->plan.levels - 1];
}

/* Computes the shares of the inputs from the level with the most samples. If r is the correlation
 * of this level with the file's model, the file's model is a multiple of the level plus a
 * remainder. The square roots of an input's parts of the variances obey the triangle inequality, so
 * its share in the file's model lies between (r sqrt(S) - e)^2 and (r sqrt(S) + e)^2, where S is
 * its share in the level and e = sqrt(1 - r^2). */
static json_t *shares_of(const study_uncertainty *u, const estimate_samples *s)
{
    estimate first[VARIATE_MOST], total[VARIATE_MOST];
    size_t last = s->levels - 1;
    json_t *shares = json_object();
    size_t n = estimate_shares(s->values[last], u->numbers, s->count[last], u->shapes,
                               u->inputs.count, u->inputs.groups, first, total);
    for (size_t g = 0; g < u->inputs.groups; g++) {
        json_t *share =
            json_pack("{s:o, s:o}", "first", describe(first[g]), "total", describe(total[g]));
        if (!isfinite(first[g].value))
            json_object_set_new(share, "untold", json_sprintf("too few samples (%zu)", n));
        json_object_set_new(shares, name_of_group(u, g), share);
    }
    return shares;
}

static double pilot_correlation(const study_uncertainty *u, size_t level, size_t output)
{
    double *values = memory_alloc(2 * u->pilot * sizeof *values);
    for (size_t i = 0; i < u->pilot; i++) {
        values[i] = study_uncertainty_value(u, study_uncertainty_pilot_case(u, 0, i), output);
        values[u->pilot + i] =
            study_uncertainty_value(u, study_uncertainty_pilot_case(u, level, i), output);
    }
    double found = estimate_correlation(values, values + u->pilot, u->pilot);
    free(values);
    return found;
}

static json_t *correlations_of(const study_uncertainty *u, size_t output)
{
    json_t *all = json_object();
    for (size_t k = 1; k < u->level_count; k++)
        json_object_set_new(all, u->levels[k].name, json_real(pilot_correlation(u, k, output)));
    return all;
}

/* Unit of an output, from the first record that has it. */
static const char *unit_of(const study_uncertainty *u, size_t output)
{
    const study_context *context = u->context;
    const char *unit = "";
    for (size_t i = 0; i < context->list.count && !*unit; i++) {
        json_t *record = study_records_get(context->records, context->keys[i]);
        const json_t *pair =
            json_object_get(json_object_get(record, "outputs"), context->outputs[output]->text);
        const char *text = json_string_value(json_array_get(pair, 0));
        unit = text ? study_context_format(u->context, "%s", text) : unit;
        json_decref(record);
        if (text)
            break;
    }
    return unit;
}

/* Returns a list of {input, word, samples, mean, deviation}. */
static json_t *words_of(const study_uncertainty *u, const estimate_samples *s)
{
    json_t *all = json_array();
    for (size_t k = 0; k < u->inputs.count; k++) {
        const variate *v = &u->inputs.all[k];
        const char *words[UNCERTAINTY_MOST_WORDS];
        size_t count = v->words ? study_uncertainty_words(v, words) : 0;
        for (size_t i = 0; count > 1 && i < count; i++) {
            estimate_samples own;
            size_t left = study_uncertainty_of_word(u, s, k, words[i], &own);
            if (left)
                json_array_append_new(all,
                                      json_pack("{s:s, s:s, s:I, s:o, s:o}", "input", v->name,
                                                "word", words[i], "samples", (json_int_t)left,
                                                "mean", describe(estimate_mean(&own)), "deviation",
                                                describe(estimate_deviation(&own))));
        }
    }
    return all;
}

static json_t *output_of(const study_uncertainty *u, size_t output)
{
    estimate_samples s = samples_of(u, output);
    json_t *percentiles = json_array();
    size_t failed = 0;
    for (size_t i = 0; i < u->share_count; i++) {
        json_t *one = describe(estimate_percentile(&s, u->shares[i]));
        json_object_set_new(one, "share", json_real(u->shares[i]));
        json_array_append_new(percentiles, one);
    }
    for (size_t i = 0; i < s.count[s.levels - 1]; i++)
        for (size_t k = 0; k < s.levels; k++)
            if (i < s.count[k] && !isfinite(s.values[k][i])) {
                failed++;
                break;
            }
    json_t *of =
        json_pack("{s:s, s:o, s:o, s:o, s:o, s:I, s:o}", "unit", unit_of(u, output), "mean",
                  describe(estimate_mean(&s)), "deviation", describe(estimate_deviation(&s)),
                  "percentiles", percentiles, "histogram", histogram_of(&s), "failed",
                  (json_int_t)failed, "correlations", correlations_of(u, output));
    json_object_set_new(of, "words", words_of(u, &s));
    json_object_set_new(of, "shares", shares_of(u, &s));
    json_object_set_new(of, "limits", study_uncertainty_limits(u, output, of));
    return of;
}

static json_t *conditions_of(const study_uncertainty *u, const json_t *outputs)
{
    json_t *all = json_object();
    for (size_t i = 0; i < u->condition_count; i++) {
        const uncertainty_condition *c = &u->conditions[i];
        const json_t *of = json_object_get(outputs, u->context->outputs[c->output]->text);
        const char *unit = study_text_of(of, "unit");
        ff_unit parsed;
        char why[300];
        double limit = (double)NAN;
        if (ff_unit_parse(unit, &parsed, why, sizeof why))
            ff_quantity_parse(c->limit, &parsed, unit, &limit, why, sizeof why);
        estimate_samples s = samples_of(u, c->output);
        estimate e = estimate_probability(&s, c->above ? limit : nextafter(limit, -INFINITY));
        if (c->above)
            e = (estimate){1 - e.value, 1 - e.high, 1 - e.low, e.error};
        json_object_set_new(all, c->text, describe(e));
    }
    return all;
}

static json_t *levels_of(const study_uncertainty *u)
{
    json_t *all = json_array();
    for (size_t k = 0; k < u->level_count; k++) {
        size_t samples = 0;
        for (size_t slot = 0; slot < u->plan.levels; slot++)
            samples += u->plan.level[slot] == k ? u->plan.count[slot] : 0;
        json_array_append_new(all,
                              json_pack("{s:s, s:o, s:f, s:b, s:o, s:I}", "name", u->levels[k].name,
                                        "seconds", study_json_real(u->seconds[k]), "cost",
                                        u->cost[k], "stated", isfinite(u->levels[k].cost),
                                        "correlation", study_json_real(u->plan.correlation[k]),
                                        "samples", (json_int_t)samples));
    }
    return all;
}

/* Gain of the ladder: how many times cheaper it was than plain samples of the same standard error,
   as promised by the pilot's correlations and costs, and as achieved; the cost of the pilot is
   included in both. */
static json_t *gain_of(const study_uncertainty *u, const json_t *outputs)
{
    const json_t *of = json_object_get(outputs, u->context->outputs[0]->text);
    double error = study_number_of(json_object_get(of, "mean"), "error");
    double deviation = study_number_of(json_object_get(of, "deviation"), "value");
    double unused = 0, spent = 0, plain = deviation * deviation / (error * error);
    for (size_t k = 0; k < u->level_count; k++) {
        bool used = false;
        for (size_t slot = 0; slot < u->plan.levels; slot++)
            used = used || u->plan.level[slot] == k;
        unused += used ? 0 : (double)u->pilot * u->cost[k];
    }
    for (size_t i = u->first_pilot; i < u->context->list.count; i++) {
        double processor = study_outcome_of(u->context, i)->processor;
        spent += isfinite(processor) ? processor : 0;
    }
    return json_pack("{s:f, s:o, s:o, s:f}", "predicted",
                     (double)u->samples / (u->plan.cost + unused), "found",
                     study_json_real(plain * u->seconds[0] / spent), "plain",
                     study_json_real(plain), "seconds", spent);
}

static json_t *inputs_of(const study_uncertainty *u)
{
    json_t *all = json_array();
    for (size_t k = 0; k < u->inputs.count; k++)
        json_array_append_new(all, json_pack("{s:s, s:s, s:s}", "name", u->inputs.all[k].name,
                                             "distribution", u->inputs.all[k].text, "group",
                                             name_of_group(u, u->inputs.all[k].group)));
    return all;
}

json_t *study_uncertainty_result(const study_uncertainty *u)
{
    json_t *outputs = json_object();
    for (size_t i = 0; i < u->context->output_count; i++)
        json_object_set_new(outputs, u->context->outputs[i]->text, output_of(u, i));
    json_t *result =
        json_pack("{s:I, s:o, s:o, s:o, s:o, s:s}", "seed", (json_int_t)u->seed, "inputs",
                  inputs_of(u), "levels", levels_of(u), "outputs", outputs, "conditions",
                  conditions_of(u, outputs), "shares_by", u->levels[last_level(u)].name);
    if (u->level_count > 1)
        json_object_set_new(result, "gain", gain_of(u, outputs));
    return result;
}
