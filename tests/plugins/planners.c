/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two engines in two threads, one with films, the other with motions by harmonic balance. Both plan
   transforms of changing lengths by FFTW, whose planner the whole process shares: each engine must
   give the results that it gives alone. */
#include <flankfilm/engine.h>

#include <check.h>

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { ROUNDS = 40 };

typedef struct planner {
    pthread_t thread;
    const char *file, *outputs, *result, *length; /* length: with the number of the round in it */
    int first, step;
    double together[ROUNDS], alone[ROUNDS];
    double *answers; /* of both engines */
    int failures;
} planner;

static void run_one(planner *p, ff_engine *engine, int round)
{
    char length[64];
    const char *const sets[] = {p->outputs, length, NULL};
    const ff_result *result;
    ff_run *run = NULL;
    snprintf(length, sizeof length, "%s=%d", p->length, p->first + p->step * round);
    if (ff_run_open(engine, p->file, sets, &run) == FF_OK && ff_run_start(run, NULL) == FF_OK &&
        ff_run_result(run, p->result, &result) == FF_OK) {
        p->answers[round] = result->data[0];
    } else {
        p->failures++;
        fputs(ff_engine_message(engine), stdout);
    }
    ff_run_close(run);
}

static void *run_all(void *ctx)
{
    planner *p = ctx;
    const char *directory = getenv("FLANKFILM_TEST_PLUGINS");
    const ff_engine_options options = {sizeof options, &directory, 1};
    ff_engine *engine;
    if (ff_engine_new(&options, &engine) != FF_OK)
        exit(2);
    for (int i = 0; i < ROUNDS; i++)
        run_one(p, engine, i);
    ff_engine_close(engine);
    return NULL;
}

int main(void)
{
    static planner planners[] = {
        {.file = "films.yaml",
         .outputs = "outputs=[volumes.h_min]",
         .result = "volumes.h_min",
         .length = "volumes.cells",
         .first = 33,
         .step = 1},
        {.file = "motions.yaml",
         .outputs = "outputs=[harmonic.dte_rms]",
         .result = "harmonic.dte_rms",
         .length = "harmonic.samples",
         .first = 50,
         .step = 2},
    };
    char folder[4096];
    snprintf(folder, sizeof folder, "%s/tests/core/engine/scenes", getenv("FLANKFILM_TEST_SOURCE"));
    if (chdir(folder) != 0)
        return 2;
    setenv("OPENBLAS_NUM_THREADS", "1", 1); /* a sanitizer does not recognise the synchronisation of
                                               its threads */
    for (int i = 0; i < 2; i++) {
        planners[i].answers = planners[i].together;
        if (pthread_create(&planners[i].thread, NULL, run_all, &planners[i]) != 0)
            return 2;
    }
    for (int i = 0; i < 2; i++)
        pthread_join(planners[i].thread, NULL);
    for (int i = 0; i < 2; i++) {
        planner *p = &planners[i];
        p->answers = p->alone;
        run_all(p);
        int same = 0;
        for (int k = 0; k < ROUNDS; k++)
            same += p->together[k] == p->alone[k] && p->alone[k] > 0;
        check_true("every run answered", p->failures == 0);
        check_true("as it does alone", same == ROUNDS);
    }
    return check_done();
}
