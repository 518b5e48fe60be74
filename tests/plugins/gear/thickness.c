/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Teeth of a stated thickness: allowances, spans and pins give the same tooth, whose backlash fills
 * the pitch. */
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

/* The pair of a user's drawing, which fits at 180.9 mm by its allowances alone. On the working
   pitch circles both arcs and the backlash fill the pitch. */
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

/* A stated backlash thins both teeth alike. */
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

/* Printed spans of gears without shift: W/m = 4.6663, 7.7305 and 16.9370 for 17, 25 and 50 teeth
 * over 2, 3 and 6. */
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

/* The least of f over points from 0 to `end`, tried one by one, then ever closer about the best. */
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

/* From a point on the middle of the space, at a radius, to a point of the flank beside it. */
static double distance(const double *given, double roll)
{
    double radius = given[0], base = given[1], half_space = given[2], at = base * hypot(1, roll);
    double angle = half_space + roll - atan(roll); /* the space grows outwards */
    return hypot(radius - at * cos(angle), at * sin(angle));
}

/* Where on the middle of the space the axis of a pin lies that touches both flanks. */
static double axis_of_pin(double pin, double base, double half_space, double most)
{
    double low = base, high = most;
    while (high - low > 1e-13) {
        double middle = (low + high) / 2, given[] = {middle, base, half_space};
        *(least_of(distance, given, 1.2) < pin / 2 ? &low : &high) = middle;
    }
    return low;
}

/* A span goes over as far as its outer flanks reach: minus half of that, at a point of one. */
static double inwards(const double *given, double roll)
{
    double base = given[0], outermost = given[1];
    return -base * hypot(1, roll) * sin(outermost - (roll - atan(roll)));
}

/* What the gear says would be measured on its teeth, with the teeth and pins that it takes. */
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

/* A pin whose axis lies where its measure says touches both flanks of the space, of gears with even
 * and odd teeth. */
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
