/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The command is done in a child of the process that the user started. That one leads: it hands
 * signals on, waits, and holds the exit code. A child that ends without its last word was ended by
 * foreign code, in whatever way; the leading process says whose code was running, which it reads in
 * memory that both share. Workers of studies leave the same words for the process that waits for
 * them.
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
    char sentence[CRASH_SENTENCE]; /* "": the child has said all */
} crash_end;

/* Forks, before anything is loaded. False: this is the child, which does the command; it is the
   process itself where a debugger or valgrind watches, and where no process can be made. True: the
   child has ended. Where a signal ended the child that is no plugin's fault, the leading process
   ends in the same way and does not return. */
bool crash_lead(crash_end *end);

/* The last word of the child: ends it. */
_Noreturn void crash_leave(int code);

/* Ends the process with that sentence, said by who waits for it. May be called in a handler of
   signals. */
_Noreturn void crash_say(const char *sentence, int code);

/* Whether a signal that the handler has at hand is the one before once more: what comes to the
   whole group is handed on by the leading process, too. */
bool crash_is_echo(const siginfo_t *info);

/* "segmentation fault"; NULL: the signal is no fault. */
const char *crash_fault_name(int number);

/* From now on it says whose code runs here, for the process that waits for this one. Borrowed. */
void crash_mark(ff_guard_mirror *mirror);
const char *crash_running(void); /* whose it is */

/* "film: the plugin ehl.so crashed during evaluate: segmentation fault", by the status of waitpid.
   False: no plugin was running. */
bool crash_describe(const ff_guard_mirror *mark, int status, char *text, size_t size);

#endif
