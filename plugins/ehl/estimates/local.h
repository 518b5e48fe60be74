/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Friction of one instant, of a film that is known by its thickness: oil at one temperature, which
 * its own friction gives it, and asperities that carry a share of the load.
 *
 * The oil is warmer than the teeth by the mean flash of two half-spaces under the contact (Jaeger
 * 1942, as ISO/TS 6336-20 has it) and by the mean rise across the film,
 *
 *   T_f = T_bulk + 0.752 tau u_s sqrt(2a)/(B_1 sqrt(u_1) + B_2 sqrt(u_2)) + h tau_f u_s/(8 k),
 *
 * with the mean stresses over 2a of the whole friction and of the oil's, and B = sqrt(k rho c) of
 * the flanks. T_f less what follows from it increases with T_f: there is one root.
 */
#ifndef EHL_LOCAL_H
#define EHL_LOCAL_H

#include "../contact/liquid.h"
#include "inlet-heat.h"

#include <flankfilm/laws.h>

/* Ranks of the words of `share`. */
enum { EHL_GREENWOOD_TRIPP, EHL_MASJEDI_KHONSARI, EHL_CLARKE };

typedef struct ehl_local {
    const ehl_laws *laws;
    double bulk;         /* of the teeth, K; 0: the oil stays at the temperature of the laws */
    double contact[2];   /* B of both flanks, J/(m2 K s^0.5) */
    double conductivity; /* of the oil, W/(m K), */
    ehl_conductivity_rise conducts; /* and over its mean pressure */
    const ff_asperity *asperities;  /* NULL: smooth flanks */
    int32_t share;
    double boundary_friction, hardness; /* Pa; 0: elastic summits */
    double modulus;                     /* E' */
    double viscosity, alpha;            /* of the oil */
} ehl_local;

/* One loaded instant; p_max and a are those of Hertz. */
typedef struct ehl_local_contact {
    double load, radius, a, p_max, h, entrainment, sliding;
} ehl_local_contact;

typedef struct ehl_local_friction {
    double oil, asperities; /* force per width with the sign of the sliding, N/m */
    double share;           /* of the load, on asperities */
    double rise;            /* T_f - T_bulk, K */
    ff_status laws;
    ff_status closure; /* of the share; FF_DOMAIN: outside what it is known for */
} ehl_local_friction;

enum { EHL_LOCAL_POINTS = 32 };

/* x/a of the places that the friction is summed over: in equal parts of the angle whose cosine it
   is, by which Hertz's pressure is integrated exactly. */
double ehl_local_place(int part);

/* `h`: the film at these places; NULL: that of c everywhere. */
ehl_local_friction ehl_local_evaluate(const ehl_local *l, const ehl_local_contact *c,
                                      const double *h);

#endif
