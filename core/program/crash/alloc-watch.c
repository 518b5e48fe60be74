/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "alloc-watch.h"

#include "crash.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <sys/resource.h>
#include <time.h>
#include <ucontext.h>

/* A timer checks the process every LOOK_MICROSECONDS. If the system has just refused memory, MORE
   is added to a count, otherwise 1 is subtracted. At MOST the process is ended. */
enum { LOOK_MICROSECONDS = 20000, MORE = 4, MOST = 200 };

/* Returns the size that mmap has just refused, or 0. */
static unsigned long long refused(const ucontext_t *context)
{
#ifdef __x86_64__
    const greg_t *registers = context->uc_mcontext.gregs;
    return registers[REG_RAX] == -ENOMEM ? (unsigned long long)registers[REG_RSI] : 0;
#else
    (void)context;
    return 0;
#endif
}

static void look(int number, siginfo_t *info, void *context)
{
    static int hunger;
    unsigned long long bytes = refused(context);
    (void)number;
    (void)info;
    hunger += bytes ? MORE : hunger > 0 ? -1 : 0;
    if (hunger >= MOST)
        crash_starve(bytes);
}

void crash_hunger_watch(void)
{
    const struct timespec pause = {.tv_nsec = 1000L * LOOK_MICROSECONDS};
    const struct itimerspec often = {pause, pause};
    struct sigevent event = {.sigev_notify = SIGEV_SIGNAL, .sigev_signo = SIGPROF};
    timer_t timer; /* a POSIX timer; a timer of setitimer would survive an exec */
    struct sigaction action = {.sa_sigaction = look, .sa_flags = SA_SIGINFO | SA_RESTART};
    struct rlimit limit;
    sigemptyset(&action.sa_mask);
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
        sigaction(SIGPROF, &action, NULL) == 0 &&
        timer_create(CLOCK_PROCESS_CPUTIME_ID, &event, &timer) == 0)
        timer_settime(timer, 0, &often, NULL);
}
