/* @ID@: psi = sqrt(1/eta^2 + (u_s/(tau0 h))^2) of Ree and Eyring. Write your law into `flow` and
   `shear`. */
#include <flankfilm/author.h>
#include <flankfilm/laws.h>

#include <math.h>

typedef struct {
    const ff_host *host;
    ff_rheology service;
    double tau0;
} law;

static ff_status flow(const void *self, size_t n, const double *ln_eta, const double *h, double u_s,
                      double *psi, double *dpsi_dln_eta, double *dpsi_dh)
{
    const law *l = self;
    for (size_t i = 0; i < n; i++) {
        int inside = fabs(ln_eta[i]) < 600;
        int thick = h[i] > 1e-12;
        double film = thick ? h[i] : 1e-12;
        double a = exp(-fmax(-600, fmin(600, ln_eta[i]))), b = u_s / (l->tau0 * film);
        psi[i] = hypot(a, b);
        if (dpsi_dln_eta)
            dpsi_dln_eta[i] = inside ? -a * (a / psi[i]) : 0;
        if (dpsi_dh)
            dpsi_dh[i] = thick ? -b / film * (b / psi[i]) : 0;
    }
    return FF_OK;
}

static ff_status shear(const void *self, size_t n, const double *p, const double *ln_eta,
                       const double *h, double u_s, double *tau)
{
    const law *l = self;
    (void)p; /* pressure, for laws with a limiting stress */
    for (size_t i = 0; i < n; i++) {
        double newtonian = fmin(exp(fmin(600, ln_eta[i])) / fmax(h[i], 1e-12), 1e300);
        tau[i] = l->tau0 * asinh(newtonian / l->tau0 * u_s);
    }
    return FF_OK;
}

static const ff_param params[] = {
    FF_QUANTITY("tau0", "MPa", law, tau0, FF_REQUIRED, NULL, NULL, 1e-3, 1e3, 1, 20,
                "Eyring stress"),
};

/* `cost`: seconds for a million points; a law with a cost is a candidate for rheology/auto. */
FF_RHEOLOGY_LAW(model, law, flow, shear, .id = "@ID@", .version = "0.1.0",
                .summary = "one line that says what the model is for", .reference = "",
                .bibtex = "", .licence = "MIT", .params = FF_TABLE(params), .cost = 4e-3);
FF_EXPORT_MODELS(&model);
