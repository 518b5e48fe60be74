/* SPDX-License-Identifier: GPL-3.0-or-later */
/* dynamics/coupled: known solutions, comparison with rigid bearings, and extreme parameters. */
#include "check.h"
#include "pair.h"

#include <complex.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double mass[2] = {2.7, 2.7},
                    base_radius[2] = {0.075 * 0.93969262078590838, 0.075 * 0.93969262078590838};
static const double centre = 0.15, alpha = M_PI / 9;

static stage *open_pair(const pair *p, double bearing, const char *settings)
{
    stage *s = pair_open("dynamics/coupled", p);
    stage_give_series(s, "gear.base_radius", 2, base_radius);
    stage_give_scalar(s, "gear.centre_distance", centre);
    stage_give_series(s, "gear.mass", 2, mass);
    stage_set(s, "bearing_stiffness", bearing);
    char copy[256], *at = NULL;
    snprintf(copy, sizeof copy, "%s", settings);
    for (char *word = strtok_r(copy, " =", &at); word; word = strtok_r(NULL, " =", &at))
        stage_set_text(s, word, strtok_r(NULL, " =", &at));
    return s;
}

static stage *run(const pair *p, double bearing, const char *settings)
{
    stage *s = open_pair(p, bearing, settings);
    check_true(settings, stage_run(s) == FF_OK);
    return s;
}

static double involute(double angle)
{
    return tan(angle) - angle;
}

/* Makes a constant mesh stiffness: the load fraction of each tooth pair increases linearly from 0
   to 1 and decreases again, so that all add up to 1, except if the path of contact becomes
   shorter. */
static pair even_pair(double frequency)
{
    pair p = pair_cosine(frequency, 0, 0, 8);
    for (int i = 0; i < PAIR_STATIONS; i++) {
        double q = 0.2 * i;
        p.roll[i] = 0.25 + q * 2 * M_PI / 50;
        p.load_share[i] = fmin(q, 2 - q);
        p.tooth_force[i] = p.load_share[i] * p.line_force;
    }
    return p;
}

/* The bearings must deflect along the line of action until they carry F; backlash, pressure angle
   and contact ratio must be those of the new centre distance. Since the path of contact becomes
   shorter, the stiffness decreases by (dC/p)^2, 1e-7 at 1e9 N/m. */
static void test_rest(void)
{
    const double bearings[] = {1e9, 1e10, 1e11};
    for (int i = 0; i < 3; i++) {
        double kb = bearings[i], base = 2 * base_radius[0], rx = 0, ry = 0, angle = alpha;
        pair p = even_pair(2000);
        for (int n = 0; n < 100; n++) {
            double turn = atan2(ry, centre + rx);
            angle = acos(base / hypot(centre + rx, ry));
            rx = 2 * p.line_force / kb * sin(angle - turn);
            ry = 2 * p.line_force / kb * cos(angle - turn);
        }
        double C = hypot(centre + rx, ry), half_gap = p.backlash / 2;
        half_gap += base * (involute(angle) - involute(alpha));
        double ratio =
            2 - (C * sin(angle) - centre * sin(alpha)) / (base_radius[0] * 2 * M_PI / 50);
        stage *s = run(&p, kb, "damping_ratio=0.1 bearing_damping_ratio=0.3");
        printf("bearings of %g N/m\n", kb);
        check_near("s at rest", stage_scalar(s, "dte_mean"),
                   half_gap + p.line_force / p.stiffness_mean, 1e-6);
        check_below("rms at rest", stage_scalar(s, "dte_rms") / half_gap, 1e-6);
        check_near("centre distance", stage_get(s, "centre_distance", NULL)[3], C, 1e-9);
        check_near("pressure angle", stage_get(s, "pressure_angle", NULL)[3], angle, 1e-8);
        check_near("backlash", stage_get(s, "backlash", NULL)[3], 2 * half_gap, 1e-6);
        check_near("contact ratio", stage_get(s, "contact_ratio", NULL)[3], ratio, 1e-7);
        check_near("bearing force", stage_get(s, "bearing_force", NULL)[1], p.line_force, 1e-4);
        check_near("mesh force", stage_get(s, "mesh_force", NULL)[5], p.line_force, 1e-4);
        stage_close(s);
    }
}

