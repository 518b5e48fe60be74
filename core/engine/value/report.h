/* SPDX-License-Identifier: MIT */
/* A lack of memory that was reported, since there is more to say of it than its name. */
#ifndef FE_REPORT_H
#define FE_REPORT_H

#include <flankfilm/engine.h>

void fe_report_note_no_memory(ff_report *report);
/* Leaves the call when it was noted in a report that is captured, not shown: what failed must not
   be passed over for something else. */
void fe_report_require_memory(const ff_report *captured);

#endif
