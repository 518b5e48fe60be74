/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reliefs, crown, slope, measured profiles and index deviations of the 50/50 pair. */
#include <check.h>
#include <stage.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double degree = M_PI / 180;

static stage *open_pair(void)
{
    stage *s = stage_open("gear/involute-spur");
    stage_set_text(s, "teeth", "[50, 40]");
    stage_set_text(s, "module", "3 mm");
    stage_set_text(s, "face_width", "20 mm");
    return s;
}

static stage *run_with(const char *param, const char *value)
{
    stage *s = open_pair();
    stage_set_text(s, param, value);
    check_true(param, stage_run(s) == FF_OK);
    return s;
}

/* Returns the deviation of a gear at a fraction of its flank. */
static double deviation(const stage *s, size_t gear, double share)
{
    uint32_t rank;
    size_t n = stage_shape(s, "profile_roll", &rank)[1], i = 1;
    const double *roll = stage_get(s, "profile_roll", NULL) + gear * n;
    const double *value = stage_get(s, "profile_deviation", NULL) + gear * n;
    double at = roll[0] + share * (roll[n - 1] - roll[0]);
    while (i + 1 < n && roll[i] < at)
        i++;
    return value[i - 1] + (value[i] - value[i - 1]) * (at - roll[i - 1]) / (roll[i] - roll[i - 1]);
}

/* Returns the fraction of the flank of gear 1 at one of the gear's roll angles. */
static double share_of(const stage *s, const char *point)
{
    double low = stage_scalar(s, "roll_sap"), high = stage_scalar(s, "roll_tip");
    return (stage_scalar(s, point) - low) / (high - low);
}

static void test_perfect_flanks(void)
{
    stage *s = run_with("tip_relief", "0 um");
    size_t n;
    const double *value = stage_get(s, "profile_deviation", &n);
    check_true("two zeros each", n == 4 && !(fabs(value[0]) + fabs(value[3]) > 0));
    stage_get(s, "pitch_deviation_1", &n);
    check_true("a value for each tooth of gear 1", n == 50);
    stage_get(s, "pitch_deviation_2", &n);
    check_true("and of gear 2", n == 40);
    stage_close(s);
}

static void test_flanks_reach_from_contact_to_contact(void)
{
    stage *s = run_with("tip_relief", "0 um");
    size_t n;
    const double *roll = stage_get(s, "profile_roll", &n);
    const double *r1 = stage_get(s, "radius_1", &n), *r2 = stage_get(s, "radius_2", NULL);
    const double *base = stage_get(s, "base_radius", NULL);
    check_near("gear 1 low", roll[0], r1[0] / base[0], 1e-12);
    check_near("gear 1 tip", roll[1], r1[n - 1] / base[0], 1e-12);
    check_near("gear 2 low", roll[2], r2[n - 1] / base[1], 1e-12);
    check_near("gear 2 tip", roll[3], r2[0] / base[1], 1e-12);
    stage_close(s);
}

static void test_tip_relief(void)
{
    stage *s = run_with("tip_relief", "[20 um, 8 um]");
    double start = share_of(s, "roll_hpstc");
    check_near("tip 1", deviation(s, 0, 1), -20e-6, 1e-12);
    check_near("tip 2", deviation(s, 1, 1), -8e-6, 1e-12);
    check_near("nothing before HPSTC", 1 + deviation(s, 0, start - 1e-6), 1, 0);
    check_near("half way", deviation(s, 0, (1 + start) / 2), -10e-6, 1e-9);
    /* the HPSTC of gear 2 meets the LPSTC of gear 1 */
    check_near("nothing on gear 2", 1 + deviation(s, 1, 1 - share_of(s, "roll_lpstc") - 1e-6), 1,
               0);
    check_true("something above", deviation(s, 1, 1 - share_of(s, "roll_lpstc") + 1e-3) < -1e-9);
    stage_close(s);
}

static void test_parabola(void)
{
    stage *s = open_pair();
    stage_set_text(s, "tip_relief", "20 um");
    stage_set_text(s, "tip_relief_start", "23 deg");
    stage_set_text(s, "tip_relief_shape", "parabolic");
    check_true("runs", stage_run(s) == FF_OK);
    double low = stage_scalar(s, "roll_sap"), high = stage_scalar(s, "roll_tip");
    double start = (23 * degree - low) / (high - low);
    check_near("a quarter half way", deviation(s, 0, (1 + start) / 2), -5e-6, 1e-5);
    stage_close(s);
}

