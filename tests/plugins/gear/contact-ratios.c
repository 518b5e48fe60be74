/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Contact ratios from 1 to below 4, at and near whole numbers: the points at which the number of
   tooth pairs changes. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double module = 3e-3;

/* Two gears without profile shift, with equal addenda, longer or shorter than usual. */
typedef struct teeth {
    double number[2], angle;
} teeth;

static const teeth usual = {{40, 60}, 20 * M_PI / 180}, slender = {{180, 220}, 14.5 * M_PI / 180};

/* Returns the contact ratio of teeth with an addendum, from the tip circles. */
static double ratio_of(const teeth *z, double addendum)
{
    double path = 0;
    for (int i = 0; i < 2; i++) {
        double r = module * z->number[i] / 2, rb = r * cos(z->angle);
        path += sqrt((r + addendum - rb) * (r + addendum + rb)) - r * sin(z->angle);
    }
    return path / (M_PI * module * cos(z->angle));
}

static stage *open_pair(const teeth *z, double ratio)
{
    double low = 0.1 * module, high = 3 * module;
    for (int i = 0; i < 100; i++) {
        double middle = (low + high) / 2;
        *(ratio_of(z, middle) < ratio ? &low : &high) = middle;
    }
    stage *gear = stage_open("gear/involute-spur");
    double tip[2], root[2];
    for (int i = 0; i < 2; i++) {
        tip[i] = module * z->number[i] + 2 * low;
        root[i] = module * z->number[i] - 2 * (low + module / 4);
    }
    stage_set_reals(gear, "teeth", 2, z->number);
    stage_set_reals(gear, "tip_diameter", 2, tip);
    stage_set_reals(gear, "root_diameter", 2, root);
    stage_set(gear, "pressure_angle", z->angle);
    stage_set(gear, "module", module);
    stage_set(gear, "face_width", 20e-3);
    return gear;
}

static double age_of(const stage *gear, double roll)
{
    return (roll - stage_scalar(gear, "roll_sap")) * stage_get(gear, "teeth", NULL)[0] / 2 / M_PI;
}

/* Checks the points with two stations, in base pitches from SAP, and roll_lpstc and roll_hpstc
   (`fewest`). */
static void check_changes(const teeth *z, double ratio, size_t count, const double *ages,
                          double tolerance, const double fewest[2])
{
    char what[80];
    snprintf(what, sizeof what, "contact ratio 2 %+.3g", ratio - 2);
    stage *gear = open_pair(z, ratio);
    if (!check_true(what, stage_run(gear) == FF_OK)) {
        printf("%s\n", stage_why(gear));
        stage_close(gear);
        return;
    }
    size_t n, found = 0, pitch = 0;
    const double *roll = stage_get(gear, "roll_angle", &n);
    double wrong = 0, back = 0;
    for (size_t i = 1; i < n; i++) {
        back = fmax(back, roll[i - 1] - roll[i]);
        pitch += roll[i] == stage_scalar(gear, "roll_pitch");
        if (roll[i] == roll[i - 1]) {
            wrong = fmax(wrong, found < count ? fabs(age_of(gear, roll[i]) - ages[found]) : 1);
            found++;
        }
    }
    check_near(what, stage_scalar(gear, "contact_ratio"), ratio, 1e-13);
    check_true("as many changes as expected", found == count);
    check_below("where they are expected", wrong, tolerance);
    check_below("stations never go back", back, 0);
    check_true("the pitch point is a station", pitch > 0);
    check_true("from SAP", roll[0] == stage_scalar(gear, "roll_sap"));
    check_true("to the tip", roll[n - 1] == stage_scalar(gear, "roll_tip"));
    check_below("lowest point of fewest pairs",
                fabs(age_of(gear, stage_scalar(gear, "roll_lpstc")) - fewest[0]), 1e-12);
    check_below("highest point of fewest pairs",
                fabs(age_of(gear, stage_scalar(gear, "roll_hpstc")) - fewest[1]), 1e-12);
    stage_close(gear);
}

static void check_between(const teeth *z, double ratio)
{
    double ages[6], e = ratio - floor(ratio);
    size_t pairs = (size_t)ratio;
    for (size_t i = 0; i < pairs; i++) {
        ages[2 * i] = (double)i + e;
        ages[2 * i + 1] = (double)(i + 1);
    }
    check_changes(z, ratio, 2 * pairs, ages, 1e-12, (double[]){e, (double)pairs});
}

/* At whole contact ratios, a pair ends contact where another begins: the number of pairs must not
   change. */
static void check_whole(const teeth *z, int pairs, double off)
{
    static const double ages[] = {1, 2, 3};
    check_changes(z, pairs + off, (size_t)pairs - 1, ages, 1e-9, (double[]){0, pairs + off});
}

static void check_relief(void)
{
    stage *gear = open_pair(&usual, 1);
    stage_set_text(gear, "tip_relief", "20 um");
    check_true("without double contact the start of relief must be given",
               stage_ready(gear) == FF_INVALID &&
                   !strcmp(stage_why_item(gear), "tip_relief_start"));
    stage_close(gear);
    gear = open_pair(&usual, 2.25);
    stage_set_text(gear, "tip_relief", "[20 um, 0 um]");
    if (check_true("tip relief of a high contact ratio", stage_run(gear) == FF_OK)) {
        uint32_t rank;
        size_t n = stage_shape(gear, "profile_roll", &rank)[1], i = 0;
        const double *roll = stage_get(gear, "profile_roll", NULL);
        const double *deviation = stage_get(gear, "profile_deviation", NULL);
        while (i + 1 < n && !(deviation[i + 1] < 0))
            i++;
        check_near("starts at HPSTC", age_of(gear, roll[i]), 2, 1e-9);
        check_near("all of it at the tip", deviation[n - 1], -20e-6, 1e-12);
    }
    stage_close(gear);
}

int main(void)
{
    static const double between[] = {1.0001, 1.2, 1.75, 1.9999, 2.0001, 2.3, 2.6},
                        off[] = {0, 1e-10, -1e-10}, near[] = {1e-7, 3e-9};
    for (size_t i = 0; i < sizeof between / sizeof between[0]; i++)
        check_between(&usual, between[i]);
    check_between(&slender, 2.9);
    check_between(&slender, 3.5);
    for (size_t i = 0; i < sizeof near / sizeof near[0]; i++) {
        check_between(&usual, 1 + near[i]);
        check_between(&usual, 2 - near[i]);
        check_between(&usual, 2 + near[i]);
    }
    for (size_t i = 0; i < sizeof off / sizeof off[0]; i++) {
        check_whole(&usual, 1, off[i]);
        check_whole(&usual, 2, off[i]);
        check_whole(&slender, 3, off[i]);
    }
    check_relief();
    return check_done();
}
