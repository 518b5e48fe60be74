/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scales parameters of a case. */
#include "context.h"

#include "../../accuracy/settings.h"
#include "../cases/case.h"

#include <math.h>
#include <stdint.h>

const ff_stage *study_find_number(const ff_pipeline *pipeline, const char *path, size_t *param)
{
    const char *name;
    const ff_stage *stage = ff_stage_of(pipeline, path, &name);
    const bool ready = stage && stage->needed && stage->loaded && stage->params;
    const int found = ready ? ff_model_find_param(stage->loaded->model, name) : -1;
    const ff_bound *b = found < 0 ? NULL : &stage->params[found];
    const bool number = b && (b->row->type == FF_INT || b->row->type == FF_REAL);
    *param = number && b->present && !b->value.text ? (size_t)found : SIZE_MAX;
    return stage;
}

bool study_scale_parameters(study_context *context, size_t number, const char *const *paths,
                            const double *factors, size_t count, const char **scaled)
{
    study_run run = *context->run;
    study_case c;
    run.study = &context->list;
    study_case_open(&c, &run, number, NULL);
    bool good = study_case_is_good(&c), all = true;
    size_t found = 0;
    for (size_t k = 0; k < count; k++) {
        size_t param = SIZE_MAX;
        const ff_stage *stage = good ? study_find_number(c.pipeline, paths[k], &param) : NULL;
        scaled[k] = NULL;
        if (param == SIZE_MAX)
            continue;
        const bool whole = stage->params[param].row->type == FF_INT;
        const double levels = log2(factors[k]) / (whole ? -1 : log2(accuracy_tolerance_factor));
        scaled[k] = accuracy_setting_at(stage, param, levels, &context->arena);
        all = all && scaled[k];
        found++;
    }
    study_case_close(&c);
    return all && found > 0;
}
