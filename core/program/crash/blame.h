/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Whose code stands on a stack, found by functions that a handler of signals may call. */
#ifndef CRASH_BLAME_H
#define CRASH_BLAME_H

#include <flankfilm/engine.h>

#include <stdbool.h>

enum { CRASH_DEEPEST_STACK = 64 };

/* The innermost addresses of code on the stack of a thread. */
typedef struct crash_stack {
    const void *at[CRASH_DEEPEST_STACK];
    size_t count;
} crash_stack;

/* The stack of this thread. */
void crash_stack_read(crash_stack *stack);

/* The innermost plugin on the stack: the one that `running` says, or one that serves it. NULL:
   there is none. */
const ff_guard_mark *crash_stack_blame(const crash_stack *stack, const ff_guard_mark *running);

/* The same where a library called this program: only the code that called the library counts. */
const ff_guard_mark *crash_stack_blame_caller(const crash_stack *stack,
                                              const ff_guard_mark *running);

/* The path of the library of a plugin that has called libc, where the stack ends in a call of
   exit(); NULL: it was not a library. */
const char *crash_stack_library(const crash_stack *stack, const ff_guard_mark *running);

/* The same as crash_stack_blame of one address. */
const ff_guard_mark *crash_address_blame(const void *address, const ff_guard_mark *running);

#endif
