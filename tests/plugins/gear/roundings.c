/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Gears with the rounded values of a drawing must run, and report the changes made because of
   rounding. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static const double degree = M_PI / 180;

static stage *open_pair(const char *teeth, const char *module, const char *shift)
{
    stage *s = stage_open("gear/involute-spur");
    stage_set_text(s, "teeth", teeth);
    stage_set_text(s, "module", module);
    stage_set_text(s, "face_width", "14 mm");
    stage_set_text(s, "profile_shift", shift);
    return s;
}

/* Returns the overlap along the line of action of teeth without backlash, m cos(a) (z1 + z2) (inv
   a_w - inv a_tight), in um. */
static double overlap(double m, double teeth, double shift, double distance)
{
    const double angle = 20 * degree, working = acos(m * teeth * cos(angle) / (2 * distance));
    const double tight = tan(angle) - angle + 2 * shift * tan(angle) / teeth;
    return -1e3 * m * cos(angle) * teeth * (tan(working) - working - tight);
}

/* Runs a pair whose published profile shifts and centre distance make the teeth overlap. */
static void run_published(const char *name, stage *s, double moved)
{
    if (!check_true(name, stage_run(s) == FF_OK && stage_verdict(s) == 0))
        return;
    const double *allowance = stage_get(s, "thickness_allowance", NULL);
    const double cosine = cos(20 * degree);
    check_near("the overlap is said, um", stage_quality(s, "rounding"), moved, 1e-6);
    check_near("and taken off both teeth", -1e6 * (allowance[0] + allowance[1]) * cosine, moved,
               1e-6);
    check_near("no backlash is left", stage_scalar(s, "backlash"), 0, 0);
    check_below("the teeth fill the pitch", stage_quality(s, "pitch_error"), 1e-14);
}

static void check_published(void)
{
    stage *s = open_pair("[16, 24]", "4.5 mm", "[0.1817, 0.1715]");
    stage_set_text(s, "centre_distance", "91.5 mm");
    run_published("FZG C", s, overlap(4.5, 40, 0.3532, 91.5));
    stage_close(s);
    s = open_pair("[18, 36]", "21 mm", "[0.389, 0.5039]");
    stage_set_text(s, "centre_distance", "584 mm");
    run_published("stage 2 of the NREL 5 MW gearbox", s, overlap(21, 54, 0.8929, 584));
    stage_close(s);
    s = open_pair("[19, 41]", "4 mm", "[0.35, 0.1]");
    stage_set_text(s, "centre_distance", "121.712 mm");
    run_published("a pair of 19 and 41 teeth", s, overlap(4, 60, 0.45, 121.712));
    stage_close(s);
}

/* A given backlash, or allowances, that differ from those of the pair in the last digit. */
static void check_stated(void)
{
    stage *s = open_pair("[25, 40]", "3 mm", "[0, 0]");
    stage_set_text(s, "centre_distance", "97.8 mm");
    const double full = -overlap(3, 65, 0, 97.8);
    stage_set(s, "backlash", 1e-6 * (full - 0.9));
    if (check_true("a rounded backlash", stage_run(s) == FF_OK && stage_verdict(s) == 0)) {
        check_near("is moved up to that of full teeth", 1e6 * stage_scalar(s, "backlash"), full,
                   1e-9);
        check_near("by what it missed", stage_quality(s, "rounding"), 0.9, 1e-6);
        check_below("full teeth remain", fabs(stage_get(s, "thickness_allowance", NULL)[1]), 1e-15);
    }
    stage_close(s);
    s = open_pair("[25, 40]", "3 mm", "[0, 0]");
    stage_set_text(s, "thickness_allowance", "[2 um, -1 um]");
    if (check_true("rounded allowances", stage_run(s) == FF_OK && stage_verdict(s) == 0)) {
        const double *allowance = stage_get(s, "thickness_allowance", NULL);
        check_near("differ as before", 1e6 * (allowance[0] - allowance[1]), 3, 1e-9);
        check_below("and sum to none", fabs(allowance[0] + allowance[1]), 1e-18);
    }
    stage_close(s);
}

/* Tip and root diameters with two decimals that touch: the root must be changed, and the clearance
   be 0. */
