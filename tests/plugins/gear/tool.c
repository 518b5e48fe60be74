/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The begin of the involute that the tool generates: compares it with points that the tip of the
   rack sweeps, and checks that depth and tip radius reach the root. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stdio.h>

typedef struct tool {
    double teeth, shift;                             /* of both gears */
    double dedendum, round, protuberance, allowance; /* modules, um */
    const char *distance;
} tool;

static const double module = 3e-3, degree = M_PI / 180;

static double involute(double angle)
{
    return tan(angle) - angle;
}

/* Returns how far, as an angle from the middle of the space, the rounding of the tool's tip sweeps
   at a radius, by trying all positions of the rack that rolls on the reference circle. */
static double swept(const tool *t, double radius)
{
    enum { ROLLS = 20000 };
    const double a = 20 * degree, r = module * t->teeth / 2, round = t->round * module;
    const double left = fmax(t->protuberance - t->allowance, 0) * 1e-6;
    const double half =
        module * (M_PI / 4 - t->shift * tan(a)); /* of the tool at the rolling line */
    const double depth = (t->dedendum - t->shift - t->round) * module;
    const double centre = half - depth * tan(a) - (round - left) / cos(a);
    double most = -1;
    for (int k = 0; k < ROLLS; k++) {
        const double roll = module * (-1 + 5.0 * k / ROLLS);
        /* the circle about (x, y) of this radius `round` cuts the circle of the gear at two points
         */
        const double x = centre + roll, y = r - depth, reach = hypot(x, y);
        const double cosine =
            (radius * radius + reach * reach - round * round) / (2 * radius * reach);
        if (fabs(cosine) <= 1)
            most = fmax(most, atan2(x, y) + acos(cosine) - roll / r);
    }
    return most;
}

/* Returns the largest radius at which the tip of the tool removes part of the flank. */
static double begins(const tool *t)
{
    const double a = 20 * degree, r = module * t->teeth / 2, base = r * cos(a);
    const double half = module * (M_PI / 4 - t->shift * tan(a));
    double low = base * (1 + 1e-9), high = r;
    for (int i = 0; i < 30; i++) {
        const double middle = (low + high) / 2;
        const double flank = half / r - involute(a) + involute(acos(base / middle));
        *(swept(t, middle) > flank + 1e-7 ? &low : &high) = middle;
    }
    return (low + high) / 2;
}

static stage *open_gear(const tool *t)
{
    char text[64];
    stage *gear = stage_open("gear/involute-spur");
    const struct {
        const char *name, *format;
        double value;
    } rows[] = {{"teeth", "%.0f", t->teeth},
                {"profile_shift", "%g", t->shift},
                {"dedendum", "%g", t->dedendum},
                {"tool_tip_radius", "%g", t->round},
                {"protuberance", "%g um", t->protuberance},
                {"machining_allowance", "%g um", t->allowance}};
    stage_set_text(gear, "module", "3 mm");
    stage_set_text(gear, "face_width", "20 mm");
    if (t->distance)
        stage_set_text(gear, "centre_distance", t->distance);
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        snprintf(text, sizeof text, rows[i].format, rows[i].value);
        stage_set_text(gear, rows[i].name, text);
    }
    check_true("the pair runs", stage_run(gear) == FF_OK);
    return gear;
}

static void check_form(void)
{
    static const tool tools[] = {
        {30, 0, 1.4, 0.25, 120, 80, "91.4 mm"},  {30, 0, 1.4, 0.25, 60, 80, "91 mm"},
        {58, 0.1, 1.4, 0.4, 150, 100, "176 mm"}, {24, 0.3, 1.4, 0.3, 90, 60, "74.8 mm"},
        {14, 0, 1.25, 0.38, 0, 0, "43.4 mm"},
    };
    for (size_t i = 0; i < sizeof tools / sizeof tools[0]; i++) {
        const tool *t = &tools[i];
        const double a = 20 * degree, s = sin(a), r = module * t->teeth / 2;
        const double straight = t->dedendum - t->round * (1 - s);
        const double curvature = r * s - (straight - t->shift) * module / s;
        const int cut = t->protuberance > t->allowance || curvature < 0;
        const double want = cut ? begins(t) : hypot(r * cos(a), curvature);
        stage *gear = open_gear(t);
        const double *form = stage_get(gear, "root_form_radius", NULL);
        char what[80];
        snprintf(what, sizeof what, "%g teeth, protuberance %g um", t->teeth, t->protuberance);
        /* 1e-7 rad of overlap is 1e-6 of the radius where the curves cross */
        check_near(what, form[0], want, 5e-6);
        check_near("both gears", form[1], form[0], 1e-12);
        stage_close(gear);
    }
}

static void check_root(void)
{
    tool t = {30, 0.1, 1.4, 0.25, 0, 0, NULL};
    stage *gear = open_gear(&t);
    check_near("root", stage_get(gear, "root_radius", NULL)[0], module * (15 + 0.1 - 1.4), 1e-12);
    check_near("tip radius", stage_get(gear, "tool_tip_radius", NULL)[1], 0.25, 1e-12);
    stage_close(gear);
    gear = stage_open("gear/involute-spur");
    stage_set_text(gear, "module", "3 mm");
    stage_set_text(gear, "face_width", "20 mm");
    stage_set_text(gear, "teeth", "30");
    check_true("the standard pair runs", stage_run(gear) == FF_OK);
    check_near("of the basic rack", stage_get(gear, "root_radius", NULL)[0], module * (15 - 1.25),
               1e-12);
    check_near("its tip radius", stage_get(gear, "tool_tip_radius", NULL)[0], 0.38, 1e-12);
    stage_close(gear);
}

int main(void)
{
    check_form();
    check_root();
    return check_done();
}
