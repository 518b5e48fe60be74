/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an audit comes to: errors apart by where they are from, held against what was promised. */
#include "audit.h"

static const ff_study_output *output_of(const study_audit *a, const study_probe *p,
                                        const char *name)
{
    const audit_subject *s = p ? &a->subjects[p->subject] : NULL;
    for (size_t i = 0; s && name && i < s->request_count; i++)
        if (!strcmp(s->request[i], name))
            return p->answer->outputs[i];
    return NULL;
}

/* What a probe gave for an output; of a series points are told apart by their number where what it
   is plotted against is not there. */
static study_series series_of(const study_audit *a, const study_probe *p, const study_item *item)
{
    const ff_study_output *own = output_of(a, p, item->output);
    const ff_study_output *axis = output_of(a, p, item->axis);
    if (!own || !own->values)
        return (study_series){.rank = 1};
    bool placed = own->rank > 0 && axis && axis->values && axis->count == own->count;
    return (study_series){own->rank > 0, own->count, placed ? axis->values : NULL, own->values};
}

/* {mean, largest}, or null; of a scalar they are the same. */
static json_t *difference(const study_audit *a, const study_probe *answer,
                          const study_probe *reference, const study_item *item)
{
    study_series one = series_of(a, answer, item), other = series_of(a, reference, item);
    study_difference d;
    return study_compare(&one, &other, &d)
               ? json_pack("{s:f, s:f}", "mean", d.mean, "largest", d.largest)
               : json_null();
}

static const json_t *choice_of(const study_probe *p, const char *stage)
{
    return json_object_get(json_object_get(p ? p->record : NULL, "choices"), stage);
}

static const char *model_of(const study_probe *p, const char *stage)
{
    const char *model = json_string_value(json_object_get(choice_of(p, stage), "model"));
    return model ? model : "";
}

static double promise_of(const study_probe *p, const char *stage)
{
    const json_t *promised = json_object_get(choice_of(p, stage), "promised");
    return json_is_number(promised) ? json_number_value(promised) : INFINITY;
}

/* What a case promises for a stage. That of a model whose counts were doubled, of which it says
   nothing, is taken to be half. */
static double refined_promise(const study_probe *base, const study_probe *p, const char *stage)
{
    bool doubled = p && p->kind == STUDY_PROBE_FINER &&
                   json_object_size(json_object_get(choice_of(base, stage), "doubled")) > 0;
    return doubled ? promise_of(base, stage) / 2 : promise_of(p, stage);
}

