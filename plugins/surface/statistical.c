/* SPDX-License-Identifier: GPL-3.0-or-later */
/* surface/statistical: rough flanks described by statistics of their asperities. For a Gaussian
   distribution of the summit heights, the asperities of both flanks carry the pressure (Greenwood &
   Tripp 1970-71) * p_a = K E'/2 F_5/2(h/sigma), K = (16 sqrt 2/15) pi (eta beta sigma)^2
   sqrt(sigma/beta) * with the distance h of the mean planes, sigma = hypot(Rq1, Rq2), and eta
   summits of radius beta per area. F_5/2(H) is the integral, or its fit 4.4086e-5 (4 - H)^6.804 for
   H < 4 and 0 above (Hu et al. 1994). Alternatively, p_a over h/sigma comes from a table. */
#include "../lubricant/curve.h"
#include "references.h"

#include <flankfilm/author.h>
#include <flankfilm/laws.h>
#include <flankfilm/simd.h>
#include <flankfilm/table.h>

#include <math.h>
#include <stdlib.h>

static const double modulus = 230e9; /* E' of steel on steel, Pa, for which p_a is computed */

typedef struct statistical {
    const ff_host *host;
    ff_asperity service;
    ff_reals rq;    /* m, one value or two */
    double cutoff;  /* m; NaN: length of the contact */
    double density; /* eta, 1/m2; NaN: from summit_product */
    double radius;  /* beta, m; NaN: from summit_slope */
    double product, slope;
    double stiffness;      /* K modulus/2, Pa */
    int32_t closure;       /* 1: integral */
    const char *path;      /* path of the table; NULL: there is none */
    lubricant_curve curve; /* ln(p_a / 1 Pa) over h/sigma, from the integral or the table */
} statistical;

enum { FIT, INTEGRAL };

/* Columns of the table. */
enum { DISTANCE, PRESSURE };

static const ff_param columns[] = {
    FF_COLUMN("distance", "1", FF_REQUIRED | FF_INCREASING, NULL, -10, 20,
              "distance of the mean planes, h/sigma"),
    FF_COLUMN("pressure", "MPa", FF_REQUIRED, NULL, 1e-12, 1e6,
              "asperity pressure of steel on steel"),
};

enum { OUT_RQ_1, OUT_RQ_2, OUT_CUTOFF, OUT_DENSITY, OUT_RADIUS, OUT_ASPERITIES, OUTPUTS };

static const ff_port outputs[OUTPUTS] = {
    [OUT_RQ_1] = {.name = "rq_1",
                  .unit = "m",
                  .doc = "root mean square roughness of flank 1",
                  .dims = "",
                  .max = 100e-6},
    [OUT_RQ_2] = {.name = "rq_2",
                  .unit = "m",
                  .doc = "root mean square roughness of flank 2",
                  .dims = "",
                  .max = 100e-6},
    [OUT_CUTOFF] = {.name = "cutoff",
                    .unit = "m",
                    .doc = "wavelength of the longest waves included in the roughness; 0: length "
                           "of the contact",
                    .dims = ""},
    [OUT_DENSITY] = {.name = "summit_density",
                     .unit = "1/m2",
                     .doc = "summits per area",
                     .dims = "",
                     .max = INFINITY},
    [OUT_RADIUS] = {.name = "summit_radius",
                    .unit = "m",
                    .doc = "radius of the summits of the asperities",
                    .dims = "",
                    .max = INFINITY},
    [OUT_ASPERITIES] = {.name = "asperities",
                        .unit = "",
                        .doc = "asperity pressure as a function of the distance of the flanks",
                        .dims = "",
                        .service = FF_ASPERITY_ID},
};

static const ff_param params[] = {
    FF_LIST("rq", "um", statistical, rq, FF_REQUIRED, NULL, NULL, 1e-4, 100, 0.02, 2, 1, 2,
            "root mean square roughness of flank 1 and flank 2, for waves shorter than cutoff; one "
            "number: both"),
    FF_QUANTITY_OR(
        "auto", "cutoff", "um", statistical, cutoff, FF_MIN_OPEN, "auto", NULL, 0, 1e4, 20, 800,
        "wavelength of the longest waves included in rq; auto: length of the contact, since the "
        "contact follows longer waves. The film stage warns if the cut-off is longer than the "
        "contact"),
    FF_QUANTITY("summit_density", "1/mm^2", statistical, density, 0, NULL, NULL, 0, 1e12, 0, 0,
                "summits per area; with summit_radius, instead of summit_product and summit_slope"),
    FF_QUANTITY("summit_radius", "um", statistical, radius, FF_MIN_OPEN, NULL, NULL, 0, 1e9, 0, 0,
                "radius of the summits of the asperities"),
    FF_QUANTITY("summit_product", "1", statistical, product, 0, "0.05", NULL, 0, 1, 0.03, 0.05,
                "summit density times summit radius times sigma (Greenwood & Tripp 1970-71)"),
    FF_QUANTITY(
        "summit_slope", "1", statistical, slope, FF_MIN_OPEN, "0.01", NULL, 0, 10, 1e-4, 0.1,
        "sigma over the summit radius; the asperity pressure is proportional to its square root"),
    FF_ONE_OF("fit|integral", "closure", statistical, closure, 0, "fit",
              "F_5/2: the fit of Hu et al., which is 0 beyond 4 sigma, or the exact integral for "
              "Gaussian summits"),
    FF_PATH("table", statistical, path, 0, NULL,
            "table that replaces the pressure of Greenwood & Tripp, with the columns distance [1] "
            "(h/sigma) and pressure [MPa] for steel on steel, E' = 230 GPa; ln p_a is extrapolated "
            "linearly beyond its rows"),
};

