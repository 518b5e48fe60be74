/* SPDX-License-Identifier: MIT */
#include "serial.h"

#include <pthread.h>

static pthread_mutex_t lock = PTHREAD_RECURSIVE_MUTEX_INITIALIZER_NP;

void fe_serial_enter(const ff_model *model)
{
    if (!model || model->flags & FF_SERIAL)
        pthread_mutex_lock(&lock);
}

void fe_serial_leave(const ff_model *model)
{
    if (!model || model->flags & FF_SERIAL)
        pthread_mutex_unlock(&lock);
}
