/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Measured profiles: values between points, and detection of kinks. */
#include "../../../plugins/stiffness/deviations.h"

#include "check.h"

#include <math.h>

enum { KNOTS = 31 };
static double roll[KNOTS], profile[KNOTS];
static const stiffness_deviations deviations = {
    .points = KNOTS, .roll = {roll, roll}, .profile = {profile, profile}};

/* Makes a relief that begins at roll angle `start`, at unequally spaced points. */
static void relieve(double start, double power)
{
    for (int i = 0; i < KNOTS; i++) {
        double x = (double)i / (KNOTS - 1);
        roll[i] = 0.25 + 0.25 * x * (0.8 + 0.2 * x);
        profile[i] = -1e-5 * pow(fmax(roll[i] - start, 0) / (0.5 - start), power);
    }
}

/* A sampled parabola, whose slope changes by 1/(KNOTS - 2) of its range from point to point, must
   have no kink. */
static void test_a_sampled_curve_has_no_corner(void)
{
    double found[KNOTS];
    relieve(0.25, 2);
    for (int gear = 0; gear < 2; gear++)
        check_true("none", stiffness_profile_corners(&deviations, gear, found, KNOTS) == 0);
}

static void test_a_line_of_relief_has_one(void)
{
    double found[KNOTS];
    relieve(0.25, 1);
    relieve(roll[17], 1);
    check_true("one", stiffness_profile_corners(&deviations, 0, found, KNOTS) == 1);
    check_near("where it begins", found[0], roll[17], 1e-15);
}

static void test_between_points(void)
{
    relieve(0.3, 1);
    check_near("linear", stiffness_profile_deviation(&deviations, 1, (roll[20] + 3 * roll[21]) / 4),
               (profile[20] + 3 * profile[21]) / 4, 1e-13);
    check_near("held before", 1 + stiffness_profile_deviation(&deviations, 0, 0.1), 1, 0);
    check_near("held behind", stiffness_profile_deviation(&deviations, 0, 0.6), -1e-5, 1e-13);
}

int main(void)
{
    test_a_sampled_curve_has_no_corner();
    test_a_line_of_relief_has_one();
    test_between_points();
    return check_done();
}
