/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The mesh spring behind the dead zone, at a phase: a convex force of g = s - e, the greatest of
 * straight lines slope g - offset whose slopes rise and whose first goes through g = 0. Where one
 * line takes over from another is a knee; the band of a deflection is the number of its line.
 *
 * Frozen at the mean force F a spring has two lines. A small vibration sees the slope k = dF/d(e_l)
 * of the mesh, which is steeper than the chord F/(e_l - e): with e_t = e_l - F/k the force is
 *
 *   k (s - e_t) = k g - offset,   offset = k (e_t - e) = k (e_l - e) - F >= 0,
 *
 * down to half the mean force. Below it the force follows the chord from there to the unloaded e,
 * so that flight begins and ends there (theory, eq. 4.3a). Without a loaded transmission error
 * beside k, or where k is the chord, the force is k g without lines.
 *
 * Shared, it has a line for each of the forces that the stiffness knows: the tangent of G(phase, s)
 * there (theory, eq. 4.3b). Two tangents meet where a further pair touches, however that moves with
 * the phase. Without the slopes the lines are the chords between the forces.
 */
#ifndef DYNAMICS_SPRING_H
#define DYNAMICS_SPRING_H

#include "excitation.h"

/* By how much the force of a line exceeds that of the line before, at a deflection g >= 0. */
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

/* Whether a line takes over where another ends. */
static inline int dynamics_spring_bends(const dynamics_piece *p)
{
    return p->lines > 1;
}

/* The band of a deflection; below 0 on the other flank. */
static inline int dynamics_spring_band(const dynamics_piece *p, double since, double bend)
{
    int band = 0;
    while (band + 1 < p->lines &&
           dynamics_spring_excess(p, band + 1, since, bend < 0 ? -bend : bend) > 0)
        band++;
    return bend < 0 ? -band : band;
}

/* The coefficients of the slope of the force in a band, and of the offset, which has the sign of
   the band. */
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

/* The force on the flank; its energy, which is the integral of the force over the deflection; and
   the rate of the energy at a fixed deflection in mesh cycles of duration T, less that of
   dynamics_spring_knee_energy. */
typedef struct dynamics_spring {
    double force, energy, energy_rate;
} dynamics_spring;

dynamics_spring dynamics_spring_at(const dynamics_piece *piece, double since, double T, double bend,
                                   int band);
/* What the energy in a band is above slope g^2/2 - offset g: the sum of
   (change of offset)^2/(2 (change of slope)) over the knees below it. It changes with the phase
   alone. */
double dynamics_spring_knee_energy(const dynamics_piece *piece, double since, int band);
double dynamics_spring_force(const dynamics_piece *piece, double since, double bend);

/* What a stiffness knows of other mesh forces than the mean, N, m, N/m: rows over the phases and
   over the stations of the path of contact. count 0: nothing. */
typedef struct dynamics_force_levels {
    size_t count, phases, stations;
    const double *force;       /* rising from 0 */
    const double *error;       /* transmission error under each; NULL: not known */
    const double *stiffness;   /* slope dF/d(error); NULL: not known */
    const double *tooth_force; /* of one pair at each station; NULL: not known */
} dynamics_force_levels;

/* What the curves of a stiffness make of the spring at their nodes, in SI: k, and the lines of a
   spring that bends. */
typedef struct dynamics_spring_nodes {
    size_t count, lines; /* lines 0: the spring does not bend */
    double *stiffness;   /* NULL: as the curves have it */
    double *rows;        /* slopes of each line, then its offsets */
    double steeper;      /* mean of k over the chord F/(e_l - e), less 1 */
    double soft;    /* share of the nodes where k is below that chord, which then stands for it;
                       of the nodes at all levels where the slope is below the chord before */
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

/* Of the loaded transmission error, m (NULL: none), under the mean force, N; `on_chord`: k is the
   chord F/(e_l - e) and the spring does not bend. 0: out of memory. */
int dynamics_spring_nodes_make(const dynamics_mesh_curves *curves, const double *loaded,
                               double force, int on_chord, dynamics_spring_nodes *nodes);
/* The numbers of the levels that stay when `every` is 2: of every second one, the mean, the least
   and the largest. Returns how many. */
size_t dynamics_spring_levels(const dynamics_force_levels *levels, double force, int every,
                              size_t taken[DYNAMICS_LINES]);
/* The lines of the mesh force at all forces of `levels`, which has errors, or at those of
   dynamics_spring_levels. `convex`: by how much the levels are not convex, over the mean
   force. 0: out of memory. */
int dynamics_spring_nodes_share(const dynamics_force_levels *levels, double force, int every,
                                dynamics_spring_nodes *nodes, double *convex);
void dynamics_spring_nodes_free(dynamics_spring_nodes *nodes);

#endif
