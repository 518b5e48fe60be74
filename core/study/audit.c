/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The audit in two rounds, each a study of its own in the directory of the study: the cases that
 * are audited as they stand, with what their outputs are plotted against; then, for each stage that
 * has chosen its model, the case with this stage finer and with the most exact model of its kind,
 * all other choices held, and the case with each input a little larger and smaller.
 */
#include "audit-private.h"

#include "../value/unit.h"

#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A level finer is what a model says it needs for this share of the error that it has promised. */
static const double finer_share = 0.25;

size_t ff_audit_count(const ff_audit *audit, const ff_study *study)
{
    return (study->count + audit->every - 1) / audit->every;
}

size_t ff_audit_case(const ff_audit *audit, const ff_study *study, size_t i)
{
    size_t parts = ff_audit_count(audit, study);
    size_t begin = i * study->count / parts, end = (i + 1) * study->count / parts;
    uint64_t hash = ff_hash(FF_HASH_START, &audit->seed, sizeof audit->seed);
    hash = ff_hash(hash, &i, sizeof i);
    return begin + (size_t)((hash ^ hash >> 32) % (end - begin));
}

static const char *keep(ff_auditing *a, char *text)
{
    const char *kept = ff_arena_text(&a->arena, text, strlen(text));
    free(text);
    return kept;
}

static ff_probe *add_probe(ff_auditing *a, size_t subject, enum ff_probe_kind kind, const char *of)
{
    a->probes = ff_resize(a->probes, (a->probe_count + 1) * sizeof *a->probes);
    ff_probe *p = &a->probes[a->probe_count++];
    *p = (ff_probe){.subject = subject, .kind = kind, .of = of, .set = json_object()};
    return p;
}

static void assign(const ff_probe *p, const char *stage, const char *name, const char *value)
{
    char *path = ff_print_text("%s.%s", stage, name);
    json_object_set_new(p->set, path, json_string(value));
    free(path);
}

static void assign_count(const ff_probe *p, const char *stage, const char *name, json_int_t count)
{
    char text[32];
    snprintf(text, sizeof text, "%lld", (long long)count);
    assign(p, stage, name, text);
}

/* One dimension, which may have another before it that is absent; NULL: a scalar or a field. */
static const char *dimension_of(const ff_port *row)
{
    const char *dims = row->dims ? row->dims : "", *optional = strstr(dims, "? ");
    dims = optional ? optional + 2 : dims;
    return *dims && !strchr(dims, ' ') ? dims : NULL;
}

static bool is_field(const ff_port *row)
{
    return row->service || (row->dims && *row->dims && !dimension_of(row));
}

/* What a series of the stage is best plotted against; NULL: nothing. */
static const ff_port *axis_of(const ff_stage *stage, const ff_port *self)
{
    const char *dim = dimension_of(self);
    const ff_port *best = NULL;
    int most = 0;
    for (size_t i = 0; dim && i < stage->loaded->model->output_count; i++) {
        const ff_port *row = stage->results[i].row;
        int rank = !strcmp(row->name, dim)     ? 3
                   : !strcmp(row->unit, "rad") ? 2
                   : !strcmp(row->unit, "s")   ? 1
                                               : 0;
        if (row == self || row->service || strcmp(row->dims, dim) != 0 || rank <= most)
            continue;
        best = row;
        most = rank;
    }
    return best;
}

static void add_item(ff_auditing *a, ff_subject *s, const ff_stage *stage, const ff_port *row)
{
    const ff_port *axis = axis_of(stage, row);
    ff_audited *items = ff_arena_alloc(&a->arena, (s->item_count + 1) * sizeof *items);
    if (s->item_count)
        memcpy(items, s->items, s->item_count * sizeof *items);
    s->items = items;
    items[s->item_count++] = (ff_audited){
        .output = keep(a, ff_print_text("%s.%s", stage->name, row->name)),
        .stage = keep(a, ff_print_text("%s", stage->name)),
        .axis = axis ? keep(a, ff_print_text("%s.%s", stage->name, axis->name)) : NULL,
    };
}

static bool add_named(ff_auditing *a, ff_subject *s, const ff_pipeline *pipeline, const char *name)
{
    const ff_stage *stage = NULL;
    size_t length = strcspn(name, ".");
    for (size_t i = 0; i < pipeline->count; i++)
        if (strlen(pipeline->stages[i].name) == length &&
            !strncmp(pipeline->stages[i].name, name, length))
            stage = &pipeline->stages[i];
    int output = stage && stage->needed && name[length]
                     ? ff_model_find_output(stage->loaded->model, name + length + 1)
                     : -1;
    if (output >= 0 && !is_field(stage->results[output].row))
        add_item(a, s, stage, stage->results[output].row);
    return output >= 0;
}

