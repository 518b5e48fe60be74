/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Computes instants of a run, and the passage of the contact before the first of them, again on
 * more cells.
 */
#ifndef EHL_PASSAGE_REFINEMENT_H
#define EHL_PASSAGE_REFINEMENT_H

#include "results.h"

/* Columns of a film on more cells: those of EHL_BOUNDS, and a bound of the error of its peak. */
enum { EHL_PEAK_BOUND = EHL_BOUNDS, EHL_PASSED };

typedef struct ehl_passage {
    const ehl_history *whole;  /* of all engagements */
    int equal;                 /* the lengths of the steps were given */
    size_t begin, first, last; /* rows of one engagement; films are kept from `first` on */
} ehl_passage;

/* Whether a row counts for the error of an output. */
typedef int ehl_row_counts(const ehl_results *r, size_t row, int kind);

/* Chooses the rows around one row that `count` and lie at most a passage away from it. */
void ehl_passage_about(ehl_passage *p, const ehl_results *r, const ehl_march *m, size_t row,
                       ehl_row_counts *counts, int kind);

/* Marches to a row from a passage before it, on `times` the cells of the run, and keeps the film of
   the row; f->change has room for its nodes. */
ff_status ehl_passage_to(const ehl_results *r, const ehl_march *m, ehl_passage *p, size_t row,
                         size_t times, ehl_instant_film *f);

/* Marches from a passage before row `first` to row `last`, on `times` the cells of the run, and
   fills in the films of these rows. */
ff_status ehl_passage_again(const ehl_results *r, const ehl_march *m, ehl_passage *p, size_t first,
                            size_t last, size_t times, double (*film)[EHL_PASSED]);

#endif
