/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks of squeezed films that the cells of a run do not resolve. */
#ifndef EHL_NARROW_H
#define EHL_NARROW_H

#include "passage-refinement.h"

/* Marches to narrow peaks again on 4 and 16 times the cells, and replaces p_max by the result: with
 * an error if these cells resolve the peak, else as a lower bound of p_max. */
ff_status ehl_narrow_peaks(ehl_results *r, const ehl_march *m, ehl_passage *p);

#endif
