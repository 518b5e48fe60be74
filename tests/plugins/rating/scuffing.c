/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scuffing: compares the flash temperature with Blok's formula in SI units and with the standard's
   other form, and the integral temperature with a calculation here for two pairs. Checks the safety
   of the test gears at the load stage at which the oil fails. */
#include "pair.h"

#include <check.h>

#include <math.h>
#include <string.h>

static const double degree = M_PI / 180;

/* Returns the flash temperature at a point of contact with friction coefficient mu. */
static double blok(const pair *p, double mu, double place, double line, double ratio)
{
    double omega = p->rpm * 2 * M_PI / 60, u1 = omega * place, u2 = omega / ratio * (line - place);
    double R = place * (line - place) / line, E = 206e9 / 0.91, B = sqrt(50 * 7850 * 484.0);
    double load = p->torque / (4.5e-3 * p->teeth[0] / 2 * cos(20 * degree)) / (p->width * 1e-3);
    double half_width = sqrt(8 * load * R / (M_PI * E));
    return 1.11 * mu * load * fabs(u1 - u2) / (B * (sqrt(u1) + sqrt(u2)) * sqrt(2 * half_width));
}

/* Returns the flash temperature by ISO/TR 13989-1, formula A.5, in mm and N/mm. */
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

/* Opens a rating with the steel of ISO/TR 13989-2, clause 5.3. */
static stage *open_scuffing(const pair *p, stage **oil)
{
    stage *s = pair_open("rating/scuffing", p, oil);
    stage_set_text(s, "thermal_conductivity", "50 W/(m K)");
    stage_set_text(s, "density", "7850 kg/m3");
    stage_set_text(s, "specific_heat", "484 J/(kg K)");
    return s;
}

/* Formula 5 has constants of three digits, and the load on the pitch circle, 6 % below the normal
   load: its result is 2.3 % below Blok's. */
