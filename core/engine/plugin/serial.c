/* SPDX-License-Identifier: MIT */
#include "serial.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdbool.h>

enum { LOCKS = 64 };

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t freed = PTHREAD_COND_INITIALIZER;

/* The state of each lock, protected by the mutex. */
static struct {
    pthread_t owner;
    size_t entered; /* how often its owner has entered it; 0: free */
} locks[LOCKS];

fe_serial fe_serial_of(const ff_model *model)
{
    Dl_info object;
    if (!(model->flags & FF_SERIAL))
        return 0;
    uintptr_t code = (uintptr_t)model->create, page = 4096;
    if (dladdr((const void *)code, &object))
        code = (uintptr_t)object.dli_fbase;
    /* the first lock is the one for loading */
    return (fe_serial)1 << (1 + code / page % (LOCKS - 1));
}

static bool is_in(fe_serial set, size_t lock)
{
    return set >> lock & 1;
}

static bool has_to_wait(fe_serial set)
{
    for (size_t i = 0; i < LOCKS; i++)
        if (is_in(set, i) && locks[i].entered && !pthread_equal(locks[i].owner, pthread_self()))
            return true;
    return false;
}

void fe_serial_enter(fe_serial set)
{
    if (!set)
        return;
    pthread_mutex_lock(&mutex);
    while (has_to_wait(set))
        pthread_cond_wait(&freed, &mutex);
    for (size_t i = 0; i < LOCKS; i++)
        if (is_in(set, i)) {
            locks[i].owner = pthread_self();
            locks[i].entered++;
        }
    pthread_mutex_unlock(&mutex);
}

void fe_serial_leave(fe_serial set)
{
    if (!set)
        return;
    pthread_mutex_lock(&mutex);
    for (size_t i = 0; i < LOCKS; i++)
        locks[i].entered -= is_in(set, i);
    pthread_cond_broadcast(&freed);
    pthread_mutex_unlock(&mutex);
}
