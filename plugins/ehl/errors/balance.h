/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks what a film must satisfy, with sums that are independent of the solver. Shared with the
   solver are only the laws of the oil, the pressure and the gap of the run, and the given history.
   The kernel, the mobilities, the volumes and the changes in time are computed independently
   (docs/theory.md, 12). */
#ifndef EHL_BALANCE_H
#define EHL_BALANCE_H

#include "../equations/march.h"

/* The largest imbalances of all checked instants. */
typedef struct ehl_imbalance {
    double conditions;  /* radius, speeds and load of the film against those of the contact */
    double load;        /* integral of p against the load of the contact */
    double rescaling;   /* scaling factor of the pressure at the end of each solution */
    double gap;         /* h minus the flanks' shape and a deflection by direct summation, over h */
    double mass;        /* imbalance of the volumes, over the mass that flows through them */
    double cavitated;   /* oil that a cell without pressure gains, or that exceeds its gap */
    double energy;      /* imbalance of the energy of the pressure flow */
    double dissipation; /* power_loss from flows minus work on h; it decreases with the cell size */
    double moment;      /* work of the entrainment minus its value from the moment of the
                           pressure */
    double history;     /* inflow minus outflow minus change of the stored oil */
    double outputs;     /* outputs of the run minus the same quantities from the fields */
} ehl_imbalance;

/* The oil between two nodes over the history. */
typedef struct ehl_content {
    int known;               /* whether an earlier instant is known */
    int mirrored;            /* whether the nodes were numbered against x */
    double time, mass, gain; /* kg/m and kg/(m s) at that instant */
    double off;              /* inflow minus stored oil over the last passage, kg/m */
} ehl_content;

typedef struct ehl_balance {
    size_t nodes, row; /* last row of the history at or before the last instant */
    double *memory;
    double *kernel; /* deflection by a pressure on the cell k nodes away, for k from 1 - nodes on */
    double *rho, *ln_eta, *psi;
    double *volume;  /* int dp/rho, J/kg */
    double *mass[3]; /* masses of the three newest films */
    double *change;  /* change of the mass in time */
    double *face;    /* pressure flow between node i and i + 1 */
    double *left;    /* mass that volume i gains */
    ehl_content content;
    double load;        /* load that the pressure of the last instant carries, N/m */
    double moment, arm; /* sums of x p and |x p| over the nodes at the last instant, N */
    double unbalanced;  /* imbalance of the energy at the last instant, from independent sums,
                           W/m */
    ehl_imbalance worst;
} ehl_balance;

ff_status ehl_balance_create(ehl_balance *b, const ehl_march *m);
void ehl_balance_destroy(ehl_balance *b);

/* Checks the newest film of the march against its equations. The reynolds must contain its gap. If
   `wholly`, all checks are made, otherwise only the cheap ones. Returns the error of its mass. */
double ehl_balance_hold(ehl_balance *b, const ehl_march *m, int wholly);

/* Two of these checks: the moment of the pressure, and the gap. */
void ehl_balance_moment(ehl_balance *b, const ehl_march *m);
void ehl_balance_gap(ehl_balance *b, const ehl_march *m);

/* Checks the row of outputs against the fields, after ehl_balance_hold with `wholly`. `boundary` is
   the friction coefficient of the asperities. */
void ehl_balance_outputs(ehl_balance *b, const ehl_march *m, const double *row, uint64_t wanted,
                         double boundary);

#endif
