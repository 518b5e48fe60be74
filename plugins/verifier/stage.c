/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests of models that compute arrays. */
#include "subject.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { PATIENCE = 2 }; /* s, after which a stage is asked to stop */

static bool check_lengths(verify_subject *s, const verify_trial *trial, size_t output)
{
    const verify_dims *dims = &s->output_dims[output];
    for (size_t other = 0; other < output; other++) {
        const verify_dims *theirs = &s->output_dims[other];
        uint32_t left = dims->rank - trial->ranks[output];
        uint32_t left_theirs = theirs->rank - trial->ranks[other];
        for (uint32_t i = left; i < dims->rank && trial->outputs[other].data; i++)
            for (uint32_t k = left_theirs; k < theirs->rank; k++)
                if (!strcmp(dims->name[i], theirs->name[k]) &&
                    trial->shapes[output][i - left] != trial->shapes[other][k - left_theirs])
                    return verify_faulty(s, "\"%s\" has %zu points along %s, but \"%s\" has %zu",
                                         ff_model_output(s->model, output)->name,
                                         trial->shapes[output][i - left], dims->name[i],
                                         ff_model_output(s->model, other)->name,
                                         trial->shapes[other][k - left_theirs]);
    }
    return true;
}

static bool check_outputs(verify_subject *s, const verify_trial *trial, uint64_t wanted)
{
    const ff_model *model = s->model;
    for (size_t i = 0; i < model->output_count; i++) {
        const verify_guarded *output = &trial->outputs[i];
        const char *name = ff_model_output(model, i)->name;
        if (!output->data && wanted >> i & 1)
            return verify_faulty(s, "the output \"%s\" was wanted, but not given", name);
        if (!output->data)
            continue;
        if (!verify_guarded_whole(output))
            return verify_faulty(s, "evaluate wrote outside the array \"%s\" of %zu numbers", name,
                                 output->count);
        for (size_t k = 0; k < output->count; k++)
            if (!isfinite(output->data[k]))
                return verify_faulty(s, "the output \"%s\" is %g at point %zu of %zu", name,
                                     output->data[k], k, output->count);
        if (!check_lengths(s, trial, i))
            return false;
    }
    return true;
}

double **verify_feed_copy(const verify_feed *feed)
{
    size_t inputs = feed->subject->model->input_count;
    double **copies = verify_alloc((inputs + 1) * sizeof *copies);
    for (size_t i = 0; i < inputs; i++) {
        size_t size = feed->memory[i].count * sizeof(double);
        copies[i] = feed->memory[i].data ? verify_alloc(size + 1) : NULL;
        if (copies[i])
            memcpy(copies[i], feed->memory[i].data, size);
    }
    return copies;
}

bool verify_feed_is_whole(verify_subject *s, const verify_feed *feed, double **copies,
                          const char *function)
{
    const ff_model *model = s->model;
    bool good = true;
    for (size_t i = 0; i < model->input_count; i++) {
        const verify_guarded *input = &feed->memory[i];
        if (copies[i] && good &&
            (!verify_guarded_whole(input) ||
             memcmp(copies[i], input->data, input->count * sizeof(double)) != 0))
            good = verify_faulty(s, "%s changed its input \"%s\"", function,
                                 ff_model_input(model, i)->name);
        free(copies[i]);
    }
    free(copies);
    return good;
}

/* Evaluates and checks what any evaluation owes; *status tells whether there are outputs. */
static bool evaluate(verify_subject *s, verify_trial *trial, uint64_t wanted,
                     const verify_feed *feed, ff_status *status)
{
    double **before = verify_feed_copy(feed);
    *status = verify_trial_evaluate(trial, wanted, feed);
    if (!verify_feed_is_whole(s, feed, before, "evaluate"))
        return false;
    if (trial->breach[0])
        return verify_faulty(s, "it %s", trial->breach);
    if (*status < FF_BUG || *status > FF_STOPPED || *status == FF_BUG)
        return verify_faulty(s, "evaluate gave the status %d: %s", *status, trial->text);
    if (*status == FF_OK || *status == FF_DOMAIN)
        return check_outputs(s, trial, wanted);
    return *status == FF_NOMEM || *status == FF_STOPPED || trial->text[0] ||
           verify_faulty(s, "evaluate gave the status %d and no reason", *status);
}

bool verify_test_inputs(verify_subject *s)
{
    enum { DRAWS = 60 };
    uint64_t all = verify_all_outputs(s->model);
    bool good = true;
    double end = verify_now() + 1;
    for (int i = 0; i < DRAWS && good && verify_now() < end; i++) {
        verify_trial trial;
        ff_status status;
        verify_feed *feed = verify_find_feed(s, &trial, false);
        if (!feed)
            return false;
        if (!s->given || i > 0)
            verify_feed_draw_inputs(feed, &s->random);
        verify_doing(s, "evaluate with random inputs, draw %d", i);
        trial.stop_at = verify_now() + PATIENCE;
        if (verify_feed_suffices(feed))
            good = evaluate(s, &trial, all, feed, &status);
        verify_trial_close(&trial);
    }
    return good;
}

