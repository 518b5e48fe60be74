/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peaks of squeezed films that the cells of a run do not resolve. */
#ifndef EHL_NARROW_H
#define EHL_NARROW_H

#include "passage.h"

/* Marches to such peaks again on 4 and 16 times the cells, and puts what these find in place of
   p_max: with an error where they resolve it, else as what p_max is at least. */
ff_status ehl_narrow_peaks(ehl_results *r, const ehl_march *m, ehl_passage *p);

#endif
