/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The heights of both flanks as they pass through the contact. At time t the point s of flank i is
   at x = s - origin + integral of u_i dt. The height of a cell is the mean over its width, computed
   as a difference of integrals. The volume of metal is therefore conserved while a flank moves by
   fractions of a cell. */
#ifndef EHL_SURFACE_H
#define EHL_SURFACE_H

#include "grid.h"

#include <flankfilm/plugin.h>

/* Number of cells per shortest wave of the flanks; the filter reduces the amplitude of this wave to
   a half. */
#define EHL_CELLS_PER_WAVE 16.

typedef struct ehl_roughness {
    size_t count; /* number of samples; 0: smooth */
    double spacing, period, origin, rq[2];
    const double *height[2];
    double cutoff; /* m, shorter waves are removed; 0: none */
    double given,
        left_out; /* root mean square height of both flanks as given, and of the removed waves, m */
    double *sum[2];          /* integral of the height up to each sample */
    double *travel[2];       /* integral of u_i up to each row of the history */
    double curvature;        /* root mean square curvature of the gap between the flanks, 1/m */
    double *memory, *smooth; /* `smooth`: heights without the removed waves */
    const ehl_history *history;
    /* m. In the first row of the history the flanks are rough up to x = `front` and smooth beyond
       `front` + `ramp`. This transition moves with the oil. If ramp is 0, the flanks are rough
       everywhere. */
    double ramp, front;
} ehl_roughness;

/* Checks position[0 .. count-1], heights, rq, period and origin, which are already set. Returns
   FF_NOMEM if out of memory. */
ff_status ehl_roughness_create(ehl_roughness *r, const double *position, const ehl_history *h,
                               const ff_host *host);
void ehl_roughness_destroy(ehl_roughness *r);

/* Removes waves shorter than `cutoff` (m, above 0) from both flanks by the Gaussian filter of ISO
   16610-21. Returns FF_NOMEM, or FF_INVALID if the points of a record with flat ends are too close
   for the filter. */
ff_status ehl_roughness_cut(ehl_roughness *r, double cutoff, const ff_host *host);

/* Computes R1 + R2 at the nodes of the grid. */
void ehl_roughness_heights(const ehl_roughness *r, const ehl_grid *g, double time, double *sum);

/* Returns the distance that the oil has moved from the first time to `time`, in the direction of
   the entrainment, m. */
double ehl_roughness_travel(const ehl_roughness *r, double time);

/* Returns the mean distance of the peaks of the finer flank. */
double ehl_roughness_wavelength(const ehl_roughness *r);

/* Returns the length over which an asperity draws oil into a film of that thickness. */
double ehl_roughness_inlet(const ehl_roughness *r, double film);

/* Returns the share of waves longer than `length` in the variance of both flanks, from the
   harmonics of the record. */
double ehl_roughness_longer(const ehl_roughness *r, double length);

/* Returns the share of the flanks' travel in which the heights at x = 0 are beyond a record that
   does not repeat. Returns 0 for flanks without Rq, such as a dent. */
double ehl_roughness_beyond(const ehl_roughness *r);

/* Returns sqrt(Rq1^2 + Rq2^2). */
double ehl_roughness_rq(const ehl_roughness *r);

/* Friction coefficient of ground and run-in steel, 0.065 +- 0.015. 0.065 is the largest mean
   friction of FZG gears at 0.5 m/s (Ziegltrum 2017, quoted by Arana, Larranaga & Ulacia 2019).
   Measured values of rollers and pins are 0.08 to 0.135. */
#define EHL_BOUNDARY_FRICTION "0.065"

/* Film parameter lambda (film over the combined roughness of both flanks) below which asperities
   are in contact (mixed lubrication). */
#define EHL_MIXED_BELOW 3.

/* Computes sqrt(Rq1^2 + Rq2^2), m, of the surface if there is one, else of the gears; 0: not known.
   The arrays are gear.roughness, surface.rq_1 and surface.rq_2. Returns FF_INVALID if a value is
   wrong. */
ff_status ehl_combined_roughness(const ff_host *host, const ff_array *gear, const ff_array *rq_1,
                                 const ff_array *rq_2, double *rq);

/* Returns FF_UNSUPPORTED if this output is requested but no roughness is known. */
ff_status ehl_lambda_check(const ff_host *host, uint64_t wanted, uint32_t output, const char *name,
                           double rq);

/* Reads the hardness of the softer gear, or uses `otherwise` if no gear is wired. A gear without
   hardness is refused. */
ff_status ehl_read_hardness(const ff_host *host, const ff_array *gears, double otherwise,
                            double *hardness);

/* Writes the quality lines of a film whose asperities carry a share of the load. */
void ehl_lambda_carried(const ff_host *host, double lowest);

/* Writes the quality lines of a smooth film between flanks of known roughness. */
void ehl_lambda_report(const ff_host *host, double lowest);

#endif
