/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Eyring stresses that depend on pressure and temperature: `tau0: auto` and
   flankfilm.rheology/3. */
#include <check.h>
#include <stage.h>

#include <difference.h>

#include <flankfilm/laws.h>

#include <math.h>
#include <string.h>

static const double GPa = 1e9;

typedef struct scene {
    stage *oil, *viscosity, *flow;
    const ff_viscosity *eta;
    const ff_rheology_3 *law;
} scene;

static scene open_scene(const char *law, const char *base, const char *grade, const char *stress)
{
    const int known = strcmp(base, "ester") != 0;
    scene s = {stage_open("lubricant/grade"),
               stage_open(known ? "viscosity/modulus" : "viscosity/barus"), stage_open(law), NULL,
               NULL};
    stage_set_text(s.oil, "grade", grade);
    stage_set_text(s.oil, "base", base);
    stage_link(s.viscosity, "oil", s.oil);
    if (strstr(law, "carreau")) {
        stage_set_text(s.flow, "G", stress);
        stage_set_text(s.flow, "n", "0.27");
    } else {
        stage_set_text(s.flow, "tau0", stress);
    }
    stage_link(s.flow, "viscosity", s.viscosity);
    stage_link(s.flow, "oil", s.oil);
    return s;
}

static void start(scene *s)
{
    s->eta = stage_service(s->viscosity, FF_VISCOSITY_ID);
    s->law = stage_service(s->flow, FF_RHEOLOGY_3_ID);
}

static void close_scene(scene *s)
{
    stage_close(s->flow);
    stage_close(s->viscosity);
    stage_close(s->oil);
}

static double ln_eta(const scene *s, double p, double T)
{
    double ln = 0;
    s->eta->eval(s->eta->self, 1, &p, &T, &ln, NULL, NULL);
    return ln;
}

static double shear(const scene *s, double p, double T, double h, double u_s)
{
    double ln = ln_eta(s, p, T), tau = 0;
    s->law->shear(s->law->self, 1, &p, &T, &ln, &h, u_s, &tau);
    return tau;
}

/* Returns tau_E from psi at infinite viscosity, psi = u_s/(tau_E h). */
static double eyring(const scene *s, double p, double T)
{
    double ln = 500, h = 1e-6, psi;
    s->law->flow(s->law->self, 1, &p, &T, &ln, &h, 2, &psi, NULL, NULL, NULL);
    return 2 / (psi * h);
}

static void test_table(void)
{
    static const double p[] = {0, 0.5, 1, 1.5, 2};
    static const struct {
        const char *base;
        double T, stress[5];
    } rows[] = {
        {"mineral", 90, {5.57, 7.09, 8.61, 10.13, 11.65}},
        {"mineral", 120, {6.21, 8.12, 10.03, 11.94, 13.85}},
        {"PAO", 85, {5.77, 7.33, 8.90, 10.47, 12.04}},
        {"PAO", 110, {6.45, 8.22, 10.00, 11.77, 13.55}},
    };
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++) {
        scene s = open_scene("rheology/ree-eyring", rows[k].base, "ISO VG 100", "auto");
        start(&s);
        for (int i = 0; i < 5; i++)
            check_near("tau_E", 1e-6 * eyring(&s, p[i] * GPa, 273.15 + rows[k].T),
                       rows[k].stress[i], 0.00501 / rows[k].stress[i]);
        close_scene(&s);
    }
}

typedef struct point {
    const scene *s;
    double T, ln_eta, h;
} point;

static double psi_over_p(const void *at, double p)
{
    const point *o = at;
    double psi = 0;
    o->s->law->flow(o->s->law->self, 1, &p, &o->T, &o->ln_eta, &o->h, 1.5, &psi, NULL, NULL, NULL);
    return psi;
}

/* Checks dpsi/dp at constant eta on both sides of 1 MPa, and that psi has no jump there. */
static void test_slopes(const char *law)
{
    scene s = open_scene(law, "mineral", "ISO VG 320", "auto");
    start(&s);
    for (double p = 2e4; p < 3 * GPa; p *= 3) {
        point o = {&s, 361, ln_eta(&s, p, 361), 3e-7};
        double psi, by_p;
        s.law->flow(s.law->self, 1, &p, &o.T, &o.ln_eta, &o.h, 1.5, &psi, &by_p, NULL, NULL);
        /* psi changes by 1e-4 over p, so that differences have errors of about 1e-9 */
        check_below("dpsi/dp", fabs(by_p / difference(psi_over_p, &o, p, 0.05 * p) - 1),
                    p < 1e8 ? 2e-3 : 2e-5);
    }
    const double below = 1e6 * (1 - 1e-12), above = 1e6 * (1 + 1e-12);
    check_near("no step at 1 MPa", eyring(&s, below, 361), eyring(&s, above, 361), 1e-6);
    check_near("nor below 0", eyring(&s, -1e8, 361), eyring(&s, 0, 361), 1e-12);
    close_scene(&s);
}

