/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a check of conformance sees of the subject. */
#include "subject.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a check changes of the instances that it opens. */
typedef struct change {
    ff_value *values; /* size 0: as it was */
    bool *given;      /* input rows that `overlay` stands for */
    verify_feed *overlay;
    bool any;
} change;

typedef struct workbench {
    ff_bench bench;
    verify_subject *subject;
    change change;
} workbench;

typedef struct instance {
    verify_trial trial;
    const verify_feed *feed;
} instance;

static void doing(void *ctx, const char *text)
{
    verify_doing(((workbench *)ctx)->subject, "%s", text);
}

static void fault(void *ctx, const char *text)
{
    verify_faulty(((workbench *)ctx)->subject, "%s", text);
}

static void untried(void *ctx, const char *text)
{
    verify_untried(((workbench *)ctx)->subject, "%s", text ? text : "");
}

static double random_number(void *ctx)
{
    return verify_uniform(&((workbench *)ctx)->subject->random);
}

static int32_t set(void *ctx, const char *param, const char *text)
{
    workbench *w = ctx;
    const ff_exam *exam = w->subject->exam;
    int index = ff_model_find_param(exam->model, param);
    const char *said; /* a check may leave the calibrated range */
    ff_value value;
    if (index < 0 || !exam->read(exam->ctx, (uint32_t)index, text, &value, &said))
        return 0;
    w->change.values[index] = value;
    w->change.any = true;
    return 1;
}

static int32_t give(void *ctx, const char *input, uint32_t rank, const size_t *shape,
                    const double *data)
{
    workbench *w = ctx;
    const ff_model *model = w->subject->model;
    verify_feed *overlay = w->change.overlay;
    int index = input ? ff_model_find_input(model, input) : 0;
    if (index < 0)
        return 0;
    for (size_t i = 0; i < model->input_count; i++) {
        if (input ? i != (size_t)index : ff_model_input(model, i)->service != NULL)
            continue;
        w->change.given[i] = w->change.any = true;
        overlay->inputs[i] = (ff_array){.data = NULL};
        overlay->memory[i] = (verify_guarded){.data = NULL};
        if (input && data)
            verify_feed_give(overlay, i, data, rank, shape);
    }
    return 1;
}

static int32_t serve(void *ctx, const char *wire, const void *table)
{
    workbench *w = ctx;
    int index = ff_model_find_input(w->subject->model, wire);
    if (index < 0 || !ff_model_input(w->subject->model, (size_t)index)->service)
        return 0;
    w->change.overlay->services[index] = table;
    w->change.given[index] = w->change.any = true;
    return 1;
}

static void clear_group(verify_feed *feed, size_t param)
{
    const ff_model *model = feed->subject->model;
    const char *group = ff_model_param(model, param)->group;
    for (size_t i = 0; group && i < model->param_count; i++) {
        const char *other = ff_model_param(model, i)->group;
        if (other && !strcmp(other, group))
            feed->values[i].size = 0;
    }
}

/* The run's, or random, with the changes of the check. */
static verify_feed *make_feed(workbench *w)
{
    verify_subject *subject = w->subject;
    const ff_model *model = subject->model;
    verify_feed *feed = verify_feed_new(subject);
    if (subject->given) {
        memcpy(feed->values, subject->given->values, model->param_count * sizeof *feed->values);
        memcpy(feed->inputs, subject->given->inputs, model->input_count * sizeof *feed->inputs);
    } else {
        verify_feed_draw_values(feed, &subject->random,
                                w->change.any ? VERIFY_NEEDED : VERIFY_INSIDE);
    }
    for (size_t i = 0; i < model->param_count; i++)
        if (w->change.values[i].size) {
            clear_group(feed, i);
            feed->values[i] = w->change.values[i];
        }
    for (size_t i = 0; i < model->input_count; i++)
        if (w->change.given[i]) {
            feed->inputs[i] = w->change.overlay->inputs[i];
            feed->services[i] = w->change.overlay->services[i];
        }
    return feed;
}