static void check_flash(const pair *p)
{
    stage *oil, *s = open_scuffing(p, &oil);
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

/* Too little relief at the tip of the driven gear, gear 2, increases the temperature at the begin
   of contact: X_J by formulas 45 and 46, from a run with little and a run with sufficient
   relief. */
static void check_approach(const pair *p)
{
    pair relieved = *p;
    double at[2], roll = NAN;
    relieved.relief[1] = 1e3;
    for (int k = 0; k < 2; k++) {
        stage *oil, *s = open_scuffing(k == 0 ? p : &relieved, &oil);
        stage_set(s, "load_stage", 12);
        check_true("a relieved pair is rated", stage_run(s) == FF_OK);
        at[k] = stage_get(s, "flash_temperature", NULL)[0];
        roll = stage_get(s, "roll_angle", NULL)[0];
        stage_close(s);
        stage_close(oil);
    }
    const double base[2] = {4.5 * p->teeth[0] * cos(20 * degree) / 2,
                            4.5 * p->teeth[1] * cos(20 * degree) / 2};
    const double angle = acos((base[0] + base[1]) / 91.5), tip = p->tip_diameter[0] / 2;
    const double sap = roll * base[0], end = sqrt(tip * tip - base[0] * base[0]),
                 pitch = base[0] * tan(angle);
    const double best = 1e3 * p->torque / base[0] / p->width / 20; /* C_eff, um */
    check_near("a tip that comes in", at[0] / at[1],
               1 + (best - p->relief[1]) / 50 * pow((pitch - sap) / (end - sap), 3), 1e-9);
}

/* Returns the contact ratio factor, formulas 39 to 44, without the denominator 2 e e1. */
static double overlap(double e1, double e2)
{
    return e1 >= 1   ? 0.18 * e1 * e1 + 0.7 * e2 * e2 + 0.82 * e1 - 0.52 * e2 - 0.3 * e1 * e2
           : e2 >= 1 ? 0.7 * e1 * e1 + 0.18 * e2 * e2 - 0.52 * e1 + 0.82 * e2 - 0.3 * e1 * e2
                     : 0.7 * (e1 * e1 + e2 * e2) - 0.22 * (e1 + e2) + 0.52 - 0.6 * e1 * e2;
}

/* ISO/TR 13989-2 for a pair of accuracy class 6, in mm, N/mm, mPa s and degC. Index 1 of the
   standard is the pinion, whichever gear drives; X_Q and X_Ca depend on the driving gear. */
static void check_integral(const pair *p, double stage_of_failure)
{
    stage *oil, *s = open_scuffing(p, &oil);
    stage_set(s, "load_stage", stage_of_failure);
    if (check_true("a pair is rated by integral temperature", stage_run(s) == FF_OK)) {
        const int one = p->teeth[1] < p->teeth[0], two = 1 - one, driving = 0, driven = 1;
        double a = 20 * degree, db[2], e[2];
        const double aw = acos(4.5 * (p->teeth[0] + p->teeth[1]) * cos(a) / 183);
        for (int i = 0; i < 2; i++) {
            db[i] = 4.5 * p->teeth[i] * cos(a);
            e[i] = p->teeth[i] / (2 * M_PI) * (tan(acos(db[i] / p->tip_diameter[i])) - tan(aw));
        }
        double u = p->teeth[two] / p->teeth[one], rho = u / ((1 + u) * (1 + u)) * 91.5 * sin(aw);
        double w = 2000 * p->torque / (4.5 * p->teeth[0]) / p->width,
               v = M_PI * 183 * p->teeth[0] / (p->teeth[0] + p->teeth[1]) * p->rpm / 60000;
        double mu = 0.045 * pow(w / (2 * v * tan(aw) * cos(a) * rho), 0.2) *
                    pow(oil_viscosity(oil, p->oil), -0.05) * 2.2 * pow(p->roughness / rho, 0.25);
        double r1 = sqrt(p->tip_diameter[one] * p->tip_diameter[one] - db[one] * db[one]) / 2,
               r2 = 91.5 * sin(aw) - r1;
        double X_ab = 1.22 * pow(sin(aw) * cos(a), 0.25) / sqrt(cos(aw) * cos(a));
        double X_B = 0.51 * sqrt(u + 1) * (sqrt(r1) - sqrt(r2 / u)) / pow(r1 * r2, 0.25);
        double in = e[driven] / e[driving], longer = fmax(e[0], e[1]);
        double X_Q = in <= 1.5 ? 1 : in >= 3 ? 0.6 : 1.4 - 4 * in / 15;
        double relief = p->relief[e[driving] > 1.5 * e[driven] ? driving : driven],
               share = fmin(1, relief / (w / 14));
        double X_Ca = 1 + (0.06 + 0.18 * share) * longer + (0.02 + 0.69 * share) * longer * longer;
        const double X_M = pow(206e3 / 0.91, 0.25) * 1000 / sqrt(50 * 7850 * 484) * pow(10, 1.5);
        double mean = mu * X_M * X_B * X_ab * pow(w, 0.75) * sqrt(v) / pow(91.5, 0.25) /
                      (X_Q * X_Ca) * overlap(e[one], e[two]) / (2 * (e[0] + e[1]) * e[one]);
        double T = 3.726 * stage_of_failure * stage_of_failure,
               nu = 1e3 * oil_viscosity(oil, 40) / oil_density(oil, 40);
        check_near("integral temperature by hand", stage_scalar(s, "integral_temperature") - 273.15,
                   p->oil + 2.2 * mean, 1e-9);
        check_near("permissible one by hand",
                   stage_get(s, "permissible_temperature", NULL)[1] - 273.15,
                   80 + 0.23 * T + 0.3 * T * pow(100 / nu, 0.02), 1e-9);
    }
    stage_close(s);
    stage_close(oil);
}

/* The scuffing temperature comes from tests with this gear: both safety factors must be near 1. An
   oil that fails one load stage earlier must have a lower scuffing temperature. */
static void check_test_gear(void)
{
    double safety[2][2];
    for (int k = 0; k < 2; k++) {
        stage *oil, *s = open_scuffing(&pair_a, &oil);
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

/* Missing data must be reported: losses, the temperature of the test, roughness of the flanks. */
static void check_refusals(void)
{
    static const double smooth[] = {0, 0};
    stage *oil, *s = open_scuffing(&pair_c, &oil);
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

/* Returns the mean contact temperature of the pair with relief, for accuracy classes of its gears
   (0: none given) and of the rating. */
static double temperature_with(double class_1, double class_2, const char *grade)
{
    pair p = pair_c;
    p.relief[0] = 24, p.relief[1] = 11;
    stage *oil, *s = open_scuffing(&p, &oil);
    const double of_gears[] = {class_1, class_2};
    stage_give_series(s, "gear.flank_class", 2, of_gears);
    if (grade)
        stage_set_text(s, "quality_grade", grade);
    stage_set(s, "load_stage", 9);
    check_true("runs", stage_run(s) == FF_OK);
    double sum = 0;
    size_t n;
    const double *of_path = stage_get(s, "contact_temperature", &n);
    for (size_t i = 0; i < n; i++)
        sum += of_path[i] / (double)n;
    stage_close(s);
    stage_close(oil);
    return sum;
}

/* The class of the less accurate gear must be used, unless the rating has a class; without any
   class, 6. */
static void check_class(void)
{
    double coarse = temperature_with(0, 0, "10"), fine = temperature_with(0, 0, "6");
    check_true("the class matters", fabs(coarse / fine - 1) > 1e-3);
    check_near("gear 2 is coarser", temperature_with(5, 10, NULL), coarse, 1e-14);
    check_near("gear 1 is coarser", temperature_with(10, 5, NULL), coarse, 1e-14);
    check_near("the rating's own", temperature_with(5, 10, "6"), fine, 1e-14);
    check_near("none known", temperature_with(0, 0, NULL), fine, 1e-14);
}

int main(void)
{
    check_class();
    check_flash(&pair_a);
    check_flash(&pair_c);
    const pair *const pairs[] = {&pair_a, &pair_c};
    for (int k = 0; k < 2; k++) {
        pair relieved = *pairs[k];
        relieved.relief[0] = 24, relieved.relief[1] = 11;
        const pair reversed = pair_reversed(pairs[k]), both = pair_reversed(&relieved);
        const pair *const all[] = {pairs[k], &reversed, &relieved, &both};
        for (int i = 0; i < 4; i++) {
            check_approach(all[i]);
            check_integral(all[i], k == 0 ? 12 : 9);
        }
    }
    check_test_gear();
    check_refusals();
    return check_done();
}
