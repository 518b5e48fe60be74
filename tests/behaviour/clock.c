/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A clock that is preloaded: each look at it is 1/256 s after the one before, so that durations,
   and all that is sorted or decided by them, are the same in every run. Their sums are exact. */
#include <stdatomic.h>
#include <time.h>

int clock_gettime(clockid_t clock, struct timespec *now)
{
    static atomic_long looks;
    const long ticks = ++looks;
    (void)clock;
    *now = (struct timespec){1700000000 + ticks / 256, ticks % 256 * 3906250};
    return 0;
}

time_t time(time_t *now)
{
    if (now)
        *now = 1700000000;
    return 1700000000;
}
