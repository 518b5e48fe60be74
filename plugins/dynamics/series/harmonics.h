/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Harmonic balance of the oscillator of excitation.h. A motion of one mesh cycle is the series s =
   a0 + sum a_n cos n theta + b_n sin n theta, n = 1 ... H, theta = 2 pi phase, Galerkin's method
   makes the harmonics up to H of the residual in the equation of motion 0. The mesh force is
   sampled in time and its harmonics are taken from the samples (Cameron & Griffin 1989). k and e
   are represented by their exact harmonics, so that without contact loss sampling causes no error.
   The damper always acts. A series is an array of 2 H + 1 numbers: a0, a1, b1, a2, b2 ... */
#ifndef DYNAMICS_HARMONICS_H
#define DYNAMICS_HARMONICS_H

#include "../excitation/excitation.h"

typedef struct dynamics_harmonics dynamics_harmonics;

/* `samples` per mesh cycle must be even and more than 4 `harmonics`. Returns NULL if out of
   memory. */
dynamics_harmonics *dynamics_harmonics_new(const dynamics_excitation *excitation, size_t harmonics,
                                           size_t samples);
void dynamics_harmonics_free(dynamics_harmonics *b);

size_t dynamics_harmonics_samples(const dynamics_harmonics *b);

/* Computes the harmonics of the residual of the series x at w (mesh frequency over natural
   frequency); their derivatives with respect to ln w, `after_w`; and the Jacobian with respect to
   x, in columns of length `stride`. `after_w` and `jacobian` may be NULL. */
void dynamics_harmonics_residual(dynamics_harmonics *b, double w, const double *x, double *residual,
                                 double *after_w, double *jacobian, size_t stride);

typedef enum dynamics_newton {
    DYNAMICS_NEWTON_DONE,
    DYNAMICS_NEWTON_FAILED,
    DYNAMICS_NEWTON_SINGULAR
} dynamics_newton;

/* Solves for x from a guess at a fixed frequency. `step` is the largest change of a coefficient in
   the last Newton step. */
dynamics_newton dynamics_harmonics_solve(dynamics_harmonics *b, double w, double *x, double *step);

/* Computes the largest change of a coefficient in the first Newton step from x, as an estimate of
   the distance to the solution. */
dynamics_newton dynamics_harmonics_correction(dynamics_harmonics *b, double w, const double *x,
                                              double *largest);

/* Returns the sum of the amplitudes of the neglected harmonics H + 1 to 2 H, estimated from the
   response of the mean stiffness to the force: |F_n|/sqrt((n^2 w^2 - 1)^2 + (2 zeta n w)^2). */
double dynamics_harmonics_neglected(dynamics_harmonics *b, double w, const double *x);

/* Computes the series of s from its samples over one mesh cycle, at theta = 2 pi i/samples. */
void dynamics_harmonics_analyse(dynamics_harmonics *b, const double *s, double *x);

/* Evaluates s and its derivative with respect to theta. */
void dynamics_fourier_at(const double *x, size_t harmonics, double theta, double *s, double *slope);

/* Copies a series to another length; missing coefficients become 0. */
void dynamics_fourier_resize(const double *from, size_t from_harmonics, double *to,
                             size_t to_harmonics);

/* Returns the root mean square of the alternating part. */
double dynamics_fourier_rms(const double *x, size_t harmonics);

#endif
