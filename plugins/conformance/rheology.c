/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checks of a rheology: shear never makes the oil stiffer than a Newtonian one, in either
   direction. */
#include "law-checks.h"
#include "law-data.h"
#include "offer.h"

#include <flankfilm/laws.h>

#include <math.h>
#include <string.h>

static ff_status flow(const void *table, size_t n, const double *const *in, double speed,
                      double *const *out)
{
    const ff_rheology *law = table;
    return law->flow(law->self, n, in[0], in[1], speed, out[0], out[1], out[2]);
}

static ff_status shear(const void *table, size_t n, const double *const *in, double speed,
                       double *const *out)
{
    const ff_rheology *law = table;
    return law->shear(law->self, n, in[0], in[1], in[2], speed, out[0]);
}

static ff_status rate(const void *table, size_t n, const double *const *in, double speed,
                      double *const *out)
{
    const ff_rheology_2 *law = table;
    (void)speed;
    return law->rate(law->self, n, in[2], in[3], in[1], in[0], out[0], out[1], out[2]);
}

static ff_status flow_at_pressure(const void *table, size_t n, const double *const *in,
                                  double speed, double *const *out)
{
    const ff_rheology_3 *law = table;
    return law->flow(law->self, n, in[2], in[3], in[0], in[1], speed, out[0], out[3], out[1],
                     out[2]);
}

static ff_status shear_at_pressure(const void *table, size_t n, const double *const *in,
                                   double speed, double *const *out)
{
    const ff_rheology_3 *law = table;
    return law->shear(law->self, n, in[0], in[3], in[1], in[2], speed, out[0]);
}

const conformance_function conformance_functions[] = {
    {.service = FF_RHEOLOGY_ID,
     .name = "flow",
     .size = sizeof(ff_rheology),
     .axes = {&conformance_ln_eta, &conformance_film},
     .axis_count = 2,
     .results = {"psi", "dpsi_dln_eta", "dpsi_dh"},
     .by = {0, 0, 1},
     .result_count = 3,
     .speeds = {0, 1.5, -1.5},
     .speed_count = 3,
     .positive = true,
     .call = flow},
    {.service = FF_RHEOLOGY_ID,
     .name = "shear",
     .size = sizeof(ff_rheology),
     .axes = {&conformance_pressure, &conformance_ln_eta, &conformance_film},
     .axis_count = 3,
     .results = {"tau"},
     .result_count = 1,
     .speeds = {0, 1.5, -1.5},
     .speed_count = 3,
     .follows_speed = true,
     .call = shear},
    {.service = FF_RHEOLOGY_2_ID,
     .name = "rate",
     .size = sizeof(ff_rheology_2),
     .axes = {&conformance_stress, &conformance_ln_eta, &conformance_pressure,
              &conformance_temperature},
     .axis_count = 4,
     .results = {"rate", "drate_dtau", "drate_dln_eta"},
     .by = {0, 0, 1},
     .result_count = 3,
     .speed_count = 1,
     .rising = true,
     .call = rate},
    {.service = FF_RHEOLOGY_3_ID,
     .name = "flow at pressure",
     .size = sizeof(ff_rheology_3),
     .axes = {&conformance_ln_eta, &conformance_film, &conformance_pressure,
              &conformance_temperature},
     .axis_count = 4,
     .results = {"psi", "dpsi_dln_eta", "dpsi_dh", "dpsi_dp"},
     .by = {0, 0, 1, 2},
     .result_count = 4,
     .speeds = {0, 1.5, -1.5},
     .speed_count = 3,
     .positive = true,
     .call = flow_at_pressure},
    {.service = FF_RHEOLOGY_3_ID,
     .name = "shear at pressure",
     .size = sizeof(ff_rheology_3),
     .axes = {&conformance_pressure, &conformance_ln_eta, &conformance_film,
              &conformance_temperature},
     .axis_count = 4,
     .results = {"tau"},
     .result_count = 1,
     .speeds = {0, 1.5, -1.5},
     .speed_count = 3,
     .follows_speed = true,
     .call = shear_at_pressure},
};
const size_t conformance_function_count =
    sizeof conformance_functions / sizeof conformance_functions[0];

