/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares surface/statistical with its formula, computed here. */
#include "check.h"
#include "difference.h"
#include "stage.h"

#include <flankfilm/laws.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static double pressure(const void *law, double h)
{
    const ff_asperity *a = law;
    double p = 0;
    a->pressure(a->self, 1, &h, &p, NULL);
    return p;
}

static void check_law(stage *s, double K, double sigma)
{
    const ff_asperity *a = stage_service(s, FF_ASPERITY_ID);
    check_near("sigma", a->sigma, sigma, 1e-12);
    for (double H = -0.5; H < 3.9; H += 0.4) {
        double h = H * sigma, p, slope;
        ff_status status = a->pressure(a->self, 1, &h, &p, &slope);
        check_near("p_a", p, K * a->modulus / 2 * 4.4086e-5 * pow(4 - H, 6.804), 1e-9);
        check_near("dp_a/dh", slope, difference(pressure, a, h, 2e-3 * sigma), 1e-6);
        check_true("below H = 0 it is extrapolated", (status == FF_DOMAIN) == (H < 0));
    }
    const double apart[] = {4 * sigma, 1, INFINITY}, deep[] = {-1e300};
    double p[3], slope[3];
    a->pressure(a->self, 3, apart, p, slope);
    for (int i = 0; i < 3; i++)
        check_true("none beyond 4 sigma", fabs(p[i]) + fabs(slope[i]) <= 0);
    a->pressure(a->self, 1, deep, p, slope);
    check_true("finite", isfinite(p[0]) && isfinite(slope[0]));
}

/* Returns F_5/2 by Simpson's rule in s; the integrand has a square root at its lower end. */
static double integral(double H)
{
    enum { STEPS = 400000 };
    double sum = 0, step = (10 - H) / STEPS;
    for (int i = 0; i <= STEPS; i++) {
        double s = H + i * step;
        sum += (i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2) * pow(s - H, 2.5) * exp(-s * s / 2);
    }
    return sum * step / 3 / sqrt(2 * 3.14159265358979323846);
}

static stage *open_flanks(const char *param, const char *text)
{
    const double rq[] = {0.3e-6, 0.4e-6};
    stage *s = stage_open("surface/statistical");
    stage_set_reals(s, "rq", 2, rq);
    stage_set_text(s, param, text);
    return s;
}

static void test_integral(void)
{
    const double K = 16 * sqrt(2) / 15 * 3.14159265358979323846 * 0.05 * 0.05 * 0.1;
    stage *s = open_flanks("closure", "integral"), *fit = open_flanks("closure", "fit");
    const ff_asperity *a = stage_service(s, FF_ASPERITY_ID),
                      *b = stage_service(fit, FF_ASPERITY_ID);
    for (double H = -0.97; H < 5; H += 0.5) {
        double h = H * a->sigma, slope, p;
        a->pressure(a->self, 1, &h, &p, &slope);
        check_near("F_5/2", p / (K * a->modulus / 2), integral(H), 1e-5);
        check_near("its slope", slope, difference(pressure, a, h, 2e-3 * a->sigma), 1e-3);
        if (H > 0 && H < 2)
            check_near("the fit is off by a tenth", pressure(b, h), p, 0.15);
    }
    /* int_0^inf s^5/2 phi(s) ds in closed form; the fit has 0.550 for 0.617 */
    check_near("F_5/2(0)", pressure(a, 0) / (K * a->modulus / 2),
               pow(2, 0.75) * tgamma(1.75) / sqrt(2 * 3.14159265358979323846), 1e-6);
    stage_close(s);
    stage_close(fit);
}

static char table_path[] = "/tmp/flankfilm-asperities-XXXXXX";

static stage *open_table(const char *text)
{
    FILE *file = fopen(table_path, "w");
    fputs(text, file);
    fclose(file);
    return open_flanks("table", table_path);
}

/* If ln p is linear in these rows, it must be linear in between and beyond. */
static void test_table(void)
{
    close(mkstemp(table_path));
    stage *s = open_table("distance [1]; pressure [MPa]\n0; 1000\n1; 100\n2; 10\n4; 0.1\n");
    const ff_asperity *a = stage_service(s, FF_ASPERITY_ID);
    for (double H = -0.5; H < 6; H += 0.25) {
        double h = H * a->sigma, p, slope;
        ff_status status = a->pressure(a->self, 1, &h, &p, &slope);
        check_near("p_a", p, 1e9 * pow(10, -H), 1e-9);
        check_near("dp_a/dh", slope, -log(10) * p / a->sigma, 1e-6);
        check_true("in front of its rows it is extrapolated", (status == FF_DOMAIN) == (H < 0));
    }
    stage_close(s);
    s = open_table("distance [1]; pressure [MPa]\n0; 1000\n1; 1000\n");
    check_true("a pressure that does not fall",
               stage_ready(s) == FF_INVALID && strstr(stage_why(s), "must decrease"));
    stage_close(s);
    s = open_table("distance [1]; pressure [MPa]\n0; 1000\n");
    check_true("one row",
               stage_ready(s) == FF_INVALID && strstr(stage_why(s), "at least two distances"));
    stage_close(s);
    static const char *const level[] = {
        "distance [1]; pressure [MPa]\n0; 1000\n1; 990\n2; 1\n",
        "distance [1]; pressure [MPa]\n0; 1000\n1; 10\n2; 9.9\n",
    };
    for (int end = 0; end < 2; end++) {
        s = open_table(level[end]);
        check_true("a pressure that would stay constant",
                   stage_ready(s) == FF_INVALID && strstr(stage_why(s), "slope of ln p_a is 0") &&
                       strstr(stage_why(s), end ? ":4:" : ":2:"));
        stage_close(s);
    }
    unlink(table_path);
}

int main(void)
{
    test_integral();
    test_table();
    const double rq[] = {0.3e-6, 0.4e-6}, pi = 3.14159265358979323846, K = 16 * sqrt(2) / 15 * pi;
    stage *s = stage_open("surface/statistical");
    stage_set_reals(s, "rq", 2, rq);
    check_law(s, K * 0.05 * 0.05 * 0.1, 0.5e-6);
    check_true("runs", stage_run(s) == FF_OK);
    check_near("radius", stage_scalar(s, "summit_radius"), 50e-6, 1e-12);
    check_near("density", stage_scalar(s, "summit_density"), 0.05 / (50e-6 * 0.5e-6), 1e-12);
    stage_close(s);
    s = stage_open("surface/statistical");
    stage_set_reals(s, "rq", 1, rq);
    stage_set(s, "summit_density", 2e9);
    stage_set(s, "summit_radius", 30e-6);
    const double sigma = 0.3e-6 * sqrt(2), product = 2e9 * 30e-6 * sigma;
    check_law(s, K * product * product * sqrt(sigma / 30e-6), sigma);
    stage_close(s);
    s = stage_open("surface/statistical");
    stage_set_reals(s, "rq", 1, rq);
    stage_set(s, "summit_density", 2e9);
    check_true("a density without a radius",
               stage_ready(s) == FF_INVALID && !strcmp(stage_why_item(s), "summit_radius"));
    stage_close(s);
    return check_done();
}
