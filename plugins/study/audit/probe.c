/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cases beside those of the study: which they are, and what is laid over them. */
#include "audit.h"

/* A level finer is what a model says it needs for this share of the error that it has promised. */
static const double finer_share = 0.25;

bool study_is_good(const ff_study_answer *answer)
{
    return answer && !strcmp(answer->status, "ok");
}

const study_probe *study_probe_at(const study_audit *a, size_t subject, size_t i)
{
    const audit_subject *s = &a->subjects[subject];
    size_t at = i == 0 ? s->base : s->begin + i - 1;
    return s->trouble || (i > 0 && at >= s->end) ? NULL : &a->probes[at];
}

const study_probe *study_find_probe(const study_audit *a, size_t subject, study_probe_kind kind,
                                    const char *of)
{
    const study_probe *p;
    for (size_t i = 0; (p = study_probe_at(a, subject, i)); i++)
        if (p->kind == kind && !strcmp(p->of, of))
            return study_is_good(p->answer) ? p : NULL;
    return NULL;
}

static void *resize(void *memory, size_t size)
{
    void *more = realloc(memory, size);
    if (!more)
        abort();
    return more;
}

/* NULL: there is no value to set. */
static void assign(const study_audit *a, study_probe *p, const char *stage, const char *name,
                   const char *value)
{
    if (!value)
        return;
    p->sets = resize(p->sets, (p->set_count + 1) * sizeof *p->sets);
    p->sets[p->set_count++] =
        study_keep(a->desk, "%s%s%s=%s", stage, *name ? "." : "", name, value);
}

/* Chooses again what a stage has chosen. */
static void hold(const study_audit *a, study_probe *p, const char *stage, const json_t *choice)
{
    json_t *settings = json_object_get(choice, "settings"), *value;
    const char *name;
    assign(a, p, stage, "only", json_string_value(json_object_get(choice, "model")));
    assign(a, p, stage, "accuracy", "100 %"); /* what it has promised is promise enough */
    json_object_foreach(settings, name, value) assign(a, p, stage, name, json_string_value(value));
}

static void hold_all(const study_audit *a, study_probe *p, const json_t *choices, const char *but)
{
    const char *stage;
    json_t *choice;
    json_object_foreach((json_t *)(size_t)choices, stage, choice) if (strcmp(stage, but) != 0)
        hold(a, p, stage, choice);
}

static study_probe *add_probe(study_audit *a, size_t subject, study_probe_kind kind, const char *of)
{
    a->probes = resize(a->probes, (a->probe_count + 1) * sizeof *a->probes);
    study_probe *p = &a->probes[a->probe_count++];
    *p = (study_probe){.subject = subject, .kind = kind, .of = of};
    return p;
}

static void ask(const study_audit *a, study_probe *p)
{
    const audit_subject *s = &a->subjects[p->subject];
    bool whole = p->kind == STUDY_PROBE_BASE;
    const ff_study_case one = {.size = sizeof one,
                               .label = "",
                               .of = s->index,
                               .sets = p->sets,
                               .set_count = p->set_count,
                               .outputs = whole ? s->whole : s->request,
                               .output_count = whole ? s->whole_count : s->request_count};
    p->number = a->desk->ask(a->desk->ctx, &one);
}

void study_ask_base(study_audit *a, size_t subject)
{
    a->subjects[subject].base = a->probe_count;
    ask(a, add_probe(a, subject, STUDY_PROBE_BASE, ""));
}

static void ask_for_more(const study_audit *a, study_probe *p, const char *stage,
                         const json_t *choice)
{
    double promised = json_number_value(json_object_get(choice, "promised"));
    if (!(promised > 0))
        promised = json_number_value(json_object_get(choice, "accuracy"));
    double accuracy = 100 * fmin(finer_share * promised, 1);
    assign(a, p, stage, "accuracy", study_keep(a->desk, "%.6g %%", accuracy));
    assign(a, p, stage, "refine", "true");
}

/* The same model finer, and the most exact one. */
static void ask_refined(study_audit *a, size_t subject, const json_t *choices, const char *stage,
                        const json_t *choice)
{
    const char *use = study_text_of(choice, "use"), *of = study_keep(a->desk, "%s", stage), *name;
    size_t length = strlen(use);
    json_t *count;
    study_probe *finer = add_probe(a, subject, STUDY_PROBE_FINER, of);
    hold_all(a, finer, choices, stage);
    ask_for_more(a, finer, stage, choice);
    assign(a, finer, stage, "only", json_string_value(json_object_get(choice, "model")));
    json_object_foreach(json_object_get(choice, "doubled"), name, count) assign(
        a, finer, stage, name, study_keep(a->desk, "%lld", (long long)json_integer_value(count)));
    ask(a, finer);
    study_probe *exact = add_probe(a, subject, STUDY_PROBE_EXACT, of);
    hold_all(a, exact, choices, stage);
    ask_for_more(a, exact, stage, choice);
    if (length < 5 || strcmp(use + length - 5, "/auto") != 0) /* one model that was tuned */
        assign(a, exact, stage, "use",
               study_keep(a->desk, "%.*s/auto", (int)strcspn(use, "/"), use));
    ask(a, exact);
}

/* The number of the case with its choices as if the file had made them: there a stage has what its
   model alone has. */
static size_t find_held(study_audit *a, size_t subject, const json_t *choices)
{
    const char *stage;
    json_t *choice;
    for (size_t i = a->subjects[subject].begin; i < a->probe_count; i++)
        if (a->probes[i].kind == STUDY_PROBE_HELD)
            return a->probes[i].number;
    study_probe *p = add_probe(a, subject, STUDY_PROBE_HELD, "");
    hold_all(a, p, choices, "");
    json_object_foreach((json_t *)(size_t)choices, stage, choice)
        assign(a, p, stage, "use", json_string_value(json_object_get(choice, "model")));
    ask(a, p);
    return p->number;
}

static bool has_chosen(const json_t *choices, const char *path)
{
    char stage[100];
    snprintf(stage, sizeof stage, "%.*s", (int)strcspn(path, "."), path);
    return json_object_get(choices, stage) != NULL;
}

/* An input that a case does not have is passed over: another law has other parameters. */
static void ask_moved(study_audit *a, size_t subject, const json_t *choices, const char *path,
                      const char *width)
{
    const ff_study_desk *desk = a->desk;
    size_t number = a->subjects[subject].index;
    const char *why;
    if (!desk->shift(desk->ctx, number, path, width, 1, &why) && has_chosen(choices, path))
        number = find_held(a, subject, choices);
    for (int sign = 1; sign >= -1; sign -= 2) {
        const char *value = desk->shift(desk->ctx, number, path, width, sign, &why);
        if (!value)
            return;
        study_probe *p = add_probe(a, subject, sign > 0 ? STUDY_PROBE_UP : STUDY_PROBE_DOWN, path);
        hold_all(a, p, choices, "");
        assign(a, p, path, "", value);
        ask(a, p);
    }
}

void study_ask_others(study_audit *a, size_t subject, const json_t *choices)
{
    audit_subject *s = &a->subjects[subject];
    const char *stage;
    json_t *choice;
    s->begin = a->probe_count;
    json_object_foreach((json_t *)(size_t)choices, stage, choice)
        ask_refined(a, subject, choices, stage, choice);
    for (size_t i = 0; a->inputs && i < a->inputs->count; i++)
        ask_moved(a, subject, choices, a->inputs->keys[i], a->inputs->items[i]->text);
    s->end = a->probe_count;
}
