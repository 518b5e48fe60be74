/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tests for models that compute arrays. */
#include "private.h"

#include <pthread.h>
#include <stdlib.h>

enum { PATIENCE = 2 }; /* time in s after which a stage is asked to stop */

bool verify_test_inputs(verify_context *c)
{
    enum { DRAWS = 60 };
    bool good = true;
    double end = study_seconds_now() + 1;
    for (int i = 0; i < DRAWS && good && study_seconds_now() < end; i++) {
        verify_instance instance;
        if (c->given && i > 0)
            verify_setup_draw_inputs(c->given, &c->random);
        verify_setup *setup = verify_open_accepted(c, &instance, false);
        if (!setup)
            return false;
        verify_step(c, "evaluate with random inputs, draw %d", i);
        instance.stop_at = study_seconds_now() + PATIENCE;
        ff_status status = verify_instance_run(&instance, NULL, setup);
        good = verify_instance_is_sound(&instance, status);
        verify_instance_close(&instance);
    }
    return good;
}

bool verify_test_wanted(verify_context *c)
{
    char *served;
    verify_instance instance;
    verify_setup *setup = verify_find_work(c, &instance, &served);
    if (!setup)
        return false;
    bool good = verify_find_served(c, &instance, setup, &served, study_seconds_now() + 2);
    verify_instance_close(&instance);
    return good;
}

typedef struct job {
    const verify_setup *setup;
    const char *wanted;
    verify_instance instance;
    ff_status status;
} job;

static void *work(void *argument)
{
    job *mine = argument;
    mine->status = verify_instance_open(&mine->instance, mine->setup);
    if (verify_is_good(mine->status))
        mine->status = verify_instance_run(&mine->instance, mine->wanted, mine->setup);
    return NULL;
}

/* Runs two instances at the same time, unless the model forbids it. Changes of the process are not
   checked meanwhile, since it has one more thread. */
static void work_twice(verify_context *c, job *here, job *there)
{
    pthread_t thread;
    bool watching = c->watching;
    c->watching = false;
    bool serial = c->model->flags & FF_SERIAL || pthread_create(&thread, NULL, work, there) != 0;
    if (serial)
        work(there);
    work(here);
    if (!serial)
        pthread_join(thread, NULL);
    c->watching = watching;
}

bool verify_test_repeat(verify_context *c)
{
    char *served;
    verify_instance instance;
    verify_setup *setup = verify_find_work(c, &instance, &served);
    if (!setup)
        return false;
    verify_context other = *c; /* each thread has its own engine */
    verify_setup there_setup = *setup;
    other.watching = false;
    other.engine = verify_open_engine(c->root);
    there_setup.context = &other;
    job here = {.setup = setup, .wanted = served};
    job there = {.setup = &there_setup, .wanted = served};
    work_twice(c, &here, &there);
    ff_status again = verify_instance_run(&instance, served, setup);
    bool good = true;
    if (here.status == FF_STOPPED || there.status == FF_STOPPED || again == FF_STOPPED)
        verify_skip(c, "too slow for the random inputs found; --pipeline FILE gives real ones");
    else
        good =
            verify_outputs_agree(c, &here.instance, &there.instance, "in a second thread") &&
            verify_outputs_agree(c, &here.instance, &instance, "when the same instance runs again");
    verify_instance_close(&here.instance);
    verify_instance_close(&there.instance);
    verify_instance_close(&instance);
    ff_engine_close(other.engine);
    return good;
}
