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
#ifndef EHL_CONTACT_H
#define EHL_CONTACT_H

#include "reynolds.h"

/* Gives each node with pressure the equation whose residual, as evaluated last, is the less, and
   puts cavitated ones in contact that are closer than the contact film. 1: some changed. */
int ehl_contact_choose(const ehl_reynolds *r, const ehl_step *step, ehl_film *film);

/* Puts c (h - contact film) in place of the balance at the nodes in contact, after the slopes. */
void ehl_contact_rows(ehl_reynolds *r, const ehl_step *step, const ehl_film *film);

/* mass = the oil that the balance leaves at the nodes in contact, up to what the contact film
   holds, after a step in time. */
void ehl_contact_mass(ehl_reynolds *r, const ehl_step *step, const ehl_film *film, double *mass);

#endif
