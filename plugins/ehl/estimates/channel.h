/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The heated channel: a parallel film with the viscosity eta exp(-beta (T - T_wall)). The heat of
   shear leaves only by conduction to walls of equal temperature. With y = z/h - 1/2 across the film
   and theta = beta (T - T_wall), the equations are theta'' = -(a + b y)^2 exp(theta), theta(-1/2) =
   theta(1/2) = 0, int y (a + b y) exp(theta) dy = sqrt(F), int (a + b y) exp(theta) dy = sqrt(S), F
   = eta beta U^2/k, S = eta beta u_s^2/k, R = b/(12 sqrt(F)). Here sqrt(beta h^2/(eta k)) tau = a +
   b y is the dimensionless stress, u_s the sliding speed, and U the difference between the mean
   speed of the flow and u_r. R is the pressure gradient over that of the isothermal film with the
   same flow. Flow and speeds are given, since there is exactly one solution for them. For a given
   gradient and stress there may be two solutions or none. */
#ifndef EHL_CHANNEL_H
#define EHL_CHANNEL_H

/* The table of R: rows and columns in equal steps of ln(1 + F) and ln(1 + S), up to 9900. */
enum { EHL_HEAT_TABLE = 93 };
#define EHL_HEAT_STEP 0.1

/* Number of intervals across the film. */
enum { EHL_CHANNEL_CELLS = 128, EHL_CHANNEL_NODES = EHL_CHANNEL_CELLS + 1 };

/* A solution, used as the start of the next solution. All members 0: the channel without heat, F =
   S = 0. */
typedef struct ehl_channel {
    double theta[EHL_CHANNEL_NODES], a, b;
} ehl_channel;

/* Solves by Newton's method with Numerov's difference formula and Simpson's rule, both of fourth
 * order. F > 0. Returns R, or NaN if it does not converge because F and S are too far from those of
 * *c. */
double ehl_channel_solve(ehl_channel *c, double F, double S);

#endif