/* Returns the mean friction coefficient of a Hertzian contact with a film of constant thickness. */
static double friction(const scene *s, double p_hertz, double u_s)
{
    enum { PARTS = 400 };
    double force = 0, load = 0;
    for (int i = 0; i < PARTS; i++) {
        double x = (i + 0.5) / PARTS, p = p_hertz * sqrt(1 - x * x);
        force += shear(s, p, 363.15, 2e-7, u_s);
        load += p;
    }
    return force / load;
}

static void test_friction(const char *law)
{
    scene s = open_scene(law, "mineral", "ISO VG 100", "auto");
    start(&s);
    double before = 0;
    int rises = 1;
    for (double p = 0.2 * GPa; p < 3.01 * GPa; p += 0.2 * GPa) {
        double mu = friction(&s, p, 1.3);
        rises = rises && mu > before;
        before = mu;
    }
    check_true("friction rises with pressure up to 3 GPa", rises);
    check_below("and stays below Lambda", before, 0.047);
    check_true("which it comes near", before > 0.035);
    check_near("odd about the pitch point", friction(&s, GPa, -0.02), -friction(&s, GPa, 0.02),
               1e-14);
    check_near("linear about it", friction(&s, 0.7 * GPa, 1e-9) / friction(&s, 0.7 * GPa, 2e-9),
               0.5, 1e-6);
    close_scene(&s);
}

/* The traction limit must be the larger of Lambda p and the Eyring stress: at low pressure, a
   Newtonian stress is not limited, and nothing jumps at p = 0. */
static void test_low_pressure(const char *law)
{
    scene s = open_scene(law, "mineral", "ISO VG 100", "auto");
    start(&s);
    const double T = 363.15, h = 1e-6, p = 1e5;
    check_near("Newtonian at 0.1 MPa", shear(&s, p, T, h, 1), exp(ln_eta(&s, p, T)) / h, 1e-3);
    check_near("no step at p = 0", shear(&s, -1e-3, T, 1e-9, 9), shear(&s, 1e-3, T, 1e-9, 9), 1e-9);
    check_near("the Eyring stress there", shear(&s, 0, T, 1e-9, 9), 5.57e6, 1e-3);
    check_near("Lambda p at 1 GPa", shear(&s, GPa, T, 1e-7, 90), 0.047e9, 1e-12);
    close_scene(&s);
}

/* Checks d ln tau/d ln Lambda = 1 - S/(sqrt(1 + S^2) asinh S). */
static void test_sensitivity(void)
{
    const double p = 0.6 * GPa, T = 363.15, h = 3e-7, u = 0.4;
    double tau[3];
    for (int k = 0; k < 3; k++) {
        scene s = open_scene("rheology/ree-eyring", "mineral", "ISO VG 100", "auto");
        stage_set(s.flow, "limiting_stress_coefficient",
                  0.047 * (k == 0   ? 1
                           : k == 1 ? 1.01
                                    : 0.99));
        start(&s);
        tau[k] = shear(&s, p, T, h, u);
        if (k == 2) {
            double tau_E = eyring(&s, p, T) / 0.99, S = exp(ln_eta(&s, p, T)) * u / (tau_E * h);
            check_near("tau", tau[0], tau_E * asinh(S), 1e-12);
            check_near("by Lambda", (tau[1] - tau[2]) / (0.02 * tau[0]),
                       1 - S / (sqrt(1 + S * S) * asinh(S)), 1e-4);
        }
        close_scene(&s);
    }
}

/* The shear rate at a point must be that of Eyring's law with the Eyring stress at the pressure,
   also above the limit. */
static void test_rate(void)
{
    scene s = open_scene("rheology/ree-eyring", "mineral", "ISO VG 150", "auto");
    start(&s);
    const ff_rheology_2 *local = stage_service(s.flow, FF_RHEOLOGY_2_ID);
    const double p = 0.7 * GPa, T = 371, tau = 1.2 * 0.047 * p, tau_E = eyring(&s, p, T);
    double ln = ln_eta(&s, p, T), rate;
    local->rate(local->self, 1, &p, &T, &ln, &tau, &rate, NULL, NULL);
    check_near("rate", rate, tau_E * exp(-ln) * sinh(tau / tau_E), 1e-9);
    close_scene(&s);
}

