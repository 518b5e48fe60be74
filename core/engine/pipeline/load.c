/* SPDX-License-Identifier: MIT */
/* Loads the model that a stage names. */
#include "build.h"

#include <stdlib.h>

bool fe_load_stage(fe_build *b, ff_stage *stage)
{
    if (stage->loaded || !stage->use)
        return stage->loaded != NULL;
    stage->loaded = ff_engine_model(b->engine, stage->use, stage->use_place, b->report);
    if (!stage->loaded)
        return false;
    const ff_model *model = stage->loaded->model;
    stage->results =
        fe_arena_alloc(&b->pipeline->memory->arena, model->output_count * sizeof *stage->results);
    for (size_t i = 0; i < model->output_count; i++)
        stage->results[i].row = ff_model_output(model, i);
    return true;
}