static void check_touching(void)
{
    stage *s = open_pair("[30, 50]", "3 mm", "[0, 0]");
    stage_set_text(s, "tip_diameter", "[96 mm, 156 mm]");
    stage_set_text(s, "root_diameter", "[82.5 mm, 144.008 mm]");
    check_true("touching diameters run", stage_run(s) == FF_OK);
    check_near("the root of gear 2 moves", 2e3 * stage_get(s, "root_radius", NULL)[1], 144, 1e-12);
    check_near("and has no clearance", stage_quality(s, "tip_clearance"), 0, 0);
    stage_close(s);
}

static void expect(stage *s, const char *item, const char *sentence)
{
    const ff_status status = stage_ready(s);
    printf("%s: %s\n", stage_why_item(s), stage_why(s));
    check_true(sentence, status == FF_INVALID && !strcmp(stage_why_item(s), item) &&
                             strstr(stage_why(s), sentence));
    stage_close(s);
}

/* Differences that rounding does not explain must remain errors. */
static void check_limits(void)
{
    stage *s = open_pair("[16, 24]", "4.5 mm", "[0.1817, 0.1715]");
    stage_set_text(s, "centre_distance", "91.495 mm");
    expect(s, "centre_distance", "it must be at least 91.5001 mm");
    s = open_pair("[18, 36]", "21 mm", "[0.389, 0.5049]");
    stage_set_text(s, "centre_distance", "584 mm");
    expect(s, "centre_distance", "it must be at least");
    s = open_pair("[25, 40]", "3 mm", "[0, 0]");
    stage_set_text(s, "thickness_allowance", "[8 um, -1 um]");
    expect(s, "thickness_allowance", "must sum to 0 mm or less");
    s = open_pair("[30, 50]", "3 mm", "[0, 0]");
    stage_set_text(s, "root_diameter", "[82.5 mm, 144.03 mm]");
    expect(s, "root_diameter", "touches the root of gear 2");
}

static uint64_t state = 584018036;

/* xorshift64*, uniform in [low, high). */
static double uniform(double low, double high)
{
    state ^= state >> 12;
    state ^= state << 25;
    state ^= state >> 27;
    double unit = (double)((state * UINT64_C(2685821657736338717)) >> 11) / 9007199254740992.0;
    return low + (high - low) * unit;
}

/* Makes a random pair, and rounds its values to the digits of drawings. */
static void draw(int *drawn, int *moved)
{
    const double z[2] = {floor(uniform(14, 60)), floor(uniform(20, 120))};
    const double m = exp(uniform(log(0.3), log(45))), x[2] = {uniform(0, 0.6), uniform(0, 0.6)};
    stage *exact = stage_open("gear/involute-spur"), *typed = stage_open("gear/involute-spur");
    char text[80];
    stage_set_reals(exact, "teeth", 2, z);
    stage_set_reals(exact, "profile_shift", 2, x);
    stage_set(exact, "module", 1e-3 * m);
    stage_set_text(exact, "face_width", "14 mm");
    if (stage_run(exact) == FF_OK && stage_verdict(exact) == 0) {
        const double *tip = stage_get(exact, "tip_radius", NULL);
        stage_set_reals(typed, "teeth", 2, z);
        stage_set(typed, "module", 1e-3 * m);
        stage_set_text(typed, "face_width", "14 mm");
        snprintf(text, sizeof text, "[%.4f, %.4f]", x[0], x[1]);
        stage_set_text(typed, "profile_shift", text);
        snprintf(text, sizeof text, "%.3f mm", 1e3 * stage_scalar(exact, "centre_distance"));
        stage_set_text(typed, "centre_distance", text);
        snprintf(text, sizeof text, "[%.2f mm, %.2f mm]", 2e3 * tip[0], 2e3 * tip[1]);
        stage_set_text(typed, "tip_diameter", text);
        const bool good = stage_run(typed) == FF_OK && stage_verdict(typed) == 0;
        if (!good)
            check_true(stage_why(typed), false);
        ++*drawn;
        *moved += good && 1e6 * stage_scalar(typed, "backlash") < 1e-12;
    }
    stage_close(exact);
    stage_close(typed);
}

static void check_any_drawing(void)
{
    int drawn = 0, moved = 0;
    for (int i = 0; i < 300; i++)
        draw(&drawn, &moved);
    printf("%d drawings, of which %d have teeth that overlap by their rounding\n", drawn, moved);
    check_true("many overlap", drawn > 200 && moved > drawn / 4);
}

int main(void)
{
    check_published();
    check_stated();
    check_touching();
    check_limits();
    check_any_drawing();
    return check_done();
}
