/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shared by the models of a line contact without gears: parameters of the elastic moduli, the
 * wire of the viscosity, and literature. */
#ifndef CONTACT_LINE_CONTACT_H
#define CONTACT_LINE_CONTACT_H

#include <flankfilm/author.h>

/* The elastic moduli: the member `moduli` of the instance, and its parameter rows. */
typedef struct contact_moduli {
    double reduced;            /* Pa; NaN if `elastic` is given */
    ff_reals elastic, poisson; /* Pa, 1; one value or two, or none */
} contact_moduli;

#define CONTACT_MODULI_ROWS(type)                                                                  \
    FF_QUANTITY("reduced_modulus", "GPa", type, moduli.reduced, 0, "226.4 GPa", "modulus", 1e-6,   \
                1e6, 0, 0, "reduced modulus E': 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2"),          \
        FF_LIST("elastic_modulus", "GPa", type, moduli.elastic, 0, NULL, "modulus", 1e-6, 1e6, 0,  \
                0, 1, 2, "Young's moduli E1 and E2, instead of reduced_modulus"),                  \
        FF_LIST("poisson_ratio", "1", type, moduli.poisson, 0, NULL, NULL, 0, 0.5, 0, 0, 1, 2,     \
                "Poisson's ratios, with elastic_modulus; left out: 0.3")

/* Computes E' from these parameters, Pa. Refuses a Poisson's ratio without elastic moduli. */
ff_status contact_reduced_modulus(const ff_host *host, const contact_moduli *moduli,
                                  double *reduced);

/* Inputs: the viscosity, and two rows of the oil. */
enum { CONTACT_LINE_VISCOSITY, CONTACT_LINE_OIL, CONTACT_LINE_INPUTS = CONTACT_LINE_OIL + 2 };
extern const ff_port contact_line_inputs[CONTACT_LINE_INPUTS];
extern const char contact_line_reference[];

#endif
