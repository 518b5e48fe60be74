/* SPDX-License-Identifier: GPL-3.0-or-later */
/* stiffness/load-distribution for the 50/50 pair of Li & Kahraman 2011. */
#include "chain.h"
#include "check.h"
#include "pair.h"

#include <math.h>
#include <string.h>
#include <time.h>

static const char model[] = "stiffness/load-distribution";
static const double force = 3547.26;

static double mean_with(const char *param, const char *value)
{
    chain c = chain_with(model, "250 N m", param, value);
    double mean = stage_scalar(c.mesh, "stiffness_mean");
    chain_close(&c);
    return mean;
}

static void test_tooth_force(void)
{
    chain c = chain_with(model, "250 N m", NULL, NULL);
    size_t n, low = chain_station(&c, "roll_lpstc"), high = chain_station(&c, "roll_hpstc");
    const double *share = stage_get(c.mesh, "load_share", &n);
    check_true("0.40 F at SAP", fabs(share[0] - 0.40) < 0.02);
    check_true("0.60 F before LPSTC", fabs(share[low] - 0.60) < 0.02);
    for (size_t i = low + 1; i <= high; i++)
        check_near("F between LPSTC and HPSTC", share[i], 1, 1e-14);
    double mirrored = 0;
    for (size_t i = 0; i < n; i++)
        mirrored = fmax(mirrored, fabs(share[i] - share[n - 1 - i]));
    check_below("mirrored", mirrored, 1e-10);
    check_near("SAP and HPSTC", share[0] + share[high + 1], 1, 1e-10);
    check_below("equilibrium", stage_quality(c.mesh, "equilibrium"), 1e-10);
    check_below("complementarity", stage_quality(c.mesh, "complementarity"), 1e-12);
    check_below("reciprocity", stage_quality(c.mesh, "reciprocity"), 1e-10);
    check_true("trusted", stage_verdict(c.mesh) == FF_GOOD);
    check_near("force", stage_get(c.mesh, "tooth_force", NULL)[low + 1], force, 1e-6);
    chain_close(&c);
}

static void test_size_of_the_stiffness(void)
{
    static const char *const bores[] = {"50 mm", "70 mm", "100 mm"};
    double last = 0;
    for (int i = 0; i < 3; i++) {
        double mean = mean_with("gear.bore_diameter", bores[i]);
        check_true("between 3.0e8 and 4.6e8 N/m", mean > 3.0e8 && mean < 4.6e8);
        check_true("a wider bore is stiffer", mean > last);
        last = mean;
    }
    double standard = mean_with(NULL, NULL);
    check_true("a deeper root is softer", mean_with("gear.root_diameter", "140.68 mm") < standard);
    check_true("plane stress is softer", mean_with("mesh.plane", "stress") < standard);
    check_true("coupling is softer", mean_with("mesh.neighbour_coupling", "false") > standard);
    check_true("sharp fillets are softer", mean_with("gear.tool_tip_radius", "0.1") < standard);
}

/* With `plane: stress`, the contact still has plane strain. The line contact_in_plane_strain is the
   increase of the deflection if the contact had plane stress, too. Over the force, it must decrease
   by Q ln 10 with ten times the load, Q: difference of 2/(pi E b) and 2 (1 - nu^2)/(pi E b). */
static void test_contact_in_plane_strain(void)
{
    double add[2] = {0};
    for (int i = 0; i < 2; i++) {
        chain c = chain_with(model, i ? "500 N m" : "50 N m", "mesh.plane", "stress");
        size_t n, middle = 0;
        const double *phase = stage_get(c.mesh, "phase", &n);
        double at = stage_scalar(c.gear, "contact_ratio") / 2;
        while (middle + 1 < n && phase[middle + 1] < at)
            middle++;
        double more = stage_quality(c.mesh, "contact_in_plane_strain");
        check_true("some per cent", more > 0.01 && more < 0.06);
        add[i] = more * stage_get(c.mesh, "loaded_transmission_error", NULL)[middle] /
                 (force * (i ? 500 : 50) / 250);
        chain_close(&c);
    }
    double softening = 2 * 0.09 / (M_PI * 206e9 * 0.02) * log(10);
    check_near("less under load", add[0] - add[1], softening, 1e-4);
}

