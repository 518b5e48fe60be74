/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests of what a model says beforehand: how well it would do (assess), and how far a law in place
   of the wired one would move its results (judge). */
#include "private.h"

#include "../memory/memory.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATIENCE = 2 /* s, after which a stage is asked to stop */, LAST_DRAW = 60 };

typedef struct question {
    const char *function; /* "assess" or "judge" */
    const verify_setup *setup;
    uint64_t wanted;
    double accuracy; /* assess */
    size_t input;    /* judge: whose law is asked for in place of itself */
    bool *answered;  /* set when it can tell */
} question;

typedef struct answer {
    ff_status status;
    ff_assessment a;
    char reason[600];
} answer;

typedef struct asking {
    const verify_instance *instance;
    const question *q;
    const ff_array *in;
    answer got;
} asking;

static ff_status call_model(void *ctx)
{
    asking *call = ctx;
    const ff_model *model = call->instance->model;
    const question *q = call->q;
    ff_assessment *a = &call->got.a;
    void *self = call->instance->self;
    return *q->function == 'a' ? model->assess(self, q->wanted, q->accuracy, call->in, a)
                               : model->judge(self, q->wanted, (uint32_t)q->input,
                                              q->setup->services[q->input], call->in, a);
}

static size_t count_of(const ff_array *array)
{
    size_t count = 1;
    for (uint32_t i = 0; i < array->rank; i++)
        count *= array->shape[i];
    return count;
}

/* Copies of the inputs, between guard zones. */
static ff_array *copy_inputs(const verify_setup *setup, size_t inputs)
{
    ff_array *in = memory_alloc((inputs + 1) * sizeof *in);
    for (size_t i = 0; i < inputs; i++) {
        in[i] = setup->inputs[i];
        if (!in[i].data)
            continue;
        double *copy = memory_require(ff_guarded_new(count_of(&in[i])));
        memcpy(copy, in[i].data, count_of(&in[i]) * sizeof *copy);
        in[i].data = copy;
    }
    return in;
}

/* Frees the copies, which must be as they were made. */
static void check_inputs(ff_array *in, const question *q)
{
    const ff_model *model = q->setup->context->model;
    for (size_t i = 0; i < model->input_count; i++) {
        const double *was = q->setup->inputs[i].data;
        size_t count = count_of(&in[i]);
        if (was && (ff_guarded_breach(in[i].data, count) ||
                    memcmp(was, in[i].data, count * sizeof *was) != 0))
            verify_fail(q->setup->context, "%s changed its input \"%s\"", q->function,
                        ff_model_input(model, i)->name);
        ff_guarded_free(in[i].data, count);
    }
    free(in);
}

static answer ask(verify_instance *instance, const question *q)
{
    ff_array *in = copy_inputs(q->setup, instance->model->input_count);
    asking call = {
        .instance = instance, .q = q, .in = in, .got = {.a = {.size = sizeof call.got.a}}};
    instance->stop_at = verify_now() + PATIENCE;
    call.got.status = verify_instance_call(instance, q->function, call_model, &call);
    snprintf(call.got.reason, sizeof call.got.reason, "%s",
             call.got.a.reason ? call.got.a.reason : "");
    check_inputs(in, q);
    return call.got;
}

static bool check_proposal(verify_context *c, const ff_proposal *p)
{
    ff_value value;
    const char *message;
    int index = p->param && p->value ? ff_model_find_param(c->model, p->param) : -1;
    if (index < 0 || !(ff_model_param(c->model, (size_t)index)->flags & FF_TUNABLE))
        return verify_fail(c,
                           "assess proposes a value for something that is not a tunable parameter");
    return verify_read_param(c, (size_t)index, p->value, &value, &message) ||
           verify_fail(c, "assess proposes \"%s\" for \"%s\", which its own table refuses",
                       p->value, p->param);
}

static bool check_answer(verify_context *c, const verify_instance *instance, const question *q,
                         const answer *got)
{
    const ff_assessment *a = &got->a;
    if (!verify_instance_is_sound(instance, got->status))
        return false;
    if (got->status != FF_OK)
        return true;
    if (a->applies < FF_APPLIES_NOT || a->applies > FF_AMBIGUOUS)
        return verify_fail(c, "%s says %d under `applies`", q->function, a->applies);
    if (!(a->error >= 0) || (a->applies == FF_APPLIES && !isfinite(a->error)))
        return verify_fail(c, "%s promises an error of %g", q->function, a->error);
    if (!(a->cost >= 0) || !isfinite(a->cost) || (a->proposal_count && !a->proposals))
        return verify_fail(c, "%s gives no usable cost or proposals", q->function);
    if (*q->function == 'j' && (a->cost > 0 || a->proposal_count > 0))
        return verify_fail(c, "judge states a cost or proposals, which only the law itself may");
    for (size_t i = 0; i < a->proposal_count; i++)
        if (!check_proposal(c, &a->proposals[i]))
            return false;
    return true;
}