/* Checks that the flanks of two pairs have equal bits. */
static void check_same(const char *what, const stage *a, const stage *b)
{
    size_t n, m;
    const double *x = stage_get(a, "profile_deviation", &n);
    const double *y = stage_get(b, "profile_deviation", &m);
    const double *roll_x = stage_get(a, "profile_roll", NULL);
    const double *roll_y = stage_get(b, "profile_roll", NULL);
    check_true(what, n == m && n > 1000 && memcmp(x, y, n * sizeof *x) == 0 &&
                         memcmp(roll_x, roll_y, n * sizeof *x) == 0);
}

/* Opens a pair with reliefs on both gears, whose starts are given in one of three ways. */
static stage *relieved(const char *end, const char *way, double first, double second)
{
    char name[40];
    stage *s = open_pair();
    snprintf(name, sizeof name, "%s_relief", end);
    stage_set_text(s, name, "[20 um, 8 um]");
    snprintf(name, sizeof name, "%s_relief_%s", end, way);
    stage_set_reals(s, name, 2, (double[]){first, second});
    check_true(name, stage_run(s) == FF_OK);
    return s;
}

/* Returns the roll angle at a diameter, sqrt(r^2 - r_b^2)/r_b. */
static double roll_of(double base, double diameter)
{
    return sqrt((diameter / 2 - base) * (diameter / 2 + base)) / base;
}

static void test_start_as_drawn(void)
{
    stage *plain = run_with("tip_relief", "0 um");
    const double *base = stage_get(plain, "base_radius", NULL);
    const double *tip = stage_get(plain, "tip_radius", NULL);
    const double *foot = stage_get(plain, "active_root_radius", NULL);
    const struct {
        const char *end;
        double d[2];
    } of[] = {{"tip", {153.21e-3, 124.87e-3}}, {"root", {147.66e-3, 117.43e-3}}};
    for (size_t k = 0; k < 2; k++) {
        const double roll[2] = {roll_of(base[0], of[k].d[0]), roll_of(base[1], of[k].d[1])};
        const double *at = k == 0 ? tip : foot;
        double length[2];
        for (size_t g = 0; g < 2; g++)
            length[g] = base[g] * fabs(roll_of(base[g], 2 * at[g]) - roll[g]);
        stage *angle = relieved(of[k].end, "start", roll[0], roll[1]);
        stage *diameter = relieved(of[k].end, "diameter", of[k].d[0], of[k].d[1]);
        stage *along = relieved(of[k].end, "length", length[0], length[1]);
        check_same("by diameter as by roll angle", diameter, angle);
        for (size_t g = 0; g < 2; g++)
            for (int i = 0; i <= 10; i++)
                check_below("by length as by roll angle, m",
                            fabs(deviation(along, g, i / 10.0) - deviation(angle, g, i / 10.0)),
                            1e-15);
        stage_close(angle);
        stage_close(diameter);
        stage_close(along);
    }
    stage_close(plain);
}

/* A relief of the whole flank, whose start has a diameter 3 um below the lowest point of
   contact. */
static void test_rounded_start(void)
{
    stage *plain = run_with("tip_relief", "0 um");
    const double *foot = stage_get(plain, "active_root_radius", NULL);
    stage *s = relieved("tip", "diameter", 2 * foot[0] - 3e-6, 2 * foot[1]);
    check_near("starts at the lowest contact", deviation(s, 0, 0.5), -10e-6, 1e-9);
    stage_close(s);
    stage_close(plain);
}

static void test_root_relief(void)
{
    stage *s = run_with("root_relief", "12 um");
    double start = share_of(s, "roll_lpstc");
    check_near("lowest contact", deviation(s, 0, 0), -12e-6, 1e-12);
    check_near("half way", deviation(s, 0, start / 2), -6e-6, 1e-9);
    check_near("nothing above LPSTC", 1 + deviation(s, 0, start + 1e-6), 1, 0);
    stage_close(s);
}

static void test_crown_and_slope(void)
{
    stage *s = open_pair();
    stage_set_text(s, "crowning", "6 um");
    stage_set_text(s, "profile_slope", "[4 um, -4 um]");
    check_true("runs", stage_run(s) == FF_OK);
    check_near("low", deviation(s, 0, 0), -8e-6, 1e-9);
    check_near("middle", 1 + deviation(s, 0, 0.5), 1, 1e-12);
    check_near("tip", deviation(s, 0, 1), -4e-6, 1e-9);
    check_near("gear 2, tip", deviation(s, 1, 1), -8e-6, 1e-9);
    check_near("quarter", deviation(s, 0, 0.25), -1.5e-6 - 1e-6, 1e-5);
    stage_close(s);
}

static void test_pitch_error(void)
{
    stage *s = open_pair();
    stage_set_text(s, "pitch_error", "[3 um, -2 um]");
    stage_set_text(s, "pitch_error_2", "[1 um]");
    check_true("runs", stage_run(s) == FF_OK);
    const double *one = stage_get(s, "pitch_deviation_1", NULL);
    check_near("first", one[0], 3e-6, 1e-12);
    check_near("second", one[1], -2e-6, 1e-12);
    check_near("others", 1 + one[49], 1, 0);
    check_near("gear 2", stage_get(s, "pitch_deviation_2", NULL)[0], 1e-6, 1e-12);
    stage_close(s);
}

