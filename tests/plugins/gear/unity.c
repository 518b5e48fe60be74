/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares the 50/50 gear pair of Li & Kahraman 2011 with closed forms, to the published digits. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stddef.h>

static const double degree = M_PI / 180;

/* Checks a value against a published one, to half of `last`, a unit of its last digit. */
static void check_printed(const char *what, double value, double printed, double last)
{
    check_near(what, value, printed, 0.5000001 * last / fabs(printed));
}

static stage *open_pair(void)
{
    stage *gear = stage_open("gear/involute-spur");
    stage_set(gear, "teeth", 50);
    stage_set_text(gear, "module", "3 mm");
    stage_set_text(gear, "face_width", "20 mm");
    stage_set_text(gear, "backlash", "0.14 mm");
    return gear;
}

static double of_gear_1(const stage *gear, const char *output)
{
    return stage_get(gear, output, NULL)[0];
}

static void check_geometry(const stage *gear)
{
    check_printed("centre distance, mm", 1e3 * stage_scalar(gear, "centre_distance"), 150, 0.1);
    check_printed("pitch diameter, mm", 2e3 * of_gear_1(gear, "pitch_radius"), 150, 0.1);
    check_printed("base radius, mm", 1e3 * of_gear_1(gear, "base_radius"), 70.476947, 1e-6);
    check_printed("base pitch, mm", 1e3 * stage_scalar(gear, "base_pitch"), 8.856394, 1e-6);
    check_printed("outside diameter, mm", 2e3 * of_gear_1(gear, "tip_radius"), 156, 0.1);
    check_printed("root diameter, mm", 2e3 * of_gear_1(gear, "root_radius"), 142.5, 0.1);
    check_printed("contact ratio", stage_scalar(gear, "contact_ratio"), 1.75467, 1e-5);
    check_near("base pitch is 7.2 degrees of roll",
               stage_scalar(gear, "base_pitch") / of_gear_1(gear, "base_radius"), 7.2 * degree,
               1e-14);
    check_near("tooth thickness is half the pitch", of_gear_1(gear, "tooth_thickness"),
               M_PI * 3e-3 / 2, 1e-14);
    check_near("backlash along the line of action", stage_scalar(gear, "backlash"), 0.14e-3, 1e-14);
    check_near("working angle is that of the rack", stage_scalar(gear, "working_pressure_angle"),
               20 * degree, 1e-15);
}

static void check_roll_angles(const stage *gear)
{
    check_printed("SAP, deg", stage_scalar(gear, "roll_sap") / degree, 14.537, 1e-3);
    check_printed("LPSTC, deg", stage_scalar(gear, "roll_lpstc") / degree, 19.971, 1e-3);
    check_printed("pitch point, deg", stage_scalar(gear, "roll_pitch") / degree, 20.854, 1e-3);
    check_printed("HPSTC, deg", stage_scalar(gear, "roll_hpstc") / degree, 21.737, 1e-3);
    check_printed("tip, deg", stage_scalar(gear, "roll_tip") / degree, 27.171, 1e-3);
    check_near("pitch point is at tan 20", stage_scalar(gear, "roll_pitch"), tan(20 * degree),
               1e-15);
}

static void check_radii(const stage *gear)
{
    size_t n;
    const double *r1 = stage_get(gear, "radius_1", &n), *r2 = stage_get(gear, "radius_2", NULL);
    const double *roll = stage_get(gear, "roll_angle", NULL);
    check_printed("radius at SAP, mm", 1e3 * r1[0], 17.881, 1e-3);
    check_printed("radius at tip, mm", 1e3 * r1[n - 1], 33.422, 1e-3);
    check_printed("sum of radii, mm", 1e3 * (r1[0] + r2[0]), 51.3030, 1e-4);
    check_printed("equivalent radius at SAP, mm", 1e3 * r1[0] * r2[0] / (r1[0] + r2[0]), 11.649,
                  1e-3);
    double mirrored = 0, lpstc = 0, pitch = 0;
    for (size_t i = 0; i < n; i++) {
        mirrored = fmax(mirrored, fabs(r1[i] - r2[n - 1 - i]));
        if (roll[i] == stage_scalar(gear, "roll_lpstc"))
            lpstc = r1[i] * r2[i] / (r1[i] + r2[i]);
        if (roll[i] == stage_scalar(gear, "roll_pitch"))
            pitch = r1[i];
    }
    check_printed("equivalent radius at LPSTC, mm", 1e3 * lpstc, 12.803, 1e-3);
    check_printed("radius at the pitch point, mm", 1e3 * pitch, 25.652, 1e-3);
    check_below("equal gears: the path reads the same from both ends", mirrored, 1e-16);
}

