/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Published gear pairs, with all digits of their sources. Each must run as published, and agree
   with the published results to half the last digit, plus the effect of rounded profile shifts, and
   with a separate calculation here. Helical stages are given in their transverse section. "hand":
   the source has no result for the gear pair alone. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

static const double degree = M_PI / 180;

/* A published result, in `unit` of SI, for a gear or the pair (gear -1). half: half a unit of the
   last digit. */
typedef struct printed {
    const char *output;
    int gear;
    double unit, value, half;
} printed;

enum { MOST = 14 };

typedef struct published {
    const char *name, *source;
    double teeth[2], module, angle, width; /* mm, deg */
    double shift[2], distance, tip[2];     /* mm; 0: not given */
    double dedendum;                       /* over the module; 0: not given */
    const char *backlash;                  /* NULL: not given */
    printed values[MOST];
} published;

#define PAIR -1
#define MM   1e-3

static const published corpus[] = {
    {"FZG C, 14 mm wide, and FZG C-PT without its relief",
     "cfernandesFEUP/GEARpie, REPORT/C14.txt",
     {16, 24},
     4.5,
     20,
     14,
     {0.1817, 0.1715},
     91.5,
     {82.456, 118.364},
     0,
     NULL,
     {{"root_radius", 0, MM, 31.193, 5e-4},
      {"root_radius", 1, MM, 49.147, 5e-4},
      {"pitch_radius", 0, MM, 36.600, 5e-4},
      {"pitch_radius", 1, MM, 54.900, 5e-4},
      {"base_pitch", PAIR, MM, 13.285, 5e-4},
      {"path_length", PAIR, MM, 19.10, 5e-3},
      {"contact_ratio", PAIR, 1, 1.44, 5e-3},
      {"lpstc", PAIR, MM, 5.81, 5e-3},
      {"pitch", PAIR, MM, 9.50, 5e-3},
      {"hpstc", PAIR, MM, 13.28, 5.01e-3},
      {"line", PAIR, MM, 34.93, 5e-3}}},
    {"FZG C, 40 mm wide, tips not shortened",
     "cfernandesFEUP/GEARpie, REPORT/C40.txt",
     {16, 24},
     4.5,
     20,
     40,
     {0.1817, 0.1715},
     91.5,
     {82.636, 118.544},
     0,
     NULL,
     {{"base_radius", 0, MM, 33.829, 5e-4},
      {"base_radius", 1, MM, 50.743, 5e-4},
      {"tip_radius", 0, MM, 41.318, 5e-4},
      {"tip_radius", 1, MM, 59.272, 5e-4},
      {"path_length", PAIR, MM, 19.43, 5e-3},
      {"contact_ratio", PAIR, 1, 1.46, 5e-3},
      {"lpstc", PAIR, MM, 6.14, 5.01e-3},
      {"pitch", PAIR, MM, 9.68, 5e-3},
      {"hpstc", PAIR, MM, 13.28, 5.01e-3},
      {"line", PAIR, MM, 34.93, 5e-3}}},
    {"FZG A",
     "ISO 14635-1, test A/8.3/90: hand",
     {16, 24},
     4.5,
     20,
     20,
     {0.8530, -0.5000},
     91.5,
     {88.77, 112.5},
     0,
     NULL,
     {{0}}},
    {"20/41, module 2",
     "cfernandesFEUP/GEARpie, REPORT/NEW.txt",
     {20, 41},
     2,
     20,
     10,
     {0, 0},
     61,
     {0, 0},
     0,
     NULL,
     {{"root_radius", 0, MM, 17.500, 5e-4},
      {"root_radius", 1, MM, 38.500, 5e-4},
      {"tip_radius", 0, MM, 22.000, 5e-4},
      {"tip_radius", 1, MM, 43.000, 5e-4},
      {"base_pitch", PAIR, MM, 5.904, 5e-4},
      {"contact_ratio", PAIR, 1, 1.64, 5e-3},
      {"line", PAIR, MM, 20.86, 5e-3},
      {"lpstc", PAIR, MM, 3.76, 5e-3},
      {"pitch", PAIR, MM, 5.07, 5e-3},
      {"hpstc", PAIR, MM, 5.90, 5e-3},
      {"path_length", PAIR, MM, 9.67, 5e-3}}},
    {"S30, 30/30, POM",
     "cfernandesFEUP/GEARpie, REPORT/S30.txt",
     {30, 30},
     2,
     20,
     15,
     {0, 0},
     60,
     {0, 0},
     0,
     NULL,
     {{"base_radius", 0, MM, 28.191, 5e-4},
      {"contact_ratio", PAIR, 1, 1.65, 5e-3},
      {"line", PAIR, MM, 20.52, 5e-3},
      {"lpstc", PAIR, MM, 3.86, 5e-3},
      {"pitch", PAIR, MM, 4.88, 5e-3},
      {"path_length", PAIR, MM, 9.76, 5e-3}}},
    {"NREL 5 MW gearbox, stage 1, sun and planet",
     "gfsReboucas/Drivetrain, @NREL_5MW/stage_01.rtf",
     {19, 17},
     45,
     20,
     491,
     {0.6170, 0.8021},
     863,
     {978.808, 905.470},
     0,
     NULL,
     {{"working_pressure_angle", PAIR, M_PI / 180, 28.118, 5e-4},
      {"base_radius", 0, MM / 2, 803.437, 5e-4},
      {"base_radius", 1, MM / 2, 718.865, 5e-4},
      {"root_radius", 0, MM / 2, 798.030, 5e-4},
      {"root_radius", 1, MM / 2, 724.692, 3.5e-3},
      {"active_root_radius", 0, MM / 2, 845.350, 2e-3},
      {"active_root_radius", 1, MM / 2, 762.541, 2e-3},
      {"tip_thickness", 0, MM, 32.599, 2e-3},
      {"tip_thickness", 1, MM, 26.588, 4e-3},
      {"base_pitch", PAIR, MM, 132.846, 5e-4},
      {"path_length", PAIR, MM, 148.093, 2e-3},
      {"contact_ratio", PAIR, 1, 1.115, 5e-4}}},
    {"NREL 5 MW gearbox, stage 2, sun and planet",
     "gfsReboucas/Drivetrain, @NREL_5MW/stage_02.rtf",
     {18, 36},
     21,
     20,
     550,
     {0.3890, 0.5039},
     584,
     {432.838, 815.663},
     0,
     NULL,
     {{"working_pressure_angle", PAIR, M_PI / 180, 24.169, 5e-4},
      {"base_radius", 0, MM / 2, 355.204, 5e-4},
      {"base_radius", 1, MM / 2, 710.408, 5e-4},
      {"root_radius", 0, MM / 2, 341.838, 5e-4},
      {"root_radius", 1, MM / 2, 724.663, 2e-3},
      {"active_root_radius", 0, MM / 2, 363.547, 2e-3},
      {"active_root_radius", 1, MM / 2, 746.983, 2e-3},
      {"tip_thickness", 0, MM, 12.910, 2e-3},
      {"tip_thickness", 1, MM, 14.858, 2e-3},
      {"base_pitch", PAIR, MM, 61.995, 5e-4},
      {"path_length", PAIR, MM, 84.952, 2e-3},
      {"contact_ratio", PAIR, 1, 1.370, 5e-4}}},
    /* normal module 14 mm, 10 deg, x 0.4800 and 0.6691: m_n/cos, atan(tan/cos), x cos */
    {"NREL 5 MW gearbox, stage 3, transverse section of helical gears",
     "gfsReboucas/Drivetrain, @NREL_5MW/stage_03.rtf",
     {24, 95},
     14.2159726,
     20.2835588,
     360,
     {0.4727077, 0.6589350},
     861,
     {380.747, 1395.376},
     0,
     NULL,
     {{"working_pressure_angle", PAIR, M_PI / 180, 22.856, 5e-4},
      {"base_radius", 0, MM / 2, 320.026, 5e-4},
      {"base_radius", 1, MM / 2, 1266.770, 6e-4},
      {"pitch_radius", 0, MM / 2, 347.294, 5e-4},
      {"pitch_radius", 1, MM / 2, 1374.706, 5e-4},
      {"active_root_radius", 0, MM / 2, 330.798, 1e-3},
      {"active_root_radius", 1, MM / 2, 1348.584, 1e-3},
      {"base_pitch", PAIR, MM, 41.891, 5e-4},
      {"path_length", PAIR, MM, 61.276, 1e-3},
      {"line", PAIR, MM, 334.426, 5e-4},
      {"contact_ratio", PAIR, 1, 1.463, 5e-4}}},
    {"handbook pair, 12/24, module 3",
     "bolsover.com, Profile Shifted External Spur Gears",
     {12, 24},
     3,
     20,
     20,
     {0.6, 0.36},
     56.500,
     {0, 0},
     0,
     NULL,
     {{"working_pressure_angle", PAIR, M_PI / 180, 26.0888, 5e-5},
      {"base_radius", 0, MM / 2, 33.8289, 5e-5},
      {"base_radius", 1, MM / 2, 67.6579, 5e-5},
      {"pitch_radius", 0, MM / 2, 37.667, 5e-4},
      {"pitch_radius", 1, MM / 2, 75.333, 5e-4},
      {"tip_radius", 0, MM / 2, 44.840, 5e-4},
      {"tip_radius", 1, MM / 2, 79.400, 5e-4},
      {"root_radius", 0, MM / 2, 32.100, 5e-4},
      {"root_radius", 1, MM / 2, 66.660, 5e-4},
      {"contact_ratio", PAIR, 1, 1.202, 5e-4}}},
    /* tips are not shortened: m (z + 2 + 2 x) */
    {"DIN 3990-11 example, 19/104, module 4",
     "a public test of its implementation",
     {19, 104},
     4,
     20,
     48.64,
     {0.5, 0.15},
     0,
     {88, 425.2},
     0,
     NULL,
     {{"working_pressure_angle", PAIR, M_PI / 180, 21.5319, 5e-5},
      {"centre_distance", PAIR, MM, 248.506843, 5e-7},
      {"contact_ratio", PAIR, 1, 1.53632, 5e-6}}},
    {"unity ratio pair, 50/50, module 3",
     "Li & Kahraman 2011, Table 1 and text",
     {50, 50},
     3,
     20,
     20,
     {0, 0},
     0,
     {156, 156},
     0,
     "0.14 mm",
     {{"roll_sap", PAIR, M_PI / 180, 14.5, 0.05},
      {"roll_lpstc", PAIR, M_PI / 180, 20.0, 0.05},
      {"roll_hpstc", PAIR, M_PI / 180, 21.7, 0.05},
      {"roll_tip", PAIR, M_PI / 180, 27.2, 0.05}}},
    /* The pitch diameter from which the module follows, 92.74 mm, has two decimals, too. The source
       has 87.73 mm for the start of the active profile, but its tips and centre distance give
       87.79. */
    {"power-loss gears, 40/40, 28 deg",
     "Petry-Johnson et al. 2008",
     {40, 40},
     2.3185,
     28,
     26.7,
     {-0.291, -0.291},
     91.5,
     {95.95, 95.95},
     0,
     NULL,
     {{"base_radius", 0, MM / 2, 81.89, 9e-3}}},
    /* The source also has 22.56 deg, from base radii with three digits, 2 x 3.76/8.143; full digits
       give 22.60. */
    {"textbook pair, diametral pitch 2",
     "Shigley, Mechanical Engineering Design, Example 13-1",
     {16, 40},
     12.7,
     20,
     76.2,
     {0, 0},
     361.95,
     {228.6, 533.4},
     0,
     NULL,
     {{"base_radius", 0, 25.4 * MM, 3.76, 5e-3},
      {"base_radius", 1, 25.4 * MM, 9.40, 5e-3},
      {"pitch_radius", 0, 12.7 * MM, 8.143, 5e-4},
      {"pitch_radius", 1, 12.7 * MM, 20.357, 5e-4}}},
    {"textbook pair, diametral pitch 6",
     "Norton, Machine Design, example of gear mesh parameters",
     {19, 37},
     25.4 / 6,
     20,
     50.8,
     {0, 0},
     0,
     {0, 0},
     0,
     NULL,
     {{"centre_distance", PAIR, 25.4 * MM, 4.667, 5e-4},
      {"path_length", PAIR, 25.4 * MM, 0.798, 5e-4},
      {"contact_ratio", PAIR, 1, 1.62, 5e-3}}},
    {"gear noise rig, 28/28, diametral pitch 8",
     "Oswald et al. 1996, NASA TM-107223: hand",
     {28, 28},
     3.175,
     20,
     6.35,
     {0, 0},
     88.9,
     {0, 0},
     0,
     NULL,
     {{0}}},
    {"long addendum, contact ratio above 2",
     "range of Liou et al. 1992, NASA TM-105606, 1.20 to 2.40: hand",
     {28, 28},
     3.175,
     20,
     6.35,
     {0, 0},
     88.9,
     {97.79, 97.79},
     1.65,
     NULL,
     {{0}}},
    {"few teeth, 12/60",
     "range of freecad.gears#65 and bd_warehouse#38: hand",
     {12, 60},
     3,
     20,
     20,
     {0.35, 0},
     0,
     {0, 0},
     0,
     "0.2 mm",
     {{0}}},
    {"few teeth, 8/40",
     "range of freecad.gears#65 and bd_warehouse#38: hand",
     {8, 40},
     1,
     20,
     8,
     {0.55, 0},
     0,
     {0, 0},
     0,
     "0.05 mm",
     {{0}}},
    {"micro gears, 30/60, module 0.3",
     "no publication found: hand",
     {30, 60},
     0.3,
     20,
     3,
     {0, 0},
     13.5,
     {9.6, 18.6},
     0,
     NULL,
     {{0}}},
    {"open mill drive, 21/112, module 10",
     "no publication found, an open gear of the field: hand",
     {21, 112},
     10,
     20,
     200,
     {0.3, -0.3},
     665,
     {0, 0},
     0,
     NULL,
     {{0}}},
    {"19/41, module 4, rounded centre distance",
     "no publication found: hand",
     {19, 41},
     4,
     20,
     30,
     {0.35, 0.1},
     121.712,
     {0, 0},
     0,
     NULL,
     {{0}}},
};
enum { PAIRS = sizeof corpus / sizeof corpus[0] };

