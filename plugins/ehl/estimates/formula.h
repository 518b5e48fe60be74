/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Film formulas of smooth isothermal line contacts. */
#ifndef EHL_FORMULA_H
#define EHL_FORMULA_H

/* U = eta0 u/(E' R) with the mean speed u, W = w/(E' R) per width, G = alpha E'. */
typedef struct ehl_contact_numbers {
    double U, W, G;
} ehl_contact_numbers;

enum { EHL_MOES, EHL_DOWSON_HIGGINSON, EHL_DOWSON_TOYODA, EHL_PAN_HAMROCK };

/* h_min/R and h_central/R; 0: not given by the formula. Moes' formula gives rho h/rho0 instead of
   h. */
typedef struct ehl_film_numbers {
    double least, central;
} ehl_film_numbers;

ehl_film_numbers ehl_film_formula(int formula, ehl_contact_numbers n);

#endif
