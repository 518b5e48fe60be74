/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests that any model stands: its texts, its life, its parameters. */
#include "subject.h"

#include <malloc.h>
#include <math.h>
#include <string.h>

/* "@type{key," with braces that close, as often as it likes. */
static bool is_bibtex(const char *text)
{
    int depth = 0;
    bool begun = false;
    for (; *text && depth >= 0; text++) {
        depth += (*text == '{') - (*text == '}');
        begun = begun || *text == '@';
        if (!begun && !strchr(" \n\t", *text))
            return false;
        if (depth == 0 && *text == '}')
            begun = false;
    }
    return depth == 0 && !begun;
}

bool verify_test_references(verify_subject *s)
{
    const ff_model *model = s->model;
    if (!is_bibtex(model->bibtex))
        return verify_faulty(s, "bibtex is no list of \"@type{key, ...}\" with braces that close");
    if (model->bibtex[0] && !model->reference[0])
        return verify_faulty(s, "bibtex names literature, but reference is empty");
    for (const char *c = model->licence; *c; c++)
        if (!strchr("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-+() ", *c))
            return verify_faulty(s, "the licence \"%s\" is no SPDX expression", model->licence);
    return true;
}

bool verify_test_presets(verify_subject *s)
{
    const ff_model *model = s->model;
    bool good = true;
    for (size_t i = 0; i < model->param_count; i++) {
        const ff_param *row = ff_model_param(model, i);
        ff_value value;
        const char *said;
        if (!row->preset || !good)
            continue;
        s->exam->read(s->exam->ctx, (uint32_t)i, NULL, &value, &said);
        if (said)
            good = verify_faulty(s, "preset of %s", said);
    }
    return good;
}

/* create, set, ready, service, destroy; true when all were good. */
static bool live(verify_subject *s, const verify_feed *feed, ff_status *status)
{
    const ff_model *model = s->model;
    verify_trial trial;
    *status = verify_trial_open(&trial, feed);
    for (size_t i = 0; i < model->output_count && *status == FF_OK; i++)
        if (ff_model_output(model, i)->service)
            model->service(trial.self, (uint32_t)i);
    verify_trial_close(&trial);
    return !trial.breach[0] || verify_faulty(s, "it %s", trial.breach);
}

bool verify_test_life(verify_subject *s)
{
    const ff_model *model = s->model;
    verify_feed *bare = verify_feed_new(s);
    verify_trial trial, second;
    ff_status status;
    verify_doing(s, "destroying NULL");
    if (model->destroy)
        model->destroy(NULL);
    verify_doing(s, "create and destroy without set");
    bool good = live(s, bare, &status);
    verify_doing(s, "create, set, ready, service, destroy");
    verify_feed *feed = verify_find_feed(s, &trial, true); /* what can be tried is */
    if (feed) { /* two at once, the older one destroyed first */
        status = verify_trial_open(&second, feed);
        verify_trial_close(&trial);
        verify_trial_close(&second);
        if (status != FF_OK)
            good = verify_faulty(s, "a second instance beside the first gave the status %d: %s",
                                 status, second.text);
    }
    return good;
}

/* What an allocator that counts says is in use; 0 where it does not count. */
static size_t in_use(void)
{
    struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

bool verify_test_leaks(verify_subject *s)
{
    enum { WARM = 50, LIVES = 1000, SLACK = 8 * LIVES };
    verify_trial trial;
    ff_status status;
    verify_feed *feed = verify_find_feed(s, &trial, false);
    if (!feed)
        return false;
    verify_trial_close(&trial);
    size_t before = 0;
    double end = verify_now() + 1;
    int lives = 0;
    for (; lives < LIVES && (lives <= WARM || verify_now() < end); lives++) {
        if (lives == WARM)
            before = in_use();
        if (!live(s, feed, &status))
            return false;
    }
    size_t after = in_use(), grown = after > before ? after - before : 0;
    if (after == 0)
        return verify_untried(s, "the allocator of this program does not count");
    if (grown * LIVES > (size_t)(lives - WARM) * SLACK)
        return verify_faulty(s, "%d lives left %zu bytes behind", lives - WARM, grown);
    return true;
}

/* Names the row at fault when it says so; `item` is a parameter, an output or a wire. */
static bool check_reason(verify_subject *s, const verify_trial *trial, ff_status status,
                         const char *what)
{
    if (status < FF_BUG || status > FF_STOPPED)
        return verify_faulty(s, "%s gave the unknown status %d", what, status);
    if (status == FF_BUG)
        return verify_faulty(s, "%s found a fault of its own: %s", what, trial->text);
    return status == FF_OK || status == FF_NOMEM || trial->text[0] ||
           verify_faulty(s, "%s gave the status %d and no reason", what, status);
}

bool verify_test_allocations(verify_subject *s)
{
    enum { MOST = 2000 };
    verify_trial trial;
    verify_feed *feed = verify_find_feed(s, &trial, false);
    if (!feed)
        return false;
    verify_trial_close(&trial);
    if (!verify_allocations_watch(s->model))
        return verify_untried(s, "its calls of malloc cannot be redirected");
    bool good = true;
    double end = verify_now() + 1;
    for (size_t nth = 1; nth < MOST && good && verify_now() < end; nth++) {
        verify_doing(s, "create, set and ready with allocation number %zu failing", nth);
        verify_allocations_fail(nth);
        ff_status status = verify_trial_open(&trial, feed);
        bool struck = verify_allocations_made() >= nth;
        verify_allocations_fail(0);
        verify_trial_close(&trial);
        good = check_reason(s, &trial, status, "a failing allocation");
        if (!struck)
            break;
    }
    return good;
}

bool verify_test_limits(verify_subject *s)
{
    enum { DRAWS = 300 };
    bool good = true;
    double end = verify_now() + 1;
    for (int i = 0; i < DRAWS && good && verify_now() < end; i++) {
        verify_feed *feed = verify_feed_new(s);
        verify_trial trial;
        verify_feed_draw_values(feed, &s->random, i % 2 ? VERIFY_LIMITS : VERIFY_INSIDE);
        verify_doing(s, "set and ready with random parameters, draw %d", i);
        ff_status status = verify_trial_open(&trial, feed);
        good = check_reason(s, &trial, status, "a set of random parameters");
        verify_trial_close(&trial);
    }
    return good;
}

bool verify_test_environment(verify_subject *s)
{
    const ff_model *model = s->model;
    verify_trial trial;
    verify_feed *feed = verify_find_feed(s, &trial, false);
    uint64_t wanted = verify_all_outputs(model);
    trial.stop_at = verify_now() + 1;
    verify_doing(s, "evaluate");
    if (feed && wanted) {
        verify_feed_draw_inputs(feed, &s->random); /* a given pipeline was not run for this */
        if (verify_feed_suffices(feed))
            verify_trial_evaluate(&trial, wanted, feed);
    }
    for (size_t k = 0; feed && k < model->output_count; k++)
        if (ff_model_output(model, k)->service)
            model->service(trial.self, (uint32_t)k);
    if (feed)
        verify_trial_close(&trial);
    const char *what = s->exam->disturbed(s->exam->ctx);
    return what ? verify_faulty(s, "%s", what) : feed != NULL;
}