static bool has_items(const ff_subject *s, const char *stage)
{
    for (size_t i = 0; i < s->item_count; i++)
        if (!strcmp(s->items[i].stage, stage))
            return true;
    return false;
}

/* Series that only serve to plot others against are not held to a promise. */
static void drop_axes(ff_subject *s)
{
    size_t kept = 0;
    for (size_t i = 0; i < s->item_count; i++) {
        bool axis = false;
        for (size_t k = 0; k < s->item_count; k++)
            axis = axis || (s->items[k].axis && !strcmp(s->items[k].axis, s->items[i].output));
        if (!axis)
            s->items[kept++] = s->items[i];
    }
    s->item_count = kept;
}

/* What is asked for by name; of a stage that chooses and is asked for nothing, what it feeds to
   others. */
static void find_items(ff_auditing *a, ff_subject *s, const ff_case *c)
{
    const ff_node *list = ff_node_get(ff_tree_root(c->tree), "outputs");
    for (size_t i = 0; i < a->audit->output_count && !s->trouble; i++)
        if (!add_named(a, s, c->pipeline, a->audit->outputs[i]))
            s->trouble = keep(a, ff_print_text("there is no output %s", a->audit->outputs[i]));
    for (size_t i = 0; !a->audit->output_count && list && i < list->count; i++)
        if (list->items[i]->kind == FF_SCALAR && !strchr(list->items[i]->text, '*'))
            add_named(a, s, c->pipeline, list->items[i]->text);
    if (!a->audit->output_count && list && list->kind == FF_SCALAR)
        add_named(a, s, c->pipeline, list->text);
    drop_axes(s);
    for (size_t i = 0; i < c->pipeline->count; i++) {
        const ff_stage *stage = &c->pipeline->stages[i];
        bool open = stage->needed && stage->choice && !has_items(s, stage->name);
        s->chooses = s->chooses || (stage->needed && stage->choice);
        for (size_t k = 0; open && k < stage->loaded->model->output_count; k++)
            if (stage->results[k].wanted && !stage->results[k].asked &&
                !is_field(stage->results[k].row))
                add_item(a, s, stage, stage->results[k].row);
    }
    drop_axes(s);
    if (s->item_count == 0 && !s->trouble)
        s->trouble = "no output is named: say which ones matter under \"outputs\" of the audit";
}

/* The outputs of a case with what they are plotted against, as a list. */
static const char *request_of(ff_auditing *a, const ff_subject *s)
{
    json_t *names = json_object();
    const char *name, *list = "[";
    json_t *none;
    for (size_t i = 0; i < s->item_count; i++) {
        json_object_set_new(names, s->items[i].output, json_null());
        if (s->items[i].axis)
            json_object_set_new(names, s->items[i].axis, json_null());
    }
    json_object_foreach(names, name, none) list =
        keep(a, ff_print_text("%s%s%s", list, list[1] ? ", " : "", name));
    json_decref(names);
    return keep(a, ff_print_text("%s]", list));
}

/* The subjects with what is compared of them, each with its first probe. */
static void open_subjects(ff_auditing *a)
{
    const ff_campaign *campaign = a->campaign;
    a->subject_count = ff_audit_count(a->audit, campaign->study);
    a->subjects = ff_alloc(a->subject_count * sizeof *a->subjects);
    for (size_t i = 0; i < a->subject_count; i++) {
        ff_subject *s = &a->subjects[i];
        ff_case c;
        s->index = ff_audit_case(a->audit, campaign->study, i);
        ff_case_open(&c, campaign, s->index);
        memcpy(s->key, c.key, sizeof s->key);
        if (ff_case_is_good(&c))
            find_items(a, s, &c);
        else
            s->trouble = keep(a, ff_print_text("%s", ff_first_error(c.report)));
        if (!s->trouble)
            json_object_set_new(add_probe(a, i, FF_PROBE_BASE, "")->set, "outputs",
                                json_string(request_of(a, s)));
        ff_case_close(&c);
    }
}

static void add_varied(ff_study *round, const ff_auditing *a, size_t first, const char *path,
                       ff_arena *arena)
{
    ff_varied *varied = &round->varied[round->varied_count++];
    const char **names = ff_arena_alloc(arena, round->count * sizeof *names);
    *varied = (ff_varied){.path = path, .names = names};
    varied->assignments = ff_arena_alloc(arena, round->count * sizeof *varied->assignments);
    for (size_t i = 0; i < round->count; i++) {
        const char *value = json_string_value(json_object_get(a->probes[first + i].set, path));
        char *text =
            ff_print_text("%s%s%s", value ? path : "", value ? "=" : "", value ? value : "");
        varied->assignments[i] = ff_arena_text(arena, text, strlen(text));
        names[i] = value ? value : "";
        free(text);
    }
}

