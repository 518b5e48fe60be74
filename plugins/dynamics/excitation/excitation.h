/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The gear pair as an oscillator with one degree of freedom (Li & Kahraman 2011, eqs 2a and 2b),
 * without dimensions:
 *
 *   s'' + 2 zeta (s' - e') + k g(s - e) = load - drag
 *
 * in the unit of length `length`, the mean mesh stiffness and the unit of time 1/omega, omega^2 =
 * mean stiffness / equivalent mass. g is the dead zone of half width `half_gap`. Where k is the
 * slope of the mesh at the mean load, or the mesh force is known at several loads, the force behind
 * the dead zone bends, as spring.h has it. k and e are polynomials between the nodes of a mesh
 * cycle and may jump there; so is drag, which is 0 without a film that gives its friction back.
 */
#ifndef DYNAMICS_EXCITATION_H
#define DYNAMICS_EXCITATION_H

#include <stddef.h>

/* When the damper acts. */
enum {
    DYNAMICS_DAMPING_ALWAYS,  /* in the gap too, as Li & Kahraman 2011 */
    DYNAMICS_DAMPING_CONTACT, /* only while the flanks touch */
    DYNAMICS_DAMPING_CLIPPED  /* only while they touch, and they never pull */
};

/* A stretch of the mesh cycle between nodes: the coefficients of k and e in powers of the phase
   since its start. */
enum { DYNAMICS_DEGREE = 7, DYNAMICS_LINES = 32 };

/* A straight line of the force over g = s - e: slope g - offset. */
typedef struct dynamics_line {
    double slope[DYNAMICS_DEGREE + 1], offset[DYNAMICS_DEGREE + 1];
} dynamics_line;

typedef struct dynamics_piece {
    double start, length; /* mesh cycles */
    int degree;           /* 1: straight lines */
    double k[DYNAMICS_DEGREE + 1], e[DYNAMICS_DEGREE + 1];
    double drag[DYNAMICS_DEGREE + 1]; /* of friction and rolling */
    double
        film[DYNAMICS_DEGREE + 1]; /* growth of the pairs' films, each by its share of the load */
    int jump;                      /* k, e or the spring is discontinuous at the start */
    int lines;                     /* 0: the force is k g; else the greatest of these (spring.h) */
    dynamics_line line[DYNAMICS_LINES];
} dynamics_piece;

/* What the smooth pieces make of the straight lines of a table. */
typedef struct dynamics_representation {
    size_t lines, pieces;
    double at_nodes, between; /* largest difference of k, over the mean stiffness */
} dynamics_representation;

typedef struct dynamics_excitation {
    dynamics_piece *pieces;
    size_t count;
    double k_max; /* the largest k */
    double zeta, load, half_gap;
    int damping;
    int on_chord; /* whether k is to be the chord where the stiffness is the slope (spring.h) */
    int shared;   /* whether the spring follows the mesh force at all loads (spring.h) */
    int drags;   /* whether pieces have a drag: of a film that is wired back, with its thickness, or
                    of a force that swings; all then have the full degree */
    double span; /* mesh cycles in one cycle of the pieces; 0: one */
    double length, stiffness, omega; /* units: m, N/m, rad/s */
    dynamics_representation represented;
    const struct dynamics_film *film; /* the oil between parted flanks; NULL: none */
} dynamics_excitation;

/* A polynomial of a piece and its derivatives by the phase. */
static inline double dynamics_piece_value(const double *c, int degree, double since)
{
    double value = c[degree];
    for (int i = degree - 1; i >= 0; i--)
        value = c[i] + value * since;
    return value;
}

static inline double dynamics_piece_slope(const double *c, int degree, double since)
{
    double value = degree * c[degree];
    for (int i = degree - 1; i >= 1; i--)
        value = i * c[i] + value * since;
    return value;
}

/* The coefficients in powers of the time since a phase, which is that since the start: c moved by
   `since` and scaled. */
static inline void dynamics_piece_shift(const double *c, int degree, double since, double scale,
                                        double *to)
{
    for (int i = 0; i <= degree; i++)
        to[i] = c[i];
    for (int i = 0; i < degree; i++)
        for (int j = degree - 1; j >= i; j--)
            to[j] += since * to[j + 1];
    double power = 1;
    for (int i = 0; i <= degree; i++, power *= scale)
        to[i] *= power;
}

/* Sets the curves of the mesh in a piece that begins `since` behind the start of `from`. */
static inline void dynamics_piece_start_later(const dynamics_piece *from, double since,
                                              dynamics_piece *to)
{
    dynamics_piece_shift(from->k, from->degree, since, 1, to->k);
    dynamics_piece_shift(from->e, from->degree, since, 1, to->e);
    to->lines = from->lines;
    for (int i = 0; i < from->lines; i++) {
        dynamics_piece_shift(from->line[i].slope, from->degree, since, 1, to->line[i].slope);
        dynamics_piece_shift(from->line[i].offset, from->degree, since, 1, to->line[i].offset);
    }
}

static inline double dynamics_piece_bend(const double *c, int degree, double since)
{
    double value = 0;
    for (int i = degree; i >= 2; i--)
        value = i * (i - 1) * c[i] + value * since;
    return value;
}

/* The excitation in SI as a stiffness model gives it; `phase` runs from 0 to 1, twice at a jump. */
typedef struct dynamics_mesh_curves {
    size_t count;
    const double *phase, *stiffness;
    const double *error; /* NULL: none */
} dynamics_mesh_curves;

/* Builds the pieces from checked curves; the scalars are set. Where the lines of a table follow a
   smooth curve, the curve is taken. 0: out of memory. */
int dynamics_excitation_build(dynamics_excitation *excitation, const dynamics_mesh_curves *curves);
/* The same with a spring that bends, of nodes at the phases of the curves. */
struct dynamics_spring_nodes;
int dynamics_excitation_build_bent(dynamics_excitation *excitation,
                                   const dynamics_mesh_curves *curves,
                                   const struct dynamics_spring_nodes *spring);
/* Marks the pieces at whose starts k or e jumps. */
void dynamics_excitation_mark_jumps(dynamics_excitation *excitation);
void dynamics_excitation_free(dynamics_excitation *excitation);

/* The piece at a phase in [0, 1]; at a node that before it (`left`) or that behind it. */
const dynamics_piece *dynamics_excitation_piece(const dynamics_excitation *excitation, double phase,
                                                int left);

/* Deflection s - e under the load alone, on the driving flank, at the spring of phase 0; and that
   of the spring alone, without the half gap. */
double dynamics_rest_deflection(const dynamics_excitation *excitation);
double dynamics_rest_bend(const dynamics_excitation *excitation);

/* The amplitude from which a motion counts as unbounded: 1000 times half backlash and
   static deflection; and whether s - e or its rate has reached it. */
double dynamics_amplitude_cap(const dynamics_excitation *excitation);
int dynamics_is_unbounded(const dynamics_excitation *excitation, double delta, double rate);

/* The mesh force of Li & Kahraman 2011, eq. 4: that of the spring behind the dead zone and
   2 zeta delta', while the damper acts; delta = s - e. `since`: phase since the start of the piece.
 */
double dynamics_mesh_force(const dynamics_excitation *excitation, const dynamics_piece *piece,
                           double since, double delta, double rate);

#endif
