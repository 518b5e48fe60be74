/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "../../../plugins/stiffness/tooth-beam.h"

#include "check.h"

#include <math.h>

/* Returns a 20 deg tooth without profile shift, module 3. */
static stiffness_tooth tooth_of(double teeth, double dedendum)
{
    double r = 1.5e-3 * teeth;
    stiffness_tooth_data data = {.base_radius = r * cos(M_PI / 9),
                                 .root_radius = r - 3e-3 * dedendum,
                                 .reference_radius = r,
                                 .rim_radius = r / 3,
                                 .thickness = 1.5e-3 * M_PI,
                                 .width = 0.02,
                                 .elastic_modulus = 206e9,
                                 .poisson_ratio = 0.3};
    stiffness_tooth tooth;
    stiffness_tooth_make(&tooth, &data);
    return tooth;
}

static double tip_roll(const stiffness_tooth *tooth, double teeth)
{
    double tip = 1.5e-3 * teeth + 3e-3;
    return sqrt(pow(tip / tooth->base_radius, 2) - 1);
}

static void test_sainsot_example(void)
{
    stiffness_sainsot s = stiffness_sainsot_at(70.34 / 25, 0.0458536);
    check_near("L*", s.L, 6.92833, 1e-5);
    check_near("M*", s.M, 1.14547, 1e-5);
    check_near("P*", s.P, 4.12701, 1e-5);
    check_near("Q*", s.Q, 0.46430, 1e-5);
}

static void test_outline(void)
{
    stiffness_tooth tooth = tooth_of(50, 1.55);
    stiffness_section a = stiffness_tooth_involute(&tooth, 0),
                      b = stiffness_tooth_radial(&tooth, tooth.base_radius);
    check_near("the parts meet, x", a.x, b.x, 1e-15);
    check_near("the parts meet, y", a.half, b.half, 1e-14);
    const double roll = 0.36, h = 1e-5;
    stiffness_section at = stiffness_tooth_involute(&tooth, roll);
    check_near("radius of the involute", hypot(at.x, at.half),
               tooth.base_radius * sqrt(1 + roll * roll), 1e-15);
    double slope = (stiffness_tooth_involute(&tooth, roll + h).x -
                    stiffness_tooth_involute(&tooth, roll - h).x);
    check_near("dx/dt", slope / (2 * h), at.dx, 1e-9);
    double reference = tan(M_PI / 9);
    stiffness_section middle = stiffness_tooth_involute(&tooth, reference);
    check_near("thickness at the reference circle",
               2 * atan2(middle.half, middle.x) * hypot(middle.x, middle.half), 1.5e-3 * M_PI,
               1e-13);
}

static stiffness_section bar(const void *shape, double t)
{
    return (stiffness_section){t, *(const double *)shape / 2, 1};
}

/* Uniform cantilever of length L, height H, width b with a load across its end: Timoshenko
   4 L^3/(E b H^3) + 1.2 L/(G b H). */
static void test_cantilever(void)
{
    const double L = 0.05, H = 0.004, b = 0.02, E = 206e9, G = 79e9, root = 0.07;
    const stiffness_beam beam = {.bending = E, .axial = E, .shear = G, .width = b};
    const stiffness_load across = {.x = root + L, .across = 1};
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(32);
    stiffness_compliance c = {0};
    stiffness_beam_add(&beam, bar, &H, root, root + L, &across, rule, &c);
    check_near("Euler-Bernoulli", c.bending, 4 * pow(L / H, 3) / (E * b), 1e-13);
    check_near("shear of Timoshenko", c.shear, 1.2 * L / (G * b * H), 1e-13);
    check_below("no compression", c.axial, 0);
    check_near("slender: bending alone", stiffness_compliance_sum(&c), c.bending, 0.01);

    const stiffness_load along = {.x = root + L, .along = 1};
    c = (stiffness_compliance){0};
    stiffness_beam_add(&beam, bar, &H, root, root + L, &along, rule, &c);
    check_near("a strut", c.axial, L / (E * b * H), 1e-13);
    check_below("does not bend", c.bending, 0);

    /* a force at angle a on the surface: the force cos(a) at the end, and a moment -sin(a) H/2 */
    const double a = 0.3, s = sin(a) * H / 2, k = cos(a), EI = E * b * H * H * H / 12;
    const stiffness_load face = {.x = root + L, .y = H / 2, .across = k, .along = sin(a)};
    c = (stiffness_compliance){0};
    stiffness_beam_add(&beam, bar, &H, root, root + L, &face, rule, &c);
    check_near("force and moment", c.bending,
               (k * k * L * L * L / 3 - k * s * L * L + s * s * L) / EI, 1e-12);
    gsl_integration_glfixed_table_free(rule);
}

