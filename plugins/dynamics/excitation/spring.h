/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The mesh spring about the mean force F. A small vibration sees the slope k = dF/d(e_l) of the
 * mesh, which is steeper than the chord F/(e_l - e): with e_t = e_l - F/k the force is
 *
 *   k (s - e_t) = k g - offset,   g = s - e,   offset = k (e_t - e) = k (e_l - e) - F >= 0,
 *
 * down to half the mean force, the knee. Below it the force follows the chord from the knee to the
 * unloaded e, so that flight begins and ends there (theory, eq. 4.3a). Without a loaded
 * transmission error beside k, or where k is the chord, offset is 0 and the force k g.
 */
#ifndef DYNAMICS_SPRING_H
#define DYNAMICS_SPRING_H

#include "excitation.h"

/* Forces of one flank pressed by g >= 0, without dimensions; `band` is 1 above the knee, 0 below,
   and -1 above it on the other flank where there is no gap between them. */
static inline double dynamics_spring_excess(const dynamics_piece *p, double since, double bend)
{
    double steeper = dynamics_piece_value(p->k, p->degree, since) -
                     dynamics_piece_value(p->chord, p->degree, since);
    return steeper * bend - dynamics_piece_value(p->offset, p->degree, since);
}

/* The band of a deflection. */
static inline int dynamics_spring_band(const dynamics_piece *p, double since, double bend)
{
    if (!p->bends || !(dynamics_spring_excess(p, since, bend < 0 ? -bend : bend) > 0))
        return 0;
    return bend < 0 ? -1 : 1;
}

/* The coefficients of the slope of the force in a band. */
static inline const double *dynamics_spring_slope(const dynamics_piece *p, int band)
{
    return p->bends && band == 0 ? p->chord : p->k;
}

/* The force on the flank; its energy, which is the integral of the force over the deflection; and
   the rate of the energy at a fixed deflection in mesh cycles of duration T, less that of
   dynamics_spring_knee_energy. */
typedef struct dynamics_spring {
    double force, energy, energy_rate;
} dynamics_spring;

dynamics_spring dynamics_spring_at(const dynamics_piece *piece, double since, double T, double bend,
                                   int band);
/* What the energy beyond the knee is above k g^2/2 - offset g: offset^2/(2 (k - chord)). It changes
   with the phase alone. */
double dynamics_spring_knee_energy(const dynamics_piece *piece, double since, int band);
double dynamics_spring_force(const dynamics_piece *piece, double since, double bend);

/* What the curves of a stiffness make of the spring at their nodes, in SI: k, the chord to the knee
   and the offset, or k alone. */
typedef struct dynamics_spring_nodes {
    double *stiffness;      /* NULL: as the curves have it */
    double *chord, *offset; /* NULL: the spring does not bend */
    double steeper;         /* mean of k over the chord F/(e_l - e), less 1 */
    double soft;    /* share of the nodes where k is below that chord, which then stands for it */
    double unknown; /* share of the nodes where e_l does not exceed e */
} dynamics_spring_nodes;

/* Of the loaded transmission error, m (NULL: none), under the mean force, N; `on_chord`: k is the
   chord F/(e_l - e) and the spring does not bend. 0: out of memory. */
int dynamics_spring_nodes_make(const dynamics_mesh_curves *curves, const double *loaded,
                               double force, int on_chord, dynamics_spring_nodes *nodes);
void dynamics_spring_nodes_free(dynamics_spring_nodes *nodes);

#endif
