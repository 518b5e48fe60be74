/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Finds the plugin whose code is on a stack, by functions that a signal handler may call. */
#ifndef CRASH_BLAME_H
#define CRASH_BLAME_H

#include <flankfilm/engine.h>

#include <stdbool.h>

enum { CRASH_DEEPEST_STACK = 64 };

/* The innermost code addresses on a thread's stack. */
typedef struct crash_stack {
    const void *at[CRASH_DEEPEST_STACK];
    size_t count;
} crash_stack;

/* Reads the stack of this thread. */
void crash_stack_read(crash_stack *stack);

/* The innermost plugin on the stack: the one named in `running`, or one that serves it. NULL if
   there is none. */
const ff_guard_mark *crash_stack_blame(const crash_stack *stack, const ff_guard_mark *running);

/* As crash_stack_blame, when a library called this program: only the code that called the library
   counts. */
const ff_guard_mark *crash_stack_blame_caller(const crash_stack *stack,
                                              const ff_guard_mark *running);

/* The path of a plugin's library that called libc, if the stack ends in a call of exit(); NULL if
   no library did. */
const char *crash_stack_library(const crash_stack *stack, const ff_guard_mark *running);

/* As crash_stack_blame, for one address. */
const ff_guard_mark *crash_address_blame(const void *address, const ff_guard_mark *running);

#endif