static void test_mesh_convergence(void)
{
    double fine = mean_with("mesh.elements_per_tooth", "3600");
    check_near("900 elements", mean_with(NULL, NULL), fine, 5e-4);
    check_near("450 elements", mean_with("mesh.elements_per_tooth", "450"), fine, 2e-3);
}

/* A single pair has 1/k = C + P - Q ln f with Q = 2 (1 - nu^2)/(pi E b), f: its force; only this
   term depends on the load. */
static void test_torque_stiffens_by_hertz_alone(void)
{
    chain low = chain_with(model, "50 N m", NULL, NULL),
          high = chain_with(model, "500 N m", NULL, NULL);
    size_t n;
    const double *a = stage_get(low.mesh, "stiffness", &n),
                 *b = stage_get(high.mesh, "stiffness", NULL);
    double softening = 2 * 0.91 / (M_PI * 206e9 * 0.02) * log(10);
    check_near("single pair", 1 / a[n - 1] - 1 / b[n - 1], softening, 1e-9);
    check_true("the mean too", stage_scalar(high.mesh, "stiffness_mean") >
                                   stage_scalar(low.mesh, "stiffness_mean"));
    chain_close(&low);
    chain_close(&high);
}

static void test_definitions(void)
{
    chain at = chain_with(model, "250 N m", "mesh.definition", "tangent"),
          more = chain_with(model, "250.01 N m", "mesh.definition", "secant"),
          less = chain_with(model, "249.99 N m", NULL, NULL);
    size_t n;
    const double *k = stage_get(at.mesh, "stiffness", &n);
    const double *up = stage_get(more.mesh, "loaded_transmission_error", NULL),
                 *down = stage_get(less.mesh, "loaded_transmission_error", NULL);
    double rise = force * 0.02 / 250, worst = 0;
    for (size_t i = 0; i < n; i++)
        worst = fmax(worst, fabs(rise / (up[i] - down[i]) / k[i] - 1));
    check_below("tangent is dF/d(e_l)", worst, 1e-6);
    const double *secant = stage_get(more.mesh, "stiffness", NULL);
    check_near("secant is F/e_l", secant[7] * up[7], force * 250.01 / 250, 1e-6);
    chain_close(&at);
    chain_close(&more);
    chain_close(&less);
}

/* Unequal gears in exchanged order: `a` pitches after the begin of contact correspond to contact
   ratio minus `a`. */
static void test_swapped_driver(void)
{
    chain a = chain_open(model, "100 N m"), b = chain_open(model, "178.2608695652174 N m");
    const struct {
        chain *c;
        const char *teeth, *shift, *modulus, *bore;
    } sides[2] = {{&a, "[23, 41]", "[0.3, -0.1]", "[206 GPa, 110 GPa]", "[20 mm, 50 mm]"},
                  {&b, "[41, 23]", "[-0.1, 0.3]", "[110 GPa, 206 GPa]", "[50 mm, 20 mm]"}};
    for (int i = 0; i < 2; i++) {
        stage_set_text(sides[i].c->gear, "teeth", sides[i].teeth);
        stage_set_text(sides[i].c->gear, "profile_shift", sides[i].shift);
        stage_set_text(sides[i].c->gear, "elastic_modulus", sides[i].modulus);
        stage_set_text(sides[i].c->gear, "bore_diameter", sides[i].bore);
        stage_set_text(sides[i].c->gear, "tip_relief", i ? "[4 um, 8 um]" : "[8 um, 4 um]");
        stage_set_text(sides[i].c->mesh, "corner_contact", "true");
        stage_set_text(sides[i].c->mesh, "definition", "secant"); /* its mean converges faster */
    }
    check_near("mean", chain_mean(&a), chain_mean(&b), 1e-5);
    check_near("bodies of both gears", stage_quality(a.mesh, "half_plane"),
               stage_quality(b.mesh, "half_plane"), 1e-9);
    size_t n;
    const double *here = stage_get(a.mesh, "load_share", &n),
                 *there = stage_get(b.mesh, "load_share", NULL);
    double worst = 0;
    for (size_t i = 0; i < n; i++)
        worst = fmax(worst, fabs(here[i] - there[n - 1 - i]));
    check_below("shares", worst, 1e-6);
    chain_close(&a);
    chain_close(&b);
}

