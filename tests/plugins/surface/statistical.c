/* SPDX-License-Identifier: GPL-3.0-or-later */
/* surface/statistical against its formula by hand. */
#include "check.h"
#include "difference.h"
#include "stage.h"

#include <flankfilm/laws.h>

#include <math.h>
#include <string.h>

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

int main(void)
{
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