static stage *open_pair(const published *p)
{
    stage *s = stage_open("gear/involute-spur");
    stage_set_reals(s, "teeth", 2, p->teeth);
    stage_set(s, "module", p->module * MM);
    stage_set(s, "pressure_angle", p->angle * degree);
    stage_set(s, "face_width", p->width * MM);
    stage_set_reals(s, "profile_shift", 2, p->shift);
    if (p->distance > 0)
        stage_set(s, "centre_distance", p->distance * MM);
    if (p->tip[0] > 0)
        stage_set_reals(s, "tip_diameter", 2, (double[]){p->tip[0] * MM, p->tip[1] * MM});
    if (p->dedendum > 0)
        stage_set(s, "dedendum", p->dedendum);
    if (p->backlash)
        stage_set_text(s, "backlash", p->backlash);
    return s;
}

/* Returns an output, or a distance along the line of action: from the begin of contact to "lpstc",
   "pitch" or "hpstc"; "line": between the tangent points on the base circles. */
static double given(const stage *s, const printed *v)
{
    const double base = stage_get(s, "base_radius", NULL)[0];
    const double from = stage_scalar(s, "roll_sap");
    if (!strcmp(v->output, "lpstc"))
        return base * (stage_scalar(s, "roll_lpstc") - from);
    if (!strcmp(v->output, "pitch"))
        return base * (stage_scalar(s, "roll_pitch") - from);
    if (!strcmp(v->output, "hpstc"))
        return base * (stage_scalar(s, "roll_hpstc") - from);
    if (!strcmp(v->output, "line"))
        return stage_scalar(s, "centre_distance") * sin(stage_scalar(s, "working_pressure_angle"));
    return v->gear == PAIR ? stage_scalar(s, v->output) : stage_get(s, v->output, NULL)[v->gear];
}

