/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of rough flanks. A node with pressure is in one of two states. It is full and its balance
 * of mass holds; or its asperities touch, h is the contact film, and they carry its pressure:
 * min(F, c (h - contact film)) = 0. F is the mass that the cell loses, and c the derivative of F by
 * h for oil that is only carried along. In contact F >= 0: without contact the film would fall
 * further. This is the reduced Reynolds equation (Hu & Zhu 2000; Li & Kahraman 2011) with contact
 * as a complementarity. The oil between asperities in contact is what the balance leaves, less than
 * the contact film holds, and the lack travels on with it. If it were filled up, a node downstream
 * would be neither in contact nor apart, and rounding would decide the asperities' load. */
#ifndef EHL_ASPERITIES_H
#define EHL_ASPERITIES_H

#include "reynolds.h"

/* Gives each node with pressure the equation with the smaller residual, as last evaluated, and puts
 * cavitated nodes closer than the contact film in contact. 1: some nodes changed. */
int ehl_contact_choose(const ehl_reynolds *r, const ehl_step *step, ehl_film *film);

/* Replaces the balance by c (h - contact film) at the nodes in contact, after the derivatives. */
void ehl_contact_rows(ehl_reynolds *r, const ehl_step *step, const ehl_film *film);

/* Sets `mass` after a time step at the nodes in contact: the oil that the balance leaves there, at
 * most what the contact film holds. */
void ehl_contact_mass(ehl_reynolds *r, const ehl_step *step, const ehl_film *film, double *mass);

/* Statistical flanks, after the derivatives: adds the derivative of p_a by h to by_h, since the
 * derivatives are by p_f, and gives a cavitated node p = p_a(h) in place of p = 0. */
void ehl_statistical_rows(ehl_reynolds *r, const ehl_film *film);

/* Yield of rough flanks: no pressure exceeds the hardness H. Where p reaches H, the metal yields
 * (elastic, perfectly plastic), and the gap gains a plastic part: h = h00 + x^2/(2 R) + v - R1 - R2
 * + plastic, 0 <= plastic, p <= H, plastic (H - p) = 0 (dry contacts: Almqvist et al. 2007, Tribol.
 * Int. 40). The balance of mass and the contact of asperities hold at such a node as at others,
 * with the plastic part as the unknown instead of p. The plastic part belongs to the instant: where
 * p falls below H the gap is elastic again, and no dent stays on a flank. */

/* Makes a given film admissible: p above H becomes H, and a plastic part where p is below H becomes
 * 0. 1: p has changed. */
int ehl_yield_begin(const ehl_reynolds *r, ehl_film *film);

/* Sets by_p of the nodes that yield: derivatives by the plastic part, in units of give. */
void ehl_yield_columns(ehl_reynolds *r, const ehl_film *film);

/* Adds `share` of the step to the plastic parts. */
void ehl_yield_step(const ehl_reynolds *r, ehl_film *film, double share, const double *step);

/* Lets nodes with p > H yield and ends the yielding of nodes with a negative plastic part. Returns
 * the largest pressure that was cut off, or plastic part, in its unit; the change of p is added to
 * `change`. */
double ehl_yield_turn(const ehl_reynolds *r, ehl_film *film, double *change);

/* Returns the load per width on the nodes that yield. */
double ehl_yield_load(const ehl_reynolds *r, const ehl_film *film);

/* Scales the pressures below H to the remaining load; `change` is the change of them. 0: the load
 * error is too large for that. */
int ehl_yield_balance(const ehl_reynolds *r, ehl_film *film, double load, double *change);

#endif
