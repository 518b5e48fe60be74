/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Records the choices of models and of settings that a case has made. */
#include "case.h"

#include <stdlib.h>
#include <string.h>

/* Returns the parameters that the chosen model has set by itself. */
static json_t *proposed_settings(const ff_stage *stage)
{
    json_t *map = json_object();
    char text[512];
    for (size_t i = 0; i < stage->loaded->model->param_count; i++) {
        if (!stage->params[i].proposed)
            continue;
        ff_bound_print(stage, i, text, sizeof text);
        json_object_set_new(map, stage->params[i].row->name, json_string(text));
    }
    return map;
}

json_t *study_choices_record(const ff_pipeline *pipeline)
{
    json_t *all = json_object();
    for (size_t i = 0; i < pipeline->count; i++) {
        const ff_stage *stage = &pipeline->stages[i];
        const ff_choice *choice = stage->choice;
        if (!stage->ran || !choice || !choice->chosen)
            continue;
        json_t *own =
            json_pack("{s:s, s:s, s:f, s:o, s:o}", "use", choice->use, "model", stage->use,
                      "accuracy", choice->accuracy, "promised",
                      study_json_real(choice->chosen->error), "settings", proposed_settings(stage));
        json_object_set_new(all, stage->name, own);
    }
    return all;
}

json_t *study_settings_record(const char *const *assignments, size_t count)
{
    json_t *all = json_object();
    for (size_t i = 0; i < count; i++) {
        const char *value = strchr(assignments[i], '=') + 1;
        char *path = memory_print_text("%.*s", (int)(value - 1 - assignments[i]), assignments[i]);
        json_object_set_new(all, path, json_string(value));
        free(path);
    }
    return all;
}
