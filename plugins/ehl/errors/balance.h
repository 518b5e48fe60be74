/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks what a film must satisfy, by sums that are independent of the solver. They share with it
 * only the laws of the oil, the pressure and the gap that a run gives, and the history as it was
 * handed in. The kernel, the mobilities, the volumes and the changes in time are computed anew
 * (docs/theory.md, 12). */
#ifndef EHL_BALANCE_H
#define EHL_BALANCE_H

#include "../equations/march.h"

/* The largest imbalances of all instants that were checked. */
typedef struct ehl_imbalance {
    double conditions;  /* radius, speeds and load of the film against those of the contact */
    double load;        /* integral of p against the load of the contact */
    double rescaling;   /* of the pressure, the last of each solution */
    double gap;         /* h against the flanks' shape and a deflection by direct sum, over h */
    double mass;        /* imbalance of the volumes, over the mass that passes them */
    double cavitated;   /* oil that a cell without pressure gains, or holds too much of */
    double energy;      /* imbalance of the energy of the pressure flow */
    double dissipation; /* power_loss by flows against work on h; it falls with the cells */
    double moment;      /* work of the entrainment against that by the moment of the pressure */
    double history;     /* oil that came and went since it entered, against what is there */
    double outputs;     /* outputs of the run against the same from the fields */
} ehl_imbalance;

/* The oil between two nodes over the history. */
typedef struct ehl_content {
    int known;               /* 0: no earlier instant is known */
    int mirrored;            /* the nodes ran against x */
    double time, mass, gain; /* kg/m, kg/(m s) of that instant */
    double off;              /* kg/m that came, minus what is there, of the last passage */
} ehl_content;

typedef struct ehl_balance {
    size_t nodes, row; /* row of the history at or before the last instant */
    double *memory;
    double *kernel; /* deflection by a pressure on the cell k nodes away, k from 1 - nodes on */
    double *rho, *ln_eta, *psi;
    double *volume;  /* int dp/rho, J/kg */
    double *mass[3]; /* of the three newest films */
    double *change;  /* of the mass, in time */
    double *face;    /* pressure flow between node i and i + 1 */
    double *left;    /* mass that volume i gains */
    ehl_content content;
    double load;        /* N/m, load that the pressure of the last instant carries */
    double moment, arm; /* N: sums of x p and |x p| over the nodes, of the last instant */
    double unbalanced;  /* W/m, imbalance of the energy of the last instant by other sums */
    ehl_imbalance worst;
} ehl_balance;

ff_status ehl_balance_create(ehl_balance *b, const ehl_march *m);
void ehl_balance_destroy(ehl_balance *b);

/* Checks the newest film of the march against its equations; the reynolds must have its gap. If
 * `wholly`, all checks are made, else only the cheap ones. Returns the error of its mass. */
double ehl_balance_hold(ehl_balance *b, const ehl_march *m, int wholly);

/* Two of these checks: the moment of the pressure, and the gap. */
void ehl_balance_moment(ehl_balance *b, const ehl_march *m);
void ehl_balance_gap(ehl_balance *b, const ehl_march *m);

/* Checks the row of outputs against the fields, after ehl_balance_hold with `wholly`; `boundary` is
 * the friction of the asperities. */
void ehl_balance_outputs(ehl_balance *b, const ehl_march *m, const double *row, uint64_t wanted,
                         double boundary);

#endif
