/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the models of a line contact without gears share: the elastic moduli as parameters, the wire
   of the viscosity, and the literature. */
#ifndef CONTACT_LINE_CONTACT_H
#define CONTACT_LINE_CONTACT_H

#include <flankfilm/author.h>

/* The elastic moduli, a member `moduli` of the instance, and their parameters. */
typedef struct contact_moduli {
    double reduced;            /* Pa; NaN where `elastic` is given */
    ff_reals elastic, poisson; /* Pa, 1; one value or two, or none */
} contact_moduli;

#define CONTACT_MODULI_ROWS(type)                                                                  \
    FF_QUANTITY("reduced_modulus", "GPa", type, moduli.reduced, 0, "226.4 GPa", "modulus", 1e-6,   \
                1e6, 0, 0, "E' of 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2"),                        \
        FF_LIST("elastic_modulus", "GPa", type, moduli.elastic, 0, NULL, "modulus", 1e-6, 1e6, 0,  \
                0, 1, 2, "Young's moduli E1 and E2, in place of reduced_modulus"),                 \
        FF_LIST("poisson_ratio", "1", type, moduli.poisson, 0, NULL, NULL, 0, 0.5, 0, 0, 1, 2,     \
                "Poisson's ratios, together with elastic_modulus; left out: 0.3")

/* E' of these parameters, Pa; a Poisson's ratio without elastic moduli is refused. */
ff_status contact_reduced_modulus(const ff_host *host, const contact_moduli *moduli,
                                  double *reduced);

/* The viscosity, and what the oil gives. */
enum { CONTACT_LINE_VISCOSITY, CONTACT_LINE_OIL, CONTACT_LINE_INPUTS = CONTACT_LINE_OIL + 2 };
extern const ff_port contact_line_inputs[CONTACT_LINE_INPUTS];
extern const char contact_line_reference[];

#endif
