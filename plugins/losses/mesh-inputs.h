/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The inputs of losses/tooth-mesh: the steps of one film or of several, one after the other, and
   the gears. */
#ifndef LOSSES_MESH_INPUTS_H
#define LOSSES_MESH_INPUTS_H

#include "../numerics/exchange.h"
#include "mesh-sum.h"
#include "rows.h"

#include <flankfilm/laws.h>

#include <stdbool.h>

/* The inputs after their checks, in SI units, and series of n that follow from them. */
typedef struct losses_mesh {
    size_t n, stations;
    numerics_exchange exchange; /* the pair whose driving flanks bear: all that follows is of it */
    const double *shown;        /* roll angles of gear 1 at the steps */
    const double *roll, *power, *traction, *friction;
    const double *part[PARTS], *engagement; /* NULL: the film does not give it */
    size_t count, *first; /* engagements, and where each begins; first[count] = n */
    const double *station, *radius[2];
    double face_width, modulus, contact_ratio, torque, oil_temperature;
    double omega[2], pitch;
    double roughness;           /* Ra, mean of both flanks, m; 0: not known */
    double viscosity, oil_base; /* of the oil at its temperature, Pa s, FF_BASE_...; NaN: unknown */
    bool heats;                 /* the gears tell how they conduct heat */
    numerics_heat heat[2];      /* of the gears */
    double *loss, *load, *flash; /* W, N/m, K */
    double *half_width;
    size_t hottest;
} losses_mesh;

/* Reads and checks; to be closed in any case. `oil`: may be NULL. */
ff_status losses_read(const ff_host *host, const ff_array *in, const ff_liquid *oil,
                      losses_mesh *m);
void losses_close(losses_mesh *m);

/* Radii (m) and surface speeds (m/s) at a roll angle; the radii of involutes are linear in it. */
void losses_motion_at(const losses_mesh *m, double roll, double radius[2], double speed[2]);

/* The steps of engagement k with their loss. */
losses_engagement losses_engagement_at(const losses_mesh *m, size_t k);

#endif
