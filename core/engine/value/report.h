/* SPDX-License-Identifier: MIT */
/* What is noted of an error beside its text. */
#ifndef FE_REPORT_H
#define FE_REPORT_H

#include <flankfilm/engine.h>

/* Reports that a number is beyond the limits of its row. Returns false. */
bool fe_report_beyond(ff_report *report, ff_place place, const char *text);

void fe_report_note_no_memory(ff_report *report);
/* Whether an error came of that: with more memory, the same call might be good. */
bool fe_report_lacked_memory(const ff_report *report);

#endif
