/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinematics, Hertz pressure and Moes' parameters in an engagement. */
#include "check.h"
#include "pair.h"

#include <math.h>

enum { MOST = 4000 };

static const double degree = M_PI / 180, force = 3547.26;

/* Returns an output at the roll angle `at`, linearly interpolated between instants. */
static double value_at(const stage *tooth, const char *output, double at)
{
    size_t n, i = 0;
    const double *roll = stage_get(tooth, "roll_angle", &n), *y = stage_get(tooth, output, NULL);
    while (i + 2 < n && roll[i + 1] < at)
        i++;
    return y[i] + (y[i + 1] - y[i]) * (at - roll[i]) / (roll[i + 1] - roll[i]);
}

static void check_printed_figures(void)
{
    static double load[MOST];
    pair p = pair_open_printed();
    size_t n;
    pair_stations(&p, &n);
    pair_share(&p, force, load);
    stage_give_series(p.tooth, "load.tooth_force", n, load);
    if (check_true("runs", stage_run_wanted(p.tooth, pair_dry) == FF_OK)) {
        const double *u = stage_get(p.tooth, "entrainment_speed", &n), *t, *srr;
        double spread = 0, omega = 1500 * M_PI / 30;
        for (size_t i = 0; i < n; i++)
            spread = fmax(spread, fabs(u[i] / (omega * 75e-3 * sin(20 * degree)) - 1));
        check_near("4000 instants", (double)n, 4000, 0);
        check_below("u_r = omega C sin(alpha)/2 all along", spread, 1e-13);
        check_near("u_r, m/s", u[0], 4.0293, 0.5e-4 / 4);
        t = stage_get(p.tooth, "time", NULL);
        check_near("duration, us", 1e3 * t[n - 1], 1.4037, 0.5e-4);
        srr = stage_get(p.tooth, "slide_roll_ratio", NULL);
        check_near("SR at SAP", srr[0], -0.6058, 1e-4);
        check_near("SR at tip", srr[n - 1], 0.6058, 1e-4);
        check_near("SR at LPSTC", value_at(p.tooth, "slide_roll_ratio", 19.971 * degree), -0.0847,
                   6e-4);
        check_near("load at the pitch point, N/mm",
                   1e-3 * value_at(p.tooth, "load_per_width", 20.854 * degree), 177.363, 1e-5);
        check_near("half width at the pitch point, um",
                   1e6 * value_at(p.tooth, "hertz_half_width", 20.854 * degree), 160.0, 4e-4);
        check_near("pressure at the pitch point, GPa",
                   1e-9 * value_at(p.tooth, "hertz_pressure", 20.854 * degree), 0.7059, 1e-4);
        check_true("quality is good", stage_verdict(p.tooth) == FF_GOOD);
    }
    pair_close(&p);
}

/* Unequal gears: checks every relation between the outputs at each instant. */
static void check_relations(void)
{
    static double load[MOST];
    pair p = pair_open();
    size_t n;
    pair_stations(&p, &n);
    pair_share(&p, force, load);
    stage_give_series(p.tooth, "load.tooth_force", n, load);
    stage *oil = stage_open("viscosity/barus");
    stage_set_text(oil, "eta0", "80 mPa s");
    stage_set_text(oil, "alpha", "20 1/GPa");
    stage_link(p.tooth, "viscosity", oil);
    if (!check_true("unequal gears run", stage_run(p.tooth) == FF_OK))
        return;
    const double *roll = stage_get(p.tooth, "roll_angle", &n);
    const double *r1 = stage_get(p.tooth, "radius_1", NULL),
                 *r2 = stage_get(p.tooth, "radius_2", NULL);
    const double *u1 = stage_get(p.tooth, "speed_1", NULL),
                 *u2 = stage_get(p.tooth, "speed_2", NULL);
    const double *w = stage_get(p.tooth, "load_per_width", NULL);
    const double *a = stage_get(p.tooth, "hertz_half_width", NULL);
    const double *ph = stage_get(p.tooth, "hertz_pressure", NULL);
    const double *M = stage_get(p.tooth, "moes_M", NULL), *L = stage_get(p.tooth, "moes_L", NULL);
    double rb1 = stage_get(p.gear, "base_radius", NULL)[0], omega = 1250 * 2 * M_PI / 25;
    double E = stage_scalar(p.tooth, "reduced_modulus");
    double radius = 0, speed = 0, carried = 0, deflected = 0, moes = 0, pitch = 1;
    for (size_t i = 0; i < n; i++) {
        double R = r1[i] * r2[i] / (r1[i] + r2[i]), u_sum = u1[i] + u2[i];
        radius = fmax(radius, fabs(r1[i] / (rb1 * roll[i]) - 1));
        speed = fmax(speed, fabs(u1[i] / (omega * r1[i]) - 1));
        speed = fmax(speed, fabs(u2[i] / (omega * 25 / 40 * r2[i]) - 1));
        carried = fmax(carried, fabs(M_PI * a[i] * ph[i] / 2 / w[i] - 1));
        deflected = fmax(deflected, fabs(ph[i] * 4 * R / (E * a[i]) - 1));
        /* with the sum speed: M = w/(E' R) (E' R/(eta0 u_sum))^(1/2), L = alpha E' (...)^(-1/4) */
        double N = E * R / (0.08 * u_sum);
        moes = fmax(moes, fabs(M[i] / (w[i] / (E * R) * sqrt(N)) - 1));
        moes = fmax(moes, fabs(L[i] / (20e-9 * E / sqrt(sqrt(N))) - 1));
        pitch = fmin(pitch, fabs(u1[i] / u2[i] - 1));
    }
    check_below("R1 = rb1 theta", radius, 1e-13);
    check_below("u = omega R on both flanks", speed, 1e-13);
    check_below("w = pi a p_H / 2", carried, 1e-13);
    check_below("p_H = E' a / (4 R)", deflected, 1e-13);
    check_below("Moes numbers by their definition", moes, 1e-12);
    check_below("no sliding near the pitch point", pitch, 1e-2);
    stage_close(oil);
    pair_close(&p);
}

/* With exchanged gears and the load reversed in time, the history must be the same backwards. */
static void check_swapped(void)
{
    static double load[2][MOST];
    double worst = 0;
    pair p[2] = {pair_open(), pair_open_exchanged()};
    size_t n;
    const double *roll = pair_stations(&p[0], &n);
    for (size_t i = 0; i < n; i++)
        load[0][i] = load[1][n - 1 - i] = 2000 + 4000 * (roll[i] - roll[0]);
    for (int k = 0; k < 2; k++) {
        stage_give_series(p[k].tooth, "load.tooth_force", n, load[k]);
        stage_set_text(p[k].tooth, "load_ramp", k ? "0.125 deg" : "0.2 deg"); /* the same path */
        if (!check_true("runs", stage_run_wanted(p[k].tooth, pair_dry) == FF_OK))
            return;
    }
    static const char *const names[][2] = {
        {"speed_1", "speed_2"}, {"radius_1", "radius_2"}, {"hertz_pressure", "hertz_pressure"}};
    for (int k = 0; k < 3; k++) {
        const double *one = stage_get(p[0].tooth, names[k][0], &n);
        const double *other = stage_get(p[1].tooth, names[k][1], NULL);
        for (size_t i = 0; i < n; i++)
            worst = fmax(worst, fabs(one[i] / other[n - 1 - i] - 1));
    }
    check_below("swapped roles mirror the history", worst, 1e-10);
    pair_close(&p[0]);
    pair_close(&p[1]);
}

int main(void)
{
    check_printed_figures();
    check_relations();
    check_swapped();
    return check_done();
}
