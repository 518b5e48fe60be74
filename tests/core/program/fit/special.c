/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Exact data, weights, parameters that cannot be told apart, limits, data that are none. */
#include "check.h"
#include "fitting.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { POINTS = 15 };

static double p[POINTS], ln_eta[POINTS], eta[POINTS];

static const char *const tait[] = {"eta0", "0.005006 Pa s", "B",        "3.7303", "V_occ", "0.6132",
                                   "K0",   "1.05 GPa",      "K0_prime", "10.076", NULL};
static const char *const roelands[] = {"eta0", "0.02261 Pa s", "z", "0.4857", NULL};

static void make(const char *id, const char *const *truth)
{
    for (int i = 0; i < POINTS; i++)
        p[i] = 1e9 * i / (POINTS - 1);
    fitting_truth(id, truth, POINTS, p, ln_eta);
    for (int i = 0; i < POINTS; i++)
        eta[i] = exp(ln_eta[i]);
}

static const points all = {.n = POINTS, .p = p, .eta = eta};

static void run(fitting *f, const points *data)
{
    check_true("the law is fitted", fitting_run(f, data));
}

/* Derivatives by differences leave some 1e-8. */
static void check_exact(void)
{
    fitting f = {.id = "viscosity/roelands"};
    make(f.id, roelands);
    run(&f, &all);
    check_near("z of exact data", fitting_param(&f, "z")->value, 0.4857, 1e-7);
    check_near("eta0 of exact data", fitting_param(&f, "eta0")->value, 0.02261, 1e-7);
    check_below("rms of exact data", f.law->rms, 1e-7);
    check_near("the cap is the highest pressure", fitting_param(&f, "pressure_cap")->value, 1e9,
               1e-12);
    fitting_close(&f);
}

/* B, V_occ, K0 and K0_prime give three shapes: whatever one is held, the law is the same. */
static void check_blind(void)
{
    fitting f = {.id = "viscosity/doolittle-tait"};
    make(f.id, tait);
    run(&f, &all);
    check_true("one parameter is held",
               f.law->free_count == 4 && fitting_param(&f, "V_occ")->found == FIT_HELD);
    check_true("and the note says so", strstr(f.law->note, "V_occ is fixed at") != NULL);
    check_below("the law is that of the data all the same", f.law->rms, 1e-6);
    fitting_close(&f);
}

/* The closed form of a line: Barus with weights. Intervals of alpha against those of the weighted
   regression, t = 2.1604 for 13 degrees of freedom. */
static void check_line(void)
{
    double weight[POINTS], W = 0, P = 0, Y = 0, PP = 0, PY = 0, S = 0;
    uint64_t state = 7;
    fitting f = {.id = "viscosity/barus"};
    make("viscosity/barus", (const char *const[]){"eta0", "0.005 Pa s", "alpha", "11 1/GPa", NULL});
    for (int i = 0; i < POINTS; i++) {
        weight[i] = 1 + i % 4;
        ln_eta[i] += 0.1 * fitting_normal(&state) / sqrt(weight[i]);
        eta[i] = exp(ln_eta[i]);
        W += weight[i];
        P += weight[i] * p[i];
        Y += weight[i] * ln_eta[i];
    }
    for (int i = 0; i < POINTS; i++) {
        PP += weight[i] * (p[i] - P / W) * (p[i] - P / W);
        PY += weight[i] * (p[i] - P / W) * (ln_eta[i] - Y / W);
    }
    double alpha = PY / PP;
    for (int i = 0; i < POINTS; i++) {
        double r = ln_eta[i] - Y / W - alpha * (p[i] - P / W);
        S += weight[i] * r * r;
    }
    double half = 2.160369 * sqrt(S / 13 / PP);
    run(&f, &(points){.n = POINTS, .p = p, .eta = eta, .weight = weight});
    const fit_param *param = fitting_param(&f, "alpha");
    check_near("alpha by the closed form", param->value, alpha, 1e-7);
    check_near("its interval", log(param->high / param->low), 2 * half / alpha, 1e-5);
    fitting_close(&f);
}

