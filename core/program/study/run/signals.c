/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The first SIGINT or SIGTERM lets the running cases finish and ends the study; the second one
 * ends it at once. */
#include "../../crash/lead.h"
#include "run.h"

#include <unistd.h>

static volatile sig_atomic_t interrupts, last_signal, leading;

static void on_interrupt(int number, siginfo_t *info, void *context)
{
    static const char text[] = "\nfinishing the running cases; press again to end at once\n";
    (void)context;
    if (info->si_pid == getpid() && ff_guard_current().path) { /* the signal was sent by a plugin */
        signal(number, SIG_DFL);
        raise(number);
        return;
    }
    if (crash_is_echo(info))
        return;
    last_signal = number;
    interrupts = interrupts + 1;
    if (interrupts > 1) {
        signal(number, SIG_DFL); /* if an executor never returns, the count would not be checked */
        if (!leading)
            raise(number);
    }
    if (leading && interrupts == 1 && write(STDERR_FILENO, text, sizeof text - 1) < 0)
        return; /* stderr is closed */
}

void study_signals_catch(study_signals *before)
{
    struct sigaction action = {.sa_sigaction = on_interrupt, .sa_flags = SA_SIGINFO};
    sigemptyset(&action.sa_mask);
    interrupts = last_signal = leading = 0;
    sigaction(SIGINT, &action, &before->interrupt);
    sigaction(SIGTERM, &action, &before->terminate);
}

void study_signals_restore(const study_signals *before)
{
    sigaction(SIGINT, &before->interrupt, NULL);
    sigaction(SIGTERM, &before->terminate, NULL);
}

void study_signals_lead(bool leads)
{
    leading = leads;
}

int study_signals_count(void)
{
    return interrupts;
}

void study_signals_raise(void)
{
    signal(last_signal, SIG_DFL);
    raise(last_signal);
}
