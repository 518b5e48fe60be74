/* @ID@: rho = rho0 (1 + C p/(1 + D p)). Write your law into `eval`. */
#include <flankfilm/author.h>
#include <flankfilm/laws.h>

typedef struct {
    const ff_host *host;
    ff_density service;
    double rho0;
} law;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *rho,
                      double *drho_dp, double *drho_dT)
{
    const law *l = self;
    const double C = 0.6e-9, D = 1.7e-9; /* 1/Pa */
    (void)T;                             /* NULL: the reference temperature */
    for (size_t i = 0; i < n; i++) {
        double x = p[i] > 0 ? p[i] : 0, slope = C / ((1 + D * x) * (1 + D * x));
        double tension = p[i] > -0.5 / C ? p[i] - x : -0.5 / C; /* keeps rho above 0 */
        rho[i] = l->rho0 * (1 + C * x / (1 + D * x) + slope * tension);
        if (drho_dp)
            drho_dp[i] = l->rho0 * (p[i] > -0.5 / C ? slope : 0);
        if (drho_dT)
            drho_dT[i] = 0;
    }
    return FF_OK;
}

static const ff_param params[] = {
    FF_QUANTITY("rho0", "kg/m3", law, rho0, FF_REQUIRED, NULL, NULL, 1, 1e5, 600, 2000,
                "density at ambient pressure"),
};

/* `cost`: seconds for a million points; a law with a cost is a candidate for density/auto. */
FF_DENSITY_LAW(model, law, eval, .id = "@ID@", .version = "0.1.0",
               .summary = "one line that says what the model is for", .reference = "", .bibtex = "",
               .licence = "MIT", .params = FF_TABLE(params), .cost = 4e-3);
FF_EXPORT_MODELS(&model);