FF_SIMD
static int64_t carry(double stiffness, double sigma, size_t n, const double *restrict h,
                     double *restrict p_a, double *restrict slope)
{
    const double factor = 4.4086e-5, power = 6.804, lowest = -1e3;
    int64_t extrapolated = 0;
    for (size_t i = 0; i < n; i++) {
        double H = h[i] / sigma, held = H > lowest ? H : lowest, below = 4 - held;
        double deep = below > 1e-30 ? below : 1e-30;
        double rise = stiffness * factor * ff_exp((power - 1) * ff_log(deep));
        double p = below > 0 ? rise * deep : 0;
        p_a[i] = p;
        slope[i] = below > 0 ? -power * rise / sigma : 0;
        extrapolated |= H < 0;
    }
    return extrapolated;
}

/* Evaluates p_a and its slope from the curve. */
FF_SIMD
static void carry_on(double sigma, size_t n, double *restrict p_a, double *restrict slope)
{
    const double most = 69; /* ln(1e30 Pa / 1 Pa) */
    for (size_t i = 0; i < n; i++) {
        double p = ff_exp(p_a[i] < most ? p_a[i] : most);
        slope[i] = p_a[i] < most ? p * slope[i] / sigma : 0;
        p_a[i] = p;
    }
}

static ff_status pressure_by_curve(const void *self, size_t n, const double *h, double *p_a,
                                   double *dp_a_dh)
{
    enum { BLOCK = 256 };
    const statistical *s = self;
    const double first = s->path ? s->curve.x[0] : 0, sigma = s->service.sigma, far = 1e3;
    double H[BLOCK], unwanted[BLOCK];
    int extrapolated = 0;
    for (size_t from = 0; from < n; from += BLOCK) {
        size_t count = n - from < BLOCK ? n - from : BLOCK;
        double *slope = dp_a_dh ? dp_a_dh + from : unwanted;
        for (size_t i = 0; i < count; i++) {
            H[i] = fmin(fmax(h[from + i] / sigma, -far), far);
            extrapolated |= H[i] < first;
        }
        lubricant_curve_values(&s->curve, count, H, p_a + from, slope);
        carry_on(sigma, count, p_a + from, slope);
    }
    return extrapolated ? FF_DOMAIN : FF_OK;
}

/* F_k(H) = int_H^inf (s - H)^k phi(s) ds, k = 5/2, with the density phi of a standard normal
 * variable. With s = H + t^2 the integrand is an even analytic function of t, so that a sum over
 * equal steps from t = 0 converges faster than any power of the step. */
static double summits(double H)
{
    enum { STEPS = 200 };
    const double end = sqrt(fmax(9 - H, 1)), dt = end / STEPS;
    double sum = 0;
    for (int i = 1; i <= STEPS; i++) {
        double t = i * dt, s = H + t * t;
        sum += 2 * pow(t, 6) * exp(-s * s / 2);
    }
    return sum * dt / sqrt(2 * M_PI);
}

static ff_status make_integral(statistical *s)
{
    enum { POINTS = 401 }; /* points of H, from -2 to 6 */
    double H[POINTS], ln[POINTS];
    for (int i = 0; i < POINTS; i++) {
        H[i] = -2 + 0.02 * i;
        ln[i] = log(s->stiffness * summits(H[i]));
    }
    return lubricant_curve_make(&s->curve, POINTS, H, ln) ? FF_OK : FF_NOMEM;
}

