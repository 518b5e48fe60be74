/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The discrete Reynolds equation of a line contact, one instant in time: d/dx (f dp/dx) = u_r d(rho
   h)/dx + d(rho h)/dt, f = rho h^3 psi/12, h = h00 + x^2/(2 R) + v - R1 - R2 + plastic as balances
   of mass over a cell around each inner node. The pressure flow uses central differences, the wedge
   uses upstream values of the product rho h, and the change in time is rate (rho h) + past. Where
   the film is cavitated, p = 0 replaces the balance of mass, and the cell must not gain mass. With
   mass-conserving cavitation the balance holds there too, and a fraction theta < 1 of the gap is
   filled (Jakobsson & Floberg 1957, Olsson 1965; Elrod 1981): p (1 - theta) = 0. The mass theta rho
   h is then the unknown in place of p. */
#ifndef EHL_REYNOLDS_H
#define EHL_REYNOLDS_H

#include "../contact/grid.h"
#include "../contact/liquid.h"
#include "statistical.h"

/* Quantities that the contact prescribes for one solution. */
typedef struct ehl_step {
    double entrainment, sliding, radius;
    double load;        /* N/m; the film must carry it if `loaded` is 1 */
    int loaded;         /* 0: h00 is given, and the load follows from h00 */
    double feed, ahead; /* pressure at the start of the domain, Pa, and load carried by the oil
                           in front of it, N/m */
    double rate;        /* 1/s, 0: steady */
    const double *past; /* kg/(m2 s), at the nodes; NULL: steady */
    int follows;        /* whether `past` was transported with the oil; there is no wedge then */
} ehl_step;

/* The unknowns. v is the deflection of p. */
typedef struct ehl_film {
    double *p, *v;
    double h00;
    double ahead;        /* N/m that the oil in front of the domain carries */
    unsigned char *full; /* 1: full, 0: cavitated */
    double *content;     /* theta rho h where cavitated, kg/m2; used when mass is conserved */
    double *plastic;     /* plastic part of the gap, m, where p equals the hardness; NULL: flanks
                            stay elastic */
    size_t yielding;     /* number of nodes where p equals the hardness */
    unsigned char *asperity; /* 1: asperities touch, h = contact film, and the node is full; for
                                rough flanks only */
} ehl_film;

enum { EHL_STENCIL = 4 }; /* nodes i-2 ... i+1 */

typedef struct ehl_reynolds {
    size_t nodes, last; /* the equations hold up to node `last`; p = 0 beyond this node */
    double dx, floor;   /* floor: smallest film thickness in the mobility, m */
    double first;       /* x of the first node, m */
    int wedge;          /* order of the upwind wedge: 1 or 2 */
    int conserving;     /* whether mass is conserved where the film is cavitated */
    int asymmetric;     /* whether the volumes lie on one side of their node; see
                           ehl_asymmetric_balance */
    double unit;        /* unit of an unknown mass, kg/m2 per Pa, so that its numbers have the
                           magnitude of pressures */
    const double
        *rough;      /* R1 + R2 at the nodes, m; NULL: smooth flanks, without asperity contact */
    double contact;  /* contact film, m; also the smallest film thickness in the
                        mobility */
    double leak;     /* 1/m2; the side flow out of the film is f leak p; 0: none */
    double hardness; /* highest pressure, Pa, if the film has a plastic part */
    ehl_statistical statistical; /* statistical asperities of smooth flanks */
    double give; /* unit of an unknown plastic part, m per Pa, so that its numbers have the
                    magnitude of pressures */
    ehl_laws laws;
    ehl_oil oil;
    const double *ease;  /* fluidity psi of the heated film over that of the laws; NULL: 1 */
    const double *swell; /* mean density of the heated film over that of the laws; NULL: 1 */
    const double *carry; /* mass that the flanks transport, over u_r rho h; NULL: 1 */
    ehl_liquid liquid;
    double *memory;
    double *half_square;         /* x^2/2 */
    double *h, *thick;           /* thick: h, but at least the floor */
    double *fluid, *p_a, *p_a_h; /* for statistical flanks, at the gap that was computed last */
    double *spare_p_a, *spare_p_a_h;
    int touching;                          /* 1: p_a is above 0 somewhere */
    double *mass;                          /* rho h */
    double *carried;                       /* `carry` times `mass`, if `carry` is given */
    double *f, *f_p, *f_h;                 /* mobility and its derivatives */
    double *mean, *mean_left, *mean_right; /* mobility of a face and its derivatives with respect
                                              to f */
    double *pinch_left, *pinch_right;      /* derivatives of `mean` with respect to h where the
                                              gap changes abruptly */
    double *flux;                          /* through the face between i and i+1 */
    double *residual;                      /* kg/(m s) */
    double *by_p[EHL_STENCIL],
        *by_h[EHL_STENCIL]; /* derivatives of the residual; 0 in rows of cavitated nodes */
    ff_status law_status;
} ehl_reynolds;

ff_status ehl_reynolds_create(ehl_reynolds *r, const ehl_grid *g, const ehl_laws *laws,
                              const ehl_oil *oil, int wedge);
void ehl_reynolds_destroy(ehl_reynolds *r);

/* Moves the nodes so that the first node is at x. */
void ehl_reynolds_place(ehl_reynolds *r, double x);

/* Computes h and rho h of the film. */
void ehl_reynolds_gap(ehl_reynolds *r, double radius, const ehl_film *film);
void ehl_reynolds_mass(ehl_reynolds *r, const ehl_film *film);

