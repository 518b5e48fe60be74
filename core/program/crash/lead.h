/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The command is done in a child of the process that the user started. The parent leads: it hands
 * signals on, waits, and holds the exit code. A child that ends without its last word was ended by
 * foreign code; the parent then names the plugin that was running, which it reads in memory shared
 * by both. Workers of studies leave the same words for the process that waits for them.
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
    char sentence[CRASH_SENTENCE]; /* "" if the child has printed all there is */
} crash_end;

/* Forks before anything is loaded. False in the child, which does the command; also false if a
   debugger or valgrind watches, or if no process can be made, and this process does the command
   itself. True in the parent once the child has ended. If a signal ended the child and no plugin is
   at fault, the parent ends by the same signal and does not return. */
bool crash_lead(crash_end *end);

/* The last word of the child: ends it. */
_Noreturn void crash_leave(int code);

/* Ends the process with a sentence that its parent prints. May be called in a signal handler. */
_Noreturn void crash_say(const char *sentence, int code);

/* True if a signal just received repeats the one before: the parent hands on also those that were
   sent to the whole group. */
bool crash_is_echo(const siginfo_t *info);

/* "segmentation fault"; NULL if the signal is no fault. */
const char *crash_fault_name(int number);

/* From now on, records in `mirror` whose code runs here, for the process that waits. Borrowed. */
void crash_mark(ff_guard_mirror *mirror);
const char *crash_running(void); /* the plugin that runs now */

/* Makes "film: the plugin ehl.so crashed during evaluate: segmentation fault" from a status of
   waitpid. False if no plugin was running. */
bool crash_describe(const ff_guard_mirror *mark, int status, char *text, size_t size);

#endif
