/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a run or a study has left in its directory, as writers see it. */
#ifndef FF_VIEW_H
#define FF_VIEW_H

#include <flankfilm/writer.h>

#include "../value/report.h"

typedef struct ff_results ff_results;

/* NULL with an error in the report: no such directory, or none with results. The report also takes
   what the view finds wrong when it is read. */
ff_results *ff_results_open(const char *directory, ff_report *report);
void ff_results_free(ff_results *results);

const ff_view *ff_results_view(const ff_results *results);

#endif
