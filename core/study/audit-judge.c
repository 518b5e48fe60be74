/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an audit comes to: errors apart by where they are from, held against what was promised. */
#include "audit-compare.h"
#include "audit-private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static json_t *real(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static double *numbers(const json_t *list, size_t *count)
{
    *count = json_array_size(list);
    double *values = ff_alloc((*count + 1) * sizeof *values);
    for (size_t i = 0; i < *count; i++) {
        const json_t *value = json_array_get(list, i);
        values[i] = json_is_number(value) ? json_number_value(value) : NAN;
    }
    return values;
}

static const json_t *data_of(const ff_probe *p, const char *output)
{
    return output ? json_object_get(json_object_get(p->arrays, output), "data") : NULL;
}

/* What a probe gave for an output; to be freed in either case. */
static ff_answer answer_of(const ff_probe *p, const ff_audited *item)
{
    const json_t *pair =
        json_object_get(json_object_get(p ? p->record : NULL, "outputs"), item->output);
    const json_t *data = p ? data_of(p, item->output) : NULL;
    ff_answer a = {.series = !pair};
    size_t length = 0;
    if (pair) {
        a.value = ff_alloc(sizeof *a.value);
        a.value[0] = json_number_value(json_array_get(pair, 1));
        a.count = 1;
    } else if (data) {
        a.value = numbers(data, &a.count);
        a.at = numbers(data_of(p, item->axis), &length);
        if (length != a.count) { /* points are told apart by their number */
            free(a.at);
            a.at = NULL;
        }
    }
    return a;
}

/* {mean, largest}, or null; of a scalar they are the same. */
static json_t *difference(const ff_probe *answer, const ff_probe *reference, const ff_audited *item)
{
    ff_answer a = answer_of(answer, item), b = answer_of(reference, item);
    ff_distance d;
    json_t *result = ff_answer_compare(&a, &b, &d)
                         ? json_pack("{s:f, s:f}", "mean", d.mean, "largest", d.largest)
                         : json_null();
    ff_answer_free(&a);
    ff_answer_free(&b);
    return result;
}

static const json_t *choice_of(const ff_probe *p, const char *stage)
{
    return json_object_get(json_object_get(p ? p->record : NULL, "choices"), stage);
}

static const char *model_of(const ff_probe *p, const char *stage)
{
    const char *model = json_string_value(json_object_get(choice_of(p, stage), "model"));
    return model ? model : "";
}

static double promise_of(const ff_probe *p, const char *stage)
{
    const json_t *promised = json_object_get(choice_of(p, stage), "promised");
    return json_is_number(promised) ? json_number_value(promised) : INFINITY;
}

/* What a case promises for a stage. That of a model whose counts were doubled, of which it says
   nothing, is taken to be half. */
static double refined_promise(const ff_probe *base, const ff_probe *p, const char *stage)
{
    bool doubled = p && p->kind == FF_PROBE_FINER &&
                   json_object_size(json_object_get(choice_of(base, stage), "doubled")) > 0;
    return doubled ? promise_of(base, stage) / 2 : promise_of(p, stage);
}

/* The more exact of the two refined cases of a stage; NULL: neither ran. */
static const ff_probe *reference_of(const ff_auditing *a, size_t subject, const char *stage)
{
    const ff_probe *base = ff_find_probe(a, subject, FF_PROBE_BASE, "");
    const ff_probe *finer = ff_find_probe(a, subject, FF_PROBE_FINER, stage);
    const ff_probe *exact = ff_find_probe(a, subject, FF_PROBE_EXACT, stage);
    if (!finer || !exact)
        return finer ? finer : exact;
    return promise_of(exact, stage) < refined_promise(base, finer, stage) ? exact : finer;
}

/* A reference that promises little more than what is judged proves nothing but gross lies. */
static const char *judge(double promised, double observed, double reference)
{
    if (!(reference <= promised / 2))
        return observed > 2 * promised + reference ? "broken" : "unchecked";
    return observed <= promised ? "kept" : observed <= 2 * promised ? "exceeded" : "broken";
}

/* What a stage that has chosen its model is to blame for in an output. */
static json_t *blame(const ff_auditing *a, size_t subject, const ff_probe *base,
                     const ff_audited *item, const char *stage)
{
    const ff_probe *finer = ff_find_probe(a, subject, FF_PROBE_FINER, stage);
    const ff_probe *exact = ff_find_probe(a, subject, FF_PROBE_EXACT, stage);
    bool other = exact && promise_of(exact, stage) < promise_of(base, stage) &&
                 strcmp(model_of(exact, stage), model_of(base, stage)) != 0;
    return json_pack("{s:o, s:o, s:o}", "observed",
                     difference(base, reference_of(a, subject, stage), item), "numerical",
                     difference(base, finer, item), "model_form",
                     other ? difference(finer, exact, item) : json_null());
}

