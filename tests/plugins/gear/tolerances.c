/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flank tolerances of an accuracy class: all values in published reports on three gear stages, in
   um (gfsReboucas/Drivetrain, @NREL_5MW/stage_01.rtf to stage_03.rtf, class 6 of ISO
   1328-1:1995). */
#include <check.h>
#include <stage.h>

#include <stdio.h>
#include <string.h>

static const char *const outputs[] = {"single_pitch_tolerance", "total_pitch_tolerance",
                                      "profile_form_tolerance", "profile_slope_tolerance",
                                      "profile_tolerance"};

static stage *open_pair(const char *teeth, const char *module, const char *quality)
{
    stage *s = stage_open("gear/involute-spur");
    stage_set_text(s, "teeth", teeth);
    stage_set_text(s, "module", module);
    stage_set_text(s, "face_width", "100 mm");
    if (quality)
        stage_set_text(s, "quality", quality);
    return s;
}

/* The third stage has helical teeth of normal module 14 mm, whose reference diameters of 341.183
   and 1350.517 mm lie in the ranges of spur gears with 24 and 96 teeth. */
static void check_printed(void)
{
    static const struct {
        const char *teeth, *module;
        double printed[5][2];
    } stages[] = {
        {"[19, 17]", "45 mm", {{33, 33}, {81, 81}, {33, 33}, {27, 27}, {42, 42}}},
        {"[18, 36]", "21 mm", {{18, 19}, {54, 67}, {21, 23}, {17, 19}, {27, 30}}},
        {"[24, 96]", "14 mm", {{14, 17}, {50, 78}, {18, 22}, {15, 18}, {23, 28}}},
    };
    for (size_t k = 0; k < sizeof stages / sizeof stages[0]; k++) {
        stage *s = open_pair(stages[k].teeth, stages[k].module, "6");
        check_true(stages[k].module, stage_run(s) == FF_OK);
        for (size_t i = 0; i < 5; i++)
            for (size_t g = 0; g < 2; g++)
                check_near(outputs[i], 1e6 * stage_get(s, outputs[i], NULL)[g],
                           stages[k].printed[i][g], 1e-12);
        stage_close(s);
    }
}

/* Two classes must differ by a factor of 2, and small values have smaller rounding steps. Computed
   for module 3 mm (range 2 to 3.5: mean 2.64575) and d = 60 and 120 mm (range 50 to 125: mean
   79.0569). */
static void check_classes(void)
{
    stage *s = open_pair("[20, 40]", "3 mm", "[5, 1]");
    check_true("two classes", stage_run(s) == FF_OK);
    const double *single = stage_get(s, "single_pitch_tolerance", NULL);
    check_near("0.3 (2.64575 + 0.4 x 8.89139) + 4 = 5.86 to half a um", 1e6 * single[0], 6, 1e-12);
    check_near("a quarter of it, 1.47 to a tenth", 1e6 * single[1], 1.5, 1e-12);
    const double *slope = stage_get(s, "profile_slope_tolerance", NULL);
    check_near("2 x 1.62658 + 0.14 x 8.89139 + 0.5 = 4.998", 1e6 * slope[0], 5, 1e-12);
    check_near("a quarter of it, 1.2494", 1e6 * slope[1], 1.2, 1e-12);
    stage_close(s);
}

static void check_refusals(void)
{
    stage *s = open_pair("[20, 40]", "0.3 mm", "6");
    check_true("a module beyond the ranges", stage_ready(s) == FF_INVALID &&
                                                 !strcmp(stage_why_item(s), "quality") &&
                                                 strstr(stage_why(s), "0.5 to 70 mm"));
    stage_close(s);
    s = open_pair("[20, 40]", "3 mm", NULL);
    check_true("without a class", stage_run_wanted(s, "profile_tolerance") == FF_UNSUPPORTED);
    check_true("all others are given", stage_run(s) == FF_OK && !stage_has(s, outputs[0]));
    stage_close(s);
    s = open_pair("[20, 40]", "3 mm", NULL);
    check_true("half a class", stage_try_text(s, "quality", "6.5") != FF_OK);
    stage_close(s);
}

int main(void)
{
    check_printed();
    check_classes();
    check_refusals();
    return check_done();
}