static double largest_step(const double *value, size_t n)
{
    double worst = 0;
    for (size_t i = 1; i < n; i++)
        worst = fmax(worst, fabs(value[i] - value[i - 1]));
    return worst;
}

static void test_corner_contact(void)
{
    static const char *const torques[] = {"25 N m", "100 N m", "250 N m"};
    double last = 0;
    for (int i = 0; i < 3; i++) {
        chain c = chain_open(model, torques[i]);
        stage_set_text(c.mesh, "corner_contact", "true");
        stage_set_text(c.gear, "stations", "2000");
        chain_run(&c);
        size_t n, points, low = chain_station(&c, "roll_lpstc");
        const double *share = stage_get(c.mesh, "load_share", &n);
        double ratio = stage_scalar(c.mesh, "loaded_contact_ratio");
        check_near("no jump at LPSTC", share[low], share[low + 1], 1e-12);
        check_true("no jump anywhere", largest_step(share, n) < 0.02);
        check_true("the loaded contact ratio grows", ratio > fmax(last, 1.7547));
        last = ratio;
        const double *w = stage_get(c.mesh, "engagement_force", &points);
        const double *roll = stage_get(c.mesh, "engagement_roll", NULL);
        check_true("from nothing to nothing", !(w[0] > 0) && !(w[points - 1] > 0));
        check_true("before SAP, after the tip",
                   roll[0] < stage_scalar(c.gear, "roll_sap") - 0.01 &&
                       roll[points - 1] > stage_scalar(c.gear, "roll_tip") + 0.01);
        check_below("equilibrium", stage_quality(c.mesh, "equilibrium"), 1e-10);
        chain_close(&c);
    }
    check_true("about 2", last > 1.9 && last < 2.1);
}

/* Long teeth, with two or three pairs in contact. */
static void test_high_contact_ratio(void)
{
    spur_pair p = spur_pair_make(60, 60, 3e-3, 1.3, 0, 0);
    stage *s = stage_open(model), *corner = stage_open(model);
    feed_path(s, &p);
    feed_teeth(s, &p);
    feed_path(corner, &p);
    feed_teeth(corner, &p);
    stage_set_text(corner, "corner_contact", "true");
    check_true("between 2 and 3", p.contact_ratio > 2.1 && p.contact_ratio < 2.9);
    check_true("run", stage_run(s) == FF_OK && stage_run(corner) == FF_OK);
    size_t n;
    const double *pairs = stage_get(s, "pairs_in_contact", &n);
    check_true("three pairs, then two", pairs[1] > 2.5 && pairs[n - 1] < 2.5 && pairs[n - 1] > 1.5);
    check_below("equilibrium", stage_quality(s, "equilibrium"), 1e-10);
    check_below("with corners", stage_quality(corner, "equilibrium"), 1e-10);
    check_true("longer contact", stage_scalar(corner, "loaded_contact_ratio") > p.contact_ratio);
    const double *share = stage_get(s, "load_share", &n);
    check_near("mirrored", share[3], share[n - 4], 1e-9);
    stage_close(s);
    stage_close(corner);
}

/* Without load, contact must be only where the gap is 0, on the path of contact. */
static void test_corner_contact_vanishes_with_the_load(void)
{
    chain c = chain_with(model, "0.001 N m", "mesh.corner_contact", "true");
    check_near("loaded contact ratio", stage_scalar(c.mesh, "loaded_contact_ratio"), 1.7547, 5e-3);
    chain_close(&c);
}

static void test_analytical_compliance(void)
{
    chain c = chain_with(model, "250 N m", "mesh.compliance", "analytical");
    double mean = stage_scalar(c.mesh, "stiffness_mean");
    check_true("of the same size", mean > 2.5e8 && mean < 5e8);
    check_true("0.42 F at SAP", fabs(stage_get(c.mesh, "load_share", NULL)[0] - 0.42) < 0.02);
    chain_close(&c);
}

