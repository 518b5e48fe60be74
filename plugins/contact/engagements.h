/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Chooses the engagements that represent a motion of many mesh cycles. */
#ifndef CONTACT_ENGAGEMENTS_H
#define CONTACT_ENGAGEMENTS_H

#include <stddef.h>
#include <stdint.h>

enum { CONTACT_ENGAGEMENTS_ALL = -1 };

typedef struct contact_engagement_choice {
    int64_t one;  /* index of a single engagement, or CONTACT_ENGAGEMENTS_ALL */
    int64_t most; /* largest number of engagements if all are requested */
} contact_engagement_choice;

/* Picks at most `most` >= 1 of the `available` engagements, in order: all of them, or one from each
   of `most` equal parts of the motion. `picked` must have room for the smaller of both numbers,
   which is returned. */
size_t contact_engagements_pick(size_t available, size_t most, size_t *picked);

#endif
