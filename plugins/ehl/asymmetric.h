/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Balances of mass over volumes that lie on one side of their node, from the node upstream to the
 * node itself, in place of those around the nodes (reynolds.h):
 *
 *   q(i) - q(i-1) - u (m(i) - m(i-1)) - int dm/dt dx = 0,   q = f dp/dx,  m = rho h.
 *
 * The faces are nodes, where rho h is known: the wedge needs no interpolation. Where the film is so
 * thin that no pressure flow is left, what remains is transport at the speed u, without
 * oscillations and, in a steady film, without an error. The change in time is integrated over the
 * volume by the trapezoidal rule; with mass-conserving cavitation it is taken at the node, so that
 * the squeeze is of first order there. The pressure flow is known between the nodes, Q(i) between i
 * and i+1, and taken to the face
 *
 *   first order: q(i) = Q(i), the gradient on one side of the face;
 *   second order: q(i) = 3/2 Q(i) - 1/2 Q(i+1).
 *
 * For p ~ exp(i k x) and constant f the pressure flow is -4 f sin^2(k/2) (3/2 - exp(i k)/2)/dx and
 * the wedge -u (1 - exp(-i k)) dm/dp: their real parts have one sign for every k, so that no wave
 * of a steady film is left to itself, whichever of the two prevails. The transport of a film that
 * changes is undamped: in steps far below dx/u, waves of a few nodes run ahead of a breakpoint of
 * the load.
 *
 * That the volumes are integrated and asymmetric is in the title of Li & Kahraman 2009, and that
 * one system holds from the thickest to the thinnest film is the unified approach of Zhu & Hu 2001
 * that they build on. Which side, the trapezoidal rule and both forms of q(i) are inferred. With
 * the first order the volume's storage is taken at its node, and the equations are those of
 * ehl/finite-volume with its first-order wedge.
 */
#ifndef EHL_ASYMMETRIC_H
#define EHL_ASYMMETRIC_H

#include "reynolds.h"

/* Node of row i that the first of the stencil's columns stands for: i - 1 ... i + 2. */
enum { EHL_ASYMMETRIC_BEFORE = 1 };

/* flux and residual from the mobilities and masses of ehl_reynolds_evaluate. */
void ehl_asymmetric_balance(ehl_reynolds *r, const ehl_step *step, const ehl_film *film);

/* Computes by_p and by_h of that residual; the by_p of a cavitated node is by its mass, in
   multiples of `unit`. */
void ehl_asymmetric_slopes(ehl_reynolds *r, const ehl_step *step, const ehl_film *film);

#endif