static void *open_instance(void *ctx)
{
    enum { TRIES = 400 };
    workbench *w = ctx;
    instance *made = verify_alloc(sizeof *made);
    char last[sizeof w->subject->doing];
    memcpy(last, w->subject->doing, sizeof last);
    verify_doing(w->subject, "create, set and ready");
    for (int i = 0; i < (w->subject->given ? 1 : TRIES); i++) {
        made->feed = make_feed(w);
        if (verify_trial_open(&made->trial, made->feed) == FF_OK) {
            verify_doing(w->subject, "%s", last);
            return made;
        }
        verify_trial_close(&made->trial);
    }
    verify_untried(w->subject,
                   "no parameters were found that it takes%s%s; --pipeline FILE gives some",
                   made->trial.text[0] ? ": " : "", made->trial.text);
    return NULL;
}

static const void *service(void *ctx, void *opened, uint32_t output)
{
    return ((workbench *)ctx)->subject->model->service(((instance *)opened)->trial.self, output);
}

/* The bits of the outputs that the words name. */
static uint64_t named(const ff_model *model, const char *words)
{
    uint64_t bits = 0;
    while (*words) {
        size_t length = strcspn(words, " ");
        for (size_t i = 0; i < model->output_count; i++) {
            const ff_port *row = ff_model_output(model, i);
            if (!row->service && strlen(row->name) == length && !strncmp(row->name, words, length))
                bits |= UINT64_C(1) << i;
        }
        words += length + strspn(words + length, " ");
    }
    return bits;
}

static ff_status evaluate(void *ctx, void *opened, const char *wanted)
{
    instance *made = opened;
    const ff_model *model = ((workbench *)ctx)->subject->model;
    uint64_t bits = wanted ? named(model, wanted) : verify_all_outputs(model);
    ff_status status = FF_UNSUPPORTED;
    if (!verify_feed_suffices(made->feed)) {
        snprintf(made->trial.text, sizeof made->trial.text, "an input has nothing to feed it");
        return FF_INVALID;
    }
    while (status == FF_UNSUPPORTED && bits) {
        status = verify_trial_evaluate(&made->trial, bits, made->feed);
        int refused = ff_model_find_output(model, made->trial.item);
        if (status != FF_UNSUPPORTED || refused < 0 || !(bits >> refused & 1))
            break;
        bits &= ~(UINT64_C(1) << refused);
    }
    return status;
}

static ff_array array(void *ctx, void *opened, const char *name)
{
    const ff_model *model = ((workbench *)ctx)->subject->model;
    instance *made = opened;
    int input = ff_model_find_input(model, name), output = ff_model_find_output(model, name);
    if (input >= 0)
        return made->feed->inputs[input];
    if (output < 0 || !made->trial.outputs[output].data)
        return (ff_array){.data = NULL};
    return (ff_array){.data = made->trial.outputs[output].data,
                      .shape = made->trial.shapes[output],
                      .rank = made->trial.ranks[output]};
}

static const char *why(void *ctx, void *opened)
{
    (void)ctx;
    return ((instance *)opened)->trial.text;
}

static void close_instance(void *ctx, void *opened)
{
    (void)ctx;
    if (opened)
        verify_trial_close(&((instance *)opened)->trial);
}

void verify_bench_check(verify_subject *subject, const ff_check *check)
{
    const ff_model *model = subject->model;
    workbench w = {.bench = {sizeof w.bench, &w, model, doing, fault, untried, random_number, set,
                             give, serve, open_instance, service, evaluate, array, why,
                             close_instance},
                   .subject = subject,
                   .change = {.values = verify_alloc(model->param_count * sizeof *w.change.values),
                              .given = verify_alloc(model->input_count * sizeof *w.change.given),
                              .overlay = verify_feed_new(subject)}};
    verify_doing(subject, "%s", check->name);
    check->run(&w.bench);
}