/* A given stress must be the same in all services. With `tau0: auto`, a service without pressure
   must use the stress at ambient pressure, and report it. */
static void test_other_services(void)
{
    const double p = 0.8 * GPa, T = 350, ln = 4, h = 2e-7;
    double a, b, by_p;
    scene s = open_scene("rheology/ree-eyring", "PAO", "ISO VG 100", "6 MPa");
    start(&s);
    const ff_rheology *plain = stage_service(s.flow, FF_RHEOLOGY_ID);
    check_true("in range", plain->flow(plain->self, 1, &ln, &h, 1, &a, NULL, NULL) == FF_OK);
    s.law->flow(s.law->self, 1, &p, &T, &ln, &h, 1, &b, &by_p, NULL, NULL);
    check_near("flow", a, b, 0);
    check_near("that pressure does not change", by_p, 0, 0);
    close_scene(&s);
    stage *flow = stage_open("rheology/ree-eyring"), *bare = stage_open("viscosity/barus");
    stage_set_text(bare, "eta0", "20 mPa s");
    stage_set_text(bare, "alpha", "16 1/GPa");
    stage_set_text(flow, "tau0", "auto");
    stage_set_text(flow, "limiting_stress_coefficient", "0.04");
    stage_link(flow, "viscosity", bare);
    plain = stage_service(flow, FF_RHEOLOGY_ID);
    check_true("continued", plain->flow(plain->self, 1, &ln, &h, 1, &a, NULL, NULL) == FF_DOMAIN);
    check_near("from ambient pressure", a, hypot(exp(-ln), 1 / (2 * 0.04 / 16e-9 * h)), 1e-12);
    stage_close(flow);
    stage_close(bare);
}

/* Carreau's law must agree up to S = 100, tau = 5.3 tau_E. */
static void test_carreau_follows(void)
{
    scene a = open_scene("rheology/ree-eyring", "PAO", "ISO VG 220", "auto");
    scene b = open_scene("rheology/carreau", "PAO", "ISO VG 220", "auto");
    const double p = 0.9 * GPa, T = 345, h = 2e-7;
    double worst = 0;
    start(&a);
    start(&b);
    const double once = eyring(&a, p, T) * h / exp(ln_eta(&a, p, T));
    for (double S = 0.1; S <= 100; S *= 1.2) {
        double one = shear(&a, p, T, h, S * once), other = shear(&b, p, T, h, S * once);
        worst = fmax(worst, fabs(other / one - 1));
    }
    check_below("Carreau against Ree-Eyring", worst, 0.05);
    close_scene(&a);
    close_scene(&b);
}

static void test_refusals(void)
{
    scene s = open_scene("rheology/ree-eyring", "ester", "ISO VG 100", "auto");
    check_true("an oil without Lambda",
               stage_ready(s.flow) == FF_INVALID && !strcmp(stage_why_item(s.flow), "tau0") &&
                   strstr(stage_why(s.flow), "limiting_stress_coefficient"));
    close_scene(&s);
    stage *alone = stage_open("rheology/carreau");
    stage_set_text(alone, "G", "auto");
    stage_set_text(alone, "n", "0.3");
    stage_set_text(alone, "limiting_stress_coefficient", "0.05");
    check_true("no viscosity",
               stage_ready(alone) == FF_INVALID && strstr(stage_why(alone), "kind viscosity"));
    stage_close(alone);
    scene steep = open_scene("rheology/carreau", "PAO", "ISO VG 220", "auto");
    stage_set_text(steep.flow, "n", "0.6");
    check_true("an exponent that was not fitted", stage_ready(steep.flow) == FF_UNSUPPORTED &&
                                                      strstr(stage_why(steep.flow), "n = 0.27"));
    close_scene(&steep);
}

int main(void)
{
    test_table();
    test_slopes("rheology/ree-eyring");
    test_slopes("rheology/carreau");
    test_low_pressure("rheology/ree-eyring");
    test_low_pressure("rheology/carreau");
    test_friction("rheology/ree-eyring");
    test_friction("rheology/carreau");
    test_sensitivity();
    test_carreau_follows();
    test_rate();
    test_other_services();
    test_refusals();
    return check_done();
}
