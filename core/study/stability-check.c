/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a map names, held against the stages of its file. */
#include "private.h"
#include "stability.h"

#include <string.h>

const ff_stage *ff_stage_of(const ff_pipeline *pipeline, const char *path)
{
    size_t length = strcspn(path, ".");
    for (size_t i = 0; i < pipeline->count; i++)
        if (strlen(pipeline->stages[i].name) == length &&
            !strncmp(pipeline->stages[i].name, path, length))
            return &pipeline->stages[i];
    return NULL;
}

static const char *name_in(const char *path)
{
    const char *dot = strchr(path, '.');
    return dot ? dot + 1 : "";
}

size_t ff_knob_param(const ff_stage *stage, const char *path)
{
    const ff_model *model = stage && stage->needed && stage->loaded ? stage->loaded->model : NULL;
    for (size_t i = 0; model && i < model->param_count; i++) {
        const ff_bound *b = &stage->params[i];
        bool number = b->row->type == FF_INT || b->row->type == FF_REAL;
        if (!strcmp(b->row->name, name_in(path)) && number && b->present && !b->value.text)
            return i;
    }
    return SIZE_MAX;
}

static bool check_stage(const ff_pipeline *pipeline, const char *path, ff_report *report)
{
    return ff_stage_of(pipeline, path) ||
           ff_error(report, FF_EXIT_INPUT, FF_NOWHERE, NULL,
                    "stability: %s: the pipeline has no stage \"%.*s\"", path,
                    (int)strcspn(path, "."), path);
}

static void check_output(const ff_pipeline *pipeline, const char *path, ff_report *report)
{
    const ff_stage *stage = ff_stage_of(pipeline, path);
    const ff_model *model = stage && stage->loaded ? stage->loaded->model : NULL;
    for (size_t i = 0; model && i < model->output_count; i++) {
        const ff_port *row = stage->results ? stage->results[i].row : NULL;
        if (row && !strcmp(row->name, name_in(path)) && row->dims && *row->dims)
            ff_error(report, FF_EXIT_INPUT, FF_NOWHERE,
                     "name a scalar, such as a mean or an extreme value",
                     "stability: %s is a series or a field, which cannot be compared", path);
    }
}

void ff_stability_check(const ff_stability *s, const ff_pipeline *pipeline, ff_report *report)
{
    size_t turned = 0;
    for (size_t i = 0; i < s->claim_count; i++) {
        check_output(pipeline, s->claims[i].output, report);
        for (size_t k = 0; k < s->claims[i].estimate_count; k++)
            check_stage(pipeline, s->claims[i].estimates[k], report);
    }
    for (size_t i = 0; i < s->physical_count; i++)
        check_stage(pipeline, s->physical[i].name, report);
    for (size_t i = 0; i < s->range_count; i++)
        check_stage(pipeline, s->range[i], report);
    for (size_t i = 0; i < s->knob_count; i++)
        if (check_stage(pipeline, s->knobs[i].path, report)) {
            const ff_stage *stage = ff_stage_of(pipeline, s->knobs[i].path);
            turned += ff_knob_param(stage, s->knobs[i].path) != SIZE_MAX;
        }
    if (turned == 0)
        ff_warn(report, FF_NOWHERE,
                "stability: no number is refined, so that verdicts rest on the quality alone");
}
