/* SPDX-License-Identifier: GPL-3.0-or-later */
/* For pairs that cannot run, the message must name the parameter and a remedy. */
#include <check.h>
#include <stage.h>

#include <stddef.h>
#include <stdio.h>
#include <string.h>

typedef struct fault {
    const char *what;
    const char *set[6][2]; /* parameter and text, beside module 3 mm and face width 20 mm */
    const char *item, *sentence;
} fault;

static const fault faults[] = {
    {"undercut", {{"teeth", "[12, 40]"}}, "profile_shift", "at least 0.298"},
    {"undercut where the flank meshes",
     {{"teeth", "[14, 20]"}},
     "profile_shift",
     "is undercut where its flank meshes"},
    {"pointed tip",
     {{"teeth", "[12, 40]"}, {"profile_shift", "[1.2, 0]"}},
     "profile_shift",
     "pointed"},
    {"pointed by a stated tip",
     {{"teeth", "[20, 40]"}, {"tip_diameter", "[72 mm, 126 mm]"}, {"centre_distance", "95 mm"}},
     "tip_diameter",
     "pointed"},
    {"tip beyond the involute of its mate",
     {{"teeth", "[20, 100]"}, {"tip_diameter", "[64 mm, 308.2 mm]"}, {"root_diameter", "50 mm"}},
     "tip_diameter",
     "reaches below the base circle of gear 1"},
    {"tip strikes root",
     {{"teeth", "50"}, {"tip_diameter", "158 mm"}},
     "tip_diameter",
     "touches the root"},
    {"root strikes tip",
     {{"teeth", "50"}, {"root_diameter", "145 mm"}},
     "root_diameter",
     "touches the root"},
    {"tip inside the root",
     {{"teeth", "50"}, {"tip_diameter", "140 mm"}},
     "tip_diameter",
     "must exceed"},
    {"contact ratio below 1",
     {{"teeth", "50"}, {"tip_diameter", "152.5 mm"}},
     "tip_diameter",
     "at least 1"},
    {"contact ratio above 4",
     {{"teeth", "200"},
      {"pressure_angle", "14.5 deg"},
      {"tip_diameter", "612 mm"},
      {"root_diameter", "586 mm"}},
     "tip_diameter",
     "less than 4"},
    {"base circles apart",
     {{"teeth", "50"}, {"centre_distance", "140 mm"}},
     "centre_distance",
     "sum of the base radii"},
    {"teeth jam",
     {{"teeth", "50"}, {"centre_distance", "149 mm"}},
     "centre_distance",
     "at least 150.0000 mm"},
    {"less backlash than the distance leaves",
     {{"teeth", "50"}, {"centre_distance", "150.3 mm"}, {"backlash", "0.1 mm"}},
     "backlash",
     "less than 0.2"},
    {"allowances that jam",
     {{"teeth", "50"}, {"thickness_allowance", "20 um"}},
     "thickness_allowance",
     "sum to 0 mm or less"},
    {"a protuberance that takes what meshes",
     {{"teeth", "50"}, {"protuberance", "200 um"}},
     "protuberance",
     "removes the flank up to"},
    {"a span without its number of teeth",
     {{"teeth", "50"}, {"span", "50.7 mm"}},
     "span",
     "needs span_teeth"},
    {"a span over half a tooth",
     {{"teeth", "50"}, {"span", "50.7 mm"}, {"span_teeth", "5.5"}},
     "span_teeth",
     "whole number"},
    {"a span beyond the flanks",
     {{"teeth", "50"}, {"span", "77.3 mm"}, {"span_teeth", "9"}, {"centre_distance", "150.2 mm"}},
     "span",
     "another number of teeth"},
    {"pins without a diameter",
     {{"teeth", "50"}, {"over_pins", "156 mm"}},
     "over_pins",
     "needs pin_diameter"},
    {"pins that touch no flank",
     {{"teeth", "50"},
      {"over_pins", "140 mm"},
      {"pin_diameter", "1 mm"},
      {"centre_distance", "155 mm"}},
     "over_pins",
     "another pin_diameter"},
    {"no working angle",
     {{"teeth", "[200, 200]"}, {"profile_shift", "[-5, -5]"}},
     "profile_shift",
     "it must exceed"},
    {"bore through the teeth",
     {{"teeth", "50"}, {"bore_diameter", "143 mm"}},
     "bore_diameter",
     "less than its root"},
};

int main(void)
{
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; i++) {
        const fault *f = &faults[i];
        stage *gear = stage_open("gear/involute-spur");
        stage_set_text(gear, "module", "3 mm");
        stage_set_text(gear, "face_width", "20 mm");
        for (size_t k = 0; k < 6 && f->set[k][0]; k++)
            stage_set_text(gear, f->set[k][0], f->set[k][1]);
        ff_status status = stage_ready(gear);
        printf("%s: %s\n", f->what, stage_why(gear));
        check_true(f->what, status == FF_INVALID && !strcmp(stage_why_item(gear), f->item) &&
                                strstr(stage_why(gear), f->sentence));
        stage_close(gear);
    }
    return check_done();
}
