/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scales parameters of a case. */
#include "context.h"

#include "../../accuracy/settings.h"
#include "../cases/case.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

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

/* Levels by which a factor makes a number coarser. A count grows to the next whole number and
   shrinks to the one below, so that it changes. */
static double levels_of(const ff_bound *b, double factor)
{
    if (b->row->type != FF_INT)
        return log2(factor) / log2(accuracy_tolerance_factor);
    const double count = (double)b->value.integer;
    return factor > 1 && count > 0 ? -log2(ceil(count * factor - 1e-6) / count) : -log2(factor);
}

enum study_scaling study_scale_parameters(study_context *context, size_t number,
                                          const char *const *paths, const double *factors,
                                          size_t count, const char **scaled)
{
    study_run run = *context->run;
    study_case c;
    run.study = &context->list;
    study_case_open(&c, &run, number, NULL);
    bool good = study_case_is_good(&c), all = true, changes = false;
    size_t found = 0;
    for (size_t k = 0; k < count; k++) {
        size_t param = SIZE_MAX;
        const ff_stage *stage = good ? study_find_number(c.pipeline, paths[k], &param) : NULL;
        scaled[k] = NULL;
        if (param == SIZE_MAX)
            continue;
        const char *given = accuracy_setting_at(stage, param, 0, &context->arena);
        scaled[k] = accuracy_setting_at(stage, param, levels_of(&stage->params[param], factors[k]),
                                        &context->arena);
        all = all && scaled[k];
        changes = changes || (scaled[k] && (!given || strcmp(scaled[k], given) != 0));
        found++;
    }
    study_case_close(&c);
    return found == 0 ? STUDY_NOTHING_SCALED : all && changes ? STUDY_SCALED : STUDY_BEYOND_LIMITS;
}
