/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the model of a study may know of a case before it runs. */
#include "desk.h"

#include "../../engine/plugin/guard.h"
#include "../../engine/value/unit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void study_desk_forget(study_desk *desk)
{
    if (desk->seen.report)
        study_case_close(&desk->seen);
    desk->seen.report = NULL;
}

/* The case as it stands; NULL: it cannot be had. */
static const fe_pipeline *look_at(study_desk *desk, size_t number)
{
    if (desk->first || !desk->campaign || number >= desk->count)
        return number == 0 ? desk->first : NULL;
    if (desk->seen.report && desk->seen_number == number)
        return desk->seen.pipeline;
    fe_guard_mark mark = fe_guard_enter(NULL, NULL, NULL);
    study_campaign campaign = *desk->campaign;
    size_t known = desk->sweep ? desk->sweep->count : 0;
    bool own = number < known;
    study_desk_forget(desk);
    campaign.study = own ? desk->sweep : &desk->list;
    study_case_open(&desk->seen, &campaign, own ? number : number - known);
    desk->seen_number = number;
    fe_guard_leave(mark);
    return desk->seen.pipeline;
}

static const ff_study_stage *describe(study_desk *desk, const fe_stage *stage)
{
    const ff_model *model = stage->loaded ? stage->loaded->model : NULL;
    ff_study_stage *seen = fe_arena_alloc(&desk->arena, sizeof *seen);
    *seen = (ff_study_stage){.size = sizeof *seen,
                             .name = study_desk_keep(desk, stage->name),
                             .model = model,
                             .runs = stage->needed,
                             .chooses = stage->choice != NULL};
    if (!model || !stage->params || !stage->results)
        return seen;
    uint8_t *numbers = fe_arena_alloc(&desk->arena, model->param_count + 1);
    uint8_t *wanted = fe_arena_alloc(&desk->arena, model->output_count + 1);
    for (size_t i = 0; i < model->param_count; i++) {
        const fe_bound *b = &stage->params[i];
        numbers[i] = b->present && b->row->type == FF_REAL && !b->value.text;
    }
    for (size_t i = 0; i < model->output_count; i++)
        wanted[i] = stage->results[i].asked ? 2 : stage->results[i].wanted;
    seen->numbers = numbers;
    seen->wanted = wanted;
    return seen;
}

/* The outputs that the case's file lists. */
static void take_list(study_desk *desk, ff_study_look *look)
{
    const fe_tree *tree = desk->seen.report ? desk->seen.tree : NULL;
    const fe_node *list = tree ? fe_node_get(fe_tree_root(tree), "outputs") : NULL;
    size_t most = list && list->kind == FE_SEQUENCE ? list->count : list != NULL;
    const char **outputs = fe_arena_alloc(&desk->arena, (most + 1) * sizeof *outputs);
    for (size_t i = 0; i < most; i++) {
        const fe_node *item = list->kind == FE_SEQUENCE ? list->items[i] : list;
        if (item->kind == FE_SCALAR)
            outputs[look->output_count++] = study_desk_keep(desk, item->text);
    }
    look->outputs = outputs;
}

static const ff_study_look *look(void *ctx, size_t number)
{
    study_desk *desk = ctx;
    const fe_pipeline *pipeline = look_at(desk, number);
    ff_study_look *seen = fe_arena_alloc(&desk->arena, sizeof *seen);
    bool good = pipeline && (desk->first || study_case_is_good(&desk->seen));
    size_t count = pipeline ? pipeline->count : 0;
    const ff_study_stage **stages = fe_arena_alloc(&desk->arena, (count + 1) * sizeof *stages);
    for (size_t i = 0; i < count; i++)
        stages[i] = describe(desk, &pipeline->stages[i]);
    char *why = good || !desk->seen.report ? NULL : study_first_error(desk->seen.report);
    *seen = (ff_study_look){.size = sizeof *seen,
                            .reason = good  ? ""
                                      : why ? study_desk_keep(desk, why)
                                            : "it cannot be looked at now",
                            .stages = stages,
                            .stage_count = count};
    free(why);
    take_list(desk, seen);
    return seen;
}

/* The stage of the case that has the parameter as a number; NULL: none does. */
static const fe_stage *find_number(study_desk *desk, size_t number, const char *path, size_t *param)
{
    const fe_pipeline *pipeline = look_at(desk, number);
    bool good = pipeline && (desk->first || study_case_is_good(&desk->seen));
    *param = SIZE_MAX;
    const fe_stage *stage = good ? study_knob_of(pipeline, path, param) : NULL;
    return *param == SIZE_MAX ? NULL : stage;
}

static const char *print_real(study_desk *desk, const fe_stage *stage, size_t param, double si)
{
    const char *unit = stage->params[param].row->unit;
    bool plain = !strcmp(unit, "1") || !*unit;
    char text[120];
    snprintf(text, sizeof text, "%.12g%s%s",
             fe_unit_from_si(&stage->loaded->param_units[param], si), plain ? "" : " ",
             plain ? "" : unit);
    return study_desk_keep(desk, text);
}

static const char *turn(void *ctx, size_t number, const char *path, double factor)
{
    study_desk *desk = ctx;
    char text[80];
    size_t i;
    const fe_stage *stage = find_number(desk, number, path, &i);
    if (!stage)
        return NULL;
    const fe_bound *b = &stage->params[i];
    if (b->row->type == FF_REAL)
        return print_real(desk, stage, i, b->value.real * factor);
    snprintf(text, sizeof text, "%.0f", fmax(1, round((double)b->value.integer * factor)));
    return study_desk_keep(desk, text);
}

/* "2 %" is a share of the value. Of "2 K" and "2 degC" alike, an interval of 2 K. */
static bool find_width(const fe_stage *stage, size_t param, const char *by, double *width,
                       char *why, size_t why_size)
{
    const fe_bound *b = &stage->params[param];
    const char *end = by;
    double number;
    fe_unit unit;
    bool share = fe_number_parse(by, &number, &end) && end[strspn(end, " ")] == '%';
    if (share && strspn(end, " %") == strlen(end)) {
        *width = number / 100 * fabs(b->value.real);
        snprintf(why, why_size, "it is 0, so that a share of it is nothing");
        return *width != 0;
    }
    if (!fe_quantity_parse(by, &stage->loaded->param_units[param], b->row->unit, width, why,
                           why_size))
        return false;
    end += strspn(end, " ");
    if (fe_unit_parse(end, &unit, why, why_size))
        *width = fe_unit_to_si(&unit, number) - fe_unit_to_si(&unit, 0);
    return true;
}

static const char *shift(void *ctx, size_t number, const char *path, const char *by, double times,
                         const char **why)
{
    study_desk *desk = ctx;
    char text[300] = "it is not one real number";
    double width;
    size_t i;
    const fe_stage *stage = find_number(desk, number, path, &i);
    bool good = stage && stage->params[i].row->type == FF_REAL &&
                find_width(stage, i, by, &width, text, sizeof text);
    *why = good ? "" : study_desk_keep(desk, text);
    return good ? print_real(desk, stage, i, stage->params[i].value.real + times * width) : NULL;
}

void study_desk_open_looks(ff_study_desk *table)
{
    table->look = look;
    table->turn = turn;
    table->shift = shift;
}