typedef struct twin {
    const stiffness_tooth *tooth;
    stiffness_load load;
    stiffness_outline outline;
    int part;
} twin;

static double density(double t, void *data)
{
    const twin *w = data;
    stiffness_section at = w->outline(w->tooth, t);
    double value[3];
    stiffness_beam_density(&w->tooth->beam, &at, &w->load, value);
    return value[w->part];
}

static double adaptive(twin w, double t0, double t1, gsl_integration_workspace *space)
{
    gsl_function f = {density, &w};
    double result, error;
    gsl_integration_qag(&f, t0, t1, 0, 1e-12, 1000, GSL_INTEG_GAUSS15, space, &result, &error);
    return result;
}

/* Returns the compliance from the same energy, by adaptive Gauss-Kronrod quadrature to 1e-12. */
static double twin_compliance(const stiffness_tooth *tooth, double roll, int part)
{
    gsl_integration_workspace *space = gsl_integration_workspace_alloc(1000);
    twin w = {.tooth = tooth, .load = stiffness_tooth_load(tooth, roll), .part = part};
    w.outline = stiffness_tooth_involute;
    double sum = adaptive(w, tooth->root_roll, roll, space);
    w.outline = stiffness_tooth_radial;
    if (tooth->root_radius < tooth->base_radius)
        sum += adaptive(w, tooth->root_radius, tooth->base_radius, space);
    gsl_integration_workspace_free(space);
    return sum;
}

static void test_twin(void)
{
    gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(32);
    static const double teeth[4] = {18, 50, 50, 200}, dedendum[4] = {1.25, 1.25, 1.55, 1.25};
    for (int i = 0; i < 4; i++) {
        stiffness_tooth tooth = tooth_of(teeth[i], dedendum[i]);
        double low = tooth.root_roll, high = tip_roll(&tooth, teeth[i]);
        for (int j = 1; j <= 4; j++) {
            double roll = low + (high - low) * j / 4;
            stiffness_compliance c = stiffness_tooth_compliance(&tooth, roll, rule);
            check_near("bending", c.bending, twin_compliance(&tooth, roll, 0), 1e-9);
            check_near("shear", c.shear, twin_compliance(&tooth, roll, 1), 1e-9);
            check_near("axial", c.axial, twin_compliance(&tooth, roll, 2), 1e-9);
        }
    }
    gsl_integration_glfixed_table_free(rule);
}

/* The error of Gauss quadrature must decrease geometrically with the number of nodes. */
static void test_quadrature_converges(void)
{
    stiffness_tooth tooth = tooth_of(50, 1.55);
    double roll = 0.99 * tip_roll(&tooth, 50), exact = 0, error[3];
    for (int part = 0; part < 3; part++)
        exact += twin_compliance(&tooth, roll, part);
    for (size_t i = 0; i < 3; i++) {
        gsl_integration_glfixed_table *rule = gsl_integration_glfixed_table_alloc(4 * (i + 1));
        stiffness_compliance c = stiffness_tooth_compliance(&tooth, roll, rule);
        error[i] = fabs((stiffness_compliance_sum(&c) - c.foundation) / exact - 1);
        gsl_integration_glfixed_table_free(rule);
    }
    check_below("8 nodes over 4", error[1] / error[0], 0.05);
    check_below("12 nodes over 8", error[2] / error[1], 0.05);
}

int main(void)
{
    test_sainsot_example();
    test_outline();
    test_cantilever();
    test_twin();
    test_quadrature_converges();
    return check_done();
}