static ff_status plain_flow(const void *self, size_t n, const double *ln_eta, const double *h,
                            double u_s, double *psi, double *by_ln_eta, double *by_h)
{
    (void)self, (void)h, (void)u_s;
    for (size_t i = 0; i < n; i++) {
        psi[i] = exp(-fmin(fmax(ln_eta[i], -700), 700));
        if (by_ln_eta)
            by_ln_eta[i] = -psi[i];
        if (by_h)
            by_h[i] = 0;
    }
    return FF_OK;
}

static ff_status plain_shear(const void *self, size_t n, const double *p, const double *ln_eta,
                             const double *h, double u_s, double *tau)
{
    (void)self, (void)p;
    for (size_t i = 0; i < n; i++)
        tau[i] = fmin(exp(fmin(ln_eta[i], 700)) / h[i], 1e300) * fmin(fmax(u_s, -1e3), 1e3);
    return FF_OK;
}

static const ff_rheology newtonian_liquid = {sizeof newtonian_liquid, NULL, plain_flow,
                                             plain_shear};

enum { POINTS = 200 };

static int agree(double a, double b)
{
    return fabs(a - b) <= 1e-9 * fmax(fabs(a), fabs(b)) + 1e-300;
}

/* Shear thinning: psi >= 1/eta and |tau| <= eta |u_s|/h; psi is even and tau odd in u_s. */
static void check_point(const ff_fixture *fixture, const ff_rheology *law)
{
    double ln_eta = -7 + 20 * fixture->random(fixture->ctx),
           p = 2e9 * fixture->random(fixture->ctx),
           h = 1e-8 * pow(1e4, fixture->random(fixture->ctx)),
           u = 5 * fixture->random(fixture->ctx), psi, psi_back, tau, tau_back, eta = exp(ln_eta);
    law->flow(law->self, 1, &ln_eta, &h, u, &psi, NULL, NULL);
    law->flow(law->self, 1, &ln_eta, &h, -u, &psi_back, NULL, NULL);
    law->shear(law->self, 1, &p, &ln_eta, &h, u, &tau);
    law->shear(law->self, 1, &p, &ln_eta, &h, -u, &tau_back);
    if (!(psi >= (1 - 1e-9) / eta))
        ff_check_failf(fixture,
                       "flow: the fluidity psi is %g, less than 1/eta = %g of the Newtonian liquid",
                       psi, 1 / eta);
    else if (!(fabs(tau) <= (1 + 1e-9) * eta * u / h))
        ff_check_failf(fixture,
                       "shear: tau is %g Pa, more than eta u_s/h = %g Pa of the Newtonian liquid",
                       tau, eta * u / h);
    else if (!agree(psi, psi_back))
        ff_check_failf(fixture, "flow: psi is %g at u_s = %g m/s, but %g at the opposite speed",
                       psi, u, psi_back);
    else if (!agree(tau, -tau_back))
        ff_check_failf(fixture, "shear: tau is %g at u_s = %g m/s, but %g at the opposite speed",
                       tau, u, tau_back);
}

static void newtonian(const ff_fixture *fixture)
{
    void *instance = fixture->open(fixture->ctx);
    const ff_rheology *law = instance ? fixture->service(fixture->ctx, instance, 0) : NULL;
    fixture->step(fixture->ctx, "calling flow and shear");
    for (int i = 0; i < POINTS && law; i++)
        check_point(fixture, law);
    fixture->close(fixture->ctx, instance);
}

/* Shear thinning at a point: |rate| >= |tau|/eta; the rate is odd in tau. */
static void check_rate(const ff_fixture *fixture, const ff_rheology_2 *law)
{
    double ln_eta = -7 + 20 * fixture->random(fixture->ctx),
           p = 2e9 * fixture->random(fixture->ctx), T = 350,
           tau = 5e7 * fixture->random(fixture->ctx), back = -tau, rate, rate_back,
           least = tau * exp(-ln_eta);
    law->rate(law->self, 1, &p, &T, &ln_eta, &tau, &rate, NULL, NULL);
    law->rate(law->self, 1, &p, &T, &ln_eta, &back, &rate_back, NULL, NULL);
    if (!(rate >= (1 - 1e-9) * least))
        ff_check_failf(fixture,
                       "rate: the shear rate is %g 1/s, less than tau/eta = %g 1/s of the "
                       "Newtonian liquid",
                       rate, least);
    else if (!agree(rate, -rate_back))
        ff_check_failf(fixture,
                       "rate: the shear rate is %g 1/s at tau = %g Pa, but %g 1/s at the "
                       "opposite stress",
                       rate, tau, rate_back);
}

