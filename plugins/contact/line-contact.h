/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the models of a line contact without gears share: the elastic moduli as parameters, the wire
   of the viscosity, and the literature. */
#ifndef CONTACT_LINE_CONTACT_H
#define CONTACT_LINE_CONTACT_H

#include <flankfilm/plugin.h>

#include <stdbool.h>

/* A parameter of one value for both surfaces or of one for each. */
typedef struct contact_value {
    double value[2];
    bool given;
} contact_value;

void contact_value_set(contact_value *to, const ff_param *row, const ff_value *value);

/* The rows of the moduli, which stand in this order. */
enum { CONTACT_REDUCED, CONTACT_ELASTIC, CONTACT_POISSON, CONTACT_MODULI };
#define CONTACT_REDUCED_MODULUS_ROW                                                                \
    {                                                                                              \
        .name = "reduced_modulus", .unit = "GPa",                                                  \
        .doc = "E' of 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2", .type = FF_REAL,                    \
        .preset = "226.4 GPa", .group = "modulus", .min = 1e-6, .max = 1e6                         \
    }
#define CONTACT_ELASTIC_MODULUS_ROW                                                                \
    {                                                                                              \
        .name = "elastic_modulus", .unit = "GPa",                                                  \
        .doc = "Young's moduli E1 and E2, in place of reduced_modulus", .type = FF_REALS,          \
        .group = "modulus", .min = 1e-6, .max = 1e6, .min_count = 1, .max_count = 2                \
    }
#define CONTACT_POISSON_RATIO_ROW                                                                  \
    {                                                                                              \
        .name = "poisson_ratio", .unit = "1",                                                      \
        .doc = "Poisson's ratios, together with elastic_modulus; left out: 0.3", .type = FF_REALS, \
        .min = 0, .max = 0.5, .min_count = 1, .max_count = 2                                       \
    }

/* E' of these parameters, Pa; a Poisson's ratio without elastic moduli is refused. */
ff_status contact_reduced_modulus(const ff_host *host, const contact_value moduli[CONTACT_MODULI],
                                  double *reduced);

extern const ff_port contact_line_inputs[1]; /* the viscosity */
extern const char contact_line_reference[], contact_line_bibtex[];

#endif