static double mean_of(const json_t *difference)
{
    const json_t *mean = json_object_get(difference, "mean");
    return json_is_number(mean) ? json_number_value(mean) : NAN;
}

/* Adds the promise of the output's own stage and the verdict. */
static void hold_to_promise(const ff_auditing *a, size_t subject, const ff_probe *base,
                            const ff_audited *item, json_t *entry)
{
    double promised = promise_of(base, item->stage);
    double reference = refined_promise(base, reference_of(a, subject, item->stage), item->stage);
    double observed = mean_of(json_object_get(entry, "observed"));
    const char *verdict =
        isfinite(observed) ? judge(promised, observed, reference) : "not compared";
    json_object_update_new(entry, json_pack("{s:o, s:o, s:s}", "promised", real(promised),
                                            "reference", real(reference), "verdict", verdict));
}

/* What an input of that uncertainty makes of the output. */
static bool central(const ff_auditing *a, size_t subject, const ff_probe *base,
                    const ff_audited *item, const char *input, double *slope, bool *bent)
{
    ff_answer middle = answer_of(base, item);
    ff_answer up = answer_of(ff_find_probe(a, subject, FF_PROBE_UP, input), item);
    ff_answer down = answer_of(ff_find_probe(a, subject, FF_PROBE_DOWN, input), item);
    bool good = ff_answer_slope(&middle, &up, &down, slope, bent);
    ff_answer_free(&middle);
    ff_answer_free(&up);
    ff_answer_free(&down);
    return good;
}

/* {uncertainty, shares: {input: part of its square}, by: {input: uncertainty}, bent: [inputs]} */
static json_t *inputs_of(const ff_auditing *a, size_t subject, const ff_probe *base,
                         const ff_audited *item)
{
    json_t *by = json_object(), *shares = json_object(), *bent = json_array(), *one;
    const char *path;
    double sum = 0;
    for (size_t i = 0; i < a->audit->input_count; i++) {
        const char *input = a->audit->inputs[i].path;
        double slope;
        bool turns;
        if (!central(a, subject, base, item, input, &slope, &turns))
            continue;
        json_object_set_new(by, input, json_real(slope));
        sum += slope * slope;
        if (turns)
            json_array_append_new(bent, json_string(input));
    }
    json_object_foreach(by, path, one)
    {
        double slope = json_number_value(one);
        json_object_set_new(shares, path, real(sum > 0 ? slope * slope / sum : 0));
    }
    if (json_object_size(by) == 0) {
        json_decref(by);
        json_decref(shares);
        json_decref(bent);
        return json_null();
    }
    return json_pack("{s:f, s:o, s:o, s:o}", "uncertainty", sqrt(sum), "by", by, "shares", shares,
                     "bent", bent);
}

static json_t *judge_item(const ff_auditing *a, size_t subject, const ff_probe *base,
                          const ff_audited *item)
{
    json_t *choices = json_object_get(base->record, "choices"), *choice, *from = json_object();
    const char *stage;
    json_t *entry = json_object_get(choices, item->stage)
                        ? blame(a, subject, base, item, item->stage)
                        : json_object();
    json_object_set_new(entry, "output", json_string(item->output));
    if (json_object_get(choices, item->stage))
        hold_to_promise(a, subject, base, item, entry);
    json_object_foreach(choices, stage, choice)
    {
        json_t *part = strcmp(stage, item->stage) ? blame(a, subject, base, item, stage) : NULL;
        if (part && mean_of(json_object_get(part, "observed")) > 0)
            json_object_set(from, stage, part);
        json_decref(part);
    }
    json_object_set_new(entry, "from", from);
    json_object_set_new(entry, "inputs", inputs_of(a, subject, base, item));
    return entry;
}

/* {stage: {model, promised, settings, finer: {...}, exact: {...}}} */
static json_t *describe_choices(const ff_auditing *a, size_t subject, const ff_probe *base)
{
    json_t *choices = json_object_get(base->record, "choices"), *choice, *all = json_object();
    const char *stage;
    json_object_foreach(choices, stage, choice)
    {
        json_t *copy = json_copy(choice);
        const ff_probe *finer = ff_find_probe(a, subject, FF_PROBE_FINER, stage);
        const ff_probe *exact = ff_find_probe(a, subject, FF_PROBE_EXACT, stage);
        const json_t *f = choice_of(finer, stage), *e = choice_of(exact, stage);
        json_object_set_new(copy, "finer", f ? json_copy((json_t *)(size_t)f) : json_null());
        json_object_set_new(copy, "exact", e ? json_copy((json_t *)(size_t)e) : json_null());
        json_object_set_new(all, stage, copy);
    }
    return all;
}

