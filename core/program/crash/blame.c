/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "blame.h"

#include <dlfcn.h>
#include <link.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unwind.h>

enum { MOST_SERVICES = 16 /* largest depth of services that use services */ };

static _Unwind_Reason_Code add_frame(struct _Unwind_Context *frame, void *argument)
{
    crash_stack *stack = argument;
    stack->at[stack->count++] = (const void *)_Unwind_GetIP(frame);
    return stack->count < CRASH_DEEPEST_STACK ? _URC_NO_REASON : _URC_END_OF_STACK;
}

void crash_stack_read(crash_stack *stack)
{
    stack->count = 0;
    _Unwind_Backtrace(add_frame, stack);
}

static const struct link_map *object_of(const void *address)
{
    struct dl_find_object found;
    return _dl_find_object((void *)(uintptr_t)address, &found) == 0 ? found.dlfo_link_map : NULL;
}

/* Returns whether the code belongs to the plugin. While an object is being loaded, all code that
   runs counts as its code. */
static bool is_code_of(const ff_guard_mark *mark, const struct link_map *object)
{
    return !mark->code || object_of(mark->code) == object;
}

static bool is_this_program(const struct link_map *object)
{
    static const char here;
    return object_of(&here) == object;
}

static const ff_guard_mark *owner(const ff_guard_mark *mark, const struct link_map *object,
                                  int depth)
{
    const ff_guard_mark *found = is_code_of(mark, object) ? mark : NULL;
    for (size_t i = 0; !found && depth < MOST_SERVICES && mark->services && mark->services[i]; i++)
        found = owner(mark->services[i], object, depth + 1);
    return found;
}

const ff_guard_mark *crash_address_blame(const void *address, const ff_guard_mark *running)
{
    const struct link_map *object = object_of(address);
    return object && !is_this_program(object) ? owner(running, object, 0) : NULL;
}

const ff_guard_mark *crash_stack_blame(const crash_stack *stack, const ff_guard_mark *running)
{
    const ff_guard_mark *found = NULL;
    for (size_t i = 0; i < stack->count && !found; i++)
        found = crash_address_blame(stack->at[i], running);
    return found;
}

const char *crash_stack_library(const crash_stack *stack, const ff_guard_mark *running)
{
    const struct link_map *libc = object_of((const void *)(uintptr_t)exit);
    size_t i = 0;
    while (i < stack->count && object_of(stack->at[i]) != libc)
        i++;
    while (i < stack->count && object_of(stack->at[i]) == libc)
        i++;
    const struct link_map *caller = i < stack->count ? object_of(stack->at[i]) : NULL;
    bool library =
        caller && running->code && !is_this_program(caller) && !owner(running, caller, 0);
    return library ? caller->l_name : NULL;
}

const ff_guard_mark *crash_stack_blame_caller(const crash_stack *stack,
                                              const ff_guard_mark *running)
{
    const struct link_map *library = NULL;
    for (size_t i = 0; i < stack->count; i++) {
        const struct link_map *object = object_of(stack->at[i]);
        if (!library && !is_this_program(object))
            library = object;
        if (library && object != library)
            return crash_address_blame(stack->at[i], running);
    }
    return NULL;
}
