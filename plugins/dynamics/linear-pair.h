/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * An estimate of how far the motion is from the static one: the pair is taken as a linear
 * oscillator at its mean stiffness that is driven by its static deflection s_0,
 *
 *   s'' + 2 zeta s' + s = s_0(t)      in units of the natural frequency.
 *
 * s_0 is straight between its phases and may jump, so that each stretch is solved in closed form.
 */
#ifndef DYNAMICS_LINEAR_PAIR_H
#define DYNAMICS_LINEAR_PAIR_H

#include <stddef.h>

typedef struct dynamics_linear_pair {
    size_t count;
    const double *phase;      /* 0 to 1, twice at a jump */
    const double *deflection; /* s_0, m */
    double frequency;         /* mesh over natural frequency */
    double zeta;
} dynamics_linear_pair;

/* Of one mesh cycle of the steady motion, m. */
typedef struct dynamics_linear_pair_response {
    double highest, lowest;           /* of s - s_0 */
    double rms;                       /* of s - s_0 */
    double rms_static;                /* of the alternating part of s_0 */
    double rms_total;                 /* of the alternating part of s */
    double swing_static, swing_total; /* highest less lowest s_0 and s */
} dynamics_linear_pair_response;

dynamics_linear_pair_response dynamics_linear_pair_motion(const dynamics_linear_pair *l);

#endif