/* Returns the distance along the flank's normal from a roll angle to the axis of the tooth. */
static double depth_of(const chain *c, int gear, double roll)
{
    const double base = stage_get(c->gear, "base_radius", NULL)[gear],
                 reference = stage_get(c->gear, "reference_radius", NULL)[gear];
    const double arc = stage_get(c->gear, "tooth_thickness", NULL)[gear] +
                       stage_get(c->gear, "thickness_allowance", NULL)[gear];
    const double angle = atan(roll), at = acos(base / reference);
    const double half = arc / (2 * reference) + (tan(at) - at) - (roll - angle);
    return hypot(base, base * roll) * sin(half) / cos(angle - half);
}

/* Weber's contact approach, h (2 ln 2d - ln(4 R w (h1 + h2)) - nu/(1 - nu)) for each flank with h =
   (1 - nu^2)/(pi E b): the deflection of a single pair must exceed that with the beams' constant
   contact compliance, 4 (1 - nu^2)/(pi E b) for both flanks, by the difference. Gears of different
   metals. */
static void test_approach(void)
{
    const double nu[2] = {0.24, 0.36}, E[2] = {206e9, 118e9}, width = 0.02, load = 3500;
    double softness[2], by_hand = 0, contact = 0, h[2];
    for (int k = 0; k < 2; k++) {
        chain c = chain_open(k ? "stiffness/potential-energy" : model, "250 N m");
        stage_set_text(c.gear, "teeth", "[25, 40]");
        stage_set_text(c.gear, "profile_shift", "[0.3, -0.1]");
        stage_set_reals(c.gear, "elastic_modulus", 2, E);
        stage_set_reals(c.gear, "poisson_ratio", 2, nu);
        stage_set(c.duty, "torque", load * 25 * 1.5e-3 * cos(M_PI / 9));
        stage_set_text(c.mesh, "plane", "strain");
        if (k == 0) {
            stage_set_text(c.mesh, "compliance", "analytical");
            stage_set_text(c.mesh, "definition", "secant");
        }
        chain_run(&c);
        size_t n, middle = 0;
        const double *phase = stage_get(c.mesh, "phase", &n);
        const double ratio = stage_scalar(c.gear, "contact_ratio");
        while (middle + 1 < n && phase[middle + 1] < ratio / 2)
            middle++;
        softness[k] = 1 / stage_get(c.mesh, "stiffness", NULL)[middle];
        const double *base = stage_get(c.gear, "base_radius", NULL);
        const double roll = stage_scalar(c.gear, "roll_sap") + phase[middle] * 2 * M_PI / 25;
        const double line = stage_scalar(c.gear, "centre_distance") *
                            sin(stage_scalar(c.gear, "working_pressure_angle"));
        const double r1 = base[0] * roll, r2 = line - r1;
        by_hand = contact = 0;
        for (int g = 0; g < 2; g++) {
            h[g] = (1 - nu[g] * nu[g]) / (M_PI * E[g] * width);
            contact += 2 * h[g];
        }
        for (int g = 0; g < 2; g++)
            by_hand +=
                h[g] * (2 * log(2 * depth_of(&c, g, g ? r2 / base[1] : roll)) -
                        log(4 * r1 * r2 / line * load * (h[0] + h[1])) - nu[g] / (1 - nu[g]));
        chain_close(&c);
    }
    check_near("approach of unlike flanks", softness[0] - softness[1] + contact, by_hand, 1e-9);
}

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The compliance must be stored between runs: with a new torque, only the mesh positions are solved
   again. */
static void test_cost(void)
{
    chain c = chain_open(model, "250 N m");
    double start = seconds();
    chain_run(&c);
    double first = seconds() - start;
    double other_force = force * 100 / 250;
    stage_give_scalar(c.mesh, "operating.line_force", other_force);
    start = seconds();
    chain_run(&c);
    double again = seconds() - start;
    double mean = stage_scalar(c.mesh, "stiffness_mean");
    chain_close(&c);
    c = chain_open(model, "100 N m");
    stage_give_scalar(c.mesh, "operating.line_force", other_force);
    check_near("kept, not mixed up", chain_mean(&c), mean, 1e-14);
    chain_close(&c);
    /* a fiftieth on an idle computer */
    check_below("time of 200 mesh positions, over that of the compliance", again / first, 0.25);
}

