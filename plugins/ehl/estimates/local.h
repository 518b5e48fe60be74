/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Friction of one instant of a film with given thickness. The oil has a single temperature, to
   which its own friction heats it, and asperities carry a share of the load. The oil is warmer than
   the teeth by the mean flash temperature of two half-spaces under the contact (Jaeger 1942, in the
   form of ISO/TS 6336-20) plus the mean rise across the film: T_f = T_bulk + 0.752 tau u_s
   sqrt(2a)/(B_1 sqrt(u_1) + B_2 sqrt(u_2)) + h tau_f u_s/(8 k). Here tau is the mean shear stress
   over 2a of the whole friction, tau_f that of the oil, and B = sqrt(k rho c) is taken for each
   flank. T_f minus the right-hand side increases with T_f, so there is one root. */
#ifndef EHL_LOCAL_H
#define EHL_LOCAL_H

#include "../contact/liquid.h"
#include "inlet-heat.h"

#include <flankfilm/laws.h>

/* Indices of the words of `share`. */
enum { EHL_GREENWOOD_TRIPP, EHL_MASJEDI_KHONSARI, EHL_CLARKE };

typedef struct ehl_local {
    const ehl_laws *laws;
    double bulk; /* temperature of the teeth, K; 0: the laws use their reference temperature */
    double contact[2];              /* B of both flanks, J/(m2 K s^0.5) */
    double conductivity;            /* conductivity of the oil at ambient pressure, W/(m K) */
    ehl_conductivity_rise conducts; /* increase of the conductivity with the mean pressure */
    const ff_asperity *asperities;  /* NULL: smooth flanks */
    int32_t share;
    double boundary_friction, hardness; /* hardness in Pa; 0: elastic summits */
    double modulus;                     /* E' */
    double viscosity, alpha;            /* viscosity and pressure coefficient of the oil */
} ehl_local;

/* One loaded instant. p_max and a are Hertz's. */
typedef struct ehl_local_contact {
    double load, radius, a, p_max, h, entrainment, sliding;
} ehl_local_contact;

typedef struct ehl_local_friction {
    double oil, asperities; /* friction force per width with the sign of the sliding, N/m */
    double share;           /* share of the load on asperities */
    double rise;            /* T_f - T_bulk, K */
    ff_status laws;
    ff_status closure; /* status of the share; FF_DOMAIN: outside its range */
} ehl_local_friction;

enum { EHL_LOCAL_POINTS = 32 };

/* Returns x/a of the points over which the friction is summed. These points divide the angle whose
   cosine is x/a into equal parts, so that Hertz's pressure is integrated exactly. */
double ehl_local_place(int part);

/* Computes the friction. `h` is the film at these points; if NULL, the film is c->h everywhere. */
ehl_local_friction ehl_local_evaluate(const ehl_local *l, const ehl_local_contact *c,
                                      const double *h);

#endif
