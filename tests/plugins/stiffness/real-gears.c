/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stiffness of pairs from gear/involute-spur and operating/steady. */
#include "check.h"
#include "stage.h"

#include <math.h>

typedef struct chain {
    stage *gear, *duty, *mesh;
} chain;

static chain open_chain(const char *model, const char *teeth, const char *module, const char *shift,
                        const char *torque)
{
    chain c = {stage_open("gear/involute-spur"), stage_open("operating/steady"), stage_open(model)};
    stage_set_text(c.gear, "teeth", teeth);
    stage_set_text(c.gear, "module", module);
    stage_set_text(c.gear, "profile_shift", shift);
    stage_set_text(c.gear, "face_width", "20 mm");
    stage_set_text(c.duty, "torque", torque);
    stage_set_text(c.duty, "speed", "1500 rpm");
    stage_link(c.duty, "gear", c.gear);
    stage_link(c.mesh, "gear", c.gear);
    stage_link(c.mesh, "operating", c.duty);
    return c;
}

static void close_chain(chain *c)
{
    stage_close(c->mesh);
    stage_close(c->duty);
    stage_close(c->gear);
}

/* Returns the first station of the gear at LPSTC or HPSTC. */
static size_t first_at(const stage *gear, const char *point)
{
    size_t n, i = 0;
    const double *roll = stage_get(gear, "roll_angle", &n);
    while (i < n && roll[i] < stage_scalar(gear, point) - 1e-9)
        i++;
    return i;
}

static void test_pair_of_the_paper(void)
{
    chain c = open_chain("stiffness/potential-energy", "[50, 50]", "3 mm", "[0, 0]", "250 N m");
    stage_set_text(c.gear, "backlash", "0.14 mm");
    stage_set_text(c.gear, "root_diameter", "140.68 mm");
    check_true("runs", stage_run(c.gear) == FF_OK && stage_run(c.mesh) == FF_OK);
    check_true("trusted", stage_verdict(c.mesh) == FF_GOOD);
    double mean = stage_scalar(c.mesh, "stiffness_mean");
    check_true("3.x e8 N/m", mean > 3e8 && mean < 4e8);
    const double *harmonic = stage_get(c.mesh, "stiffness_harmonics", NULL);
    check_near("ratio of harmonic 1", harmonic[0] / mean, 0.229, 0.03);
    check_near("ratio of harmonic 2", harmonic[1] / mean, 0.144, 0.03);
    check_near("ratio of harmonic 3", harmonic[2] / mean, 0.068, 0.03);
    check_near("exit", stage_get(c.mesh, "breakpoints", NULL)[1], 0.75467, 1e-5);

    const double *force = stage_get(c.mesh, "tooth_force", NULL);
    size_t n, low = first_at(c.gear, "roll_lpstc"), high = first_at(c.gear, "roll_hpstc");
    stage_get(c.mesh, "tooth_force", &n);
    check_near("LPSTC and tip", force[low] + force[n - 1], 3547.26, 1e-6);
    check_near("SAP and HPSTC", force[0] + force[high + 1], 3547.26, 1e-6);
    check_near("alone", force[low + 1], 3547.26, 1e-6);
    check_near("still alone", force[high], 3547.26, 1e-6);
    close_chain(&c);
}