/* The more exact of the two refined cases of a stage; NULL: neither ran. */
static const study_probe *reference_of(const study_audit *a, size_t subject, const char *stage)
{
    const study_probe *base = study_find_probe(a, subject, STUDY_PROBE_BASE, "");
    const study_probe *finer = study_find_probe(a, subject, STUDY_PROBE_FINER, stage);
    const study_probe *exact = study_find_probe(a, subject, STUDY_PROBE_EXACT, stage);
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
static json_t *blame(const study_audit *a, size_t subject, const study_probe *base,
                     const study_item *item, const char *stage)
{
    const study_probe *finer = study_find_probe(a, subject, STUDY_PROBE_FINER, stage);
    const study_probe *exact = study_find_probe(a, subject, STUDY_PROBE_EXACT, stage);
    bool other = exact && promise_of(exact, stage) < promise_of(base, stage) &&
                 strcmp(model_of(exact, stage), model_of(base, stage)) != 0;
    return json_pack("{s:o, s:o, s:o}", "observed",
                     difference(a, base, reference_of(a, subject, stage), item), "numerical",
                     difference(a, base, finer, item), "model_form",
                     other ? difference(a, finer, exact, item) : json_null());
}

static double mean_of(const json_t *difference)
{
    const json_t *mean = json_object_get(difference, "mean");
    return json_is_number(mean) ? json_number_value(mean) : NAN;
}

/* Adds the promise of the output's own stage and the verdict. */
static void hold_to_promise(const study_audit *a, size_t subject, const study_probe *base,
                            const study_item *item, json_t *entry)
{
    double promised = promise_of(base, item->stage);
    double reference = refined_promise(base, reference_of(a, subject, item->stage), item->stage);
    double observed = mean_of(json_object_get(entry, "observed"));
    const char *verdict =
        isfinite(observed) ? judge(promised, observed, reference) : "not compared";
    json_object_update_new(entry,
                           json_pack("{s:o, s:o, s:s}", "promised", study_real(promised),
                                     "reference", study_real(reference), "verdict", verdict));
}

/* What an input of that uncertainty makes of the output. */
static bool central(const study_audit *a, size_t subject, const study_probe *base,
                    const study_item *item, const char *input, double *slope, bool *bent)
{
    study_series middle = series_of(a, base, item);
    study_series up = series_of(a, study_find_probe(a, subject, STUDY_PROBE_UP, input), item);
    study_series down = series_of(a, study_find_probe(a, subject, STUDY_PROBE_DOWN, input), item);
    return study_slope(&middle, &up, &down, slope, bent);
}

/* {uncertainty, shares: {input: part of its square}, by: {input: uncertainty}, bent: [inputs]} */
static json_t *inputs_of(const study_audit *a, size_t subject, const study_probe *base,
                         const study_item *item)
{
    json_t *by = json_object(), *shares = json_object(), *bent = json_array(), *one;
    const char *path;
    double sum = 0;
    for (size_t i = 0; a->inputs && i < a->inputs->count; i++) {
        const char *input = a->inputs->keys[i];
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
        json_object_set_new(shares, path, study_real(sum > 0 ? slope * slope / sum : 0));
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

static json_t *judge_item(const study_audit *a, size_t subject, const study_probe *base,
                          const study_item *item)
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
static json_t *describe_choices(const study_audit *a, size_t subject, const study_probe *base)
{
    json_t *choices = json_object_get(base->record, "choices"), *choice, *all = json_object();
    const char *stage;
    json_object_foreach(choices, stage, choice)
    {
        json_t *copy = json_copy(choice);
        const study_probe *finer = study_find_probe(a, subject, STUDY_PROBE_FINER, stage);
        const study_probe *exact = study_find_probe(a, subject, STUDY_PROBE_EXACT, stage);
        const json_t *f = choice_of(finer, stage), *e = choice_of(exact, stage);
        json_object_set_new(copy, "finer", f ? json_copy((json_t *)(size_t)f) : json_null());
        json_object_set_new(copy, "exact", e ? json_copy((json_t *)(size_t)e) : json_null());
        json_object_set_new(all, stage, copy);
    }
    return all;
}

/* Whether the case, computed once more, gives what the study has. */
static bool same_again(const json_t *study, const study_probe *base)
{
    json_t *outputs = json_object_get(study, "outputs"), *value;
    const char *name;
    bool same =
        json_equal(json_object_get(study, "chosen"), json_object_get(base->record, "chosen"));
    json_object_foreach(outputs, name, value)
    {
        const json_t *again = json_object_get(json_object_get(base->record, "outputs"), name);
        same = same && (!again || json_equal(value, again));
    }
    return same;
}

/* Probes that failed: what the audit has not seen. */
static json_t *failures_of(const study_audit *a, size_t subject)
{
    static const char *const what[] = {"as it stands", "finer",   "more exact",
                                       "larger",       "smaller", "with its choices held"};
    json_t *list = json_array();
    const study_probe *p;
    for (size_t i = 0; (p = study_probe_at(a, subject, i)); i++) {
        if (study_is_good(p->answer))
            continue;
        const char *reason = *p->answer->reason ? p->answer->reason : "it did not run";
        json_array_append_new(list, json_pack("{s:s, s:O?}", "reason",
                                              study_keep(a->desk, "%s%s%s: %s", p->of,
                                                         *p->of ? " " : "", what[p->kind], reason),
                                              "command", json_object_get(p->record, "command")));
    }
    return list;
}

static json_t *judge_subject(const study_audit *a, size_t subject)
{
    const audit_subject *s = &a->subjects[subject];
    const study_probe *base = study_find_probe(a, subject, STUDY_PROBE_BASE, "");
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
    const ff_study_answer *answer = a->desk->answer(a->desk->ctx, s->index);
    json_t *study = answer->record ? json_loads(answer->record, 0, NULL) : NULL;
    bool known = study_is_good(answer);
    if (base && known && !same_again(study, base))
        json_array_append_new(
            failures,
            json_pack("{s:s}", "reason", "computed once more it differs from what the study has"));
    json_t *set = json_incref(json_object_get(study, "set"));
    json_decref(study);
    return json_pack("{s:I, s:o, s:s, s:o, s:o, s:o}", "case", (json_int_t)s->index + 1, "set",
                     set ? set : json_object(), "status",
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

json_t *study_audit_result(const study_audit *a)
{
    json_t *cases = json_array(), *inputs = json_object();
    for (size_t i = 0; i < a->subject_count; i++)
        json_array_append_new(cases, judge_subject(a, i));
    for (size_t i = 0; a->inputs && i < a->inputs->count; i++)
        json_object_set_new(inputs, a->inputs->keys[i], json_string(a->inputs->items[i]->text));
    return json_pack("{s:I, s:I, s:I, s:o, s:o, s:o}", "every", (json_int_t)a->every, "seed",
                     (json_int_t)a->seed, "of", (json_int_t)a->cases, "inputs", inputs, "summary",
                     summarise(cases), "cases", cases);
}
