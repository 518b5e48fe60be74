/* SPDX-License-Identifier: MIT */
/* Which code runs from here on, for ff_guard_current. Calls may nest: what fe_guard_enter returns
   is given to fe_guard_leave. */
#ifndef FE_GUARD_H
#define FE_GUARD_H

#include <flankfilm/engine.h>

ff_guard_mark fe_guard_enter(ff_guard_mark mark);
void fe_guard_leave(ff_guard_mark previous);

/* Writes "film: the plugin film.so", and behind it those whose services it may call: ", or one that
   serves it (oil: the plugin oil.so)," with that comma. */
void fe_guard_name(const ff_guard_mark *mark, char *out, size_t size);

#endif
