/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The heights of both flanks, that pass through the contact: at the time t the point s of flank i
 * stands at x = s - origin + integral of u_i dt. A cell takes the mean height over its width, from
 * the difference of the integral of the height, so that no metal is lost as the flank moves on by
 * parts of a cell.
 */
#ifndef EHL_ROUGHNESS_H
#define EHL_ROUGHNESS_H

#include "grid.h"

typedef struct ehl_roughness {
    size_t count; /* of samples; 0: smooth */
    double spacing, period, origin, rq[2];
    const double *height[2];
    double *sum[2];    /* integral of the height up to each sample */
    double *travel[2]; /* integral of u_i up to each row of the history */
    double curvature;  /* root mean square of the gap between the flanks, 1/m */
    double *memory;
    const ehl_history *history;
    /* m, m/s, s: until x = speed (time - passed) the flanks are rough, `ramp` further on smooth;
       ramp 0: rough all over */
    double ramp, speed, passed;
} ehl_roughness;

/* Checks position[0 .. count-1], the heights, rq, period and origin, which are set; FF_NOMEM. */
ff_status ehl_roughness_create(ehl_roughness *r, const double *position, const ehl_history *h,
                               const ff_host *host);
void ehl_roughness_destroy(ehl_roughness *r);

/* R1 + R2 at the nodes of the grid. */
void ehl_roughness_heights(const ehl_roughness *r, const ehl_grid *g, double time, double *sum);

/* What the oil is carried from the first time to `time`, in the direction of the entrainment, m. */
double ehl_roughness_travel(const ehl_roughness *r, double time);

/* Mean distance of the peaks of the finer flank. */
double ehl_roughness_wavelength(const ehl_roughness *r);

/* Length over which an asperity draws in a film of that thickness. */
double ehl_roughness_inlet(const ehl_roughness *r, double film);

/* sqrt(Rq1^2 + Rq2^2) */
double ehl_roughness_rq(const ehl_roughness *r);

#endif