/* Constant stiffness without damping: the natural frequencies of mesh and gears on bearings follow
   from (k/me - w^2)(kb/m + 2 k/m - w^2) = 2 k^2/(me m), and are sqrt(kb/m) for motions that do not
   deform the mesh. The rotation of the force with the line of action changes them by about F/(k C),
   1e-4. */
static void test_frequencies(void)
{
    pair p = even_pair(2000);
    double kb = 4e8, k = p.stiffness_mean, m = mass[0], me = p.mass;
    double a = k / me, b = kb / m + 2 * k / m, half = (a + b) / 2;
    double root = sqrt(half * half - (a * b - 2 * k * k / (me * m)));
    double squares[3] = {half - root, half + root, kb / m};
    stage *s = open_pair(
        &p, kb, "damping_ratio=0 bearing_damping_ratio=0 cycles_settle=20 cycles_measured=1");
    check_true("runs", stage_run(s) == FF_OK);
    const double *mu = stage_get(s, "multipliers", NULL);
    for (int i = 0; i < 3; i++) {
        double turn = sqrt(squares[i]) / p.mesh_frequency, nearest = 9;
        for (int n = 0; n < 10; n++)
            nearest = fmin(nearest, cabs(mu[2 * n] + I * mu[2 * n + 1] - cexp(I * turn)));
        check_below("a multiplier has the angle of the frequency", nearest, 2e-3);
    }
    check_below("moduli are 1", fabs(stage_scalar(s, "floquet_max") - 1), 1e-5);
    stage_close(s);
}

/* Compares the times, over the mesh period, and speeds at which the flanks touch again. */
static void compare_landings(const pair *p, const stage *stiff, const stage *stiffer,
                             const stage *rigid)
{
    static const char *const names[] = {"landing_time", "landing_speed"};
    size_t count = stage_count(rigid, names[0]);
    check_true("as many landings",
               stage_count(stiff, names[0]) == count && stage_count(stiffer, names[0]) == count);
    for (size_t i = 0; i < 2 * count; i++) {
        const char *name = names[i % 2];
        double a = stage_get(stiff, name, NULL)[i / 2], z = stage_get(stiffer, name, NULL)[i / 2];
        double exact = stage_get(rigid, name, NULL)[i / 2];
        double unit = i % 2 ? exact : 1 / p->mesh_frequency, first = fabs(z - exact) / unit;
        check_below(name, first, 5e-2);
        check_below("what is left is of second order", fabs(2 * z - a - exact) / unit,
                    fmax(1e-3, 10 * first * first));
    }
}

/* For stiff bearings, the difference to rigid bearings is proportional to their compliance, which
   shifts the resonance by k/kb = 2e-3 of its frequency, 0.1 of its width: extrapolation from two
   stiffnesses must give the motion with rigid bearings. Returns the fraction of the time with
   contact on the back flanks. */
static double compare_with_rigid(const pair *p, const char *branch, const char *damping)
{
    static const char *const names[] = {"dte_rms",      "dte_mean",     "dynamic_factor_mesh",
                                        "contact_loss", "back_contact", "dynamic_factor_tooth"};
    char settings[128];
    snprintf(settings, sizeof settings, "branch=%s damping=%s bearing_damping_ratio=0.1", branch,
             damping);
    printf("%g Hz, %s, damping %s\n", p->mesh_frequency, branch, damping);
    stage *stiff = run(p, 1e11, settings), *stiffer = run(p, 2e11, settings);
    stage *rigid = pair_open("dynamics/time-integration", p);
    stage_set_text(rigid, "branch", branch);
    stage_set_text(rigid, "damping", damping);
    check_true("runs", stage_run(rigid) == FF_OK);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        double a = stage_scalar(stiff, names[i]), z = stage_scalar(stiffer, names[i]);
        double exact = stage_scalar(rigid, names[i]), unit = fmax(fabs(exact), 0.1);
        unit = exact > 0 && exact < 1e-3 ? exact : unit;
        double first = fabs(z - exact) / unit;
        check_below(names[i], first, 2e-2);
        check_below("what is left is of second order", fabs(2 * z - a - exact) / unit,
                    fmax(1e-3, 10 * first * first));
    }
    compare_landings(p, stiff, stiffer, rigid);
    double largest = stage_scalar(rigid, "floquet_max");
    check_near("largest multiplier", stage_scalar(stiffer, "floquet_max"), largest, 5e-3);
    check_near("period", stage_scalar(stiffer, "period"), 1, 0);
    check_below("energy balance", stage_quality(stiffer, "energy_balance"), 1e-9);
    /* contact on the back flanks with the stiffness of the driving flanks is outside the range of
       the model */
    bool trusted = pair_is_trusted(stiffer);
    check_true("is trusted", trusted || stage_has_quality(stiffer, "back_flank"));
    double back = stage_scalar(stiffer, "back_contact");
    stage_close(stiff);
    stage_close(stiffer);
    stage_close(rigid);
    return back;
}

