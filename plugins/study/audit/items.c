/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is compared of a case: which outputs, and what they are plotted against. */
#include "audit.h"

/* What a series of the stage is best plotted against; NULL: nothing. */
static const ff_port *axis_of(const ff_model *model, const ff_port *self)
{
    const char *dim = study_dimension_of(self);
    const ff_port *best = NULL;
    int most = 0;
    for (size_t i = 0; dim && i < model->output_count; i++) {
        const ff_port *row = study_output_row(model, i);
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

static void add_item(const study_audit *a, audit_subject *s, const ff_study_stage *stage,
                     const ff_port *row)
{
    const ff_study_desk *desk = a->desk;
    const ff_port *axis = axis_of(stage->model, row);
    study_item *items = desk->memory(desk->ctx, (s->item_count + 1) * sizeof *items);
    if (s->item_count)
        memcpy(items, s->items, s->item_count * sizeof *items);
    s->items = items;
    items[s->item_count++] = (study_item){
        .output = study_keep(desk, "%s.%s", stage->name, row->name),
        .stage = stage->name,
        .axis = axis ? study_keep(desk, "%s.%s", stage->name, axis->name) : NULL,
    };
}

static bool add_named(const study_audit *a, audit_subject *s, const ff_study_look *look,
                      const char *path)
{
    const ff_study_stage *stage = study_find_stage(look, path);
    const char *dot = strchr(path, '.');
    size_t output =
        stage && stage->runs && stage->model && dot ? study_find_output(stage, dot + 1) : SIZE_MAX;
    if (output == SIZE_MAX)
        return false;
    const ff_port *row = study_output_row(stage->model, output);
    if (!study_is_field(row))
        add_item(a, s, stage, row);
    return true;
}

static bool has_items(const audit_subject *s, const char *stage)
{
    for (size_t i = 0; i < s->item_count; i++)
        if (!strcmp(s->items[i].stage, stage))
            return true;
    return false;
}

/* Series that only serve to plot others against are not held to a promise. */
static void drop_axes(audit_subject *s)
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

/* Of a stage that chooses and is asked for nothing, what it feeds to others. */
static void add_fed(const study_audit *a, audit_subject *s, const ff_study_stage *stage)
{
    bool chooses = stage->runs && stage->chooses && stage->wanted;
    s->chooses = s->chooses || chooses;
    if (!chooses || has_items(s, stage->name))
        return;
    for (size_t k = 0; k < stage->model->output_count; k++) {
        const ff_port *row = study_output_row(stage->model, k);
        if (stage->wanted[k] == 1 && !study_is_field(row))
            add_item(a, s, stage, row);
    }
}

static void add_request(audit_subject *s, const char *name)
{
    for (size_t i = 0; i < s->request_count; i++)
        if (!strcmp(s->request[i], name))
            return;
    s->request[s->request_count++] = name;
}

/* All that is asked for: a model is chosen for that, be it audited or not. */
static void add_asked(const study_audit *a, audit_subject *s, const ff_study_look *look)
{
    size_t most = s->request_count;
    for (size_t i = 0; i < look->stage_count; i++)
        most += look->stages[i]->wanted ? look->stages[i]->model->output_count : 0;
    s->whole = a->desk->memory(a->desk->ctx, (most + 1) * sizeof *s->whole);
    for (; s->whole_count < s->request_count; s->whole_count++)
        s->whole[s->whole_count] = s->request[s->whole_count];
    for (size_t i = 0; i < look->stage_count; i++) {
        const ff_study_stage *stage = look->stages[i];
        for (size_t k = 0; stage->wanted && k < stage->model->output_count; k++)
            if (stage->wanted[k] == 2)
                s->whole[s->whole_count++] = study_keep(a->desk, "%s.%s", stage->name,
                                                        study_output_row(stage->model, k)->name);
    }
}

void study_find_items(const study_audit *a, audit_subject *s, const ff_study_look *look)
{
    const ff_study_desk *desk = a->desk;
    for (size_t i = 0; i < a->output_count && !s->trouble; i++)
        if (!add_named(a, s, look, a->outputs[i]))
            s->trouble = study_keep(desk, "there is no output %s", a->outputs[i]);
    for (size_t i = 0; !a->output_count && i < look->output_count; i++)
        if (!strchr(look->outputs[i], '*'))
            add_named(a, s, look, look->outputs[i]);
    drop_axes(s);
    for (size_t i = 0; i < look->stage_count; i++)
        add_fed(a, s, look->stages[i]);
    drop_axes(s);
    if (s->item_count == 0 && !s->trouble)
        s->trouble = "no output is named: say which ones matter under \"outputs\" of the audit";
    s->request = desk->memory(desk->ctx, (2 * s->item_count + 1) * sizeof *s->request);
    for (size_t i = 0; i < s->item_count; i++) {
        add_request(s, s->items[i].output);
        if (s->items[i].axis)
            add_request(s, s->items[i].axis);
    }
    add_asked(a, s, look);
}
