/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests of what a model says beforehand: how well it would do (assess), and how far a law in place
   of the wired one would move its results (judge). */
#include "subject.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PATIENCE = 2 /* s, after which a stage is asked to stop */, LAST_DRAW = 60 };

typedef struct question {
    const char *function; /* "assess" or "judge" */
    const verify_feed *feed;
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

static answer ask(verify_trial *trial, const question *q)
{
    const ff_model *model = trial->subject->model;
    answer got = {.a = {.size = sizeof got.a}};
    trial->text[0] = trial->item[0] = 0;
    trial->stop_at = verify_now() + PATIENCE;
    got.status = *q->function == 'a'
                     ? model->assess(trial->self, q->wanted, q->accuracy, q->feed->inputs, &got.a)
                     : model->judge(trial->self, q->wanted, (uint32_t)q->input,
                                    q->feed->services[q->input], q->feed->inputs, &got.a);
    snprintf(got.reason, sizeof got.reason, "%s", got.a.reason ? got.a.reason : "");
    return got;
}

static bool check_proposal(verify_subject *s, const ff_proposal *p)
{
    ff_value value;
    const char *said;
    int index = p->param && p->value ? ff_model_find_param(s->model, p->param) : -1;
    if (index < 0 || !(ff_model_param(s->model, (size_t)index)->flags & FF_TUNABLE))
        return verify_faulty(s, "assess proposes a value for what is no tunable parameter");
    return s->exam->read(s->exam->ctx, (uint32_t)index, p->value, &value, &said) ||
           verify_faulty(s, "assess proposes \"%s\" for \"%s\", which its own table refuses",
                         p->value, p->param);
}

static bool check_answer(verify_subject *s, const verify_trial *trial, const question *q,
                         const answer *got)
{
    const ff_assessment *a = &got->a;
    if (trial->breach[0])
        return verify_faulty(s, "in %s it %s", q->function, trial->breach);
    if (got->status <= FF_BUG || got->status > FF_STOPPED)
        return verify_faulty(s, "%s gave the status %d: %s", q->function, got->status, trial->text);
    if (got->status != FF_OK)
        return got->status == FF_NOMEM || got->status == FF_STOPPED || trial->text[0] ||
               verify_faulty(s, "%s gave the status %d and no reason", q->function, got->status);
    if (a->applies < FF_APPLIES_NOT || a->applies > FF_AMBIGUOUS)
        return verify_faulty(s, "%s says %d under `applies`", q->function, a->applies);
    if (!(a->error >= 0) || (a->applies == FF_APPLIES && !isfinite(a->error)))
        return verify_faulty(s, "%s promises an error of %g", q->function, a->error);
    if (!(a->cost >= 0) || !isfinite(a->cost) || (a->proposal_count && !a->proposals))
        return verify_faulty(s, "%s gives no usable cost or proposals", q->function);
    if (*q->function == 'j' && (a->cost > 0 || a->proposal_count > 0))
        return verify_faulty(s, "judge speaks of cost or proposals, which are the law's");
    for (size_t i = 0; i < a->proposal_count; i++)
        if (!check_proposal(s, &a->proposals[i]))
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
static bool check_purity(verify_subject *s, verify_trial *trial, const question *q,
                         const answer *got, bool evaluates)
{
    verify_trial other;
    answer again = ask(trial, q);
    if (!alike(got, &again))
        return verify_faulty(s, "%s says something else when asked again", q->function);
    bool good = true;
    if (verify_trial_open(&other, q->feed) == FF_OK) {
        ff_status there = FF_STOPPED, here = FF_STOPPED;
        other.stop_at = trial->stop_at = verify_now() + PATIENCE;
        if (evaluates) {
            verify_doing(s, "evaluate after %s", q->function);
            there = verify_trial_evaluate(&other, q->wanted, q->feed);
            here = verify_trial_evaluate(trial, q->wanted, q->feed);
        }
        char when[40];
        snprintf(when, sizeof when, "after %s was called", q->function);
        if (there == FF_OK && here == FF_OK)
            good = verify_trial_same(s, &other, trial, when);
        else if (!evaluates) {
            again = ask(&other, q);
            good = alike(got, &again) ||
                   verify_faulty(s, "%s says something else in another instance", q->function);
        }
    }
    verify_trial_close(&other);
    return good;
}

static bool put_question(verify_subject *s, verify_trial *trial, const question *q, bool evaluates)
{
    verify_doing(s, "%s", q->function);
    double **before = verify_feed_copy(q->feed);
    answer got = ask(trial, q);
    bool good = verify_feed_is_whole(s, q->feed, before, q->function);
    *q->answered = *q->answered || got.status == FF_OK;
    good = good && check_answer(s, trial, q, &got) && check_purity(s, trial, q, &got, false);
    return good && (!evaluates || got.status != FF_OK || check_purity(s, trial, q, &got, true));
}

/* Inputs of a run at first, where there is one, then random ones. */
static bool question_all(verify_subject *s, const char *function)
{
    static const double accuracies[] = {0.02, 1e-9, 1};
    const ff_model *model = s->model;
    uint64_t all = verify_all_outputs(model);
    bool good = true, answered = false, assesses = *function == 'a';
    double end = verify_now() + 1;
    for (size_t draw = 0; draw < LAST_DRAW && good && (draw == 0 || verify_now() < end); draw++) {
        verify_trial trial;
        verify_feed *feed = verify_find_feed(s, &trial, false);
        if (!feed)
            return false;
        if (!s->given || draw > 0)
            verify_feed_draw_inputs(feed, &s->random);
        question q = {
            .function = function, .feed = feed, .wanted = all ? all : 1, .answered = &answered};
        if (draw % 2 && all)
            q.wanted = UINT64_C(1) << verify_below(&s->random, model->output_count) & all;
        q.accuracy = accuracies[draw % 3];
        for (size_t i = 0; i < (assesses ? 1 : model->input_count) && good; i++) {
            q.input = i;
            if (verify_feed_suffices(feed) && (assesses || feed->services[i]))
                good = put_question(s, &trial, &q, all && draw == 0);
        }
        verify_trial_close(&trial);
    }
    if (good && !answered)
        verify_untried(s, "no random inputs suit it; --pipeline FILE gives real ones");
    return good;
}

bool verify_test_assess(verify_subject *s)
{
    return question_all(s, "assess");
}

bool verify_test_judge(verify_subject *s)
{
    bool any = false;
    for (size_t i = 0; i < s->model->input_count; i++)
        any = any || s->exam->laws[i];
    return any ? question_all(s, "judge")
               : verify_untried(s, "there is no plain law of the kinds that it takes");
}