static ff_status read_table(statistical *s)
{
    const ff_table *t;
    ff_status status = ff_table_read(s->host, "table", s->path, FF_TABLE(columns), &t);
    if (status != FF_OK)
        return status;
    const double *p = t->columns[PRESSURE];
    if (t->row_count < 2)
        return ff_table_failf(s->host, t, FF_TABLE_ALL, PRESSURE,
                              "at least two distances are needed");
    double *ln = malloc(t->row_count * sizeof *ln);
    for (size_t i = 0; ln && i < t->row_count; i++)
        ln[i] = log(p[i]);
    int made = ln && lubricant_curve_make(&s->curve, t->row_count, t->columns[DISTANCE], ln);
    free(ln);
    for (size_t i = 1; i < t->row_count; i++)
        if (!(p[i] < p[i - 1]))
            return ff_table_failf(s->host, t, i, PRESSURE,
                                  "the pressure must decrease with the distance of the flanks");
    if (!made)
        return FF_NOMEM;
    for (size_t end = 0, row = 0; end < 2; end++, row = t->row_count - 1)
        if (!(s->curve.slope[row] < 0))
            return ff_table_failf(s->host, t, row, PRESSURE,
                                  "the slope of ln p_a is 0 at this end, so the extrapolated "
                                  "pressure would stay constant: add a row beyond this end");
    return FF_OK;
}

static ff_status pressure(const void *self, size_t n, const double *h, double *p_a, double *dp_a_dh)
{
    enum { BLOCK = 256 };
    const statistical *s = self;
    double unwanted[BLOCK];
    int64_t extrapolated = 0;
    for (size_t from = 0; from < n; from += BLOCK) {
        size_t count = n - from < BLOCK ? n - from : BLOCK;
        extrapolated |= carry(s->stiffness, s->service.sigma, count, h + from, p_a + from,
                              dp_a_dh ? dp_a_dh + from : unwanted);
    }
    return extrapolated ? FF_DOMAIN : FF_OK;
}

static ff_status ready(void *self)
{
    statistical *s = self;
    const double sigma = hypot(ff_of_both(&s->rq, 0), ff_of_both(&s->rq, 1));
    const int by_numbers = !isnan(s->density);
    if (by_numbers != !isnan(s->radius))
        return ff_failf(s->host, FF_INVALID, by_numbers ? "summit_radius" : "summit_density",
                        "summit_density and summit_radius belong together: give both, or none");
    const char *const by = s->path ? "table" : "summit_density";
    const ff_serving rows[] = {
        {by_numbers || s->path, "summit_product", "", by, NULL},
        {by_numbers || s->path, "summit_slope", "", by, NULL},
        {!!s->path, "summit_density", "", "table", NULL},
        {!!s->path, "summit_radius", "", "table", NULL},
        {!!s->path, "closure", "", "table", NULL},
    };
    ff_serve(s->host, rows, sizeof rows / sizeof rows[0]);
    if (!by_numbers) {
        s->radius = sigma / s->slope;
        s->density = s->product / (s->radius * sigma);
    }
    const double product = s->density * s->radius * sigma;
    const double K = 16 * sqrt(2) / 15 * M_PI * product * product * sqrt(sigma / s->radius);
    if (!isfinite(K))
        return ff_failf(s->host, FF_INVALID, "summit_density",
                        "with these summits the asperity pressure is not finite");
    s->stiffness = K * modulus / 2;
    s->service.sigma = sigma;
    lubricant_curve_free(&s->curve);
    if (!s->path && (s->closure == FIT || !(K > 0)))
        return FF_OK;
    s->service.pressure = pressure_by_curve;
    return s->path ? read_table(s) : make_integral(s);
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const statistical *s = self;
    const double values[] = {[OUT_RQ_1] = ff_of_both(&s->rq, 0),
                             [OUT_RQ_2] = ff_of_both(&s->rq, 1),
                             [OUT_CUTOFF] = isnan(s->cutoff) ? 0 : s->cutoff,
                             [OUT_DENSITY] = s->density,
                             [OUT_RADIUS] = s->radius};
    (void)in;
    for (uint32_t k = 0; k < OUT_ASPERITIES; k++)
        if (wanted & FF_BIT(k) && ff_put_scalar(s->host, k, values[k]) != FF_OK)
            return FF_NOMEM;
    return FF_OK;
}

static void destroy(void *self)
{
    statistical *s = self;
    if (s)
        lubricant_curve_free(&s->curve);
    free(s);
}

static const void *service(void *self, uint32_t row)
{
    statistical *s = self;
    return row == OUT_ASPERITIES ? &s->service : NULL;
}

static ff_status create(const ff_host *host, void **self)
{
    statistical *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    s->service = (ff_asperity){sizeof s->service, s, NAN, pressure, modulus};
    *self = s;
    return FF_OK;
}

const ff_model surface_statistical = {
    FF_HEAD(statistical, create),
    .id = "surface/statistical",
    .version = "1.0.0",
    .summary = "statistical asperities, which carry a share of the load of a mixed film",
    .reference = "Greenwood & Tripp 1970-71, Proc. IMechE 185, 625-633; Hu et al. 1994, J. Tribol. "
                 "116, 470-478 (the fit of F_5/2)",
    .bibtex = BIB_greenwood1970 "\n" BIB_hu1994,
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .outputs = FF_TABLE(outputs),
    .ready = ready,
    .evaluate = evaluate,
    .service = service,
    .destroy = destroy,
};
