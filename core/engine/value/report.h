/* SPDX-License-Identifier: MIT */
/* Properties of an error that a report stores beside its text. */
#ifndef FE_REPORT_H
#define FE_REPORT_H

#include <flankfilm/engine.h>

/* Reports that a number is outside the limits of its row. Returns false. */
bool fe_report_beyond(ff_report *report, ff_place place, const char *text);

void fe_report_note_no_memory(ff_report *report);
/* Whether an error was caused by a lack of memory, so that the same call may succeed later. */
bool fe_report_lacked_memory(const ff_report *report);

#endif
