/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Estimates the errors of a film from a second one on half the cells and half the steps. */
#ifndef EHL_STAGE_TWIN_H
#define EHL_STAGE_TWIN_H

#include "run.h"

/* Fills in the errors of h_min and h_central that are not known. Where the second film is not found
 * they stay unknown. Returns FF_OK, FF_NOMEM or FF_STOPPED. */
ff_status ehl_twin_errors(ehl_model *m, const ff_array *in, ehl_run *run);

#endif