/* Checks the shear rates if the rheology offers them. */
static void check_rates(const ff_fixture *fixture)
{
    void *instance = fixture->open(fixture->ctx);
    const ff_rheology_2 *law = NULL;
    for (uint32_t i = 0; i < fixture->model->output_count && instance; i++) {
        const ff_port *row = (const void *)((const char *)fixture->model->outputs +
                                            i * fixture->model->output_stride);
        if (row->service && !strcmp(row->service, FF_RHEOLOGY_2_ID))
            law = fixture->service(fixture->ctx, instance, i);
    }
    for (int i = 0; i < POINTS && law; i++)
        check_rate(fixture, law);
    fixture->close(fixture->ctx, instance);
}

/* Checks that psi is the derivative of the shear rate with respect to the stress, and that the
   stress depends on u_s/h only. */
static void check_tangent(const ff_fixture *fixture, const ff_rheology *law)
{
    const double d = 1e-4;
    double ln_eta = -6 + 12 * fixture->random(fixture->ctx), p = 2e9,
           h = 1e-7 * pow(1e2, fixture->random(fixture->ctx)),
           u = 1e-2 * pow(1e3, fixture->random(fixture->ctx)), twice = 2 * h, psi, tau[4];
    law->flow(law->self, 1, &ln_eta, &h, u, &psi, NULL, NULL);
    law->shear(law->self, 1, &p, &ln_eta, &h, u * (1 - d), &tau[0]);
    law->shear(law->self, 1, &p, &ln_eta, &h, u * (1 + d), &tau[1]);
    law->shear(law->self, 1, &p, &ln_eta, &h, u, &tau[2]);
    law->shear(law->self, 1, &p, &ln_eta, &twice, 2 * u, &tau[3]);
    double slope = 2 * d * u / h / (tau[1] - tau[0]);
    if (!(fabs(tau[3] - tau[2]) <= 1e-6 * tau[2]))
        ff_check_failf(
            fixture,
            "shear: tau is %.6g Pa at u_s = %g m/s, h = %g m, but %.6g Pa if both are doubled, "
            "although the shear rate is the same",
            tau[2], u, h, tau[3]);
    else if (!(fabs(psi - slope) <= 1e-3 * slope))
        ff_check_failf(
            fixture,
            "flow: psi is %.6g at ln_eta = %g, u_s = %g m/s, h = %g m, but the derivative of the "
            "shear rate with respect to the stress is %.6g",
            psi, ln_eta, u, h, slope);
}

static void tangent(const ff_fixture *fixture)
{
    void *instance;
    const ff_rheology *law = conformance_open_law(fixture, FF_RHEOLOGY_ID, &instance);
    fixture->step(fixture->ctx, "calling flow and shear");
    for (int i = 0; i < POINTS && law; i++)
        check_tangent(fixture, law);
    fixture->close(fixture->ctx, instance);
}

static const ff_check checks[] = {
    CONFORMANCE_LAW_CHECKS,
    {"newtonian", "shear thins the oil or leaves it Newtonian, equally in both directions",
     newtonian},
    {"rates", "the shear rate, if offered, is not below the Newtonian rate at any stress",
     check_rates},
    {"tangent", "pressure flow and shear follow the same flow curve", tangent},
};

const ff_conformance conformance_offer = {.size = sizeof conformance_offer,
                                          .checks = FF_TABLE(checks),
                                          .service = FF_RHEOLOGY_ID,
                                          .plain = &newtonian_liquid};

CONFORMANCE_MODEL("rheology",
                  "checks of a rheology: finite, pure, shear-thinning, odd in the sliding speed",
                  "");
