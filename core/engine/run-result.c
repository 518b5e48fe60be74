/* SPDX-License-Identifier: MIT */
/* The results of a run, and their verdicts. */
#include "run.h"

static bool has_stages(const ff_run *run)
{
    return !run->broken && run->pipeline;
}

/* Whether the stage has complete results. */
static bool is_done(const ff_stage *stage)
{
    return stage->ran || stage->reused;
}

/* Returns the result with that path; NULL: it was not computed. */
static const ff_result *find(const ff_run *run, const char *path)
{
    const char *name;
    const ff_stage *stage = run->pipeline ? ff_stage_of(run->pipeline, path, &name) : NULL;
    int output = stage && is_done(stage) ? ff_model_find_output(stage->loaded->model, name) : -1;
    return output >= 0 && stage->results[output].data ? &stage->results[output] : NULL;
}

static const char *why_not(const ff_run *run, const ff_stage *stage, const ff_result *result)
{
    if (!run->started)
        return "the run has not been started";
    if (result && result->refused)
        return "the model does not give it for these inputs";
    if (!result || !result->wanted)
        return "`outputs` in the file does not request it";
    return stage->status == FF_OK ? "a stage that feeds its stage failed" : "its stage failed";
}

static void refuse_result(fe_run_request *call)
{
    const ff_run *run = call->run;
    const char *name;
    const ff_stage *stage = run->pipeline ? ff_stage_of(run->pipeline, call->text, &name) : NULL;
    const ff_model *model = stage && stage->loaded ? stage->loaded->model : NULL;
    int output = model ? ff_model_find_output(model, name) : -1;
    if (run->pipeline &&
        (!stage || (model && (output < 0 || ff_model_output(model, (size_t)output)->service))))
        ff_error(run->call_report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "there is no result \"%.80s\"",
                 call->text);
    else
        ff_error(run->call_report, FF_FAULT_INPUT, FF_NOWHERE, NULL, "%.80s was not computed: %s",
                 call->text, why_not(run, stage, output < 0 ? NULL : &stage->results[output]));
}

ff_status ff_run_result(ff_run *run, const char *path, const ff_result **result)
{
    if (!result)
        return FF_INVALID;
    *result = NULL;
    if (!run || !path)
        return FF_INVALID;
    *result = run->broken ? NULL : find(run, path);
    return *result
               ? FF_OK
               : fe_run_call(&(fe_run_request){.run = run, .text = path, .work = refuse_result});
}

ff_status ff_run_output(const ff_run *run, size_t index, const char **stage,
                        const ff_result **result)
{
    if (!run || !stage || !result)
        return FF_INVALID;
    *stage = NULL;
    *result = NULL;
    for (size_t i = 0; has_stages(run) && i < run->pipeline->count; i++) {
        const ff_stage *s = &run->pipeline->stages[run->pipeline->order[i]];
        for (size_t k = 0; is_done(s) && k < s->loaded->model->output_count; k++)
            if (s->results[k].data && index-- == 0) {
                *stage = s->name;
                *result = &s->results[k];
                return FF_OK;
            }
    }
    return run->broken ? FF_NOMEM : FF_INVALID;
}

ff_status ff_run_quality(const ff_run *run, size_t index, const ff_quality **line)
{
    if (!run || !line)
        return FF_INVALID;
    *line = NULL;
    for (size_t i = 0; has_stages(run) && i < run->pipeline->count; i++) {
        const ff_stage *stage = &run->pipeline->stages[run->pipeline->order[i]];
        if (index < stage->quality_count) {
            *line = &stage->quality[index];
            return FF_OK;
        }
        index -= stage->quality_count;
    }
    return FF_INVALID;
}

static void refuse_verdict(fe_run_request *call)
{
    ff_error(call->run->call_report, FF_FAULT_INPUT, FF_NOWHERE, NULL,
             "there is no verdict: the run has not been started");
}

ff_status ff_run_verdict(const ff_run *run, int32_t *verdict)
{
    const ff_quality *line;
    if (!run || !verdict)
        return FF_INVALID;
    *verdict = run->started && !run->failed ? FF_GOOD : FF_BAD;
    if (run->broken || !run->started)
        return fe_run_call(
            &(fe_run_request){.run = (ff_run *)(uintptr_t)run, .work = refuse_verdict});
    for (size_t i = 0; ff_run_quality(run, i, &line) == FF_OK; i++)
        *verdict = line->verdict > *verdict ? line->verdict : *verdict;
    return FF_OK;
}

const char *ff_stage_name(const ff_stage *stage)
{
    return stage ? stage->name : "";
}
