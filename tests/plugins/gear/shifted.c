/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares profile shift, centre distance and backlash with a published table and separate
   derivations. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stddef.h>

static const double degree = M_PI / 180;

static double involute(double angle)
{
    return tan(angle) - angle;
}

/* Returns the inverse involute by bisection; the model uses Newton's method. */
static double angle_of(double value)
{
    double low = 0, high = M_PI / 2;
    for (int i = 0; i < 200; i++) {
        double middle = (low + high) / 2;
        if (involute(middle) < value)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static stage *open_pair(double z1, double z2, double x1, double x2)
{
    stage *gear = stage_open("gear/involute-spur");
    stage_set_reals(gear, "teeth", 2, (double[]){z1, z2});
    stage_set_reals(gear, "profile_shift", 2, (double[]){x1, x2});
    stage_set_text(gear, "module", "3 mm");
    stage_set_text(gear, "face_width", "20 mm");
    return gear;
}

static void check_pair(const stage *gear, const char *output, double first, double second,
                       double half_unit)
{
    const double *value = stage_get(gear, output, NULL);
    check_near(output, 2e3 * value[0], first, half_unit / first);
    check_near(output, 2e3 * value[1], second, half_unit / second);
}

/* bolsover.com, "Profile Shifted External Spur Gears": m 3, 20 deg, 12/24, x 0.6/0.36, centre
   distance 56.500 mm. */
static void check_published(void)
{
    stage *gear = open_pair(12, 24, 0.6, 0.36);
    stage_set_text(gear, "centre_distance", "56.5 mm");
    if (check_true("the published pair runs", stage_run(gear) == FF_OK)) {
        check_near("working angle, deg", stage_scalar(gear, "working_pressure_angle") / degree,
                   26.0888, 0.5e-4 / 26);
        check_pair(gear, "base_radius", 33.8289, 67.6579, 0.5e-4);
        check_pair(gear, "pitch_radius", 37.667, 75.333, 0.5e-3);
        check_pair(gear, "tip_radius", 44.840, 79.400, 0.5e-3);
        check_pair(gear, "root_radius", 32.100, 66.660, 0.5e-3);
        check_near("contact ratio", stage_scalar(gear, "contact_ratio"), 1.202, 0.5e-3 / 1.2);
    }
    stage_close(gear);
}

static void check_tight_centre_distance(void)
{
    stage *gear = open_pair(19, 43, 0.4, -0.15);
    double a = 20 * degree, aw = angle_of(involute(a) + 2 * 0.25 * tan(a) / 62);
    double C = 3e-3 * 31 * cos(a) / cos(aw);
    if (check_true("an unequal shifted pair runs", stage_run(gear) == FF_OK)) {
        check_near("working angle", stage_scalar(gear, "working_pressure_angle"), aw, 1e-14);
        check_near("centre distance", stage_scalar(gear, "centre_distance"), C, 1e-14);
        check_near("no backlash", stage_scalar(gear, "backlash"), 0, 0);
        double rb = 3e-3 * 9.5 * cos(a), ra1 = 3e-3 * (9.5 + 1 + 0.4) + C - 3e-3 * 31.25;
        check_near("tip with shortening", stage_get(gear, "tip_radius", NULL)[0], ra1, 1e-14);
        check_near("roll angle at the tip", stage_scalar(gear, "roll_tip"), tan(acos(rb / ra1)),
                   1e-13);
    }
    stage_close(gear);
}

/* With a centre distance larger by dC, the backlash on the working pitch circle must be the pitch
   minus both tooth thicknesses there. */
static void check_backlash_of_distance(void)
{
    stage *gear = open_pair(25, 40, 0, 0);
    stage_set_text(gear, "centre_distance", "97.8 mm");
    double a = 20 * degree, aw = acos(97.5 / 97.8 * cos(a)), filled = 0;
    for (int i = 0; i < 2; i++) {
        double z = i ? 40 : 25, working = 3e-3 * z * cos(a) / cos(aw);
        filled += working * (M_PI / (2 * z) + involute(a) - involute(aw));
    }
    double circular = M_PI * 3e-3 * cos(a) / cos(aw) - filled;
    if (check_true("a pair pulled apart runs", stage_run(gear) == FF_OK))
        check_near("backlash of the centre distance", stage_scalar(gear, "backlash"),
                   circular * cos(aw), 1e-11);
    stage_close(gear);
    gear = open_pair(25, 40, 0, 0);
    stage_set_text(gear, "centre_distance", "97.8 mm");
    stage_set_text(gear, "backlash", "0.3 mm");
    if (check_true("a pair with a stated backlash runs", stage_run(gear) == FF_OK))
        check_near("stated backlash is the whole", stage_scalar(gear, "backlash"), 0.3e-3, 1e-14);
    stage_set_text(gear, "backlash_measure", "circular");
    if (check_true("a pair with a circular backlash runs", stage_run(gear) == FF_OK))
        check_near("an arc of the working pitch circle", stage_scalar(gear, "backlash"),
                   0.3e-3 * cos(aw), 1e-12);
    stage_close(gear);
}

/* With a rack, the path of contact is sqrt(ra1^2 - rb1^2) - r1 sin a + m / sin a. With a wheel, the
   difference is proportional to its curvature, 1/z2. */
static void check_rack_limit(void)
{
    double a = 20 * degree, r = 3e-3 * 12.5, rb = r * cos(a), ra = r + 3e-3, error[2];
    double path = sqrt(ra * ra - rb * rb) - r * sin(a) + 3e-3 / sin(a);
    for (int i = 0; i < 2; i++) {
        stage *gear = open_pair(25, i ? 1e6 : 1e5, 0, 0);
        error[i] = stage_run(gear) == FF_OK ? stage_scalar(gear, "path_length") / path - 1 : 1;
        stage_close(gear);
    }
    check_below("a wheel of 1e6 teeth is a rack", fabs(error[1]), 1e-5);
    check_near("the rack is approached as 1/z2", error[0] / error[1], 10, 1e-2);
}

/* With module and all lengths doubled, lengths must double and angles be equal, exactly in binary
   arithmetic. */
static void check_scaling(void)
{
    static const char *const lengths[] = {"base_radius", "tip_radius",      "root_radius",
                                          "radius_1",    "radius_2",        "base_pitch",
                                          "path_length", "tooth_thickness", "backlash"};
    stage *gear[2];
    for (int i = 0; i < 2; i++) {
        double unit = i ? 2e-3 : 1e-3;
        gear[i] = open_pair(21, 47, 0.3, 0.1);
        stage_set(gear[i], "module", 3 * unit);
        stage_set(gear[i], "face_width", 20 * unit);
        stage_set(gear[i], "backlash", 0.1 * unit);
        if (!check_true("a scaled pair runs", stage_run(gear[i]) == FF_OK))
            return;
    }
    for (size_t k = 0; k < sizeof lengths / sizeof lengths[0]; k++) {
        size_t n;
        const double *big = stage_get(gear[1], lengths[k], &n);
        const double *small = stage_get(gear[0], lengths[k], NULL);
        double error = 0;
        for (size_t i = 0; i < n; i++)
            error = fmax(error, fabs(big[i] / (2 * small[i]) - 1));
        check_below(lengths[k], error, 1e-15);
    }
    check_near("contact ratio stays", stage_scalar(gear[1], "contact_ratio"),
               stage_scalar(gear[0], "contact_ratio"), 1e-15);
    check_near("inertia grows as the fifth power", stage_get(gear[1], "inertia", NULL)[0],
               32 * stage_get(gear[0], "inertia", NULL)[0], 1e-14);
    stage_close(gear[0]);
    stage_close(gear[1]);
}

/* FZG's wheel A has 24 teeth and x = -0.5, below the limit of undercut, -0.404; its pinion's tips
   reach down to a radius of curvature of 6.19 mm, far above the undercut. */
static void check_harmless_undercut(void)
{
    stage *gear = open_pair(16, 24, 0.853, -0.5);
    stage_set_text(gear, "module", "4.5 mm");
    stage_set_text(gear, "centre_distance", "91.5 mm");
    stage_set_text(gear, "tip_diameter", "[88.77 mm, 112.5 mm]");
    if (check_true("an undercut below the contact does no harm", stage_run(gear) == FF_OK)) {
        size_t n;
        const double *radius = stage_get(gear, "radius_2", &n);
        check_near("the lowest contact of the wheel", radius[n - 1], 6.191e-3, 1e-3);
    }
    stage_close(gear);
}

int main(void)
{
    check_published();
    check_tight_centre_distance();
    check_backlash_of_distance();
    check_rack_limit();
    check_harmless_undercut();
    check_scaling();
    return check_done();
}
