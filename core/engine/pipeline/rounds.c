/* SPDX-License-Identifier: MIT */
/* Runs a loop: evaluates its stages in order, round after round, until the values on its feedback
   wires have converged. In the first round these values are absent, as in a run without feedback. A
   stage whose inputs are bitwise equal to those of its last evaluation is not evaluated again. */
#include "build.h"

#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A running loop. */
typedef struct iteration {
    ff_pipeline *pipeline;
    fe_loop_stage *members;
    size_t count;
    double *residuals; /* one for each round so far */
    size_t rounds;
    const char *uneven; /* the last input whose series changed its length, or NULL */
    size_t lengths[2];
    ff_report *report;
} iteration;

static bool same_shape(const ff_result *a, const ff_result *b)
{
    return a->data && b->data && a->rank == b->rank &&
           !memcmp(a->shape, b->shape, a->rank * sizeof *a->shape);
}

static bool same_bits(const ff_result *a, const ff_result *b)
{
    if (!a->data || !b->data)
        return !a->data && !b->data;
    return same_shape(a, b) && !memcmp(a->data, b->data, a->count * sizeof *a->data);
}

/* Returns the largest change relative to the largest number; 1 if the two cannot be compared. */
static double change(const ff_result *now, const ff_result *before)
{
    double most = 0, off = 0;
    if (!now->data && !before->data)
        return 0;
    if (!same_shape(now, before))
        return 1;
    for (size_t i = 0; i < now->count; i++) {
        most = fmax(most, fabs(now->data[i]));
        off = fmax(off, fabs(now->data[i] - before->data[i]));
    }
    return off > 0 ? most > 0 ? off / most : 1 : 0;
}

/* Returns the output at the other end of a feedback wire; NULL: the input is on no such wire. */
static const ff_result *given_back(const iteration *it, const fe_loop_stage *m, size_t input)
{
    return fe_is_fed_back(m->stage, input) ? ff_feeding_result(it->pipeline, m->stage, input)
                                           : NULL;
}

static double residual_of(const iteration *it)
{
    double largest = 0;
    for (size_t k = 0; k < it->count; k++) {
        const fe_loop_stage *m = &it->members[k];
        for (size_t i = 0; i < m->stage->loaded->model->input_count; i++)
            if (given_back(it, m, i))
                largest = fmax(largest, change(given_back(it, m, i), &m->fed[i]));
    }
    return largest;
}

static void forget(ff_result *result)
{
    ff_guarded_free(result->data, result->count);
}

/* Replaces the value on a feedback wire. True if it has changed. */
static bool feed(ff_result *fed, const ff_result *given, double relaxation)
{
    ff_result next = *given;
    bool relaxed = relaxation < 1 && same_shape(fed, given);
    double *data = given->data ? ff_guarded_new(given->count) : NULL;
    for (size_t i = 0; data && i < given->count; i++)
        data[i] =
            relaxed ? fed->data[i] + relaxation * (given->data[i] - fed->data[i]) : given->data[i];
    next.data = data;
    bool anew = !same_bits(&next, fed);
    forget(fed);
    *fed = next;
    return anew;
}

static void feed_all(iteration *it)
{
    for (size_t k = 0; k < it->count; k++) {
        fe_loop_stage *m = &it->members[k];
        for (size_t i = 0; i < m->stage->loaded->model->input_count; i++)
            if (given_back(it, m, i))
                m->fed_anew[i] =
                    feed(&m->fed[i], given_back(it, m, i), it->pipeline->feedback.relaxation);
    }
}

/* Whether an input has changed since the stage was last evaluated. */
static bool is_fed_anew(const iteration *it, const fe_loop_stage *m)
{
    const ff_model *model = m->stage->loaded->model;
    for (size_t i = 0; i < model->input_count; i++) {
        const ff_wire *wire = fe_input_wire(m->stage, i);
        const ff_stage *from = wire->stage < 0 ? NULL : &it->pipeline->stages[wire->stage];
        const ff_result *given = ff_feeding_result(it->pipeline, m->stage, i);
        if (!given || from->loop != m->stage->loop)
            continue;
        if (wire->closes ? m->fed_anew[i]
                         : from->instance->member->gave_anew[given - from->results])
            return true;
    }
    return false;
}

static void want_all(fe_loop_stage *m)
{
    for (size_t i = 0; i < m->stage->loaded->model->output_count; i++) {
        m->stage->results[i].wanted = m->initial[i].wanted;
        m->stage->results[i].requested = m->initial[i].requested;
    }
}

/* Whether the first round dropped an output that the stage must give. */
static bool lacks_output(const fe_loop_stage *m)
{
    bool lacks = false;
    for (size_t i = 0; i < m->stage->loaded->model->output_count; i++)
        lacks = lacks ||
                (m->initial[i].required && m->initial[i].wanted != m->stage->results[i].wanted);
    return lacks;
}