/* Motions with contact on both flanks in a small backlash, and with loss of contact in a large
   one. */
static void test_stiff_bearings(void)
{
    pair p = pair_trapezoid(2900);
    p.backlash *= 0.05;
    check_true("touches its back flanks", compare_with_rigid(&p, "upper", "always") > 0.3);
    p = pair_trapezoid(3240);
    compare_with_rigid(&p, "upper", "contact");
}

/* The impulse of the damper at a jump of e, in both directions. */
static void test_jump_on_stiff_bearings(void)
{
    pair p = pair_trapezoid(1800);
    const double phase[] = {0, 0.4, 0.4, 1}, error[] = {0, -2e-6, 1e-6, 3e-6},
                 k[] = {3.6e8, 3.6e8, 3.6e8, 3.6e8};
    p.phases = 4;
    memcpy(p.phase, phase, sizeof phase);
    memcpy(p.stiffness, k, sizeof k);
    memcpy(p.error, error, sizeof error);
    compare_with_rigid(&p, "lower", "always");
}

/* A motion that starts from that of a nearby speed must stay on its branch, at a speed where a run
   without start finds another branch. */
static void test_chain(void)
{
    static const char alone[] = "damping_ratio=0.02 tolerance=1e-7",
                      first[] = "branch=upper damping_ratio=0.02 tolerance=1e-7";
    static const double speed[3] = {2000, 1950, 1900};
    pair pairs[3];
    stage *last = NULL;
    double rms = 0, cycles = 0;
    for (int i = 0; i < 3; i++) {
        pairs[i] = pair_trapezoid(speed[i]);
        stage *s = open_pair(&pairs[i], 2e9, i ? alone : first);
        stage_ready(s);
        check_true("a state is handed on", !last || stage_carry(s, last));
        check_true("runs", stage_run(s) == FF_OK);
        rms = stage_scalar(s, "dte_rms");
        cycles = stage_quality(s, "settled_cycles");
        stage_close(last);
        last = s;
    }
    stage_close(last);
    stage *upper = run(&pairs[2], 2e9, first), *lower = run(&pairs[2], 2e9, alone);
    check_near("stays on the upper branch", rms, stage_scalar(upper, "dte_rms"), 1e-5);
    check_true("the lower one is another", stage_scalar(lower, "dte_rms") < 0.9 * rms);
    check_below("cycles from the neighbour", cycles, 30);
    stage_close(upper);
    stage_close(lower);
}

/* Bearings as soft as the mesh must change the motion. */
static void test_soft_bearings(void)
{
    const char *dampings[] = {"always", "contact", "clipped"};
    for (int i = 0; i < 3; i++) {
        char settings[64];
        snprintf(settings, sizeof settings, "damping=%s bearing_damping_ratio=0.05", dampings[i]);
        pair p = pair_trapezoid(3000);
        stage *s = run(&p, 5e8, settings);
        check_below("energy balance", stage_quality(s, "energy_balance"), 1e-8);
        size_t count;
        const double *C = stage_get(s, "centre_distance", &count);
        check_true("the centres move apart", C[0] > centre && C[count / 2] > centre);
        stage_close(s);
    }
}

/* When contact is lost, the damper force may be negative, unless it is limited to positive
   values. */
