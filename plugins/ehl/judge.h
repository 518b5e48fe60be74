/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Estimates how much one law of the oil in place of another would change film and friction: the
 * film from the inlet of the steady contact (inlet.h) at some instants of the history, the friction
 * from the shear stress under the Hertzian pressure.
 */
#ifndef EHL_JUDGE_H
#define EHL_JUDGE_H

#include "assess.h"

typedef enum ehl_law_kind { EHL_LAW_VISCOSITY, EHL_LAW_DENSITY, EHL_LAW_RHEOLOGY } ehl_law_kind;

/* `laws` are the reference, `service` is the candidate; the history has been checked. Fills `a` as
   `judge` of plugin.h requires. */
ff_status ehl_judge_law(const ff_host *host, const ehl_history *h, const ehl_laws *laws,
                        ehl_law_kind kind, const void *service, ehl_error_targets w, char *reason,
                        size_t size, ff_assessment *a);
/* Refuses to judge with rough flanks. */
ff_status ehl_judge_rough(const ff_host *host);

#endif