/* The probes from `first` on as cases of one axis: the study's own values, then what is laid over
   them. */
static void lay_out(ff_study *round, const ff_auditing *a, size_t first, ff_arena *arena)
{
    const ff_study *study = a->campaign->study;
    json_t *paths = json_object(), *value;
    const char *path;
    for (size_t i = first; i < a->probe_count; i++)
        json_object_foreach(a->probes[i].set, path, value)
            json_object_set_new(paths, path, json_null());
    *round = *study;
    round->varied = ff_arena_alloc(arena, (study->varied_count + json_object_size(paths)) *
                                              sizeof *round->varied);
    round->points = ff_arena_alloc(arena, sizeof *round->points);
    round->points[0] = round->count = a->probe_count - first;
    round->axis_count = round->followed = round->way = 1;
    round->varied_count = 0;
    for (size_t k = 0; k < study->varied_count; k++) {
        ff_varied *varied = &round->varied[round->varied_count++];
        const char **names = ff_arena_alloc(arena, round->count * sizeof *names);
        *varied = (ff_varied){.path = study->varied[k].path, .names = names};
        varied->assignments = ff_arena_alloc(arena, round->count * sizeof *varied->assignments);
        for (size_t i = 0; i < round->count; i++) {
            size_t index = a->subjects[a->probes[first + i].subject].index;
            varied->assignments[i] = ff_study_assignment(study, k, index);
            names[i] = ff_study_value(study, k, index);
        }
    }
    json_object_foreach(paths, path, value)
        add_varied(round, a, first, ff_arena_text(arena, path, strlen(path)), arena);
    json_decref(paths);
}

static void add_tally(ff_tally *sum, const ff_tally *part)
{
    sum->leads = part->leads;
    sum->total += part->total;
    sum->before += part->before;
    sum->done += part->done;
    sum->failed += part->failed;
    sum->seconds += part->seconds;
}

