/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mesh spring in series with the dead zone, at a phase: a convex piecewise linear force over
   the deflection g = s - e. It is the largest of several straight lines, slope g - offset. The
   slopes increase from line to line, and the first line passes through g = 0. A knee is the
   intersection of two consecutive lines. The band of a deflection is the index of the line that
   gives its force. The spring of `force: frozen` is made for the mean force F and has two lines.
   For small vibrations the slope of the mesh is k = dF/d(e_l), which is steeper than the chord
   F/(e_l - e). Above F/2 the force is k g - offset, with offset = k (e_l - e) - F
   >= 0. Below F/2 the force is the straight line through 0 at g = 0 and through F/2, so that
   contact is lost at s = e (theory, eq. 4.3a). If there is no loaded transmission error, or if k is
   the chord, the spring has no lines and its force is k g. The spring of `force: shared`, the
   shared spring, has a line for each force level of the stiffness: the tangent of the mesh force
   G(phase, s) at the level (theory, eq. 4.3b). Two tangents intersect where a further pair comes
   into contact, even if the force at which this happens varies with the phase. If no slopes are
   given, the lines are the chords between the levels. */
#ifndef DYNAMICS_SPRING_H
#define DYNAMICS_SPRING_H

#include "excitation.h"

/* Returns the force of a line minus the force of the previous line at a deflection g >= 0. */
static inline double dynamics_spring_excess(const dynamics_piece *p, int line, double since,
                                            double g)
{
    const dynamics_line *above = &p->line[line], *below = above - 1;
    double steeper = dynamics_piece_value(above->slope, p->degree, since) -
                     dynamics_piece_value(below->slope, p->degree, since);
    double offset = dynamics_piece_value(above->offset, p->degree, since) -
                    dynamics_piece_value(below->offset, p->degree, since);
    return steeper * g - offset;
}

/* Returns whether the spring has a knee. */
static inline int dynamics_spring_bends(const dynamics_piece *p)
{
    return p->lines > 1;
}

/* Returns the band of a deflection; it is negative on the back flank. */
static inline int dynamics_spring_band(const dynamics_piece *p, double since, double bend)
{
    int band = 0;
    while (band + 1 < p->lines &&
           dynamics_spring_excess(p, band + 1, since, bend < 0 ? -bend : bend) > 0)
        band++;
    return bend < 0 ? -band : band;
}

/* Return the coefficients of slope and offset of the line that belongs to a band, as polynomials in
   the phase. The force is slope * bend - dynamics_spring_sign(band) * offset. */
static inline const double *dynamics_spring_slope(const dynamics_piece *p, int band)
{
    return p->lines ? p->line[band < 0 ? -band : band].slope : p->k;
}

static inline const double *dynamics_spring_offset(const dynamics_piece *p, int band)
{
    return p->line[band < 0 ? -band : band].offset;
}

static inline int dynamics_spring_sign(int band)
{
    return (band > 0) - (band < 0);
}

/* The force on the flank, its energy (integral of the force over the deflection), and the rate of
   the energy at constant deflection for mesh cycles of duration T. The rate excludes that of
   dynamics_spring_knee_energy. */
typedef struct dynamics_spring {
    double force, energy, energy_rate;
} dynamics_spring;

dynamics_spring dynamics_spring_at(const dynamics_piece *piece, double since, double T, double bend,
                                   int band);
/* Returns the difference between the energy in a band and slope g^2/2 - offset g: the sum of
   (change of offset)^2/(2 (change of slope)) over the knees below the band. It depends only on the
   phase. */
double dynamics_spring_knee_energy(const dynamics_piece *piece, double since, int band);
double dynamics_spring_force(const dynamics_piece *piece, double since, double bend);

/* Values of a stiffness at mesh forces other than the mean, in N, m and N/m. Each level has a row
   over the phases, or over the stations of the path of contact. count 0: none are given. */
typedef struct dynamics_force_levels {
    size_t count, phases, stations;
    const double *force;       /* increasing from 0 */
    const double *error;       /* transmission error under each force; NULL: not known */
    const double *stiffness;   /* slope dF/d(error); NULL: not known */
    const double *tooth_force; /* tooth force of one pair at each station; NULL: not known */
} dynamics_force_levels;

/* The spring at the nodes of the stiffness curves, in SI units: k, and the lines of the piecewise
   linear force. */
typedef struct dynamics_spring_nodes {
    size_t count, lines; /* lines 0: the spring is linear */
    double *stiffness;   /* NULL: the stiffness of the curves */
    double *rows;        /* slopes of each line, then its offsets */
    double steeper;      /* mean over the nodes of k divided by the chord F/(e_l - e), minus 1 */
    /* share of the nodes where k is below this chord and is replaced by it; for a
       shared spring, share of the nodes and levels where the slope is below the chord to the
       previous level */
    double soft;
    double unknown; /* share of the nodes where e_l does not exceed e */
} dynamics_spring_nodes;

typedef struct dynamics_spring_row {
    double *slope, *offset;
} dynamics_spring_row;

static inline dynamics_spring_row dynamics_spring_row_of(const dynamics_spring_nodes *nodes,
                                                         size_t line)
{
    double *slope = nodes->rows + 2 * line * nodes->count;
    return (dynamics_spring_row){slope, slope + nodes->count};
}

/* Makes the spring from the loaded transmission error (m; NULL: none) at the mean force (N).
   `on_chord`: k is the chord F/(e_l - e), and the spring is linear. Returns 0 if out of memory. */
int dynamics_spring_nodes_make(const dynamics_mesh_curves *curves, const double *loaded,
                               double force, int on_chord, dynamics_spring_nodes *nodes);
/* Selects every `every`-th level, counted from the level of the mean force, and the smallest and
   the largest level. Returns the number of selected levels. */
size_t dynamics_spring_levels(const dynamics_force_levels *levels, double force, int every,
                              size_t taken[DYNAMICS_LINES]);
/* Makes the lines of a shared spring from the levels selected by dynamics_spring_levels.
   levels->error must not be NULL. Sets `convex` to the largest deviation from a convex curve,
   relative to the mean force. Returns 0 if out of memory. */
int dynamics_spring_nodes_share(const dynamics_force_levels *levels, double force, int every,
                                dynamics_spring_nodes *nodes, double *convex);
void dynamics_spring_nodes_free(dynamics_spring_nodes *nodes);

#endif
