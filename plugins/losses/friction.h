/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares the friction of the film with formulas that were fitted to measured losses of gears. */
#ifndef LOSSES_FRICTION_H
#define LOSSES_FRICTION_H

#include "mesh-inputs.h"

/* Ranks of the words in LOSSES_FORMULAS. */
enum { LOSSES_SCHLENK, LOSSES_ISO_15144 };
#define LOSSES_FORMULAS "schlenk|iso-15144"

typedef struct losses_formula {
    double film;         /* mean coefficient of the film, weighted by load and sliding speed */
    double coefficient;  /* by the formula; NaN: oil or roughness unknown */
    double loss_factor;  /* H_v: loss over transmitted power at a friction coefficient of 1 */
    double pitch_speed;  /* at the pitch line, m/s */
    double roughness;    /* Ra, mean of both flanks, m; 0: unknown */
    double oil_factor;   /* X_L */
    bool oil_is_guessed; /* X_L is that of a mineral oil, since the base oil is unknown */
} losses_formula;

/* Returns the mean friction coefficient int |tau| |u_s| / int w |u_s|, with the friction force per
   width tau and the load per width w. */
double losses_friction_mean(const losses_mesh *m);

/* Evaluates a formula. If `oil_factor` is NaN, it follows from the base oil. */
losses_formula losses_formula_of(const losses_mesh *m, int32_t formula, double oil_factor);

/* Reports whether the contact ratio is in the range of the loss factor. */
void losses_report_factor(const ff_host *host, const losses_mesh *m);

/* Reports the verdicts on friction. `wanted`: the formula itself was requested. */
void losses_report_friction(const ff_host *host, const losses_mesh *m, const losses_formula *f,
                            bool wanted);

#endif
