/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tooth thickness given by allowances, spans or pins must give the same tooth; both thicknesses and
   the backlash must add up to the pitch. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stdio.h>

static const double degree = M_PI / 180;

static double involute(double angle)
{
    return tan(angle) - angle;
}

static stage *open_pair(const char *teeth, const char *shift)
{
    stage *gear = stage_open("gear/involute-spur");
    stage_set_text(gear, "module", "4 mm");
    stage_set_text(gear, "face_width", "40 mm");
    stage_set_text(gear, "teeth", teeth);
    stage_set_text(gear, "profile_shift", shift);
    return gear;
}

static double allowance(stage *gear, int i)
{
    return stage_get(gear, "thickness_allowance", NULL)[i];
}

/* The pair of a user's drawing, which fits at 180.9 mm only with its allowances. On the working
   pitch circles, both tooth thicknesses and the backlash must add up to the pitch. */
static void check_drawing(void)
{
    stage *gear = open_pair("[23, 67]", "[0.35, -0.1]");
    stage_set_text(gear, "centre_distance", "180.9 mm");
    stage_set_text(gear, "thickness_allowance", "[-70 um, -110 um]");
    double a = 20 * degree, aw = acos(180 * cos(a) / 180.9), filled = 0;
    const double z[] = {23, 67}, x[] = {0.35, -0.1}, A[] = {-70e-6, -110e-6};
    for (int i = 0; i < 2; i++) {
        double r = 4e-3 * z[i] / 2, s = 4e-3 * (M_PI / 2 + 2 * x[i] * tan(a)) + A[i];
        filled += 2 * r * cos(a) / cos(aw) * (s / (2 * r) + involute(a) - involute(aw));
    }
    double circular = M_PI * 4e-3 * cos(a) / cos(aw) - filled;
    if (check_true("a drawing's pair runs", stage_run(gear) == FF_OK))
        check_near("backlash of the allowances", stage_scalar(gear, "backlash"), circular * cos(aw),
                   1e-10);
    check_true("teeth and backlash fill the pitch", stage_quality(gear, "pitch_error") <= 1e-9);
    stage_close(gear);
}

/* A given backlash must reduce both tooth thicknesses equally. */
static void check_backlash(void)
{
    stage *gear = open_pair("[23, 67]", "[0.35, -0.1]");
    stage_set_text(gear, "centre_distance", "180.9 mm");
    stage_set_text(gear, "backlash", "0.1 mm");
    if (!check_true("a pair with a stated backlash runs", stage_run(gear) == FF_OK))
        return;
    double each[] = {allowance(gear, 0), allowance(gear, 1)};
    check_near("both are thinned alike", each[0], each[1], 0);
    stage_close(gear);
    gear = open_pair("[23, 67]", "[0.35, -0.1]");
    stage_set_text(gear, "centre_distance", "180.9 mm");
    char text[64];
    snprintf(text, sizeof text, "%.12g um", 1e6 * each[0]);
    stage_set_text(gear, "thickness_allowance", text);
    if (check_true("a pair with these allowances runs", stage_run(gear) == FF_OK))
        check_near("which give that backlash", stage_scalar(gear, "backlash"), 0.1e-3, 1e-10);
    stage_close(gear);
}

/* Published spans of gears without profile shift: W/m = 4.6663, 7.7305 and 16.9370 for 17, 25 and
   50 teeth, over 2, 3 and 6 teeth. */
static void check_printed_spans(void)
{
    static const struct {
        const char *teeth, *over;
        double span;
    } rows[] = {{"17", "2", 4.6663}, {"25", "3", 7.7305}, {"50", "6", 16.9370}};
    for (int i = 0; i < 3; i++) {
        stage *gear = open_pair(rows[i].teeth, "0");
        char text[64];
        snprintf(text, sizeof text, "%.12g mm", 4 * (rows[i].span - 0.01));
        stage_set_text(gear, "span", text);
        stage_set_text(gear, "span_teeth", rows[i].over);
        if (check_true("a printed span runs", stage_run(gear) == FF_OK))
            check_near("a span shorter by 0.01 m is an arc shorter by 0.01 m/cos a",
                       allowance(gear, 0), -0.04e-3 / cos(20 * degree), 5e-5 / 0.01);
        stage_close(gear);
    }
}

