/* @ID@: ln eta = ln eta0 + alpha p. Write your law into `eval`. */
#include <flankfilm/author.h>
#include <flankfilm/laws.h>

#include <math.h>

typedef struct {
    const ff_host *host;
    ff_viscosity service;
    double eta0, alpha; /* Pa s, 1/Pa */
} law;

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta,
                      double *dln_dp, double *dln_dT)
{
    const law *l = self;
    const double ln_eta0 = log(l->eta0);
    (void)T; /* NULL: the reference temperature */
    for (size_t i = 0; i < n; i++) {
        ln_eta[i] = ln_eta0 + l->alpha * p[i];
        if (dln_dp)
            dln_dp[i] = l->alpha;
        if (dln_dT)
            dln_dT[i] = 0;
    }
    return FF_OK;
}

static const ff_param params[] = {
    FF_QUANTITY("eta0", "mPa s", law, eta0, FF_REQUIRED, NULL, NULL, 0.01, 1e6, 0, 0,
                "viscosity at ambient pressure"),
    FF_QUANTITY("alpha", "1/GPa", law, alpha, 0, "11 1/GPa", NULL, 0, 1000, 2, 50,
                "pressure-viscosity coefficient"),
};

/* `cost`: seconds for a million points; a law with a cost is a candidate for viscosity/auto. */
FF_VISCOSITY_LAW(model, law, eval, .id = "@ID@", .version = "0.1.0",
                 .summary = "one line that says what the model is for", .reference = "",
                 .bibtex = "", .licence = "MIT", .params = FF_TABLE(params), .cost = 1e-3);
FF_EXPORT_MODELS(&model);
