/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The gear pair as a dimensionless oscillator with one degree of freedom (Li & Kahraman 2011, eqs
   2a and 2b): s'' + 2 zeta (s' - e') + k g(s - e) = load - drag The unit of length is `length`, the
   unit of stiffness is the mean mesh stiffness, and the unit of time is 1/omega with omega^2 = mean
   stiffness / equivalent mass. g is the dead zone of half width `half_gap`. A piecewise linear
   force (spring.h) replaces the spring force k g if k is the slope of the mesh force at the mean
   load, or if transmission errors are given at several mesh forces. k and e are polynomials between
   the nodes of a mesh cycle and may jump at the nodes. The drag force is a piecewise polynomial,
   too. It is 0 unless a film is wired back or the torque or speed fluctuates. */
#ifndef DYNAMICS_EXCITATION_H
#define DYNAMICS_EXCITATION_H

#include <stddef.h>

/* When the damper acts. */
enum {
    DYNAMICS_DAMPING_ALWAYS,  /* also in the gap (Li & Kahraman 2011) */
    DYNAMICS_DAMPING_CONTACT, /* only while the flanks touch */
    DYNAMICS_DAMPING_CLIPPED  /* only while the flanks touch, and the mesh force is clipped at 0 */
};

/* Largest degree of the polynomials of a piece, and largest number of lines of its spring. */
enum { DYNAMICS_DEGREE = 7, DYNAMICS_LINES = 32 };

/* A straight line of the spring force: slope g - offset with g = s - e. Slope and offset are
   polynomials in the phase since the start of the piece. */
typedef struct dynamics_line {
    double slope[DYNAMICS_DEGREE + 1], offset[DYNAMICS_DEGREE + 1];
} dynamics_line;

typedef struct dynamics_piece {
    double start, length; /* mesh cycles */
    int degree;           /* degree of the polynomials; 1: straight lines */
    double k[DYNAMICS_DEGREE + 1], e[DYNAMICS_DEGREE + 1];
    double drag[DYNAMICS_DEGREE + 1]; /* force of friction, rolling resistance and fluctuation */
    double film[DYNAMICS_DEGREE + 1]; /* integral of the film growth of the pairs, weighted by their
                                         load shares */
    int jump;                         /* whether k, e or the spring is discontinuous at the start */
    int lines;                        /* 0: the force is k g; else the force is the largest of these
                                         lines (spring.h) */
    dynamics_line line[DYNAMICS_LINES];
} dynamics_piece;

/* How closely the smooth pieces reproduce the straight lines of the table. */
typedef struct dynamics_representation {
    size_t lines, pieces;
    double at_nodes, between; /* largest difference of k, relative to the mean stiffness */
} dynamics_representation;

/* The pieces of one mesh cycle (tracks.h). */
typedef struct dynamics_track {
    dynamics_piece *pieces;
    size_t count;
} dynamics_track;

typedef struct dynamics_excitation {
    dynamics_piece *pieces; /* pieces of the driving flanks */
    size_t count;
    dynamics_track back, flight; /* pieces of the back flanks, and of free flight; count 0: the
                                    pieces of the driving flanks are used */
    double back_room;    /* smallest difference of e of the driving flanks minus e of the back
                            flanks */
    double flight_share; /* weight of e of the back flanks in e of free flight */
    int both_flanks;     /* whether the model uses separate curves for the back flanks */
    double k_max;        /* the largest k */
    double zeta, load, half_gap;
    int damping;
    int on_chord; /* whether k is replaced by the chord F/(e_l - e) (spring.h) */
    int shared;   /* whether the spring follows the mesh force at all loads (spring.h) */
    int drags;    /* whether the pieces have a drag, because a film is wired back or the force
                     fluctuates; all pieces then have the full degree */
    double span;  /* mesh cycles in one period of the excitation; 0: one */
    double length, stiffness, omega; /* units: length, m (the static deflection, or the range of the
                                        transmission error if that is larger); stiffness, N/m;
                                        omega, rad/s */
    dynamics_representation represented;
    const struct dynamics_film *film; /* the oil film between separated flanks; NULL: none */
} dynamics_excitation;

/* Return the value, the slope and the second derivative (`bend`) of a polynomial at the phase
   `since` the start of the piece. */
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

/* Shifts the polynomial c by the phase `since` and scales its variable: to(x) = c(since + scale
   x). */
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

/* Copies the mesh curves of piece `from` to piece `to`, which starts at the phase `since` after the
   start of `from`. */
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

/* The mesh curves of a stiffness model, in SI units. `phase` runs from 0 to 1 and repeats a value
   where a curve jumps. */
typedef struct dynamics_mesh_curves {
    size_t count;
    const double *phase, *stiffness;
    const double *error; /* NULL: none */
} dynamics_mesh_curves;

/* Builds the pieces from checked curves. The scalar members are already set. Straight lines that
   sample a smooth curve are replaced by that curve. Returns 0 if out of memory. */
int dynamics_excitation_build(dynamics_excitation *excitation, const dynamics_mesh_curves *curves);
/* Does the same with a piecewise linear spring, whose nodes are at the phases of the curves. */
struct dynamics_spring_nodes;
int dynamics_excitation_build_bent(dynamics_excitation *excitation,
                                   const dynamics_mesh_curves *curves,
                                   const struct dynamics_spring_nodes *spring);
/* Marks the pieces at whose starts k or e jumps. */
void dynamics_excitation_mark_jumps(dynamics_excitation *excitation);
void dynamics_excitation_free(dynamics_excitation *excitation);

/* Returns the piece at a phase in [0, 1]. At a node it is the piece before the node if `left`, else
   the piece after it. */
const dynamics_piece *dynamics_track_piece(dynamics_track track, double phase, int left);
const dynamics_piece *dynamics_excitation_piece(const dynamics_excitation *excitation, double phase,
                                                int left);
/* Returns the piece of the track that a motion follows at s. */
const dynamics_piece *dynamics_excitation_piece_at(const dynamics_excitation *excitation,
                                                   double phase, int left, double s);

/* Returns the deflection s - e of the driving flank under the constant load at phase 0, with
   (rest_deflection) and without (rest_bend) the half gap. */
double dynamics_rest_deflection(const dynamics_excitation *excitation);
double dynamics_rest_bend(const dynamics_excitation *excitation);

/* A motion counts as unbounded if its amplitude exceeds this cap: 1000 times the sum of half
   backlash and static deflection. The second function returns whether s - e or its rate exceeds the
   cap. */
double dynamics_amplitude_cap(const dynamics_excitation *excitation);
int dynamics_is_unbounded(const dynamics_excitation *excitation, double delta, double rate);

/* Returns the mesh force of Li & Kahraman 2011, eq. 4: the spring force behind the dead zone, plus
   2 zeta delta' while the damper acts. delta = s - e; `since` is the phase since the start of the
   piece. */
double dynamics_mesh_force(const dynamics_excitation *excitation, const dynamics_piece *piece,
                           double since, double delta, double rate);

#endif
