/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * The 95 % intervals hold what they say: of 200 noisy sets of data from a known law, those whose
 * interval covers the truth are counted for each parameter. With a true probability of 0.95 fewer
 * than 180 or more than 198 of 200 come by chance in 0.2 % of all tries.
 */
#include "check.h"
#include "fitting.h"

#include <math.h>
#include <stdio.h>

enum { SETS = 200, POINTS = 21, FOUND = 4, LEAST = 180, MOST = 198 };

typedef struct known {
    const char *id;
    const char *truth[12]; /* as a user writes them */
    const char *found[FOUND];
    double values[FOUND]; /* the same in SI */
    const char *hold[4];
    double noise;
} known;

static const known cases[] = {
    {"viscosity/barus",
     {"eta0", "0.005 Pa s", "alpha", "11 1/GPa"},
     {"eta0", "alpha"},
     {5e-3, 11e-9},
     {NULL},
     0.05},
    {"viscosity/roelands",
     {"eta0", "0.02261 Pa s", "z", "0.4857"},
     {"eta0", "z"},
     {22.61e-3, 0.4857},
     {NULL},
     0.02},
    {"viscosity/two-slope",
     {"eta0", "0.005 Pa s", "alpha_1", "12 1/GPa", "alpha_2", "7 1/GPa", "p_transition",
      "0.37 GPa"},
     {"eta0", "alpha_1", "alpha_2", "p_transition"},
     {5e-3, 12e-9, 7e-9, 0.37e9},
     {NULL},
     0.02},
    {"viscosity/doolittle-tait",
     {"eta0", "0.005006 Pa s", "B", "3.7303", "V_occ", "0.6132", "K0", "1.05 GPa", "K0_prime",
      "10.076"},
     {"eta0", "B", "K0", "K0_prime"},
     {5.006e-3, 3.7303, 1.05e9, 10.076},
     {"V_occ=0.6132"},
     0.02},
};

static void try_case(const known *c)
{
    double p[POINTS], ln_eta[POINTS], eta[POINTS];
    int covered[FOUND] = {0}, fitted = 0;
    uint64_t state = 1;
    fitting f = {.id = c->id};
    for (int i = 0; c->hold[i]; i++)
        f.hold[i] = c->hold[i];
    for (int i = 0; i < POINTS; i++)
        p[i] = 1e9 * i / (POINTS - 1);
    fitting_truth(c->id, c->truth, POINTS, p, ln_eta);
    for (int k = 0; k < SETS; k++) {
        for (int i = 0; i < POINTS; i++)
            eta[i] = exp(ln_eta[i] + c->noise * fitting_normal(&state));
        fitted += fitting_run(&f, &(points){.n = POINTS, .p = p, .eta = eta});
        for (int j = 0; j < FOUND && c->found[j]; j++) {
            const fit_param *param = fitting_param(&f, c->found[j]);
            covered[j] += param->low <= c->values[j] && c->values[j] <= param->high;
        }
    }
    printf("%s, noise %g\n", c->id, c->noise);
    check_true("  every set is fitted", fitted == SETS);
    for (int j = 0; j < FOUND && c->found[j]; j++) {
        printf("  %s: %d of %d\n", c->found[j], covered[j], SETS);
        check_true("  as many as chance allows", covered[j] >= LEAST && covered[j] <= MOST);
    }
    fitting_close(&f);
}

static void checks(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        try_case(&cases[i]);
}

int main(void)
{
    return fitting_test(checks);
}
