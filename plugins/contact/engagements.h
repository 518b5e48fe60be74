/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which engagements of a motion of many mesh cycles stand for all. */
#ifndef CONTACT_ENGAGEMENTS_H
#define CONTACT_ENGAGEMENTS_H

#include <stddef.h>

/* Picks at most `most` >= 1 of `had`, in their order: all, or one of each of `most` equal parts of
   the motion. `picked` holds the smaller of both numbers, which is given back. */
size_t contact_engagements_pick(size_t had, size_t most, size_t *picked);

#endif
