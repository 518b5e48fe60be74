/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Measures errors due to the cells. Instants of a run, and the passage of the contact before the
 * first of them, are computed again on the cells of the run, on twice and on four times as many.
 * The errors include those of the inlet, of the way through the contact and of the outlet.
 */
#ifndef EHL_PASSAGE_REFINEMENT_H
#define EHL_PASSAGE_REFINEMENT_H

#include "results.h"

/* Columns of a film on more cells: those of EHL_BOUNDS, and a bound of the error of its peak. */
enum { EHL_PEAK_BOUND = EHL_BOUNDS, EHL_PASSED };

typedef struct ehl_passage {
    const ehl_history *whole;  /* of all engagements */
    int equal;                 /* the lengths of the steps were given */
    size_t begin, first, last; /* rows of one engagement; errors are found from `first` on */
    double way;                /* m, least distance that the oil moves in a step */
    /* h_min and h_central of these rows on 1, 2, 4 times the cells, and their relative errors due
       to the cells, positive if the film is too thick. NaN if the film on the cells of the run
       differs from that of the run by more than a quarter of the larger of the error and its limit
       (with heat: ten times it), since the film then remembers more than a passage. */
    double (*film)[EHL_PASSED], (*error)[EHL_PASSED];
} ehl_passage;

/* Whether a row counts for the error of an output. */
typedef int ehl_row_counts(const ehl_results *r, size_t row, int kind);

/* Chooses the rows around one row that `count` and lie at most a passage away from it. The march
 * begins a passage before them. */
void ehl_passage_about(ehl_passage *p, const ehl_results *r, const ehl_march *m, size_t row,
                       ehl_row_counts *counts, int kind);

/* Returns 1 when the end of the contact has moved at more than half the speed of the oil there,
   since the film of the row has come from a tenth of its half-width upstream. */
int ehl_outlet_moves(const ehl_passage *p, const ehl_results *r, size_t row);

/* Finds the errors from films on the cells of the run and on twice as many. `kind` is the output
 * for which `counts` selects rows. Returns FF_OK, or a failure after which there are no errors. */
ff_status ehl_passage_errors(const ehl_results *r, const ehl_march *m, ehl_passage *p,
                             ehl_row_counts *counts, int kind);

/* Finds these errors anew with films on four times the cells. Returns FF_OK, or a failure after
 * which the earlier errors remain. */
ff_status ehl_passage_refine(const ehl_results *r, const ehl_march *m, ehl_passage *p);

/* Marches to a row from a passage before it, on `times` the cells of the run, and keeps the film of
   the row; f->change has room for its nodes. */
ff_status ehl_passage_to(const ehl_results *r, const ehl_march *m, ehl_passage *p, size_t row,
                         size_t times, ehl_instant_film *f);

/* Marches from a passage before row `first` to row `last`, on `times` the cells of the run, and
   fills in the films of these rows. */
ff_status ehl_passage_again(const ehl_results *r, const ehl_march *m, ehl_passage *p, size_t first,
                            size_t last, size_t times, double (*film)[EHL_PASSED]);

void ehl_passage_destroy(ehl_passage *p);

#endif