static double check_printed(const stage *s, const published *p)
{
    double worst = 0;
    for (size_t i = 0; i < MOST && p->values[i].output; i++) {
        const printed *v = &p->values[i];
        const double value = given(s, v) / v->unit;
        worst = fmax(worst, fabs(value / v->value - 1));
        check_near(v->output, value, v->value, v->half / v->value);
    }
    return worst;
}

static double involute(double angle)
{
    return tan(angle) - angle;
}

/* Returns the working pressure angle, from the centre distance, or by bisection for teeth without
   backlash. */
static double working_angle(const published *p)
{
    const double a = p->angle * degree, sum = p->teeth[0] + p->teeth[1];
    if (p->distance > 0)
        return acos(p->module * sum * cos(a) / (2 * p->distance));
    const double fit = involute(a) + 2 * (p->shift[0] + p->shift[1]) * tan(a) / sum;
    double low = 0, high = 1.4;
    for (int i = 0; i < 200; i++) {
        const double middle = (low + high) / 2;
        *(involute(middle) < fit ? &low : &high) = middle;
    }
    return low;
}

/* Checks the contact ratio with the pressure angles at the tips, sum z_i (tan a_a,i - tan a_w)/(2
   pi), and the sliding factors, while the model uses lengths. */
static void check_by_hand(const stage *s, const published *p)
{
    const double a = p->angle * degree, w = working_angle(p);
    const double distance = p->module * (p->teeth[0] + p->teeth[1]) * cos(a) / (2 * cos(w));
    const double shortening =
        distance - p->module * ((p->teeth[0] + p->teeth[1]) / 2 + p->shift[0] + p->shift[1]);
    double ratio = 0, tangent[2];
    for (int i = 0; i < 2; i++) {
        const double standard = p->module * (p->teeth[i] + 2 + 2 * p->shift[i]);
        const double tip = p->tip[i] > 0 ? p->tip[i] : standard + 2 * fmin(0, shortening);
        tangent[i] = tan(acos(p->module * p->teeth[i] * cos(a) / tip));
        ratio += p->teeth[i] * (tangent[i] - tan(w)) / (2 * M_PI);
    }
    check_near("contact ratio by hand", stage_scalar(s, "contact_ratio"), ratio, 1e-10);
    check_near("working angle by hand", stage_scalar(s, "working_pressure_angle"), w, 1e-12);
    check_near("tip's roll angle by hand", stage_scalar(s, "roll_tip"), tangent[0], 1e-10);
    check_near("first contact's roll angle by hand", stage_scalar(s, "roll_sap"),
               tan(w) - p->teeth[1] / p->teeth[0] * (tangent[1] - tan(w)), 1e-9);
}

int main(void)
{
    int with_print = 0;
    for (size_t i = 0; i < PAIRS; i++) {
        const published *p = &corpus[i];
        stage *s = open_pair(p);
        printf("%s (%s)\n", p->name, p->source);
        if (check_true("runs", stage_run(s) == FF_OK && stage_quality(s, "pitch_error") < 1e-12)) {
            const double worst = check_printed(s, p);
            check_by_hand(s, p);
            if (p->values[0].output)
                printf("largest difference from the print: %.2g\n", worst);
            with_print += p->values[0].output != NULL;
        } else {
            printf("%s\n", stage_why(s));
        }
        stage_close(s);
    }
    check_true("20 pairs, 8 of them with printed results", PAIRS >= 20 && with_print >= 8);
    return check_done();
}
