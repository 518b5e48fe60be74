/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The members of a harmonic balance, and the sampling of its curves. */
#ifndef DYNAMICS_HARMONICS_SAMPLES_H
#define DYNAMICS_HARMONICS_SAMPLES_H

#include "harmonics.h"

#include <complex.h>

#include <fftw3.h>
#include <lapacke.h>

/* A crossing of the edge of the gap, or of a knee of the spring, between the neighbouring samples i
   and j. `area` is the error of the trapezoidal rule at the kink of the force; the correction is
   distributed to the two samples. after_i and after_j are the derivatives of `area` with respect to
   s at i and at j. */
typedef struct dynamics_harmonics_edge {
    size_t i, j;
    double area, after_i, after_j;
} dynamics_harmonics_edge;

struct dynamics_harmonics {
    const dynamics_excitation *excitation;
    size_t harmonics, samples;
    size_t lines;                   /* number of lines of the spring (spring.h), at least 1 */
    double *slope, *offset;         /* slope and offset of each line at the samples, from the exact
                                       harmonics below samples/2 */
    double *e;                      /* e at the samples, from its exact harmonics below samples/2 */
    double *e_series;               /* series of e */
    double *time;                   /* workspace for samples */
    dynamics_harmonics_edge *edges; /* edges that the motion crosses */
    fftw_complex *spectrum;
    fftw_plan to_time, to_spectrum;
    double *cosine, *sine;          /* harmonics of the mesh stiffness along the motion, up to 2
                                       H */
    double *residual, *trial, *try; /* workspace of Newton's method */
    double *jacobian;
    lapack_int *pivot;
};

/* Samples e and the lines of the spring by their exact harmonics. */
void dynamics_harmonics_sample(dynamics_harmonics *b);

#endif