/* Roelands with a p0 that is far too high wants an exponent beyond 2. */
static void check_limit(void)
{
    fitting f = {.id = "viscosity/roelands", .hold = {"p0=3000 MPa"}};
    make(f.id, roelands);
    run(&f, &all);
    check_true("z is at its limit", fitting_param(&f, "z")->found == FIT_AT_LIMIT);
    check_near("which is", fitting_param(&f, "z")->value, 2, 1e-9);
    check_true("and the note says so", strstr(f.law->note, "z is at its limit, 2") != NULL);
    check_true("and that the form is wrong", strstr(f.law->note, "another form") != NULL);
    fitting_close(&f);
}

/* Barus' straight line for oil that bends. */
static void check_form(void)
{
    fitting barus = {.id = "viscosity/barus"}, own = {.id = "viscosity/roelands"};
    make("viscosity/roelands", roelands);
    uint64_t state = 3;
    for (int i = 0; i < POINTS; i++)
        eta[i] *= exp(0.01 * fitting_normal(&state));
    run(&barus, &all);
    run(&own, &all);
    check_true("a law of the wrong form is told", strstr(barus.law->note, "another form") != NULL);
    check_true("one of the right form is not", strstr(own.law->note, "another form") == NULL);
    check_true("the criterion tells them apart", own.law->criterion + 20 < barus.law->criterion);
    fitting_close(&barus);
    fitting_close(&own);
}

/* The unit of the data is of no account: all of it in 1 % steps of one relative error. */
static void check_uncertainty(void)
{
    double stated[POINTS];
    uint64_t state = 5;
    fitting f = {.id = "viscosity/roelands"}, g = {.id = "viscosity/roelands"};
    make(f.id, roelands);
    for (int i = 0; i < POINTS; i++) {
        stated[i] = 0.002;
        eta[i] *= exp(0.02 * fitting_normal(&state));
    }
    run(&f, &all);
    run(&g, &(points){.n = POINTS, .p = p, .eta = eta, .uncertainty = stated});
    check_near("equal uncertainties change nothing", fitting_param(&g, "z")->value,
               fitting_param(&f, "z")->value, 1e-9);
    check_true("those that are too small are told",
               strstr(g.law->note, "times the stated uncertainty") != NULL);
    fitting_close(&f);
    fitting_close(&g);
}

static void check_refused(const char *what, const points *data, const char *part)
{
    fitting f = {.id = "viscosity/roelands"};
    check_true(what, !fitting_run(&f, data) && fitting_says(&f, part));
    fitting_close(&f);
}

static void check_no_data(void)
{
    double other[POINTS], T[POINTS];
    make("viscosity/roelands", roelands);
    check_refused("two points", &(points){.n = 2, .p = p, .eta = eta}, "at least");
    for (int i = 0; i < POINTS; i++)
        other[i] = 1e8;
    check_refused("one pressure", &(points){.n = POINTS, .p = other, .eta = eta},
                  "all rows have the pressure 0.1 GPa");
    for (int i = 0; i < POINTS; i++)
        other[i] = 0.1;
    check_refused("one viscosity", &(points){.n = POINTS, .p = p, .eta = other}, "no rise to fit");
    for (int i = 0; i < POINTS; i++)
        other[i] = 1 / eta[i];
    check_refused("a fall", &(points){.n = POINTS, .p = p, .eta = other}, "falls with pressure");
    for (int i = 0; i < POINTS; i++)
        T[i] = 300 + 10 * (i % 2);
    check_refused("two temperatures", &(points){.n = POINTS, .p = p, .eta = eta, .T = T},
                  "does not depend on temperature");
    memcpy(other, p, sizeof other);
    other[7] = other[6];
    eta[7] = eta[6];
    check_refused("a row twice", &(points){.n = POINTS, .p = other, .eta = eta},
                  "repeats row 7 of the table");
}

static void checks(void)
{
    check_exact();
    check_blind();
    check_line();
    check_limit();
    check_form();
    check_uncertainty();
    check_no_data();
}

int main(void)
{
    return fitting_test(checks);
}
