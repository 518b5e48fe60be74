/* SPDX-License-Identifier: MIT */
/* Sets and restores the mark of ff_guard_current. Calls may nest: fe_guard_leave takes the mark
   that fe_guard_enter returned. */
#ifndef FE_GUARD_H
#define FE_GUARD_H

#include <flankfilm/engine.h>

ff_guard_mark fe_guard_enter(ff_guard_mark mark);
void fe_guard_leave(ff_guard_mark previous);

/* Writes "film: the plugin film.so", followed by the plugins whose services it may call: ", or
 * one that serves it (oil: the plugin oil.so),", with the last comma. */
void fe_guard_name(const ff_guard_mark *mark, char *out, size_t size);

#endif
