/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stores the film at each time for the outputs, and records how accurate it is. */
#ifndef EHL_OUTPUTS_H
#define EHL_OUTPUTS_H

#include "../errors/results.h"

/* `judged`: errors are estimated that take time. */
ff_status ehl_results_create(ehl_results *r, const ff_host *host, uint64_t wanted, int judged,
                             const ehl_march *m);
void ehl_results_destroy(ehl_results *r);

/* Records the newest film of the march. `last`: it is the last film. */
ff_status ehl_results_record(ehl_results *r, ehl_march *m, int last);

/* Writes all outputs and the quality record. */
ff_status ehl_results_finish(const ehl_results *r, const ehl_march *m);

void ehl_results_quality(const ehl_results *r, const ehl_march *m);

#endif