/* Returns the minimum of f from 0 to `end`, by a search over points, repeated with smaller
   distances near the best. */
static double least_of(double (*f)(const double *, double), const double *given, double end)
{
    enum { POINTS = 200 };
    double from = 0, to = end, best = 0;
    for (int round = 0; round < 5; round++) {
        double step = (to - from) / POINTS;
        for (int k = 0; k <= POINTS; k++)
            if (f(given, from + k * step) < f(given, best))
                best = from + k * step;
        from = fmax(best - step, 0);
        to = best + step;
    }
    return f(given, best);
}

/* Returns the distance from a point on the middle line of the space to a point of the flank. */
static double distance(const double *given, double roll)
{
    double radius = given[0], base = given[1], half_space = given[2], at = base * hypot(1, roll);
    double angle = half_space + roll - atan(roll); /* the space grows outwards */
    return hypot(radius - at * cos(angle), at * sin(angle));
}

/* Returns the radius of the axis of a pin that touches both flanks of the space. */
static double axis_of_pin(double pin, double base, double half_space, double most)
{
    double low = base, high = most;
    while (high - low > 1e-13) {
        double middle = (low + high) / 2, given[] = {middle, base, half_space};
        *(least_of(distance, given, 1.2) < pin / 2 ? &low : &high) = middle;
    }
    return low;
}

/* Returns minus half the extent of a span's outer flanks, at a point of one flank. */
static double inwards(const double *given, double roll)
{
    double base = given[0], outermost = given[1];
    return -base * hypot(1, roll) * sin(outermost - (roll - atan(roll)));
}

/* Checks the measurements that the gear states for its teeth, for the numbers of teeth and pins
   that it chooses. */
static void check_measures(void)
{
    const double m = 4e-3, a = 20 * degree, z[] = {23, 68}, x[] = {0.35, -0.1},
                 A[] = {-70e-6, -110e-6};
    stage *gear = open_pair("[23, 68]", "[0.35, -0.1]");
    stage_set_text(gear, "thickness_allowance", "[-70 um, -110 um]");
    if (!check_true("a pair that is measured runs", stage_run(gear) == FF_OK))
        return;
    const double *over = stage_get(gear, "span_teeth", NULL),
                 *pins = stage_get(gear, "pin_diameter", NULL);
    for (int i = 0; i < 2; i++) {
        double r = m * z[i] / 2, base = r * cos(a);
        double half = (m * (M_PI / 2 + 2 * x[i] * tan(a)) + A[i]) / (2 * r) + involute(a);
        double span[] = {base, (over[i] - 1) * M_PI / z[i] + half};
        double axis = axis_of_pin(pins[i], base, M_PI / z[i] - half, r + 4 * m);
        check_near("span", stage_get(gear, "span", NULL)[i], -2 * least_of(inwards, span, 2), 1e-9);
        check_near("measure over pins", stage_get(gear, "over_pins", NULL)[i],
                   2 * axis * (i == 0 ? cos(M_PI / (2 * z[i])) : 1) + pins[i], 1e-8);
    }
    stage_close(gear);
}

/* A pin whose axis lies where the measurement over pins gives it must touch both flanks of the
   space, for even and odd numbers of teeth. */
static void check_pins(const char *teeth, double z)
{
    const double m = 4e-3, a = 20 * degree, pin = 7e-3, A = -90e-6, r = m * z / 2;
    double base = r * cos(a), half_space = M_PI / z - (m * M_PI / 2 + A) / (2 * r) - involute(a);
    double over = 2 * axis_of_pin(pin, base, half_space, r + 4 * m) *
                      (fmod(z, 2) == 1 ? cos(M_PI / (2 * z)) : 1) +
                  pin;
    stage *gear = open_pair(teeth, "0");
    char text[64];
    snprintf(text, sizeof text, "%.12g mm", 1e3 * over);
    stage_set_text(gear, "over_pins", text);
    stage_set_text(gear, "pin_diameter", "7 mm");
    if (check_true("a measure over pins runs", stage_run(gear) == FF_OK))
        check_near("its tooth is that of the pins", allowance(gear, 0), A, 1e-4);
    stage_close(gear);
}

int main(void)
{
    check_drawing();
    check_backlash();
    check_printed_spans();
    check_measures();
    check_pins("30", 30);
    check_pins("31", 31);
    return check_done();
}
