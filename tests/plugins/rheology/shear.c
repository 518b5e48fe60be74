/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mean shear stress of the film: values, limits, extremes. */
#include "check.h"
#include "stage.h"

#include <flankfilm/rheology.h>

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static ff_status status;

static double shear(const ff_rheology *law, double p, double ln_eta, double h, double u_s)
{
    double tau;
    status = law->shear(law->self, 1, &p, &ln_eta, &h, u_s, &tau);
    return tau;
}

/* stress: tau0 of Ree-Eyring, G of Carreau, 0 without either */
static stage *open_law(const char *id, double stress, double limit)
{
    stage *s = stage_open(id);
    int carreau = !strcmp(id, "rheology/carreau");
    if (stress > 0)
        stage_set(s, carreau ? "G" : "tau0", stress);
    if (carreau)
        stage_set(s, "n", 0.463);
    if (limit > 0)
        stage_set(s, "limiting_stress_coefficient", limit);
    return s;
}

static const ff_rheology *service(stage *s)
{
    return stage_service(s, FF_RHEOLOGY_ID);
}

static void check_extremes(const ff_rheology *law)
{
    static const double films[] = {5e-324, 1e-300, 1e-30, 1e-9, 1, 1e30, DBL_MAX};
    static const double speeds[] = {5e-324, 1e-30, -1, 1e30, -1e300, DBL_MAX};
    static const double viscosities[] = {-DBL_MAX, -1e30, -800, -1e-30, 0, 40, 800, 1e30, DBL_MAX};
    static const double pressures[] = {-DBL_MAX, -1, 0, 1e9, DBL_MAX};
    int finite = 1, sign = 1;
    for (size_t i = 0; i < 7; i++)
        for (size_t k = 0; k < 6; k++)
            for (size_t j = 0; j < 9; j++)
                for (size_t m = 0; m < 5; m++) {
                    double tau = shear(law, pressures[m], viscosities[j], films[i], speeds[k]);
                    finite = finite && isfinite(tau);
                    sign = sign && tau * copysign(1, speeds[k]) >= 0;
                }
    check_true("  finite for every double", finite);
    check_true("  with the sign of the sliding speed", sign);
    check_true("  none without sliding", shear(law, 1e9, DBL_MAX, 1e-9, 0) == 0);
    check_true("  no points is a legal batch",
               law->shear(law->self, 0, NULL, NULL, NULL, 1, NULL) == FF_OK &&
                   law->shear(law->self, 0, NULL, NULL, NULL, 0, NULL) == FF_OK);
}

static void newtonian(void)
{
    stage *s = open_law("rheology/newtonian", 0, 0);
    const ff_rheology *law = service(s);
    printf("newtonian\n");
    check_near("  eta u_s/h", shear(law, 0, log(0.02), 2e-7, -3), -0.02 * 3 / 2e-7, 1e-14);
    check_true("  in range", status == FF_OK);
    check_true("  finite where it overflows", isfinite(shear(law, 0, 1e4, 2e-7, 3)));
    check_true("  and says so", status == FF_DOMAIN);
    check_extremes(law);
    stage_close(s);
}

static void ree_eyring(void)
{
    const double tau0 = 5e6, h = 2e-7;
    stage *s = open_law("rheology/ree-eyring", tau0, 0);
    const ff_rheology *law = service(s);
    double worst = 0, odd = 0, last = 0;
    int rising = 1;
    printf("ree-eyring\n");
    for (double ln_eta = -10; ln_eta < 600; ln_eta += 0.7) {
        double tau = shear(law, 0, ln_eta, h, 3), S = exp(ln_eta) * 3 / (tau0 * h);
        worst = fmax(worst, fabs(tau / (tau0 * asinh(S)) - 1));
        odd = fmax(odd, fabs(tau + shear(law, 0, ln_eta, h, -3)));
        rising = rising && tau > last;
        last = tau;
    }
    check_below("  tau0 asinh S", worst, 1e-13);
    check_below("  odd in the sliding speed", odd, 0);
    check_true("  rises with viscosity", rising);
    /* asinh S = ln 2S where S itself overflows */
    check_near("  beyond overflow", shear(law, 0, 5000, h, 3),
               tau0 * (5000 + log(2 * 3 / (tau0 * h))), 1e-13);
    check_true("  in range there", status == FF_OK);
    check_extremes(law);
    stage_close(s);
}

static void carreau(void)
{
    const double G = 5e6, n = 0.463, h = 2e-7;
    stage *s = open_law("rheology/carreau", G, 0);
    const ff_rheology *law = service(s);
    double worst = 0, odd = 0, last = 0;
    int rising = 1;
    printf("carreau\n");
    for (double ln_eta = -10; ln_eta < 250; ln_eta += 0.7) {
        double tau = shear(law, 0, ln_eta, h, 3), S = exp(ln_eta) * 3 / (G * h);
        worst = fmax(worst, fabs(tau / (G * S * pow(1 + S * S, (n - 1) / 2)) - 1));
        odd = fmax(odd, fabs(tau + shear(law, 0, ln_eta, h, -3)));
        rising = rising && tau > last;
        last = tau;
    }
    /* the exponent, up to 125, is rounded before the exponential */
    check_below("  G S (1 + S^2)^((n - 1)/2)", worst, 1e-12);
    check_below("  odd in the sliding speed", odd, 0);
    check_true("  rises with viscosity", rising);
    check_true("  finite and out of range far beyond",
               isfinite(shear(law, 0, 5000, h, 3)) && status == FF_DOMAIN);
    check_extremes(law);
    stage_close(s);
}

/* tau0 -> infinity; the error of asinh is S^2/6. */
static void large_tau0_is_newtonian(void)
{
    stage *eyring = open_law("rheology/ree-eyring", 1e30, 0);
    stage *newton = open_law("rheology/newtonian", 0, 0);
    printf("ree-eyring without thinning\n");
    for (double ln_eta = -8; ln_eta < 20; ln_eta += 9)
        check_near("  Newtonian", shear(service(eyring), 0, ln_eta, 1e-7, 2),
                   shear(service(newton), 0, ln_eta, 1e-7, 2), 1e-13);
    stage_close(eyring);
    stage_close(newton);
}

static void limiting_stress(const char *id, double stress)
{
    stage *bare = open_law(id, stress, 0), *cut = open_law(id, stress, 0.05);
    printf("%s with a limiting stress\n", id);
    check_near("  0.05 p where the law asks for more", shear(service(cut), 1e9, 25, 1e-7, -2),
               -0.05e9, 1e-15);
    check_true("  no change where it asks for less",
               shear(service(cut), 1e9, -5, 1e-7, 2) == shear(service(bare), 1e9, -5, 1e-7, 2));
    check_near("  4 MPa where the pressure is low, and none", shear(service(cut), 0, 25, 1e-7, 2),
               4e6, 1e-15);
    check_true("  no change below that, as in an inlet",
               shear(service(cut), 1e5, -4, 1e-6, 2) == shear(service(bare), 1e5, -4, 1e-6, 2));
    check_extremes(service(cut));
    stage_close(bare);
    stage_close(cut);
}

int main(void)
{
    newtonian();
    ree_eyring();
    carreau();
    large_tau0_is_newtonian();
    limiting_stress("rheology/newtonian", 0);
    limiting_stress("rheology/ree-eyring", 5e6);
    limiting_stress("rheology/carreau", 5e6);
    return check_done();
}
