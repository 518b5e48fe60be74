/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records the choices of models that a case has made. */
#include "case.h"

/* Returns the parameters that the chosen model has set by itself. */
static json_t *proposed_settings(const fe_stage *stage)
{
    json_t *map = json_object();
    char text[512];
    for (size_t i = 0; i < stage->loaded->model->param_count; i++) {
        if (!stage->params[i].proposed)
            continue;
        fe_bound_print(stage, i, text, sizeof text);
        json_object_set_new(map, stage->params[i].row->name, json_string(text));
    }
    return map;
}

/* Returns twice each count that trades speed for accuracy, for a model that does not set any by
   itself. */
static json_t *doubled_counts(const fe_stage *stage)
{
    json_t *map = json_object();
    for (size_t i = 0; i < stage->loaded->model->param_count; i++) {
        const fe_bound *b = &stage->params[i];
        double most = b->row->min < b->row->max ? b->row->max : 1e9;
        if (b->row->type == FF_INT && b->row->flags & FF_TUNABLE && b->present && !b->value.text &&
            b->value.integer > 0 && 2 * (double)b->value.integer <= most)
            json_object_set_new(map, b->row->name, json_integer(2 * (json_int_t)b->value.integer));
    }
    return map;
}

json_t *study_choices_record(const fe_pipeline *pipeline)
{
    json_t *all = json_object();
    for (size_t i = 0; i < pipeline->count; i++) {
        const fe_stage *stage = &pipeline->stages[i];
        const fe_choice *choice = stage->choice;
        if (!stage->ran || !choice || !choice->chosen)
            continue;
        double promised = choice->chosen->error;
        json_t *own = json_pack("{s:s, s:s, s:f, s:o, s:o}", "use", choice->use, "model",
                                stage->use, "accuracy", choice->accuracy, "promised",
                                study_json_real(promised), "settings", proposed_settings(stage));
        if (json_object_size(json_object_get(own, "settings")) == 0)
            json_object_set_new(own, "doubled", doubled_counts(stage));
        json_object_set_new(all, stage->name, own);
    }
    return all;
}
