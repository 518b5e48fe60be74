/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scuffing: the flash temperature against Blok's formula in SI and against the other form that the
   standard prints, the integral temperature by hand for two pairs, and what both say of the test
   gears at the stage at which the oil fails. */
#include "pair.h"

#include <check.h>

#include <math.h>
#include <string.h>

static const double degree = M_PI / 180;

/* Flash temperature at the highest point of single contact with friction coefficient mu. */
static double blok(const pair *p, double mu, double place, double line, double ratio)
{
    double omega = p->rpm * 2 * M_PI / 60, u1 = omega * place, u2 = omega / ratio * (line - place);
    double R = place * (line - place) / line, E = 206e9 / 0.91, B = sqrt(50 * 7850 * 484.0);
    double load = p->torque / (4.5e-3 * p->teeth[0] / 2 * cos(20 * degree)) / (p->width * 1e-3);
    double half_width = sqrt(8 * load * R / (M_PI * E));
    return 1.11 * mu * load * fabs(u1 - u2) / (B * (sqrt(u1) + sqrt(u2)) * sqrt(2 * half_width));
}

/* ISO/TR 13989-1, formula A.5, in mm and N/mm. */
static double by_factors(const pair *p, double mu, double place, double angle, double ratio)
{
    double base = 4.5 * p->teeth[0] / 2 * cos(20 * degree),
           beside = 1e3 * place / (base * tan(angle)) - 1;
    double X_ab =
        1.22 * pow(sin(angle) * cos(20 * degree), 0.25) / sqrt(cos(angle) * cos(20 * degree));
    double X_G = 0.51 * X_ab * sqrt(ratio + 1) * fabs(sqrt(1 + beside) - sqrt(1 - beside / ratio)) /
                 (pow(1 + beside, 0.25) * pow(ratio - beside, 0.25));
    double w = p->torque / (4.5e-3 * p->teeth[0] / 2) / p->width,
           speed = p->rpm * 2 * M_PI / 60 * 36.6e-3;
    return mu * 50.04 * X_G * pow(w, 0.75) * sqrt(speed) / pow(91.5, 0.25);
}

/* The constants of formula 5 are printed to three digits, and its load is that of the pitch circle,
   6 % less than the normal one: 2.3 % less than Blok's. */
static void check_flash(const pair *p)
{
    stage *oil, *s = pair_open("rating/scuffing", p, &oil);
    stage_set(s, "load_stage", 12);
    stage_set(s, "points", 2000);
    if (check_true("a pair is rated", stage_run(s) == FF_OK)) {
        size_t n;
        const double *roll = stage_get(s, "roll_angle", &n),
                     *flash = stage_get(s, "flash_temperature", NULL);
        double ratio = p->teeth[1] / p->teeth[0],
               base = 4.5e-3 * p->teeth[0] / 2 * cos(20 * degree);
        double angle = acos(base * (1 + ratio) / 91.5e-3), line = 91.5e-3 * sin(angle),
               mu = stage_scalar(s, "friction_coefficient");
        double upper = roll[0] + 2 * M_PI / p->teeth[0], least = HUGE_VAL, at_upper = NAN;
        for (size_t i = 0; i < n; i++) {
            least = fmin(least, flash[i]);
            if (roll[i] <= upper)
                at_upper = flash[i];
        }
        check_near("at HPSTC it is Blok's", at_upper, blok(p, mu, upper * base, line, ratio), 0.03);
        check_near("and that of the factors", at_upper,
                   by_factors(p, mu, upper * base, angle, ratio), 0.04);
        check_below("pure rolling has none", least / at_upper, 2e-3);
    }
    stage_close(s);
    stage_close(oil);
}