static void test_other_pairs(void)
{
    static const char *const pairs[][3] = {
        {"[19, 41]", "4 mm", "[0.35, 0.1]"},    {"[17, 17]", "2 mm", "[0.2, 0.2]"},
        {"[23, 120]", "1.5 mm", "[0.3, -0.3]"}, {"[80, 31]", "5 mm", "[0, 0]"},
        {"[14, 60]", "10 mm", "[0.5, 0.5]"},    {"[150, 150]", "1 mm", "[0, 0]"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        chain c = open_chain("stiffness/potential-energy", pairs[i][0], pairs[i][1], pairs[i][2],
                             "100 N m");
        check_true(pairs[i][0], stage_run(c.gear) == FF_OK && stage_run(c.mesh) == FF_OK);
        check_below("quadrature", stage_quality(c.mesh, "quadrature_error"), 1e-12);
        check_below("equilibrium", stage_quality(c.mesh, "equilibrium"), 1e-14);
        check_below("straight lines", stage_quality(c.mesh, "interpolation_error"), 1e-4);
        close_chain(&c);
    }
}

static void test_table_on_a_gear(void)
{
    static const double phase[] = {0, 0.75467, 0.75467, 1}, k[] = {4e8, 4e8, 2e8, 2e8};
    chain c = open_chain("stiffness/table", "[50, 50]", "3 mm", "[0, 0]", "250 N m");
    stage_set_reals(c.mesh, "phase", 4, phase);
    stage_set_reals(c.mesh, "stiffness", 4, k);
    stage_set_text(c.mesh, "ends", "jump");
    check_true("runs", stage_run(c.gear) == FF_OK && stage_run(c.mesh) == FF_OK);
    const double *share = stage_get(c.mesh, "load_share", NULL);
    size_t low = first_at(c.gear, "roll_lpstc"), high = first_at(c.gear, "roll_hpstc");
    check_near("SAP", share[0], 0.5, 0);
    check_near("before LPSTC", share[low], 0.5, 0);
    check_near("after LPSTC", share[low + 1], 1, 0);
    check_near("before HPSTC", share[high], 1, 0);
    check_near("after HPSTC", share[high + 1], 0.5, 0);
    check_near("F/k", stage_get(c.mesh, "loaded_transmission_error", NULL)[0], 3547.26 / 4e8, 1e-6);
    close_chain(&c);
}

/* Teeth with relief that touch late under light loads: the errors of the mean and of the amplitudes
   of k must be at most twice the mean error of linear interpolation that the model states, which
   must be at most a few times as large as they are. */
static void test_straight_lines(const char *definition)
{
    static const char *const torques[] = {"1 N m", "20 N m", "1000 N m"};
    enum { HARMONICS = 8, SETS = 3 };
    static const char *const points[] = {"6400", "50", "200"};
    for (size_t i = 0; i < sizeof torques / sizeof torques[0]; i++) {
        double fine[HARMONICS] = {0}, mean = 0;
        for (int k = 0; k < SETS; k++) {
            chain c = open_chain("stiffness/load-distribution", "[23, 67]", "4 mm", "[0.35, -0.1]",
                                 torques[i]);
            stage_set_text(c.gear, "tip_relief", "25 um");
            stage_set_text(c.mesh, "compliance", "analytical");
            stage_set_text(c.mesh, "points", points[k]);
            stage_set_text(c.mesh, "definition", definition);
            check_true(torques[i], stage_run(c.mesh) == FF_OK);
            const double *now = stage_get(c.mesh, "stiffness_harmonics", NULL);
            double stated = stage_quality(c.mesh, "interpolation_error");
            mean = k > 0 ? mean : stage_scalar(c.mesh, "stiffness_mean");
            double off = fabs(stage_scalar(c.mesh, "stiffness_mean") / mean - 1);
            for (int n = 0; n < HARMONICS; n++) {
                fine[n] = k > 0 ? fine[n] : now[n];
                off = fmax(off, fabs(now[n] - fine[n]) / mean);
            }
            check_below("amplitudes", off, 2 * stated);
            if (k > 0)
                check_below("stated", stated, 2 * off);
            close_chain(&c);
        }
    }
}

/* Results at other force levels must be those of runs with these forces. */
static void test_levels(void)
{
    static const char *const torques[] = {"90 N m", "40 N m", "160 N m"};
    static const size_t levels[] = {3, 2, 4}; /* 90 N m times 1, 4/9 and 16/9 */
    chain c[3];
    for (int i = 0; i < 3; i++) {
        c[i] = open_chain("stiffness/load-distribution", "[23, 67]", "4 mm", "[0.35, -0.1]",
                          torques[i]);
        stage_set_text(c[i].gear, "tip_relief", "12 um");
        stage_set_text(c[i].gear, "elastic_modulus", "[206 GPa, 170 GPa]");
        stage_set_text(c[i].mesh, "compliance", "analytical");
        stage_set_text(c[i].mesh, "points", "50");
        check_true(torques[i], stage_run(c[i].mesh) == FF_OK);
    }
    size_t phases, stations, count, equal = 0;
    const double *phase = stage_get(c[0].mesh, "phase", &phases);
    const double *force = stage_get(c[0].mesh, "force_level", &count);
    const double *error = stage_get(c[0].mesh, "level_error", NULL);
    const double *slope = stage_get(c[0].mesh, "level_stiffness", NULL);
    const double *teeth = stage_get(c[0].mesh, "level_tooth_force", NULL);
    const double *unloaded = stage_get(c[0].mesh, "transmission_error", NULL);
    check_true("from none to nine times the load", count == 10 && force[0] == 0);
    check_near("nine times", force[9], 9 * stage_scalar(c[0].duty, "line_force"), 1e-12);
    for (size_t i = 0; i < phases; i++)
        check_true("no load", error[i] == unloaded[i]);
    for (int i = 0; i < 3; i++) {
        size_t n, row = levels[i];
        const double *at = stage_get(c[i].mesh, "phase", &n);
        const double *alone = stage_get(c[i].mesh, "tooth_force", &stations);
        const double *loaded = stage_get(c[i].mesh, "loaded_transmission_error", NULL);
        const double *k = stage_get(c[i].mesh, "stiffness", NULL);
        double F = stage_scalar(c[i].duty, "line_force");
        check_near("force", force[row], F, 1e-12);
        for (size_t j = 0; j < stations; j++)
            check_below("tooth force", fabs(teeth[row * stations + j] - alone[j]), 1e-9 * F);
        for (size_t a = 0; a < phases; a++)
            for (size_t b = 0; b < n; b++) {
                int single = (a + 1 == phases || phase[a + 1] > phase[a]) &&
                             (a == 0 || phase[a - 1] < phase[a]);
                if (!single || fabs(at[b] - phase[a]) > 1e-12)
                    continue;
                check_near("error", error[row * phases + a], loaded[b], 1e-9);
                /* a pair that has just touched has so small a force that few digits of it are
                   exact */
                check_near("slope", slope[row * phases + a], k[b], 1e-5);
                equal++;
            }
    }
    check_true("phases of all", equal > 120);
    for (int i = 0; i < 3; i++)
        close_chain(&c[i]);
}

int main(void)
{
    test_pair_of_the_paper();
    test_other_pairs();
    test_table_on_a_gear();
    test_straight_lines("secant");
    test_straight_lines("tangent");
    test_levels();
    return check_done();
}
