/* SPDX-License-Identifier: MIT */
/* One evaluation of a stage, for its wanted outputs. */
#include "build.h"

#include <assert.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>

bool fe_check_quality(const ff_stage *stage, ff_report *report)
{
    bool good = true;
    for (size_t i = 0; i < stage->quality_count; i++) {
        const ff_quality *line = &stage->quality[i];
        if (line->verdict == FF_BAD)
            good = ff_error(report, FF_FAULT_RUN, stage->place, NULL,
                            "%s: its result cannot be trusted: %s is %.3g, limit %.3g%s%s",
                            stage->name, line->name, line->value, line->limit,
                            line->text ? ": " : "", line->text ? line->text : "");
    }
    return good;
}

static double wall_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Returns the processor time of the process. CLOCK_PROCESS_CPUTIME_ID would advance by ticks of
   some milliseconds while the process has a timer on it or a limit of its time, as the workers of a
   study have. */
static double cpu_seconds(void)
{
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

/* Whether another stage requires the output, or the output closes a loop. */
static bool must_feed(const ff_pipeline *pipeline, const ff_result *result)
{
    for (size_t k = 0; k < pipeline->count; k++) {
        const ff_stage *stage = &pipeline->stages[k];
        for (size_t i = 0; stage->needed && stage->loaded && i < stage->loaded->model->input_count;
             i++)
            if (ff_feeding_result(pipeline, stage, i) == result &&
                (fe_is_fed_back(stage, i) ||
                 !(ff_model_input(stage->loaded->model, i)->flags & FF_OPTIONAL)))
                return true;
    }
    return false;
}

/* Drops outputs that the model refuses because its inputs do not allow them. An output may be
   dropped if no required input needs it and it was not requested by name; "film.*" is not a request
   by name. In the first round of a loop, which has no feedback values, an output requested by name
   is dropped, too. True if any was dropped. */
static bool drop_refused(const ff_pipeline *pipeline, ff_stage *stage)
{
    const fe_instance *instance = stage->instance;
    int output = ff_model_find_output(stage->loaded->model, instance->item);
    if (stage->status != FF_UNSUPPORTED || instance->fault[0] || output < 0 ||
        !stage->results[output].wanted)
        return false;
    if (stage->results[output].required && (!instance->member || !instance->member->first ||
                                            must_feed(pipeline, &stage->results[output])))
        return false;
    stage->results[output].wanted = false;
    stage->results[output].requested = 0;
    stage->results[output].refused = true;
    return true;
}

/* Calls the model; if it refuses some outputs, calls it once more without them. */
static bool call_model(const ff_pipeline *pipeline, ff_stage *stage, const ff_array *in,
                       ff_report *report)
{
    fe_instance *instance = stage->instance;
    bool good, again;
    for (size_t i = 0; i < stage->loaded->model->output_count; i++)
        if (stage->results[i].wanted) /* the others were left out before the run */
            stage->results[i].refused = false;
    do {
        fe_forget_results(stage);
        stage->status = FF_OK;
        if (!fe_wants_any(stage))
            return true;
        if (!fe_restore_state(pipeline, stage, report))
            return false;
        fe_call call = fe_call_begin(stage, "evaluate");
        instance->evaluating = true;
        double start = wall_seconds(), work = cpu_seconds();
        stage->status = stage->loaded->model->evaluate(instance->self, fe_wanted_of(stage), in);
        stage->work += cpu_seconds() - work;
        stage->seconds += wall_seconds() - start;
        instance->evaluating = false;
        again = drop_refused(pipeline, stage);
        good = fe_call_end(&call, again ? FF_OK : stage->status, report);
        fe_check_folder(pipeline, stage, "evaluate", report);
    } while (again);
    return good;
}

bool fe_evaluate(const ff_pipeline *pipeline, ff_stage *stage, const ff_array *in,
                 ff_report *report)
{
    assert(stage->loaded && stage->instance && !stage->instance->evaluating);
    uint64_t *sums = fe_sum_inputs(stage, in);
    bool good = call_model(pipeline, stage, in, report);
    good = fe_check_inputs(stage, in, sums, report) && good;
    fe_free(sums);
    fe_drop_untouched(stage);
    good = good && fe_check_results(stage, in, report);
    if (good)
        fe_judge_bounds(stage);
    return good;
}
