/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Instants of a run, and the passage of the contact before the first of them, on the cells of the
 * run, on twice and on four times as many: what the films owe to the cells in the inlet, on their
 * way and at the outlet.
 */
#ifndef EHL_PASSAGE_H
#define EHL_PASSAGE_H

#include "results.h"

/* Columns of a film on more cells: those of EHL_BOUNDS, and what bounds the error of its peak. */
enum { EHL_PEAK_BOUND = EHL_BOUNDS, EHL_PASSED };

typedef struct ehl_passage {
    const ehl_history *whole;  /* of all engagements */
    int equal;                 /* the lengths of the steps were given */
    size_t begin, first, last; /* rows of one engagement; errors are found from `first` on */
    double way;                /* m, least distance that the oil moves in a step */
    /* h_min and h_central of these rows on 1, 2, 4 times the cells, and their errors by the cells,
       relative, positive where the film is too thick. NaN where the film on the cells of the run
       is not that of the run within a quarter of the error or of its limit, or, with heat, ten
       times of these: where it remembers more than a passage. */
    double (*film)[EHL_PASSED], (*error)[EHL_PASSED];
} ehl_passage;

/* Whether a row counts for the error of an output. */
typedef int ehl_row_counts(const ehl_results *r, size_t row, int kind);

/* Chooses the rows: around one row, those that `count`, at most a passage away from it. They begin
 * a passage before. */
void ehl_passage_about(ehl_passage *p, const ehl_results *r, const ehl_march *m, size_t row,
                       ehl_row_counts *counts, int kind);

/* Returns 1 when the end of the contact has moved at more than half the speed of the oil there,
   since the film of the row has come from a tenth of its half-width upstream. */
int ehl_outlet_moves(const ehl_passage *p, const ehl_results *r, size_t row);

/* Finds the errors by twice the cells; kind: what the rows are looked at for. FF_OK, or a failure
 * after which there are no errors. */
ff_status ehl_passage_errors(const ehl_results *r, const ehl_march *m, ehl_passage *p,
                             ehl_row_counts *counts, int kind);

/* Refines these errors by four times the cells. FF_OK, or a failure after which the errors before
 * stand. */
ff_status ehl_passage_refine(const ehl_results *r, const ehl_march *m, ehl_passage *p);

/* Marches from a passage before to a row, on so many times the cells of the run, and keeps the film
   there; f->change has room for its nodes. */
ff_status ehl_passage_to(const ehl_results *r, const ehl_march *m, ehl_passage *p, size_t row,
                         size_t times, ehl_instant_film *f);

/* Marches from a passage before row `first` to `last`, on so many times the cells of the run, and
   fills in the films of all rows from the first one on. */
ff_status ehl_passage_again(const ehl_results *r, const ehl_march *m, ehl_passage *p, size_t first,
                            size_t last, size_t times, double (*film)[EHL_PASSED]);

void ehl_passage_destroy(ehl_passage *p);

#endif
