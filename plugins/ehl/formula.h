/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Film formulas of smooth isothermal line contacts. */
#ifndef FF_EHL_FORMULA_H
#define FF_EHL_FORMULA_H

/* U = eta0 u/(E' R) with the mean speed u, W = w/(E' R) per width, G = alpha E'. */
typedef struct ff_contact_numbers {
    double U, W, G;
} ff_contact_numbers;

enum { FF_MOES, FF_DOWSON_HIGGINSON, FF_DOWSON_TOYODA, FF_PAN_HAMROCK };

/* h_min/R and h_central/R, 0: not given. That of Moes is the flow film rho h/rho0. */
typedef struct ff_film_numbers {
    double least, central;
} ff_film_numbers;

ff_film_numbers ff_film_formula(int formula, ff_contact_numbers n);

#endif
