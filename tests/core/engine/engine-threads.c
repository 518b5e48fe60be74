/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Engines in several threads at once: each gives its own answers, and models that must run alone
   do. Built with a thread sanitizer by .ci/run. */
#include <flankfilm/engine.h>

#include <check.h>

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { THREADS = 4, ROUNDS = 8 };

typedef struct worker {
    pthread_t thread;
    int level; /* mm */
    int wrong_sums, wrong_messages, failures;
    double others; /* calls of a serial object that ran at the same time */
} worker;

static const char *const sides[] = {"toy/left", "toy/right"}; /* each a serial object */
static atomic_int inside;                                     /* sides that run */

static double scalar(worker *w, ff_run *run, const char *path)
{
    const ff_result *result;
    if (ff_run_result(run, path, &result) == FF_OK && result->count == 1)
        return result->data[0];
    w->failures++;
    return 0;
}

static void run_toys(worker *w, ff_engine *engine)
{
    char level[32];
    const char *const sets[] = {level, NULL};
    ff_run *run;
    snprintf(level, sizeof level, "one.level=%d mm", w->level);
    if (ff_run_open(engine, "toys.yaml", sets, &run) != FF_OK || ff_run_start(run, NULL) != FF_OK) {
        w->failures++;
    } else {
        double wanted = 5e-3 * w->level, sum = scalar(w, run, "sum.sum");
        w->wrong_sums += !(sum > 0.999 * wanted && sum < 1.001 * wanted);
        w->others += scalar(w, run, "alone.others");
    }
    ff_run_close(run);
}

static void run_wrong(worker *w, ff_engine *engine)
{
    ff_run *run;
    w->failures += ff_run_open(engine, "wrong.yaml", NULL, &run) != FF_BUG;
    w->wrong_messages += !strstr(ff_engine_message(engine), "there is no stage \"nobody\"");
    ff_run_close(run);
}

/* A law and its user by hand: level times 2. */
static void use_instances(worker *w, ff_engine *engine)
{
    ff_instance *law = NULL, *user = NULL;
    const ff_result *value = NULL;
    const double gain = w->level;
    if (ff_instance_new(engine, "toy/law", &law) != FF_OK ||
        ff_instance_new(engine, "toy/user", &user) != FF_OK ||
        ff_instance_set_reals(law, "gain", &gain, 1) != FF_OK ||
        ff_instance_use(user, "law", law) != FF_OK || ff_instance_run(user, NULL) != FF_OK ||
        ff_instance_result(user, "value", &value) != FF_OK)
        w->failures++;
    else
        w->wrong_sums += value->data[0] != 2 * gain;
    ff_instance_close(user);
    ff_instance_close(law);
}

/* One side uses the service of the other: in each second thread it is the other way round. */
static void take_turns(worker *w, ff_engine *engine)
{
    ff_instance *own = NULL, *other = NULL;
    const ff_result *others;
    if (ff_instance_new(engine, sides[w->level % 2], &own) != FF_OK ||
        ff_instance_new(engine, sides[(w->level + 1) % 2], &other) != FF_OK ||
        ff_instance_use(own, "other", other) != FF_OK)
        w->failures++;
    for (int i = 0; i < ROUNDS && w->failures == 0; i++)
        if (ff_instance_run(own, "others") != FF_OK ||
            ff_instance_result(own, "others", &others) != FF_OK)
            w->failures++;
        else
            w->others += others->data[0];
    ff_instance_close(own);
    ff_instance_close(other);
}

/* Stays in the call until the other side is in one, too. */
static int32_t meet(void *ctx, const ff_stage *stage, double fraction)
{
    (void)ctx, (void)stage, (void)fraction;
    atomic_fetch_add(&inside, 1);
    for (int i = 0; i < 20000 && atomic_load(&inside) < 2; i++)
        usleep(1000);
    return atomic_load(&inside) < 2;
}

static void *run_side(void *ctx)
{
    worker *w = ctx;
    const char *directory = getenv("FLANKFILM_TEST_BAD");
    const ff_engine_options options = {sizeof options, &directory, 1};
    const ff_observer observer = {.size = sizeof observer, .progress = meet};
    ff_engine *engine = NULL;
    ff_instance *side = NULL;
    w->failures = ff_engine_new(&options, &engine) != FF_OK ||
                  ff_instance_new(engine, sides[w->level], &side) != FF_OK ||
                  ff_instance_observe(side, &observer) != FF_OK ||
                  ff_instance_run(side, "others") != FF_OK;
    ff_instance_close(side);
    ff_engine_close(engine);
    return NULL;
}

static void *work(void *ctx)
{
    worker *w = ctx;
    const char *directory = getenv("FLANKFILM_TEST_BAD");
    const ff_engine_options options = {sizeof options, &directory, 1};
    for (int i = 0; i < ROUNDS; i++) {
        ff_engine *engine;
        if (ff_engine_new(&options, &engine) != FF_OK)
            w->failures++;
        run_toys(w, engine);
        run_wrong(w, engine);
        use_instances(w, engine);
        take_turns(w, engine);
        run_toys(w, engine);
        ff_engine_close(engine);
    }
    return NULL;
}

/* Each in a thread of its own, until all have ended. */
static void start(worker *workers, int count, int first, void *(*function)(void *ctx))
{
    for (int i = 0; i < count; i++) {
        workers[i].level = first + i;
        if (pthread_create(&workers[i].thread, NULL, function, &workers[i]) != 0)
            exit(2);
    }
    for (int i = 0; i < count; i++)
        pthread_join(workers[i].thread, NULL);
}

int main(void)
{
    static worker workers[THREADS], both[2];
    char folder[4096];
    snprintf(folder, sizeof folder, "%s/tests/core/engine/scenes", getenv("FLANKFILM_TEST_SOURCE"));
    if (chdir(folder) != 0)
        return 2;
    start(workers, THREADS, 1, work);
    for (int i = 0; i < THREADS; i++) {
        check_true("every call answered", workers[i].failures == 0);
        check_true("with its own numbers", workers[i].wrong_sums == 0);
        check_true("and its own messages", workers[i].wrong_messages == 0);
        check_true("a serial model ran alone", workers[i].others == 0);
    }
    start(both, 2, 0, run_side);
    check_true("two serial objects run beside each other",
               both[0].failures + both[1].failures == 0);
    return check_done();
}
