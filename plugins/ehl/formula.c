/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "formula.h"

#include <math.h>

typedef struct power_law {
    double factor, G, U, W;
} power_law;

static double law(power_law c, ehl_contact_numbers n)
{
    return c.factor * pow(n.G, c.G) * pow(n.U, c.U) * pow(n.W, c.W);
}

/* Dowson & Higginson 1977, Elasto-hydrodynamic Lubrication, from Dowson 1968, Proc. IMechE 182
   3A: least film; Dowson & Toyoda 1978, Proc. 5th Leeds-Lyon Symp.: central film; Pan & Hamrock
   1989, J. Tribol. 111: both. */
static const power_law dowson_higginson = {2.65, 0.54, 0.7, -0.13};
static const power_law dowson_toyoda = {3.06, 0.56, 0.69, -0.10};
static const power_law pan_hamrock_least = {1.714, 0.568, 0.694, -0.128};
static const power_law pan_hamrock_central = {2.922, 0.470, 0.692, -0.166};

/* M = W (2U)^-1/2, L = G (2U)^1/4, H = (h/R)(2U)^-1/2 (Moes 2000, Lubrication and beyond). */
static double moes(ehl_contact_numbers n)
{
    double M = n.W / sqrt(2 * n.U), L = fmax(n.G * pow(2 * n.U, 0.25), 1e-6);
    double ri = 3 / M, ei = 2.621 * pow(M, -0.2);
    double rp = 1.287 * pow(L, 2. / 3), ep = 1.311 * pow(M, -0.125) * pow(L, 0.75);
    double s = (7 + 8 * exp(-2 * ei / ri)) / 5;
    double iso = pow(pow(ri, 7. / 3) + pow(ei, 7. / 3), 3 * s / 7);
    double piezo = pow(pow(rp, -3.5) + pow(ep, -3.5), -2 * s / 7);
    return sqrt(2 * n.U) * pow(iso + piezo, 1 / s);
}

ehl_film_numbers ehl_film_formula(int formula, ehl_contact_numbers n)
{
    switch (formula) {
    case EHL_DOWSON_HIGGINSON:
        return (ehl_film_numbers){law(dowson_higginson, n), law(dowson_toyoda, n)};
    case EHL_DOWSON_TOYODA:
        return (ehl_film_numbers){0, law(dowson_toyoda, n)};
    case EHL_PAN_HAMROCK:
        return (ehl_film_numbers){law(pan_hamrock_least, n), law(pan_hamrock_central, n)};
    default:
        return (ehl_film_numbers){0, moes(n)};
    }
}
