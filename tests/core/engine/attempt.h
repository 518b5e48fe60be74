/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef TEST_ATTEMPT_H
#define TEST_ATTEMPT_H

#include <flankfilm/engine.h>

/* What is run, in the directory of the test, and what came of it. */
typedef struct attempt {
    const char *plugins; /* their directory */
    const char *file;
    enum {
        RUN,
        INSTANCES, /* toys by hand */
        STAGES     /* each stage by hand */
    } how;
    bool only_loads; /* a RUN is opened, but not started */
    ff_status status;
    size_t calls, opening; /* of the allocator, and until all models are there */
    double answer;         /* over all numbers and messages */
} attempt;

/* What `how` needs to know of the file, before the first attempt; false: it cannot be had. */
bool attempt_prepare(const attempt *plan);

/* Makes the attempt, and returns what came of it. */
attempt attempt_run(const attempt *plan);

#endif
