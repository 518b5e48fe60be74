/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The film-forming pressure coefficient against closed forms of 1/int eta0/eta dp. */
#include "check.h"
#include "line.h"

#include <math.h>
#include <stdio.h>

static const double eta0 = 5e-3;

static double alpha_star(const char *film, const char *law, const char *const set[][2])
{
    line c;
    line_open(&c, film);
    line_oil(&c, law, eta0, 0);
    for (size_t i = 0; set[i][0]; i++)
        stage_set_text(c.oil, set[i][0], set[i][1]);
    check_true("runs", line_run(&c, "alpha_star") == FF_OK);
    double value = stage_scalar(c.film, "alpha_star");
    line_close(&c);
    return value;
}

/* Where the exponent of Roelands is 1/2, u = (1 + p/p0)^(1/2) gives int = 2 p0 (1/L + 1/L^2). */
static double roelands_half(double p0)
{
    double L = log(eta0) + 9.67;
    return 1 / (2 * p0 * (1 / L + 1 / (L * L)));
}

static void all_laws(const char *film)
{
    const double first = 12e-9, second = 7e-9, transition = 0.17e9;
    double left = exp(-first * transition);
    printf("%s\n", film);
    check_near("Barus, exact",
               alpha_star(film, "viscosity/barus",
                          (const char *const[][2]){{"alpha", "15 1/GPa"}, {NULL, NULL}}),
               15e-9, 1e-12);
    check_near("two slopes",
               alpha_star(film, "viscosity/two-slope",
                          (const char *const[][2]){{"alpha_1", "12 1/GPa"},
                                                   {"alpha_2", "7 1/GPa"},
                                                   {"p_transition", "0.17 GPa"},
                                                   {NULL, NULL}}),
               1 / ((1 - left) / first + left / second), 1e-5); /* a kink within a step */
    check_near(
        "Roelands, z = 1",
        alpha_star(film, "viscosity/roelands", (const char *const[][2]){{"z", "1"}, {NULL, NULL}}),
        (log(eta0) + 9.67) / 196e6, 1e-9);
    check_near("Roelands, z = 1/2",
               alpha_star(film, "viscosity/roelands",
                          (const char *const[][2]){
                              {"z", "0.5"}, {"pressure_cap", "90 GPa"}, {NULL, NULL}}),
               roelands_half(196e6), 1e-6);
    check_near("Barus that rises by 10 at 100 GPa, too little for a film-forming one",
               alpha_star(film, "viscosity/barus",
                          (const char *const[][2]){{"alpha", "0.1 1/GPa"}, {NULL, NULL}}),
               0, 0);
    check_near("isoviscous",
               alpha_star(film, "viscosity/isoviscous", (const char *const[][2]){{NULL, NULL}}), 0,
               0);
}

int main(void)
{
    all_laws("ehl/film-formula");
    all_laws("ehl/finite-volume");
    return check_done();
}
