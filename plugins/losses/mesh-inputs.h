/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Inputs of losses/tooth-mesh: the steps of one film or of several in sequence, and the gears. */
#ifndef LOSSES_MESH_INPUTS_H
#define LOSSES_MESH_INPUTS_H

#include "../numerics/exchange.h"
#include "mesh-sum.h"
#include "rows.h"

#include <flankfilm/laws.h>

#include <stdbool.h>

/* The checked inputs, in SI, and series of n values derived from them. */
typedef struct losses_mesh {
    size_t n, stations;
    numerics_exchange exchange; /* the pair whose driving flanks have the film; all data below refer
                                   to it */
    bool other;                 /* whether these flanks are opposite to those that carry the mean
                                   load; torque is then 0 */
    const double *back[1 + PARTS]; /* mean losses of the opposite flanks, W: total and parts; NULL:
                                      not wired */
    const double *shown;           /* roll angles of gear 1 at the steps, as written to outputs */
    const double *roll, *power, *traction, *friction;
    const double *part[PARTS], *engagement; /* NULL: the film does not give it */
    size_t count, *first; /* number of engagements, and the first step of each; first[count] = n */
    const double *station, *radius[2];
    double face_width, modulus, contact_ratio, torque, oil_temperature;
    double omega[2], pitch;
    double roughness;            /* Ra, mean of both flanks, m; 0: unknown */
    double viscosity, oil_base;  /* viscosity at the oil temperature, Pa s, and base oil as
                                    FF_BASE_...; NaN:  unknown */
    bool heats;                  /* the gears give their thermal data */
    numerics_heat heat[2];       /* thermal data of the gears */
    double *loss, *load, *flash; /* loss in W, load per width in N/m and flash temperature in K at
                                    the steps */
    double *half_width;
    size_t hottest;
} losses_mesh;

/* Reads and checks the inputs; the caller closes them, also after an error. `oil` may be NULL. */
ff_status losses_read(const ff_host *host, const ff_array *in, const ff_liquid *oil,
                      losses_mesh *m);
void losses_close(losses_mesh *m);

/* Computes radii (m) and surface speeds (m/s) at a roll angle; the radii of involutes are linear in
   the roll angle. */
void losses_motion_at(const losses_mesh *m, double roll, double radius[2], double speed[2]);

/* Returns the base radius of the driving gear, m. */
double losses_base_radius(const losses_mesh *m);

/* Reports flanks that do not carry the mean load, and losses of opposite flanks that are missing in
   the means. `force` is the mean mesh force of the film, N; `heated`: the bulk temperature follows
   from the loss. */
void losses_report_flanks(const ff_host *host, const losses_mesh *m, double force, bool heated);

/* Returns roll angles and losses of engagement k. */
losses_engagement losses_engagement_at(const losses_mesh *m, size_t k);

#endif
