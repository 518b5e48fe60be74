/* SPDX-License-Identifier: MIT */
/* A lack of memory that was reported, since there is more to say of it than its name. */
#ifndef FE_REPORT_H
#define FE_REPORT_H

#include <flankfilm/engine.h>

void fe_report_note_no_memory(ff_report *report);
/* Whether an error came of that: with more memory, the same call might be good. */
bool fe_report_lacked_memory(const ff_report *report);

#endif