/* Whether the case, computed once more, gives what the study has. */
static bool same_again(const ff_auditing *a, const ff_subject *s, const ff_probe *base)
{
    const json_t *study = json_object_get(a->records, s->key), *value;
    json_t *outputs = json_object_get(study, "outputs");
    const char *name;
    bool same = ff_record_is_ok(study) && json_equal(json_object_get(study, "chosen"),
                                                     json_object_get(base->record, "chosen"));
    json_object_foreach(outputs, name, value)
    {
        const json_t *again = json_object_get(json_object_get(base->record, "outputs"), name);
        same = same && (!again || json_equal(value, again));
    }
    return same;
}

/* Probes that failed: what the audit has not seen. */
static json_t *failures_of(const ff_auditing *a, size_t subject)
{
    static const char *const what[] = {"as it stands", "finer", "more exact", "larger", "smaller"};
    json_t *list = json_array();
    for (size_t i = 0; i < a->probe_count; i++) {
        const ff_probe *p = &a->probes[i];
        if (p->subject != subject || ff_record_is_ok(p->record))
            continue;
        const char *reason = json_string_value(json_object_get(p->record, "reason"));
        char *text = ff_print_text("%s%s%s: %s", p->of, *p->of ? " " : "", what[p->kind],
                                   reason ? reason : "it did not run");
        json_array_append_new(list, json_pack("{s:s, s:O?}", "reason", text, "command",
                                              json_object_get(p->record, "command")));
        free(text);
    }
    return list;
}

static json_t *judge_subject(const ff_auditing *a, size_t subject)
{
    const ff_subject *s = &a->subjects[subject];
    const ff_probe *base = ff_find_probe(a, subject, FF_PROBE_BASE, "");
    json_t *outputs = json_array(), *failures = failures_of(a, subject);
    for (size_t i = 0; base && i < s->item_count; i++)
        json_array_append_new(outputs, judge_item(a, subject, base, &s->items[i]));
    if (s->trouble)
        json_array_append_new(failures, json_pack("{s:s}", "reason", s->trouble));
    if (base && s->chooses && !json_object_get(base->record, "choices"))
        json_array_append_new(failures,
                              json_pack("{s:s}", "reason",
                                        "an earlier version has run it, which did not write down "
                                        "its choices: --rerun all computes it anew"));
    bool known = ff_record_is_ok(json_object_get(a->records, s->key));
    if (base && known && !same_again(a, s, base))
        json_array_append_new(
            failures,
            json_pack("{s:s}", "reason", "computed once more it differs from what the study has"));
    return json_pack("{s:I, s:o, s:s, s:o, s:o, s:o}", "case", (json_int_t)s->index + 1, "set",
                     ff_case_set(a->campaign->study, s->index), "status",
                     !known                      ? "failed in the study"
                     : json_array_size(failures) ? "failed"
                                                 : "ok",
                     "stages", base ? describe_choices(a, subject, base) : json_object(), "outputs",
                     outputs, "failures", failures);
}

/* Counts of the verdicts, and the output that is worst by its promise. */
static json_t *summarise(json_t *cases)
{
    json_t *counts = json_pack("{s:i, s:i, s:i, s:i, s:i}", "kept", 0, "exceeded", 0, "broken", 0,
                               "unchecked", 0, "not compared", 0);
    json_t *one, *output, *worst = json_null();
    size_t i, k, failed = 0;
    double most = -1;
    json_array_foreach(cases, i, one)
    {
        failed += !strcmp(json_string_value(json_object_get(one, "status")), "failed");
        json_array_foreach(json_object_get(one, "outputs"), k, output)
        {
            const char *verdict = json_string_value(json_object_get(output, "verdict"));
            double promised = json_number_value(json_object_get(output, "promised"));
            double ratio = mean_of(json_object_get(output, "observed")) / promised;
            if (!verdict)
                continue;
            json_object_set_new(
                counts, verdict,
                json_integer(json_integer_value(json_object_get(counts, verdict)) + 1));
            if (!(ratio > most) || !isfinite(ratio))
                continue;
            most = ratio;
            json_decref(worst);
            worst = json_pack("{s:O, s:O, s:f}", "case", json_object_get(one, "case"), "output",
                              json_object_get(output, "output"), "times_promised", ratio);
        }
    }
    return json_pack("{s:o, s:I, s:o}", "verdicts", counts, "failed", (json_int_t)failed, "worst",
                     worst);
}

json_t *ff_audit_result(const ff_auditing *a)
{
    json_t *cases = json_array(), *inputs = json_object();
    for (size_t i = 0; i < a->subject_count; i++)
        json_array_append_new(cases, judge_subject(a, i));
    for (size_t i = 0; i < a->audit->input_count; i++)
        json_object_set_new(inputs, a->audit->inputs[i].path,
                            json_string(a->audit->inputs[i].text));
    return json_pack("{s:I, s:I, s:I, s:o, s:o, s:o}", "every", (json_int_t)a->audit->every, "seed",
                     (json_int_t)a->audit->seed, "of", (json_int_t)a->campaign->study->count,
                     "inputs", inputs, "summary", summarise(cases), "cases", cases);
}
