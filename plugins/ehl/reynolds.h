/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The discrete Reynolds equation of a line contact, one instant in time:
 *
 *   d/dx (f dp/dx) = u_r d(rho h)/dx + d(rho h)/dt,   f = rho h^3 psi/12,
 *   h = h00 + x^2/(2 R) + v
 *
 * as balances of mass over a cell around each inner node. The pressure flow is central, the wedge
 * takes the product rho h from upstream, and the change in time is rate (rho h) + past. Where the
 * film is dry (cavitated) p = 0 replaces the balance, which then must not gain mass.
 */
#ifndef FF_EHL_REYNOLDS_H
#define FF_EHL_REYNOLDS_H

#include "fluid.h"
#include "grid.h"

/* What the contact prescribes for one solve. */
typedef struct ff_step {
    double entrainment, sliding, radius;
    double load;        /* N/m; held only when `loaded` */
    int loaded;         /* 0: h00 is given and the load follows */
    double rate;        /* 1/s, 0: steady */
    const double *past; /* kg/(m2 s), nodes; NULL: steady */
} ff_step;

/* The unknowns. v is the deflection of p. */
typedef struct ff_film {
    double *p, *v;
    double h00;
    unsigned char *wet; /* 1: the balance holds, 0: cavitated */
} ff_film;

enum { FF_STENCIL = 4 }; /* nodes i-2 ... i+1 */

typedef struct ff_reynolds {
    size_t nodes, last; /* laws hold up to node `last`; behind it p = 0 */
    double dx, floor;   /* floor: the thinnest film of the mobility, m */
    int wedge;          /* order of the upwind wedge: 1 or 2 */
    ff_laws laws;
    ff_oil oil;
    ff_liquid liquid;
    double *memory;
    double *half_square;                         /* x^2/2 */
    double *h, *thick;                           /* thick: h, not below the floor */
    double *mass;                                /* rho h */
    double *f, *f_p, *f_h;                       /* mobility and its derivatives */
    double *mean, *mean_left, *mean_right;       /* mobility of a face and its derivatives by f */
    double *flux;                                /* through the face between i and i+1 */
    double *residual;                            /* kg/(m s) */
    double *by_p[FF_STENCIL], *by_h[FF_STENCIL]; /* of the residual; 0 in dry rows */
    ff_status law_status;
} ff_reynolds;

ff_status ff_reynolds_create(ff_reynolds *r, const ff_grid *g, const ff_laws *laws,
                             const ff_oil *oil, int wedge);
void ff_reynolds_destroy(ff_reynolds *r);

/* h and rho h of the film. */
void ff_reynolds_gap(ff_reynolds *r, double radius, const ff_film *film);
void ff_reynolds_mass(ff_reynolds *r, const ff_film *film);

/* h, liquid, flux and residual. */
void ff_reynolds_evaluate(ff_reynolds *r, const ff_step *step, const ff_film *film);

/* by_p and by_h at what was evaluated last. */
void ff_reynolds_slopes(ff_reynolds *r, const ff_step *step, const ff_film *film);

/* sum of p over the nodes times dx: load per width, N/m */
double ff_film_load(const ff_film *film, size_t nodes, double dx);

#endif
