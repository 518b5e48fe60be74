/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Compares Blok's flash temperature with the temperature under a moving band of heat. */
#include "check.h"
#include "engagement.h"

#include <math.h>
#include <string.h>

static engagement e;

typedef struct steel {
    double k, rho, c;
} steel;

static const steel ordinary = {47, 7850, 455};

/* Returns the highest surface temperature of a half-space under a band of half width a and speed u,
   with elliptic heat flux of Q per width, without conduction along the surface (Jaeger 1942): T(x)
   = 1/(B sqrt(pi u)) int_-a^x q(s)/sqrt(x - s) ds. The substitution s = x - v^2 removes the
   singularity. */
static double band_temperature(double Q, double a, double u, steel of)
{
    enum { PANELS = 2000 };
    double most = 0, B = sqrt(of.k * of.rho * of.c);
    for (double x = 0.5; x < 0.8; x += 1e-3) {
        double h = sqrt(x + 1) / PANELS, sum = 0;
        for (int i = 0; i < PANELS; i++) {
            double v = (i + 0.5) * h, s = x - v * v;
            sum += 2 * h * sqrt(fmax(0, 1 - s * s));
        }
        most = fmax(most, sum);
    }
    return 2 * Q / (M_PI * a) * most * sqrt(a) / (B * sqrt(M_PI * u));
}

/* Returns the temperature of both flanks under one band, with the heat divided so that their
   highest temperatures are equal. */
static double expected(const engagement *m, int i, steel one, steel two)
{
    double R = 1 / (1 / m->radius_1[i] + 1 / m->radius_2[i]);
    double a = sqrt(8 * m->load * R / (M_PI * m->modulus));
    double t1 = band_temperature(m->power[i], a, m->omega * m->radius_1[i], one);
    double omega_2 = m->omega * TEETH / TEETH_2;
    double t2 = band_temperature(m->power[i], a, omega_2 * m->radius_2[i], two);
    return t1 * t2 / (t1 + t2);
}

static void test_flash(steel one, steel two)
{
    engagement_fill(&e, 1.6);
    stage *s = engagement_open(&e);
    stage_set_reals(s, "thermal_conductivity", 2, (double[]){one.k, two.k});
    stage_set_reals(s, "density", 2, (double[]){one.rho, two.rho});
    stage_set_reals(s, "specific_heat", 2, (double[]){one.c, two.c});
    check_true("runs", stage_run(s) == FF_OK);
    const double *flash = stage_get(s, "flash_temperature", NULL);
    /* Blok's 1.11 is 1.1115, rounded */
    static const int places[] = {0, 500, INSTANTS - 1};
    for (int k = 0; k < 3; k++)
        check_near("flash temperature", flash[places[k]], expected(&e, places[k], one, two), 2e-3);
    check_below("pitch point", flash[INSTANTS / 2], 1e-9);
    stage_close(s);
}

/* Each gear has its own material; if the material of one is unknown, steel must not replace it. */
static void test_gears_tell(steel one, steel two)
{
    engagement_fill(&e, 1.6);
    stage *s = engagement_open(&e);
    stage_give_series(s, "gear.thermal_conductivity", 2, (double[]){one.k, two.k});
    stage_give_series(s, "gear.density", 2, (double[]){one.rho, two.rho});
    stage_give_series(s, "gear.specific_heat", 2, (double[]){one.c, two.c});
    check_true("runs", stage_run(s) == FF_OK);
    check_near("flash temperature", stage_get(s, "flash_temperature", NULL)[500],
               expected(&e, 500, one, two), 2e-3);
    const double loss = stage_scalar(s, "power_loss_mean");
    stage_give_series(s, "gear.thermal_conductivity", 2, (double[]){one.k, 0});
    check_true("a gear that does not tell", stage_run_wanted(s, "flash_temperature_max") != FF_OK &&
                                                strstr(stage_why(s), "of gear 2 is unknown"));
    check_true("has a loss all the same", stage_run_wanted(s, "power_loss_mean") == FF_OK);
    check_near("the same", stage_scalar(s, "power_loss_mean"), loss, 0);
    stage_close(s);
}

static void test_highest_contact_temperature(void)
{
    engagement_fill(&e, 1.6);
    stage *s = engagement_open(&e);
    check_true("runs", stage_run(s) == FF_OK);
    size_t n;
    const double *flash = stage_get(s, "flash_temperature", &n), *roll = e.roll;
    const double *contact = stage_get(s, "contact_temperature", NULL);
    size_t top = 0;
    for (size_t i = 0; i < n; i++)
        top = flash[i] > flash[top] ? i : top;
    check_near("of the oil", stage_scalar(s, "bulk_temperature"), 353.15, 1e-12);
    check_near("highest", stage_scalar(s, "flash_temperature_max"), flash[top], 0);
    check_near("where", stage_scalar(s, "flash_temperature_max_at"), roll[top], 0);
    check_near("above the bulk", contact[top] - flash[top], 353.15, 1e-12);
    check_near("sum", stage_scalar(s, "contact_temperature_max"), contact[top], 0);
    stage_close(s);
    s = engagement_open(&e);
    stage_set_text(s, "bulk_temperature", "100 degC");
    check_true("runs", stage_run(s) == FF_OK);
    check_near("given", stage_scalar(s, "bulk_temperature"), 373.15, 1e-12);
    stage_close(s);
}

static void test_slow_sources_are_doubted(void)
{
    engagement_fill(&e, 1.6);
    stage *s = engagement_open(&e);
    stage_set(s, "thermal_conductivity", 5000);
    check_true("runs", stage_run(s) == FF_OK);
    check_below("Peclet", stage_quality(s, "peclet"), 5);
    check_true("doubted", stage_verdict(s) == FF_DOUBTFUL);
    stage_close(s);
}

static void test_no_heat_without_load(void)
{
    engagement_fill(&e, 1.6);
    for (int i = 0; i < 200; i++)
        e.coefficient[i] = 0; /* value of the film models for separated flanks */
    stage *s = engagement_open(&e);
    check_true("runs", stage_run(s) == FF_OK);
    check_near("in flight", stage_get(s, "flash_temperature", NULL)[10], 0, 0);
    check_true("under load", stage_get(s, "flash_temperature", NULL)[300] > 1);
    stage_close(s);
}

int main(void)
{
    test_flash(ordinary, ordinary);
    test_flash(ordinary, (steel){0.3, 1400, 1500}); /* on a polymer */
    test_gears_tell((steel){0.3, 1415, 1465}, ordinary);
    test_highest_contact_temperature();
    test_slow_sources_are_doubted();
    test_no_heat_without_load();
    return check_done();
}
