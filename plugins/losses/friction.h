/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares the friction of the film with formulas fitted to measured losses of gears. */
#ifndef LOSSES_FRICTION_H
#define LOSSES_FRICTION_H

#include "mesh-inputs.h"

/* In the order of LOSSES_FORMULAS. */
enum { LOSSES_SCHLENK, LOSSES_ISO_15144 };
#define LOSSES_FORMULAS "schlenk|iso-15144"

typedef struct losses_formula {
    double film;         /* mean coefficient of the film, weighted by its loss */
    double coefficient;  /* by the formula; NaN: oil or roughness is not known */
    double loss_factor;  /* H_v: loss over power for a coefficient of 1 */
    double pitch_speed;  /* m/s */
    double roughness;    /* Ra, mean of both flanks, m; 0: not known */
    double oil_factor;   /* X_L */
    bool oil_is_guessed; /* X_L of a mineral oil is assumed, since the base oil is not known */
} losses_formula;

/* Returns int |tau| |u_s| over int w |u_s|: the loss over the loss at a coefficient of 1. */
double losses_friction_mean(const losses_mesh *m);

/* Evaluates a formula. `oil_factor` NaN: by the base oil. */
losses_formula losses_formula_of(const losses_mesh *m, int32_t formula, double oil_factor);

/* Reports whether the gears are in the range of the loss factor. */
void losses_report_factor(const ff_host *host, const losses_mesh *m);

/* Reports the verdicts on friction; `wanted`: the formula itself was requested. */
void losses_report_friction(const ff_host *host, const losses_mesh *m, const losses_formula *f,
                            bool wanted);

#endif
