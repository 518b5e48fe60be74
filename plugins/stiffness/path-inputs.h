/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The path of contact, and the total force on its pairs of teeth. */
#ifndef STIFFNESS_PATH_INPUTS_H
#define STIFFNESS_PATH_INPUTS_H

#include <flankfilm/plugin.h>

typedef struct stiffness_path {
    size_t stations;
    const double *roll;     /* roll angle of gear 1 at the stations, rad */
    double roll_sap, pitch; /* roll angle at SAP and of one mesh cycle, rad */
    double contact_ratio;   /* (tip - SAP)/pitch */
    double line_force;      /* F, N, for which stiffness and load sharing are evaluated; never
                               negative */
    double largest;         /* largest line force during a fluctuation, N; 0: no fluctuation */
    double load;            /* load shared by the pairs, N, for either sign of the torque */
} stiffness_path;

/* Reads and checks the input rows of the path of contact. */
ff_status stiffness_path_read(const ff_host *host, const ff_array *in, stiffness_path *path);

#endif