static bool alike(const answer *x, const answer *y)
{
    const ff_assessment *a = &x->a, *b = &y->a;
    return x->status == FF_STOPPED || y->status == FF_STOPPED ||
           (x->status == y->status && (x->status != FF_OK || /* bit for bit, also of NaN */
                                       (a->applies == b->applies && a->error == b->error &&
                                        a->cost == b->cost && !strcmp(x->reason, y->reason))));
}

/* The same again, from an instance of its own, and whatever evaluate does afterwards. */
static bool check_purity(verify_context *c, verify_instance *instance, const question *q,
                         const answer *got, bool evaluates)
{
    verify_instance other;
    answer again = ask(instance, q);
    if (!alike(got, &again))
        return verify_fail(c, "%s gives another answer when asked again", q->function);
    bool good = true;
    if (verify_is_good(verify_instance_open(&other, q->setup))) {
        ff_status there = FF_STOPPED, here = FF_STOPPED;
        other.stop_at = instance->stop_at = verify_now() + PATIENCE;
        if (evaluates) {
            verify_step(c, "evaluate after %s", q->function);
            there = verify_instance_run(&other, NULL, q->setup);
            here = verify_instance_run(instance, NULL, q->setup);
        }
        char when[40];
        snprintf(when, sizeof when, "after %s was called", q->function);
        if (there == FF_OK && here == FF_OK)
            good = verify_outputs_agree(c, &other, instance, when);
        else if (!evaluates) {
            again = ask(&other, q);
            good = alike(got, &again) ||
                   verify_fail(c, "%s gives another answer in another instance", q->function);
        }
    }
    verify_instance_close(&other);
    return good;
}

static bool put_question(verify_context *c, verify_instance *instance, const question *q,
                         bool evaluates)
{
    verify_step(c, "%s", q->function);
    answer got = ask(instance, q);
    *q->answered = *q->answered || got.status == FF_OK;
    bool good = check_answer(c, instance, q, &got) && check_purity(c, instance, q, &got, false);
    return good && (!evaluates || got.status != FF_OK || check_purity(c, instance, q, &got, true));
}

/* Inputs of a run at first, where there is one, then random ones. */
static bool question_all(verify_context *c, const char *function)
{
    static const double accuracies[] = {0.02, 1e-9, 1};
    const ff_model *model = c->model;
    uint64_t all = verify_data_outputs(model);
    bool good = true, answered = false, assesses = *function == 'a';
    double end = verify_now() + 1;
    for (size_t draw = 0; draw < LAST_DRAW && good && (draw == 0 || verify_now() < end); draw++) {
        verify_instance instance;
        if (c->given && draw > 0)
            verify_setup_draw_inputs(c->given, &c->random);
        verify_setup *setup = verify_open_accepted(c, &instance, false);
        if (!setup)
            return false;
        question q = {
            .function = function, .setup = setup, .wanted = all ? all : 1, .answered = &answered};
        if (draw % 2 && all)
            q.wanted = UINT64_C(1) << verify_below(
                           &c->random, model->output_count < 64 ? model->output_count : 64) &
                       all;
        q.accuracy = accuracies[draw % 3];
        for (size_t i = 0; i < (assesses ? 1 : model->input_count) && good; i++) {
            q.input = i;
            if (assesses || setup->services[i])
                good = put_question(c, &instance, &q, all && draw == 0);
        }
        verify_instance_close(&instance);
    }
    if (good && !answered)
        verify_skip(c, "no random inputs suit it; --pipeline FILE gives real ones");
    return good;
}

bool verify_test_assess(verify_context *c)
{
    return question_all(c, "assess");
}

bool verify_test_judge(verify_context *c)
{
    bool any = false;
    for (size_t i = 0; i < c->model->input_count; i++)
        any = any || c->laws[i];
    return any ? question_all(c, "judge")
               : verify_skip(c, "there is no plain law of the kinds that it takes");
}
