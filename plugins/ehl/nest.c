/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "nest.h"

#include "level.h"

/* Cells that are not halved any more. */
enum { COARSEST = 512 };

ff_status ff_nested_film(ff_solver *s, const ff_step *step, const ff_instant *at, double modulus,
                         double thinnest, ff_film *film)
{
    ff_level l[2] = {0};
    size_t all = s->grid->nodes - 1, halvings = 0, now = 0;
    int found = 0;
    ff_status status = FF_NOCONV;
    while (all >> (halvings + 1) >= COARSEST)
        halvings++;
    for (size_t k = halvings; k > 0; k--) {
        ff_level *before = &l[now];
        now = 1 - now;
        ff_level_destroy(&l[now]);
        status = ff_level_create(&l[now], s, all >> k, modulus);
        if (status == FF_OK)
            status = ff_level_find(&l[now], found ? before : NULL, step, at, modulus, thinnest);
        if (status != FF_OK && (found || status != FF_NOCONV))
            break;
        found = status == FF_OK; /* what is too coarse for a film is left out */
    }
    if (status == FF_OK)
        ff_level_refine(&l[now], s, film);
    ff_level_destroy(&l[0]);
    ff_level_destroy(&l[1]);
    return status;
}