static void check_inertia(const stage *gear)
{
    double J = of_gear_1(gear, "inertia"), rb = of_gear_1(gear, "base_radius");
    check_printed("inertia of a solid disc, kg m2", J, 7.803e-3, 1e-6);
    check_near("mass of a solid disc", of_gear_1(gear, "mass"), 7850 * M_PI * 75e-3 * 75e-3 * 20e-3,
               1e-14);
    check_near("equivalent mass of equal gears", stage_scalar(gear, "equivalent_mass"),
               J / (2 * rb * rb), 1e-14);
    check_near("reduced modulus of steel", stage_scalar(gear, "reduced_modulus"), 206e9 / 0.91,
               1e-14);
}

static void check_bore(const char *bore, double printed)
{
    stage *gear = open_pair();
    stage_set_text(gear, "bore_diameter", bore);
    if (check_true(bore, stage_run(gear) == FF_OK))
        check_printed("inertia with that bore, kg m2", of_gear_1(gear, "inertia"), printed, 1e-6);
    stage_close(gear);
}

static void check_given_inertia(void)
{
    stage *gear = open_pair();
    stage_set(gear, "inertia", 7.80e-3);
    if (check_true("runs with an inertia", stage_run(gear) == FF_OK))
        check_printed("equivalent mass, kg", stage_scalar(gear, "equivalent_mass"), 0.7852, 1e-4);
    stage_close(gear);
}

static void check_circular_backlash(void)
{
    stage *gear = open_pair();
    stage_set_text(gear, "backlash_measure", "circular");
    if (check_true("runs with circular backlash", stage_run(gear) == FF_OK))
        check_printed("0.14 mm on the pitch circle, mm along the line of action",
                      1e3 * stage_scalar(gear, "backlash"), 0.1316, 1e-4);
    stage_close(gear);
}

static void check_roughness(const char *param, const char *text, double first, double second)
{
    stage *gear = open_pair();
    stage_set_text(gear, param, text);
    if (check_true(param, stage_run(gear) == FF_OK)) {
        const double *rough = stage_get(gear, "roughness", NULL);
        check_near("Rq of gear 1", rough[0], first, 1e-12);
        check_near("Rq of gear 2", rough[1], second, 1e-12);
    }
    stage_close(gear);
}

int main(void)
{
    stage *gear = open_pair();
    if (check_true("runs", stage_run(gear) == FF_OK)) {
        check_geometry(gear);
        check_roll_angles(gear);
        check_radii(gear);
        check_inertia(gear);
        check_true("no roughness", of_gear_1(gear, "roughness") == 0);
        check_true("quality is good", stage_verdict(gear) == FF_GOOD);
    }
    stage_close(gear);
    check_roughness("roughness_rq", "[0.54 um, 0.53 um]", 0.54e-6, 0.53e-6);
    check_roughness("roughness_ra", "0.4 um", 0.4e-6 * sqrt(M_PI / 2), 0.4e-6 * sqrt(M_PI / 2));
    check_bore("40 mm", 7.764e-3);
    check_bore("50 mm", 7.707e-3);
    check_bore("70 mm", 7.433e-3);
    check_given_inertia();
    check_circular_backlash();
    return check_done();
}
