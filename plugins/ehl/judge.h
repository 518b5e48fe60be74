/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * How far a law of the oil in place of another would move the film and the friction: both from the
 * inlet of the steady contact (inlet.h) at some instants of the history, and from the shear stress
 * under the Hertzian pressure.
 */
#ifndef FF_EHL_JUDGE_H
#define FF_EHL_JUDGE_H

#include "assess.h"

typedef enum ff_law_kind { FF_LAW_VISCOSITY, FF_LAW_DENSITY, FF_LAW_RHEOLOGY } ff_law_kind;

/* laws: those of reference; service: the candidate. The history has been checked. Fills in what
   `judge` of plugin.h promises. */
ff_status ff_judge_law(const ff_host *host, const ff_history *h, const ff_laws *laws,
                       ff_law_kind kind, const void *service, ff_wishes w, char *reason,
                       size_t size, ff_assessment *a);
/* The refusal where flanks are rough. */
ff_status ff_judge_rough(const ff_host *host);

#endif