static void expect_refusal(const char *what, chain *c, const char *item, const char *word)
{
    ff_status status = stage_run(c->mesh);
    int bad = status < 0 || status == FF_NOCONV;
    check_true(what, bad);
    if (!strncmp(item, "gear:", 5))
        check_true(item,
                   !strcmp(stage_why_item(c->gear), item + 5) && strstr(stage_why(c->gear), word));
    else
        check_true(item,
                   !strcmp(stage_why_item(c->mesh), item) && strstr(stage_why(c->mesh), word));
    chain_close(c);
}

static chain with(const char *param, const char *value)
{
    chain c = chain_open(model, "250 N m");
    stage_set_text(strncmp(param, "mesh.", 5) ? c.gear : c.mesh, param + 5, value);
    return c;
}

static void test_refusals(void)
{
    chain c = with("mesh.rim_radius", "72 mm");
    expect_refusal("rim above the root circle", &c, "rim_radius", "root radius");
    c = with("gear.root_diameter", "133 mm");
    expect_refusal("pointed space", &c, "gear.root_radius", "tooth space meet");
    c = with("gear.poisson_ratio", "0.5");
    expect_refusal("plane strain without volume change", &c, "plane", "plane stress");
    c = with("mesh.mesh_cycle", "3");
    expect_refusal("no such cycle", &c, "mesh_cycle", "meet again after 1");
    c = with("gear.face_width", "0.01 mm");
    check_true("contacts as wide as teeth are not trusted",
               stage_run(c.mesh) == FF_OK && stage_verdict(c.mesh) == FF_DOUBTFUL);
    chain_close(&c);
}

static void test_no_load(void)
{
    chain c = chain_open(model, "250 N m");
    stage_give_scalar(c.mesh, "operating.line_force", 0);
    chain_run(&c);
    check_true("no force", !(stage_get(c.mesh, "tooth_force", NULL)[9] > 0));
    check_true("a stiffness", stage_scalar(c.mesh, "stiffness_mean") > 1e8);
    check_below("no error", stage_get(c.mesh, "loaded_transmission_error", NULL)[9], 0);
    chain_close(&c);
}

/* The difference to beams on an elastic foundation must be at most 14 %. */
static void test_unlike_gears(void)
{
    static const char *const pairs[][3] = {
        {"[19, 41]", "4 mm", "[0.35, 0.1]"},    {"[17, 17]", "2 mm", "[0.2, 0.2]"},
        {"[23, 120]", "1.5 mm", "[0.3, -0.3]"}, {"[14, 60]", "10 mm", "[0.5, 0.5]"},
        {"[150, 150]", "1 mm", "[0, 0]"},       {"[17, 40]", "3 mm", "[0, 0]"},
        {"[80, 31]", "5 mm", "[0, 0]"},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        double mean[2];
        for (int k = 0; k < 2; k++) {
            chain c = chain_open(k ? "stiffness/potential-energy" : model, "100 N m");
            stage_set_text(c.gear, "teeth", pairs[i][0]);
            stage_set_text(c.gear, "module", pairs[i][1]);
            stage_set_text(c.gear, "profile_shift", pairs[i][2]);
            stage_set_text(c.gear, "backlash", "0.1 mm");
            mean[k] = chain_mean(&c);
            check_true("good", k > 0 || stage_verdict(c.mesh) == FF_GOOD);
            chain_close(&c);
        }
        check_near(pairs[i][0], mean[0], mean[1], 0.17);
    }
}

int main(void)
{
    test_tooth_force();
    test_size_of_the_stiffness();
    test_contact_in_plane_strain();
    test_mesh_convergence();
    test_torque_stiffens_by_hertz_alone();
    test_definitions();
    test_swapped_driver();
    test_corner_contact();
    test_high_contact_ratio();
    test_corner_contact_vanishes_with_the_load();
    test_analytical_compliance();
    test_approach();
    test_cost();
    test_refusals();
    test_no_load();
    test_unlike_gears();
    return check_done();
}