/* The outputs that the model serves with these inputs, found one by one until the time is up. */
static bool find_served(verify_subject *s, verify_trial *trial, const verify_feed *feed,
                        uint64_t *served, double end)
{
    uint64_t all = verify_all_outputs(s->model);
    *served = 0;
    for (size_t i = 0; i < s->model->output_count && verify_now() < end; i++) {
        const char *name = ff_model_output(s->model, i)->name;
        ff_status status = FF_UNSUPPORTED;
        verify_doing(s, "evaluate with \"%s\" alone wanted", name);
        if (all >> i & 1 && !evaluate(s, trial, UINT64_C(1) << i, feed, &status))
            return false;
        if (status == FF_OK || status == FF_DOMAIN)
            *served |= UINT64_C(1) << i;
        else if (status != FF_UNSUPPORTED && status != FF_STOPPED) /* stopped: too slow to tell */
            return verify_faulty(s, "\"%s\" alone cannot be had: %s", name, trial->text);
    }
    return true;
}

/* Opens an instance and finds inputs that it can work with, and what it then serves; NULL when
   there are none. */
static verify_feed *find_work(verify_subject *s, verify_trial *trial, uint64_t *served)
{
    enum { TRIES = 40 };
    double end = verify_now() + 5;
    for (int i = 0; i < (s->given ? 1 : TRIES) && verify_now() < end; i++) {
        ff_status status = FF_INVALID;
        verify_feed *feed = verify_find_feed(s, trial, false);
        if (!feed)
            return NULL;
        if (!s->given)
            verify_feed_draw_inputs(feed, &s->random);
        if (!s->given)
            trial->stop_at = verify_now() + PATIENCE;
        *served = verify_all_outputs(s->model);
        verify_doing(s, "evaluate");
        if (verify_feed_suffices(feed) && !evaluate(s, trial, *served, feed, &status))
            return NULL;
        if (status == FF_UNSUPPORTED && !find_served(s, trial, feed, served, INFINITY))
            return NULL;
        if (status == FF_OK || status == FF_DOMAIN || (status == FF_UNSUPPORTED && *served))
            return feed;
        if (s->given)
            verify_faulty(s, "evaluate gave the status %d: %s", status, trial->text);
        verify_trial_close(trial);
    }
    verify_untried(s, "no random inputs suit it; --pipeline FILE gives real ones");
    return NULL;
}

bool verify_test_wanted(verify_subject *s)
{
    uint64_t served;
    verify_trial trial;
    verify_feed *feed = find_work(s, &trial, &served);
    if (!feed)
        return false;
    bool good = find_served(s, &trial, feed, &served, verify_now() + 2);
    verify_trial_close(&trial);
    return good;
}

typedef struct shift {
    const verify_feed *feed;
    uint64_t wanted;
    verify_trial trial;
    ff_status status;
} shift;

static void *work(void *argument)
{
    shift *mine = argument;
    mine->status = verify_trial_open(&mine->trial, mine->feed);
    if (mine->status == FF_OK)
        mine->status = verify_trial_evaluate(&mine->trial, mine->wanted, mine->feed);
    return NULL;
}

bool verify_trial_same(verify_subject *s, const verify_trial *a, const verify_trial *b,
                       const char *when)
{
    for (size_t i = 0; i < s->model->output_count; i++) {
        const verify_guarded *x = &a->outputs[i], *y = &b->outputs[i];
        if (!x->data && !y->data)
            continue;
        if (!x->data || !y->data || x->count != y->count ||
            memcmp(x->data, y->data, x->count * sizeof(double)) != 0)
            return verify_faulty(s, "the output \"%s\" is another %s",
                                 ff_model_output(s->model, i)->name, when);
    }
    return true;
}

bool verify_test_repeat(verify_subject *s)
{
    uint64_t served;
    verify_trial trial;
    pthread_t thread;
    verify_feed *feed = find_work(s, &trial, &served);
    if (!feed)
        return false;
    shift here = {.feed = feed, .wanted = served}, there = {.feed = feed, .wanted = served};
    bool good = true,
         serial = s->model->flags & FF_SERIAL || pthread_create(&thread, NULL, work, &there) != 0;
    if (serial)
        work(&there);
    work(&here);
    if (!serial)
        pthread_join(thread, NULL);
    ff_status again = verify_trial_evaluate(&trial, served, feed);
    if (here.status == FF_STOPPED || there.status == FF_STOPPED || again == FF_STOPPED)
        verify_untried(s, "too slow for the random inputs found; --pipeline FILE gives real ones");
    else
        good = verify_trial_same(s, &here.trial, &there.trial, "in a second thread") &&
               verify_trial_same(s, &here.trial, &trial, "when the same instance works again");
    verify_trial_close(&here.trial);
    verify_trial_close(&there.trial);
    verify_trial_close(&trial);
    return good;
}
