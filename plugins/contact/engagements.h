/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which engagements of a motion of many mesh cycles stand for all. */
#ifndef CONTACT_ENGAGEMENTS_H
#define CONTACT_ENGAGEMENTS_H

#include <stddef.h>
#include <stdint.h>

enum { CONTACT_ENGAGEMENTS_ALL = -1 };

typedef struct contact_engagement_choice {
    int64_t one;  /* the number of one, or CONTACT_ENGAGEMENTS_ALL */
    int64_t most; /* of all */
} contact_engagement_choice;

/* Picks at most `most` >= 1 of the `available` ones, in their order: all, or one of each of `most`
   equal parts of the motion. `picked` holds the smaller of both numbers, which is given back. */
size_t contact_engagements_pick(size_t available, size_t most, size_t *picked);

#endif
