/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact of tip corners with flanks of unequal gears, computed here from triangles about the line
   of centres. */
#include "../../../plugins/stiffness/contact-point.h"

#include "check.h"

#include <math.h>

static const double degree = M_PI / 180;

static double involute(double roll)
{
    return roll - atan(roll);
}

/* Makes gears of 19 and 41 teeth, module 3 mm, 20 deg, with a centre distance increased by 0.4 mm
   and tip diameters of 64 and 128 mm. */
static stiffness_gears make(double *working)
{
    const double teeth[2] = {19, 41}, tip[2] = {32e-3, 64.4e-3};
    stiffness_gears g = {.width = 0.02};
    for (int i = 0; i < 2; i++) {
        double base = 1.5e-3 * teeth[i] * cos(20 * degree);
        g.gear[i] = (stiffness_gear){
            .teeth = teeth[i], .base_radius = base, .roll_tip = sqrt(pow(tip[i] / base, 2) - 1)};
    }
    const double distance = 90.4e-3;
    *working = acos((g.gear[0].base_radius + g.gear[1].base_radius) / distance);
    g.tangent_length = distance * sin(*working);
    g.roll_sap =
        (g.tangent_length - g.gear[1].base_radius * g.gear[1].roll_tip) / g.gear[0].base_radius;
    g.pitch = 2 * M_PI / teeth[0];
    g.contact_ratio = (g.gear[0].roll_tip - g.roll_sap) / g.pitch;
    return g;
}

/* Returns the gap, a rotation of the flank, and finds the flank's roll angle where the corner
   touches it. beside, seen: angles of the corner from the line of centres, about the axis of its
   gear and of the flank's gear. Angles of the flank begin where the line of action touches its base
   circle. */
static double gap_of(const stiffness_gears *g, int tip, double working, double age, double *roll)
{
    const stiffness_gear *corner = &g->gear[tip], *flank = &g->gear[1 - tip];
    const double distance = (corner->base_radius + flank->base_radius) / cos(working);
    const double radius = corner->base_radius * sqrt(1 + corner->roll_tip * corner->roll_tip);
    const double own = stiffness_gears_roll(g, tip, age),
                 others = stiffness_gears_roll(g, 1 - tip, age);
    const double beside = own - involute(corner->roll_tip) - working;
    const double away =
        sqrt(distance * distance + radius * radius - 2 * distance * radius * cos(beside));
    const double seen = asin(radius * sin(beside) / away);
    *roll = sqrt(pow(away / flank->base_radius, 2) - 1);
    return flank->base_radius * (working - seen + involute(*roll) - others);
}

int main(void)
{
    double working;
    const stiffness_gears g = make(&working);
    for (int k = 1; k <= 5; k++)
        for (int tip = 0; tip < 2; tip++) {
            double age = tip == 1 ? -0.05 * k : g.contact_ratio + 0.05 * k, roll[2], gap, met;
            double by_hand = gap_of(&g, tip, working, age, &met);
            check_true("a corner meets the flank", stiffness_gears_contact(&g, age, roll, &gap));
            check_near("gap", gap, by_hand, 1e-9);
            check_near("where", roll[1 - tip], met, 1e-9);
            check_near("the tip", roll[tip], g.gear[tip].roll_tip, 1e-15);
            check_true("apart", gap > 0);
        }
    return check_done();
}