/* Points the probes to their records, and reads the series of those that are good. */
static void read_answers(ff_auditing *a, size_t first)
{
    const char *directory = a->campaign->directory;
    int fd = open(directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    json_t *records = fd < 0 ? json_object() : ff_journal_read(fd), *before = a->records;
    if (fd >= 0)
        close(fd);
    a->records = records;
    for (size_t i = 0; i < a->probe_count; i++) {
        ff_probe *p = &a->probes[i];
        p->record = json_object_get(records, p->key);
        if (i < first || !ff_record_is_ok(p->record))
            continue;
        char *path = ff_print_text("%s/cases/%s/arrays.json", directory, p->key);
        json_t *all = json_load_file(path, 0, NULL);
        p->arrays = json_incref(json_object_get(all, "outputs"));
        json_decref(all);
        free(path);
    }
    json_decref(before);
}

static bool run_round(ff_auditing *a, size_t first, ff_tally *tally, ff_report *report)
{
    ff_campaign campaign = *a->campaign;
    ff_arena arena = {NULL};
    ff_study round;
    ff_tally part;
    if (first == a->probe_count) {
        read_answers(a, first);
        return true;
    }
    lay_out(&round, a, first, &arena);
    campaign.study = &round;
    campaign.keys = ff_alloc(round.count * sizeof *campaign.keys);
    bool good = ff_study_run(&campaign, &part, report);
    add_tally(tally, &part);
    for (size_t i = 0; good && i < round.count; i++)
        memcpy(a->probes[first + i].key, campaign.keys[i], FF_KEY_SIZE);
    if (good)
        read_answers(a, first);
    free(campaign.keys);
    ff_arena_free(&arena);
    return good;
}

/* Chooses again what a stage has chosen. */
static void hold(const ff_probe *p, const char *stage, const json_t *choice)
{
    json_t *settings = json_object_get(choice, "settings"), *value;
    const char *name;
    assign(p, stage, "only", json_string_value(json_object_get(choice, "model")));
    assign(p, stage, "accuracy", "100 %"); /* what it has promised is promise enough */
    json_object_foreach(settings, name, value) assign(p, stage, name, json_string_value(value));
}

static void hold_all(const ff_probe *p, const json_t *choices, const char *but)
{
    const char *stage;
    json_t *choice;
    json_object_foreach((json_t *)(size_t)choices, stage, choice) if (strcmp(stage, but) != 0)
        hold(p, stage, choice);
}

static void ask_for_more(const ff_probe *p, const char *stage, const json_t *choice)
{
    double promised = json_number_value(json_object_get(choice, "promised"));
    if (!(promised > 0))
        promised = json_number_value(json_object_get(choice, "accuracy"));
    char *accuracy = ff_print_text("%.6g %%", 100 * fmin(finer_share * promised, 1));
    assign(p, stage, "accuracy", accuracy);
    assign(p, stage, "refine", "true");
    free(accuracy);
}

static void add_refined(ff_auditing *a, size_t subject, const char *request, const json_t *choices)
{
    const char *stage, *name;
    json_t *choice, *count;
    json_object_foreach((json_t *)(size_t)choices, stage, choice)
    {
        const char *use = json_string_value(json_object_get(choice, "use"));
        const char *of = ff_arena_text(&a->arena, stage, strlen(stage));
        ff_probe *finer = add_probe(a, subject, FF_PROBE_FINER, of);
        json_object_set_new(finer->set, "outputs", json_string(request));
        hold_all(finer, choices, stage);
        ask_for_more(finer, stage, choice);
        assign(finer, stage, "only", json_string_value(json_object_get(choice, "model")));
        json_object_foreach(json_object_get(choice, "doubled"), name, count)
            assign_count(finer, stage, name, json_integer_value(count));
        ff_probe *exact = add_probe(a, subject, FF_PROBE_EXACT, of);
        json_object_set_new(exact->set, "outputs", json_string(request));
        hold_all(exact, choices, stage);
        ask_for_more(exact, stage, choice);
        if (!ff_names_kind_only(use)) { /* one model that was tuned */
            char *any = ff_print_text("%.*s/auto", (int)strcspn(use, "/"), use);
            assign(exact, stage, "use", any);
            free(any);
        }
    }
}

static const char *varied_value(ff_auditing *a, const ff_stage *stage, size_t param, double si)
{
    const ff_bound *b = &stage->params[param];
    double number = ff_unit_from_si(&stage->loaded->param_units[param], si);
    bool plain = !strcmp(b->row->unit, "1") || !*b->row->unit;
    return keep(a, ff_print_text("%.12g%s%s", number, plain ? "" : " ", plain ? "" : b->row->unit));
}

/* An input that a case does not have is passed over: another law has other parameters. */
static void add_inputs(ff_auditing *a, size_t subject, const char *request, const json_t *choices)
{
    ff_case c;
    ff_case_open(&c, a->campaign, a->subjects[subject].index);
    for (size_t i = 0; ff_case_is_good(&c) && i < a->audit->input_count; i++) {
        const ff_unsure *u = &a->audit->inputs[i];
        const ff_stage *stage;
        size_t param = ff_unsure_param(c.pipeline, u->path, &stage);
        char why[300];
        double width;
        if (param == SIZE_MAX || !ff_unsure_width(u, stage, param, &width, why, sizeof why))
            continue;
        for (int sign = 1; sign >= -1; sign -= 2) {
            ff_probe *p = add_probe(a, subject, sign > 0 ? FF_PROBE_UP : FF_PROBE_DOWN, u->path);
            double value = stage->params[param].value.real + sign * width;
            json_object_set_new(p->set, "outputs", json_string(request));
            hold_all(p, choices, "");
            json_object_set_new(p->set, u->path, json_string(varied_value(a, stage, param, value)));
        }
    }
    ff_case_close(&c);
}

const ff_probe *ff_find_probe(const ff_auditing *a, size_t subject, enum ff_probe_kind kind,
                              const char *of)
{
    for (size_t i = 0; i < a->probe_count; i++) {
        const ff_probe *p = &a->probes[i];
        if (p->subject == subject && p->kind == kind && !strcmp(p->of, of))
            return ff_record_is_ok(p->record) ? p : NULL;
    }
    return NULL;
}

static void add_second_round(ff_auditing *a)
{
    size_t count = a->probe_count;
    for (size_t i = 0; i < count; i++) {
        size_t subject = a->probes[i].subject;
        const json_t *record = a->probes[i].record;
        const json_t *choices = json_object_get(record, "choices");
        if (!ff_record_is_ok(record) || !json_object_size(choices))
            continue;
        const char *request = request_of(a, &a->subjects[subject]);
        add_refined(a, subject, request, choices);
        add_inputs(a, subject, request, choices);
    }
}

bool ff_audit_run(const ff_campaign *campaign, ff_tally *tally, json_t **result, ff_report *report)
{
    ff_auditing a = {.campaign = campaign, .audit = campaign->study->audit};
    *result = NULL;
    *tally = (ff_tally){.leads = true};
    open_subjects(&a);
    size_t first = a.probe_count;
    bool good = run_round(&a, 0, tally, report);
    if (good)
        add_second_round(&a);
    if (good && run_round(&a, first, tally, report))
        *result = ff_audit_result(&a);
    for (size_t i = 0; i < a.probe_count; i++) {
        json_decref(a.probes[i].set);
        json_decref(a.probes[i].arrays);
    }
    json_decref(a.records);
    free(a.probes);
    free(a.subjects);
    ff_arena_free(&a.arena);
    return *result != NULL;
}