static int write_file(char *path, const char *text)
{
    strcpy(path, "/tmp/flankfilm-curve-XXXXXX");
    int descriptor = mkstemp(path);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "w");
    if (!file)
        return 0;
    fputs(text, file);
    return fclose(file) == 0;
}

static void test_measured_profile(void)
{
    char path[64];
    check_true("written", write_file(path, "# measured\ngear; roll_angle [deg]; deviation [um]\n"
                                           "1; 10; 0\n1; 20; -4\n1; 30; 6\n2;20;1\n"));
    stage *s = run_with("profile_file", path);
    double low = stage_scalar(s, "roll_sap"), high = stage_scalar(s, "roll_tip");
    check_near("at a point", deviation(s, 0, (20 * degree - low) / (high - low)), -4e-6, 1e-9);
    check_near("between", deviation(s, 0, (25 * degree - low) / (high - low)), 1e-6, 1e-6);
    check_near("one point is a constant", deviation(s, 1, 0.3), 1e-6, 1e-12);
    stage_close(s);
    unlink(path);
}

static void expect_refusal(stage *s, const char *item, const char *sentence)
{
    ff_status status = stage_ready(s);
    printf("%s: %s\n", stage_why_item(s), stage_why(s));
    check_true(sentence, status == FF_INVALID && !strcmp(stage_why_item(s), item) &&
                             strstr(stage_why(s), sentence));
    stage_close(s);
}

static void refuse_file(const char *text, const char *sentence)
{
    char path[64];
    check_true("written", write_file(path, text));
    stage *s = open_pair();
    stage_set_text(s, "profile_file", path);
    expect_refusal(s, "profile_file", sentence);
    unlink(path);
}

#define HEADER "gear, roll_angle [deg], deviation [um]\n"

static void test_refusals(void)
{
    stage *s = open_pair();
    stage_set_text(s, "tip_relief", "20 um");
    stage_set_text(s, "tip_relief_start", "13 deg");
    expect_refusal(s, "tip_relief_start",
                   "gear 1: the relief starts at the roll angle 13.0000 deg");
    s = open_pair();
    stage_set_text(s, "tip_relief", "20 um");
    stage_set_text(s, "tip_relief_diameter", "[153 mm, 131 mm]");
    expect_refusal(s, "tip_relief_diameter",
                   "gear 2: the relief starts at the diameter 131.0000 mm");
    s = open_pair();
    stage_set_text(s, "root_relief", "20 um");
    stage_set_text(s, "root_relief_length", "[3 mm, 0 mm]");
    expect_refusal(s, "root_relief_length", "gear 2: the relief starts where it ends");
    s = open_pair();
    stage_set_text(s, "root_relief_start", "[20 deg, 40 deg]");
    expect_refusal(s, "root_relief_start", "gear 2");
    s = open_pair();
    double many[41] = {0};
    stage_set_reals(s, "pitch_error_2", 41, many);
    expect_refusal(s, "pitch_error_2", "41 index deviations for the 40 teeth");
    s = open_pair();
    check_true("no such file", stage_try_text(s, "profile_file", "/no/such/file") == FF_INVALID &&
                                   !strcmp(stage_why_item(s), "profile_file"));
    stage_close(s);
    refuse_file("", "the file has no header");
    refuse_file(HEADER, "has no rows");
    refuse_file("gear, roll_angle [deg], deviation [furlong]\n", ":1:25: the unit \"furlong\"");
    refuse_file("gear, roll_angle [deg]\n1, 2\n", "the column \"deviation [um]\" is missing");
    refuse_file(HEADER "3, 20, 0\n", ":2:1: gear must be at most 2, but is 3");
    refuse_file(HEADER "1.5, 20, 0\n", ":2:1: gear must be a whole number");
    refuse_file(HEADER "1, 20, 0\n1, 20, 1\n", ":3:4: the roll angles of a gear must increase");
    refuse_file(HEADER "1, 20\n", ":2:1: 2 fields in this line, but 3 in the header");
    refuse_file(HEADER "1, 20, nan\n", ":2:8: \"nan\" is not a number");
}

int main(void)
{
    test_perfect_flanks();
    test_flanks_reach_from_contact_to_contact();
    test_tip_relief();
    test_parabola();
    test_start_as_drawn();
    test_rounded_start();
    test_root_relief();
    test_crown_and_slope();
    test_pitch_error();
    test_measured_profile();
    test_refusals();
    return check_done();
}
