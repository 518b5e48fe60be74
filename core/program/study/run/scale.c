/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scales parameters of a case. */
#include "context.h"

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

static const char *print_scaled(study_context *context, const ff_stage *stage, size_t param,
                                double factor)
{
    const ff_bound *b = &stage->params[param];
    const char *unit = b->row->unit;
    bool plain = !strcmp(unit, "1") || !*unit;
    if (b->row->type == FF_INT)
        return study_context_format(context, "%.0f",
                                    fmax(1, round((double)b->value.integer * factor)));
    double number = ff_unit_from_si(&stage->loaded->param_units[param], b->value.real * factor);
    return study_context_format(context, "%.12g%s%s", number, plain ? "" : " ", plain ? "" : unit);
}

void study_scale_parameters(study_context *context, size_t number, const char *const *paths,
                            const double *factors, size_t count, const char **scaled)
{
    study_run run = *context->run;
    study_case c;
    run.study = &context->list;
    study_case_open(&c, &run, number, NULL);
    bool good = study_case_is_good(&c);
    for (size_t k = 0; k < count; k++) {
        size_t param = SIZE_MAX;
        const ff_stage *stage = good ? study_find_number(c.pipeline, paths[k], &param) : NULL;
        scaled[k] = param == SIZE_MAX ? NULL : print_scaled(context, stage, param, factors[k]);
    }
    study_case_close(&c);
}
