/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The command runs in a child of the process that the user started. The parent leads: it forwards
 * signals, waits, and returns the exit code. If a child ends without calling crash_leave, foreign
 * code has ended it. The parent then names the plugin that was running, which the child records in
 * shared memory. Workers of studies leave the same record for the process that waits for them.
 */
#ifndef CRASH_LEAD_H
#define CRASH_LEAD_H

#include <flankfilm/engine.h>

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>

enum { CRASH_SENTENCE = 2400 };

/* How the child ended. */
typedef struct crash_end {
    int code;
    char sentence[CRASH_SENTENCE]; /* "" if the child has printed everything itself */
} crash_end;

/* Forks before any plugin is loaded. Returns false in the child, which runs the command. Also
   returns false if a debugger or valgrind is active, or if no process can be made; this process
   then runs the command itself. Returns true in the parent after the child has ended. If a signal
   ended the child and no plugin is at fault, the parent ends by the same signal and does not
   return. */
bool crash_lead(crash_end *end);

/* Ends the child regularly. */
_Noreturn void crash_leave(int code);

/* Ends the process; its parent prints the sentence. A signal handler may call it. */
_Noreturn void crash_say(const char *sentence, int code);

/* Returns true if a signal just received is a copy of the previous one: the parent also forwards
   signals that were sent to the whole group. */
bool crash_is_echo(const siginfo_t *info);

/* Returns a name such as "segmentation fault", or NULL if the signal is not a fault. */
const char *crash_fault_name(int number);

/* From now on, records in `mirror` which plugin's code runs here, for the process that waits.
   `mirror` is borrowed. */
void crash_mark(ff_guard_mirror *mirror);
const char *crash_running(void); /* returns the plugin that is running */

/* Makes "film: the plugin ehl.so crashed during evaluate: segmentation fault" from a status of
   waitpid. Returns false if no plugin was running. */
bool crash_describe(const ff_guard_mirror *mark, int status, char *text, size_t size);

#endif