/* Computes h, liquid, flux and residual. */
void ehl_reynolds_evaluate(ehl_reynolds *r, const ehl_step *step, const ehl_film *film);

/* Does the same if only film->full and film->asperity have changed since the last evaluation. */
void ehl_reynolds_turned(ehl_reynolds *r, const ehl_step *step, const ehl_film *film);

/* Returns the pressure of the oil. With statistical flanks the pressure of the asperities is
   subtracted, at the gap that was computed last. */
static inline const double *ehl_fluid(const ehl_reynolds *r, const ehl_film *film)
{
    return r->statistical.law ? r->fluid : film->p;
}

/* Returns the pressure of the oil of another film, whose gap is h. `room` is an array of one value
   per node. */
const double *ehl_fluid_of(const ehl_reynolds *r, const ehl_film *film, const double *h,
                           double *room);

/* Returns 1 if node i has an equation for its pressure or its mass. */
static inline int ehl_is_solved(const ehl_reynolds *r, const ehl_film *film, size_t i)
{
    return film->full[i] || r->conserving || r->statistical.law;
}

/* Returns 1 if node i is cavitated and its mass is unknown. */
static inline int ehl_is_cavitated(const ehl_reynolds *r, const ehl_film *film, size_t i)
{
    return r->conserving && !film->full[i] && i > 0 && i + 1 < r->nodes;
}

/* Returns 1 if the metal yields at node i and the plastic part of its gap is unknown. */
static inline int ehl_yields(const ehl_reynolds *r, const ehl_film *film, size_t i)
{
    return film->yielding > 0 && film->p[i] >= r->hardness;
}

/* Returns 1 if the pressure of node i is unknown and deflects the flanks. */
static inline int ehl_carries(const ehl_reynolds *r, const ehl_film *film, size_t i)
{
    return (film->full[i] || r->statistical.law) && !ehl_yields(r, film, i);
}

/* Sets the weights of the wedge at the face downstream of node i > 0: near rho h(i) + far rho
   h(i-1) for u = 1. The value at the face is extrapolated from the two nodes upstream of the face.
   Downstream of a cavitated node, where the film begins sharply, the value of the nearest node
   upstream is used. The weights must not depend on the state of node i; otherwise node i could be
   neither full nor cavitated. */
static inline void ehl_upwind(const ehl_reynolds *r, const ehl_film *film, size_t i, double *near,
                              double *far)
{
    int second = r->wedge == 2 && !ehl_is_cavitated(r, film, i - 1);
    *near = second ? 1.5 : 1;
    *far = second ? -0.5 : 0;
}

/* Computes by_p and by_h at the film that was evaluated last. by_p of a cavitated node is the
   derivative with respect to its mass, in multiples of `unit`. */
void ehl_reynolds_slopes(ehl_reynolds *r, const ehl_step *step, const ehl_film *film);

/* Returns the load per width, N/m: the sum of p over the nodes times dx, plus the load carried by
   the oil in front of the domain. */
double ehl_film_load(const ehl_film *film, size_t nodes, double dx);

/* Balances of mass over volumes on one side of their node: from the node upstream to the node
   itself, instead of volumes around the nodes: q(i) - q(i-1) - u (m(i) - m(i-1)) - int dm/dt dx =
   0, q = f dp/dx, m = rho h. The faces are nodes, where rho h is known: the wedge needs no
   interpolation. Where the film is so thin that the pressure flow vanishes, only transport at the
   speed u remains; the scheme for it is free of oscillations, and exact in a steady film. The
   change in time is integrated over the volume by the trapezoidal rule; with mass-conserving
   cavitation it is taken at the node, so that the squeeze is of first order there. The pressure
   flow Q(i) is known between nodes i and i+1; from it follows the flow at the face: first order:
   q(i) = Q(i), the gradient on one side of the face; second order: q(i) = 3/2 Q(i) - 1/2 Q(i+1).
   For p ~ exp(i k x) and constant f the pressure flow is -4 f sin^2(k/2) (3/2 - exp(i k)/2)/dx and
   the wedge -u (1 - exp(-i k)) dm/dp: their real parts have the same sign for every k. Every wave
   of a steady film is therefore damped, whether pressure flow or wedge dominates. The transport of
   a changing film is not damped: with time steps far below dx/u, waves of a few nodes run ahead of
   a breakpoint of the load. Sources: Li & Kahraman 2009 name asymmetric integrated control volumes
   in their title, and build on the unified approach of Zhu & Hu 2001, one system of equations for
   all film thicknesses. The side of the volumes, the trapezoidal rule and both forms of q(i) are
   inferred. At first order, the storage of a volume is taken at its node, and the equations equal
   those of ehl/finite-volume with its first-order wedge. */

/* Offset of the first column of the stencil: the stencil of row i consists of the nodes i - 1 ... i
   + 2. */
enum { EHL_ASYMMETRIC_BEFORE = 1 };

/* Computes flux and residual from the mobilities and masses of ehl_reynolds_evaluate. */
void ehl_asymmetric_balance(ehl_reynolds *r, const ehl_step *step, const ehl_film *film);

/* Computes by_p and by_h of that residual. by_p of a cavitated node is the derivative with respect
   to its mass, in multiples of `unit`. */
void ehl_asymmetric_slopes(ehl_reynolds *r, const ehl_step *step, const ehl_film *film);

#endif
