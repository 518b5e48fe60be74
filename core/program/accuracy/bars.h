/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Error bars of the outputs of an answer, from its twins and from what its stages estimate. */
#ifndef ACCURACY_BARS_H
#define ACCURACY_BARS_H

#include "compare.h"
#include "twins.h"

/* Finds the errors of all outputs of the record from the twins that exist so far. */
void accuracy_find_bars(const accuracy_twins *twins);
/* The numbers of an output along an axis; `at`: NULL if it is the index. */
accuracy_series accuracy_series_of(const double *at, const accuracy_error *e);
/* Memory that lives as long as the record. */
void *accuracy_take(const accuracy_twins *twins, size_t count, size_t size);

#endif
