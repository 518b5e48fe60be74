/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The heated channel: a parallel film in which conduction to walls at one temperature alone takes
 * the heat of shear away, with the viscosity eta exp(-beta (T - T_wall)). Across it, y = z/h - 1/2
 * and theta = beta (T - T_wall), the equations are
 *
 *   theta'' = -(a + b y)^2 exp(theta),   theta(-1/2) = theta(1/2) = 0,
 *   int y (a + b y) exp(theta) dy = sqrt(F),   int (a + b y) exp(theta) dy = sqrt(S),
 *   F = eta beta U^2/k,   S = eta beta u_s^2/k,   R = b/(12 sqrt(F)),
 *
 * with the stress sqrt(beta h^2/(eta k)) tau = a + b y and the mean speed U by which the flow
 * departs from u_r h. R is the pressure gradient over that of the isothermal film with the same
 * flow. Held are the flow and the speeds, for which there is one solution; for a gradient and a
 * stress there may be two or none.
 */
#ifndef EHL_CHANNEL_H
#define EHL_CHANNEL_H

/* The table of R: rows and columns in equal steps of ln(1 + F) and ln(1 + S), up to 9900. */
enum { EHL_HEAT_TABLE = 93 };
#define EHL_HEAT_STEP 0.1

/* Number of intervals across the film. */
enum { EHL_CHANNEL_CELLS = 128, EHL_CHANNEL_NODES = EHL_CHANNEL_CELLS + 1 };

/* A solution, from which the next one starts. All 0: the cold channel, F = S = 0. */
typedef struct ehl_channel {
    double theta[EHL_CHANNEL_NODES], a, b;
} ehl_channel;

/* Solves by Newton's method with Numerov's difference formula and Simpson's rule, both of fourth
 * order. F > 0. Returns R, or NaN if it does not converge because F and S are too far from those of
 * *c. */
double ehl_channel_solve(ehl_channel *c, double F, double S);

#endif
