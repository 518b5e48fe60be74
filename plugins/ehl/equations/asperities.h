/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Rough flanks: a node with pressure is full, and its balance of mass holds, or its asperities are
 * in contact, and h is the contact film; they then carry its pressure:
 *
 *   min(F, c (h - contact film)) = 0
 *
 * with F the mass that the cell loses and c what F changes by with h where the oil is only carried
 * along. In contact F >= 0: the film would fall further. That is the reduced Reynolds equation (Hu
 * & Zhu 2000; Li & Kahraman 2011) with the contact as complementarity. Between the asperities stays
 * the oil that the balance leaves there, less than the contact film holds; the missing part travels
 * on with it. Filled up, it would be neither in contact nor apart from it downstream, where
 * rounding would then decide what the asperities carry.
 */
#ifndef EHL_ASPERITIES_H
#define EHL_ASPERITIES_H

#include "reynolds.h"

/* Gives each node with pressure the equation whose residual, as evaluated last, is the less, and
   puts cavitated ones in contact that are closer than the contact film. 1: some changed. */
int ehl_contact_choose(const ehl_reynolds *r, const ehl_step *step, ehl_film *film);

/* Puts c (h - contact film) in place of the balance at the nodes in contact, after the slopes. */
void ehl_contact_rows(ehl_reynolds *r, const ehl_step *step, const ehl_film *film);

/* mass = the oil that the balance leaves at the nodes in contact, up to what the contact film
   holds, after a step in time. */
void ehl_contact_mass(ehl_reynolds *r, const ehl_step *step, const ehl_film *film, double *mass);

/* Statistical flanks, after the slopes: by_h takes what p_a changes by with h, since the slopes are
   by p_f; and a cavitated node has p = p_a(h) in place of p = 0. */
void ehl_statistical_rows(ehl_reynolds *r, const ehl_film *film);

/*
 * Rough flanks: no pressure exceeds the hardness H. Where it reaches it the metal yields, elastic
 * and perfectly plastic, and the gap takes a plastic part:
 *
 *   h = h00 + x^2/(2 R) + v - R1 - R2 + plastic,  0 <= plastic,  p <= H,  plastic (H - p) = 0
 *
 * (dry contacts: Almqvist et al. 2007, Tribol. Int. 40). The balance of mass and the contact of
 * asperities hold at such a node as at others, with the plastic part as the unknown in place of p.
 * The plastic part is that of the instant: where p falls below H again the gap is elastic, and no
 * dent stays on a flank.
 */

/* Takes the film as it comes: p above H becomes H, and below H there is no plastic part. 1: p has
   changed. */
int ehl_yield_begin(const ehl_reynolds *r, ehl_film *film);

/* by_p of the nodes that yield: by the plastic part, in units of give. */
void ehl_yield_columns(ehl_reynolds *r, const ehl_film *film);

/* Plastic part += share of the step. */
void ehl_yield_step(const ehl_reynolds *r, ehl_film *film, double share, const double *step);

/* Nodes with p > H yield, and those with a plastic part below 0 do no more. Returns the largest
   pressure that was cut off, or plastic part, in units; `change` gains what p changed by. */
double ehl_yield_turn(const ehl_reynolds *r, ehl_film *film, double *change);

/* Load per width on the nodes that yield. */
double ehl_yield_load(const ehl_reynolds *r, const ehl_film *film);

/* Brings the pressures below H to what is left of the load, by a factor; `change` is what they
   change by. 0: the load is further off than that. */
int ehl_yield_balance(const ehl_reynolds *r, ehl_film *film, double load, double *change);

#endif
