/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The path of contact, and the force that its pairs of teeth carry together. */
#ifndef STIFFNESS_PATH_INPUTS_H
#define STIFFNESS_PATH_INPUTS_H

#include <flankfilm/plugin.h>

typedef struct stiffness_path {
    size_t stations;
    const double *roll;     /* roll angle of gear 1 at the stations, rad */
    double roll_sap, pitch; /* roll angle at SAP and of one mesh cycle, rad */
    double contact_ratio;   /* (tip - SAP)/pitch */
    double line_force;      /* F, N, at which stiffness and sharing are taken */
    double largest;         /* N, that the line force swings to; 0: it does not swing */
    double load;            /* N, of both signs of the torque, which the pairs share */
} stiffness_path;

/* Reads and checks the input rows of the path of contact. */
ff_status stiffness_path_read(const ff_host *host, const ff_array *in, stiffness_path *path);

#endif
