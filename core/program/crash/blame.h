/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the plugin whose code is on a stack. A signal handler may call these functions. */
#ifndef CRASH_BLAME_H
#define CRASH_BLAME_H

#include <flankfilm/engine.h>

#include <stdbool.h>

enum { CRASH_DEEPEST_STACK = 64 };

/* The innermost return addresses on a thread's stack. */
typedef struct crash_stack {
    const void *at[CRASH_DEEPEST_STACK];
    size_t count;
} crash_stack;

/* Reads the stack of the current thread. */
void crash_stack_read(crash_stack *stack);

/* Returns the innermost plugin on the stack: the plugin in `running`, or a plugin that serves it.
   Returns NULL if there is none. */
const ff_guard_mark *crash_stack_blame(const crash_stack *stack, const ff_guard_mark *running);

/* Like crash_stack_find, for a call from a library into this program: only the code that called the
 * library counts. */
const ff_guard_mark *crash_stack_blame_caller(const crash_stack *stack,
                                              const ff_guard_mark *running);

/* Returns the path of a plugin's library that called libc, if the stack ends in a call of exit().
   Returns NULL if no library did. */
const char *crash_stack_library(const crash_stack *stack, const ff_guard_mark *running);

/* Returns the plugin to which an address belongs, among those of crash_stack_blame. NULL if there
 * is none. */
const ff_guard_mark *crash_address_blame(const void *address, const ff_guard_mark *running);

#endif