static bool is_complete(const iteration *it)
{
    bool complete = true;
    for (size_t i = 0; i < it->count; i++)
        complete = complete && !lacks_output(&it->members[i]);
    return complete;
}

static void hand_on(const ff_report *from, ff_report *to)
{
    for (size_t i = 0; i < ff_report_count(from); i++)
        fe_hand_on(ff_report_at(from, i), to);
    if (fe_report_lacked_memory(from))
        fe_report_note_no_memory(to);
}

/* Evaluates a stage, and records which of its outputs have changed. */
static bool evaluate(iteration *it, fe_loop_stage *m)
{
    ff_stage *stage = m->stage;
    size_t outputs = stage->loaded->model->output_count;
    ff_result *before = fe_alloc(outputs * sizeof *before);
    ff_array *in = fe_alloc(stage->loaded->model->input_count * sizeof *in);
    memcpy(before, stage->results, outputs * sizeof *before);
    for (size_t i = 0; i < outputs; i++)
        stage->results[i].data = NULL;
    ff_report_free(m->report);
    m->report = ff_report_new();
    m->line_count = 0;
    want_all(m);
    stage->ran = fe_gather_inputs(it->pipeline, stage, in, m->report) &&
                 fe_evaluate(it->pipeline, stage, in, m->report);
    for (size_t i = 0; i < outputs; i++) {
        m->gave_anew[i] = !same_bits(&stage->results[i], &before[i]);
        forget(&before[i]);
    }
    if (!stage->ran)
        hand_on(m->report, it->report);
    fe_free(in);
    fe_free(before);
    return stage->ran;
}

static bool run_round(iteration *it, bool first)
{
    for (size_t i = 0; i < it->count; i++) {
        fe_loop_stage *m = &it->members[i];
        m->first = first;
        if (!first && !is_fed_anew(it, m) && !lacks_output(m))
            memset(m->gave_anew, 0, m->stage->loaded->model->output_count * sizeof *m->gave_anew);
        else if (!evaluate(it, m))
            return false;
    }
    return true;
}

/* Records the first input whose series has another length than in the round before; its residual
   cannot become small. */
static void note_uneven(iteration *it)
{
    for (size_t k = 0; k < it->count; k++) {
        const fe_loop_stage *m = &it->members[k];
        for (size_t i = 0; i < m->stage->loaded->model->input_count; i++) {
            const ff_result *now = given_back(it, m, i), *before = &m->fed[i];
            if (!now || !now->data || !before->data || same_shape(now, before))
                continue;
            it->uneven = ff_model_input(m->stage->loaded->model, i)->name;
            it->lengths[0] = before->count;
            it->lengths[1] = now->count;
            return;
        }
    }
}

/* Prints the stages, the residuals of the first rounds and the last one: "a, b: 1, 0.5, ...,
   0.01". */
static char *print_history(const iteration *it)
{
    enum { AT_FIRST = 4, AT_LAST = 8 };
    char *text = fe_pipeline_print(it->pipeline, "%s", "");
    for (size_t i = 0; i < it->count; i++)
        text = fe_pipeline_print(it->pipeline, "%.200s%s%s", text, i ? ", " : "",
                                 it->members[i].stage->name);
    for (size_t i = 0; i < it->rounds; i++)
        if (i < AT_FIRST || i + AT_LAST >= it->rounds)
            text = fe_pipeline_print(it->pipeline, "%s%s %.3g", text, i ? "," : ": residuals",
                                     it->residuals[i]);
        else if (i == AT_FIRST)
            text = fe_pipeline_print(it->pipeline, "%s, ...", text);
    if (it->uneven && it->residuals[it->rounds - 1] > it->pipeline->feedback.tolerance)
        text = fe_pipeline_print(it->pipeline,
                                 "%s; %s had %zu values, and %zu a round later: a loop converges "
                                 "only if this number stays the same",
                                 text, it->uneven, it->lengths[0], it->lengths[1]);
    return text;
}

/* Reports that a stage failed in a round after the first. */
static bool report_round(const iteration *it)
{
    if (it->rounds == 0)
        return false;
    return ff_error(it->report, FF_FAULT_RUN, it->members[0].stage->place, NULL,
                    "the loop failed in round %zu: %s", it->rounds + 1, print_history(it));
}

/* Adds a quality line about the loop's convergence to its first stage. */
static void note_rounds(const iteration *it)
{
    const ff_feedback *feedback = &it->pipeline->feedback;
    ff_stage *first = it->members[0].stage;
    double residual = it->residuals[it->rounds - 1];
    int verdict = residual <= feedback->tolerance ? FF_GOOD : FF_BAD;
    ff_add_quality(first, "feedback_rounds", (double)it->rounds, (double)feedback->rounds, FF_GOOD,
                   NULL);
    ff_add_quality(first, "feedback_residual", residual, feedback->tolerance, verdict,
                   print_history(it));
}

