/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "nested-grids.h"

#include "grid-level.h"

/* Cells that are not halved any more. */
enum { COARSEST = 512 };

ff_status ehl_nested_film(ehl_solver *s, const ehl_step *step, const ehl_instant *at,
                          double modulus, double thinnest, ehl_film *film)
{
    ehl_grid_level l[2] = {0};
    size_t all = s->grid->nodes - 1, halvings = 0, now = 0;
    int found = 0;
    ff_status status = FF_NOCONV;
    while (all >> (halvings + 1) >= COARSEST)
        halvings++;
    for (size_t k = halvings; k > 0; k--) {
        ehl_grid_level *before = &l[now];
        now = 1 - now;
        ehl_grid_level_destroy(&l[now]);
        status = ehl_grid_level_create(&l[now], s, all >> k, modulus);
        if (status == FF_OK)
            status =
                ehl_grid_level_solve(&l[now], found ? before : NULL, step, at, modulus, thinnest);
        if (status != FF_OK && (found || status != FF_NOCONV))
            break;
        found = status == FF_OK; /* what is too coarse for a film is left out */
    }
    if (status == FF_OK)
        ehl_grid_level_refine(&l[now], s, film);
    ehl_grid_level_destroy(&l[0]);
    ehl_grid_level_destroy(&l[1]);
    return status;
}