/* ISO/TR 13989-2 for a pair without relief of class 6, in mm, N/mm, mPa s and degC. */
static void check_integral(const pair *p, double stage_of_failure)
{
    stage *oil, *s = pair_open("rating/scuffing", p, &oil);
    stage_set(s, "load_stage", stage_of_failure);
    if (check_true("a pair is rated by integral temperature", stage_run(s) == FF_OK)) {
        double a = 20 * degree, db1 = 4.5 * p->teeth[0] * cos(a), db2 = 4.5 * p->teeth[1] * cos(a);
        double u = p->teeth[1] / p->teeth[0], aw = acos((db1 + db2) / 183),
               rho = u / ((1 + u) * (1 + u)) * 91.5 * sin(aw);
        double w = 2000 * p->torque / (4.5 * p->teeth[0]) / p->width,
               v = M_PI * 183 / (1 + u) * p->rpm / 60000;
        double mu = 0.045 * pow(w / (2 * v * tan(aw) * cos(a) * rho), 0.2) *
                    pow(oil_viscosity(oil, p->oil), -0.05) * 2.2 * pow(p->roughness / rho, 0.25);
        double e1 = p->teeth[0] / (2 * M_PI) * (tan(acos(db1 / p->tip_diameter[0])) - tan(aw));
        double e2 = p->teeth[1] / (2 * M_PI) * (tan(acos(db2 / p->tip_diameter[1])) - tan(aw));
        double r1 = sqrt(p->tip_diameter[0] * p->tip_diameter[0] - db1 * db1) / 2,
               r2 = 91.5 * sin(aw) - r1;
        double X_ab = 1.22 * pow(sin(aw) * cos(a), 0.25) / sqrt(cos(aw) * cos(a));
        double X_B = 0.51 * sqrt(u + 1) * (sqrt(r1) - sqrt(r2 / u)) / pow(r1 * r2, 0.25),
               e = fmax(e1, e2);
        double X_eps = e1 < 1
                           ? 0.7 * (e1 * e1 + e2 * e2) - 0.22 * (e1 + e2) + 0.52 - 0.6 * e1 * e2
                           : 0.18 * e1 * e1 + 0.7 * e2 * e2 + 0.82 * e1 - 0.52 * e2 - 0.3 * e1 * e2;
        double mean = mu * 50.04 * X_B * X_ab * pow(w, 0.75) * sqrt(v) / pow(91.5, 0.25) /
                      (1 + 0.06 * e + 0.02 * e * e) * X_eps / (2 * (e1 + e2) * e1);
        double T = 3.726 * stage_of_failure * stage_of_failure,
               nu = 1e3 * oil_viscosity(oil, 40) / oil_density(oil, 40);
        check_near("integral temperature by hand", stage_scalar(s, "integral_temperature") - 273.15,
                   p->oil + 2.2 * mean, 1e-3);
        check_near("permissible one by hand",
                   stage_get(s, "permissible_temperature", NULL)[1] - 273.15,
                   80 + 0.23 * T + 0.3 * T * pow(100 / nu, 0.02), 1e-9);
    }
    stage_close(s);
    stage_close(oil);
}

/* The scuffing temperature was drawn from this gear: near 1 both safeties must be. It is less with
 * a load stage less. */
static void check_test_gear(void)
{
    double safety[2][2];
    for (int k = 0; k < 2; k++) {
        stage *oil, *s = pair_open("rating/scuffing", &pair_a, &oil);
        stage_set(s, "load_stage", k == 0 ? 12 : 11);
        check_true("the test gear is rated", stage_run(s) == FF_OK);
        memcpy(safety[k], stage_get(s, "safety", NULL), sizeof safety[k]);
        stage_close(s);
        stage_close(oil);
    }
    check_near("the test gear fails at its stage by flash temperature", safety[0][0], 1, 0.25);
    check_near("and by integral temperature", safety[0][1], 1, 0.25);
    check_true("an oil that fails a stage before is less safe",
               safety[1][0] < safety[0][0] && safety[1][1] < safety[0][1]);
}

/* What cannot be told is said: own outputs without losses and without the test's temperature,
 * flanks without roughness. */
static void check_refusals(void)
{
    static const double smooth[] = {0, 0};
    stage *oil, *s = pair_open("rating/scuffing", &pair_c, &oil);
    stage_set(s, "load_stage", 12);
    check_true("own temperature without losses",
               stage_run_wanted(s, "own_contact_temperature_max") != FF_OK &&
                   strstr(stage_why(s), "losses"));
    stage_give_scalar(s, "losses.contact_temperature_max", 450);
    check_true("own safety without the test gear's",
               stage_run_wanted(s, "own_safety") != FF_OK &&
                   strstr(stage_why(s), "test_contact_temperature"));
    stage_set_text(s, "test_contact_temperature", "220 degC");
    if (check_true("own safety", stage_run_wanted(s, "own_safety") == FF_OK))
        check_near("is over the oil", stage_scalar(s, "own_safety"),
                   (220 - 90) / (450 - 273.15 - 90), 1e-12);
    stage_give_series(s, "gear.roughness", 2, smooth);
    check_true("no roughness", stage_run(s) == FF_INVALID && strstr(stage_why(s), "roughness_ra"));
    stage_close(s);
    stage_close(oil);
}

int main(void)
{
    check_flash(&pair_a);
    check_flash(&pair_c);
    check_integral(&pair_a, 12);
    check_integral(&pair_c, 9);
    check_test_gear();
    check_refusals();
    return check_done();
}