static bool iterate(iteration *it)
{
    const ff_feedback *feedback = &it->pipeline->feedback;
    bool good = true, settled = false;
    it->residuals = fe_alloc((size_t)feedback->rounds * sizeof *it->residuals);
    while (!settled && it->rounds < (size_t)feedback->rounds) {
        if (it->rounds > 0)
            feed_all(it);
        if (!run_round(it, it->rounds == 0))
            return report_round(it);
        it->residuals[it->rounds] = residual_of(it);
        note_uneven(it);
        settled = it->residuals[it->rounds++] <= feedback->tolerance && is_complete(it);
    }
    for (size_t i = 0; i < it->count; i++) {
        const fe_loop_stage *m = &it->members[i];
        const ff_observer *watch = m->stage->instance->watch;
        good = ff_report_errors(m->report) == 0 && good;
        hand_on(m->report, it->report);
        for (size_t k = 0; watch && watch->log && k < m->line_count; k++)
            watch->log(watch->ctx, m->stage, m->lines[k].level, m->lines[k].text);
        good = fe_save_state(it->pipeline, m->stage, it->report) && good;
    }
    note_rounds(it);
    return good;
}

/* Reuses the results of an earlier run, or computes them. */
static bool obtain(iteration *it, const ff_observer *watch)
{
    ff_stage *first = it->members[0].stage;
    bool good = true, carries = false;
    for (size_t i = 0; i < it->count; i++)
        carries = carries || (it->pipeline->chained && ff_stage_has_state(it->members[i].stage));
    if (carries || !watch || !watch->recall || !watch->recall(watch->ctx, it->pipeline, first)) {
        good = iterate(it);
        for (size_t i = 0; i < it->count; i++)
            it->members[i].stage->ran = good;
        if (!carries && watch && watch->keep)
            watch->keep(watch->ctx, it->pipeline, first);
        return good;
    }
    for (size_t i = 0; i < it->count; i++) {
        it->members[i].stage->reused = it->members[i].stage->ran = true;
        good = fe_check_results(it->members[i].stage, NULL, it->report) && good;
    }
    return good;
}

static bool feeders_ran(const iteration *it)
{
    for (size_t k = 0; k < it->count; k++) {
        const ff_stage *stage = it->members[k].stage;
        for (size_t i = 0; i < stage->wire_count; i++) {
            int from = stage->wires[i].stage;
            if (from >= 0 && it->pipeline->stages[from].loop != stage->loop &&
                !it->pipeline->stages[from].ran)
                return false;
        }
        if (!stage->instance->alive)
            return false;
    }
    return true;
}

static void enter(fe_loop_stage *m, ff_stage *stage, const ff_observer *watch)
{
    const ff_model *model = stage->loaded->model;
    *m = (fe_loop_stage){.stage = stage,
                         .initial = fe_alloc(model->output_count * sizeof *m->initial),
                         .fed = fe_alloc(model->input_count * sizeof *m->fed),
                         .fed_anew = fe_alloc(model->input_count * sizeof *m->fed_anew),
                         .gave_anew = fe_alloc(model->output_count * sizeof *m->gave_anew)};
    fe_forget_results(stage);
    memcpy(m->initial, stage->results, model->output_count * sizeof *m->initial);
    stage->instance->member = m;
    stage->instance->watch = watch;
}

static void leave(fe_loop_stage *m)
{
    if (!m->stage->ran)
        want_all(m);
    for (size_t i = 0; i < m->stage->loaded->model->input_count; i++)
        forget(&m->fed[i]);
    fe_free(m->initial);
    fe_free(m->fed);
    fe_free(m->fed_anew);
    fe_free(m->gave_anew);
    fe_free(m->lines);
    ff_report_free(m->report);
    m->stage->instance->member = NULL;
    m->stage->instance->watch = NULL;
}

bool fe_run_loop(ff_pipeline *pipeline, const ff_loop *loop, const ff_observer *watch,
                 ff_report *report)
{
    assert(loop->count > 0 && loop->first + loop->count <= pipeline->count);
    iteration it = {.pipeline = pipeline, .count = loop->count, .report = report};
    bool good = true, stopped = false, left = false;
    it.members = fe_alloc(loop->count * sizeof *it.members);
    for (size_t i = 0; i < loop->count; i++)
        enter(&it.members[i], &pipeline->stages[pipeline->order[loop->first + i]], watch);
    good = feeders_ran(&it) && obtain(&it, watch);
    for (size_t i = 0; i < loop->count; i++) {
        stopped = stopped || it.members[i].stage->status == FF_STOPPED;
        left = left || it.members[i].stage->instance->left;
        good = fe_check_quality(it.members[i].stage, report) && good;
        leave(&it.members[i]);
    }
    for (size_t i = 0; i < loop->count && stopped; i++) {
        ff_stage *stage = &pipeline->stages[pipeline->order[loop->first + i]];
        stage->status = FF_STOPPED;
        stage->instance->left = left;
    }
    fe_free(it.residuals);
    fe_free(it.members);
    return good;
}