static void test_clipped(void)
{
    for (int clipped = 0; clipped < 2; clipped++) {
        pair p = pair_trapezoid(2375);
        stage *s = run(&p, 1e10,
                       clipped ? "branch=upper damping=clipped bearing_damping_ratio=0.1"
                               : "branch=upper damping=always bearing_damping_ratio=0.1");
        size_t count;
        const double *force = stage_get(s, "mesh_force", &count);
        double least = force[0];
        for (size_t k = 0; k < count; k++)
            least = fmin(least, force[k]);
        check_true(clipped ? "never pulls" : "pulls", clipped ? least >= 0 : least < 0);
        stage_close(s);
    }
}

/* No backlash, no backlash and no load, a light load with impacts, very high speed: results must be
   finite, or the run must stop with a reason. */
static void test_extremes(void)
{
    pair p = pair_trapezoid(2375);
    p.backlash = 0;
    stage *s = run(&p, 1e10, "bearing_damping_ratio=0.1");
    check_below("energy balance", stage_quality(s, "energy_balance"), 1e-8);
    stage_close(s);
    p = pair_trapezoid(2000);
    p.line_force = 0;
    memset(p.tooth_force, 0, sizeof p.tooth_force);
    s = run(&p, 1e9, "");
    check_below("stays", stage_scalar(s, "dte_rms"), 1e-12);
    stage_close(s);
    p = pair_trapezoid(1400);
    p.line_force = 12;
    for (int i = 0; i < PAIR_STATIONS; i++)
        p.tooth_force[i] = 12 * p.load_share[i];
    for (size_t i = 0; i < p.phases; i++)
        p.error[i] = 20e-6 * sin(2 * M_PI * p.phase[i]);
    s = run(&p, 1e9, "damping=clipped cycles_settle=100 cycles_measured=4");
    check_true("touches both flanks", stage_scalar(s, "contact_loss") > 0);
    check_below("energy balance", stage_quality(s, "energy_balance"), 1e-8);
    stage_close(s);
    p = pair_trapezoid(50 * pair_natural_frequency);
    s = run(&p, 1e9, "damping_ratio=0.1 bearing_damping_ratio=0.2");
    check_below("hardly moves", stage_scalar(s, "dte_rms"), 1e-8);
    stage_close(s);
    p = pair_trapezoid(0.01);
    s = open_pair(&p, 1e12, "");
    check_true("too slow", stage_run(s) == FF_NOCONV && stage_why(s)[0]);
    stage_close(s);
}

static void test_jump_of_error(void)
{
    pair p = pair_trapezoid(1800);
    const double phase[] = {0, 0.4, 0.4, 1}, error[] = {0, 0, 8e-6, 8e-6},
                 k[] = {4e8, 4e8, 3e8, 3e8};
    p.phases = 4;
    memcpy(p.phase, phase, sizeof phase);
    memcpy(p.stiffness, k, sizeof k);
    memcpy(p.error, error, sizeof error);
    p.stiffness_mean = pair_mean(&p);
    stage *s = run(&p, 1e9, "damping_ratio=0.05 bearing_damping_ratio=0.1");
    check_below("energy balance", stage_quality(s, "energy_balance"), 1e-8);
    stage_close(s);
}

static void test_refused(void)
{
    static const double zero[2] = {0, 0}, small = 0.1;
    pair p = pair_trapezoid(2375);
    stage *s = open_pair(&p, 1e9, "");
    stage_give_series(s, "gear.base_radius", 2, zero);
    check_true("no base circle",
               stage_run(s) == FF_INVALID && !strcmp(stage_why_item(s), "gear.base_radius"));
    stage_close(s);
    s = open_pair(&p, 1e9, "");
    stage_give_scalar(s, "gear.centre_distance", small);
    check_true("centres too near",
               stage_run(s) == FF_INVALID && !strcmp(stage_why_item(s), "gear.centre_distance"));
    stage_close(s);
    s = open_pair(&p, 1e9, "");
    stage_stop_at(s, 2);
    check_true("stops when told", stage_run(s) == FF_STOPPED);
    stage_close(s);
}

int main(void)
{
    test_rest();
    test_frequencies();
    test_stiff_bearings();
    test_jump_on_stiff_bearings();
    test_chain();
    test_soft_bearings();
    test_clipped();
    test_extremes();
    test_jump_of_error();
    test_refused();
    return check_done();
}
