/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of rough flanks. A node with pressure is in one of two states. Either it is full, and its
   balance of mass holds; or its asperities touch, h is the contact film, and the asperities carry
   its pressure: min(F, c (h - contact film)) = 0. F is the mass that the cell loses, and c the
   derivative of F with respect to h for oil that moves with the flanks. In contact F >= 0: without
   contact the film would become thinner. This is the reduced Reynolds equation (Hu & Zhu 2000; Li &
   Kahraman 2011) with contact as a complementarity. A node in contact contains only the oil that
   the balance of mass leaves there, which is less than the contact film. This deficit is
   transported with the oil. If the deficit were filled up, a node downstream could be neither in
   contact nor separated, and round-off would decide the load of the asperities. */
#ifndef EHL_ASPERITIES_H
#define EHL_ASPERITIES_H

#include "reynolds.h"

/* Chooses for each node with pressure the equation with the smaller residual, as last evaluated.
   Puts cavitated nodes closer than the contact film in contact. Returns 1 if some nodes changed. */
int ehl_contact_choose(const ehl_reynolds *r, const ehl_step *step, ehl_film *film);

/* Replaces the balance by c (h - contact film) at the nodes in contact, after the derivatives. */
void ehl_contact_rows(ehl_reynolds *r, const ehl_step *step, const ehl_film *film);

/* Sets `mass` at the nodes in contact after a time step: the oil that the balance of mass leaves
   there, at most the mass of the contact film. */
void ehl_contact_mass(ehl_reynolds *r, const ehl_step *step, const ehl_film *film, double *mass);

/* Statistical flanks, after the derivatives: adds the derivative of p_a with respect to h to by_h,
   since the derivatives are with respect to p_f. For a cavitated node the equation is p = p_a(h)
   instead of p = 0. */
void ehl_statistical_rows(ehl_reynolds *r, const ehl_film *film);

/* Yield of rough flanks: no pressure exceeds the hardness H. Where p reaches H, the metal yields
   (elastic, perfectly plastic), and the gap gains a plastic part: h = h00 + x^2/(2 R) + v - R1 - R2
   + plastic, 0 <= plastic, p <= H, plastic (H - p) = 0 (dry contacts: Almqvist et al. 2007, Tribol.
   Int. 40). The equations of a node that yields are those of other nodes, but its unknown is the
   plastic part instead of p. The plastic part belongs to the instant: where p falls below H the gap
   is elastic again, and no dent stays on a flank. */

/* Makes a given film admissible: p above H becomes H, and a plastic part where p is below H becomes
   0. Returns 1 if p has changed. */
int ehl_yield_begin(const ehl_reynolds *r, ehl_film *film);

/* Sets by_p of the nodes that yield to the derivatives with respect to the plastic part, in units
   of `give`. */
void ehl_yield_columns(ehl_reynolds *r, const ehl_film *film);

/* Adds `share` of the step to the plastic parts. */
void ehl_yield_step(const ehl_reynolds *r, ehl_film *film, double share, const double *step);

/* Lets nodes with p > H yield, and ends the yielding of nodes with a negative plastic part. Returns
   the larger of the largest pressure that was cut off and the largest negative plastic part, in
   pressure units. The change of p is added to `change`. */
double ehl_yield_turn(const ehl_reynolds *r, ehl_film *film, double *change);

/* Returns the load per width on the nodes that yield. */
double ehl_yield_load(const ehl_reynolds *r, const ehl_film *film);

/* Scales the pressures below H to the remaining load. Stores the change of the pressures in
   `change`. Returns 0 if the load error is too large for scaling. */
int ehl_yield_balance(const ehl_reynolds *r, ehl_film *film, double load, double *change);

#endif
