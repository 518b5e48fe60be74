/* SPDX-License-Identifier: MIT */
/*
 * Free-volume viscosity of Yasutomi, Bair & Winer 1984, J. Tribology 106, 291-303 (eq 5 to 7):
 *
 *   log10 eta = log10 eta_g - C1 (T - Tg) F/(C2 + (T - Tg) F)
 *   Tg = Tg0 + A1 ln(1 + A2 p),   F = 1 - B1 ln(1 + B2 p)
 *
 * The presets are those of the polyphenyl ether 5P4E after Ehret, Dowson & Taylor 1998.
 */
#include <flankfilm/author.h>
#include <flankfilm/viscosity.h>

#include <cmath>
#include <new>

namespace {

enum { TG0, A1, A2, B1, B2, C1, C2, ETA_G, TEMPERATURE, PARAMS };

const ff_param params[] = {
    {.name = "Tg0", .unit = "degC", .doc = "glass transition temperature at ambient pressure", .type = FF_REAL, .preset = "-28.2 degC", .min = -200, .max = 200},
    {.name = "A1", .unit = "K", .doc = "rise of Tg with pressure", .type = FF_REAL, .flags = FF_MIN_OPEN, .preset = "134.2 K", .min = 0, .max = 1e4},
    {.name = "A2", .unit = "1/GPa", .doc = "inverse of the pressure at which the rise bends", .type = FF_REAL, .flags = FF_MIN_OPEN, .preset = "1.929 1/GPa", .min = 0, .max = 1e3},
    {.name = "B1", .unit = "", .doc = "fall of the expansion of free volume with pressure", .type = FF_REAL, .preset = "4.815", .min = 0, .max = 100},
    {.name = "B2", .unit = "1/GPa", .doc = "inverse of the pressure at which the fall bends", .type = FF_REAL, .preset = "0.160 1/GPa", .min = 0, .max = 1e3},
    {.name = "C1", .unit = "", .doc = "decades from eta_g down to the limit of hot oil", .type = FF_REAL, .flags = FF_MIN_OPEN, .preset = "16.01", .min = 0, .max = 40},
    {.name = "C2", .unit = "K", .doc = "temperature above Tg at which half of them are gone", .type = FF_REAL, .flags = FF_MIN_OPEN, .preset = "20.69 K", .min = 0, .max = 1e3},
    {.name = "eta_g", .unit = "Pa s", .doc = "viscosity at the glass transition", .type = FF_REAL, .preset = "1e12 Pa s", .min = 1e3, .max = 1e15},
    {.name = "temperature", .unit = "degC", .doc = "reference temperature", .type = FF_REAL, .preset = "100 degC", .min = -100, .max = 400},
};
static_assert(sizeof params / sizeof params[0] == PARAMS, "a row for each parameter");

const ff_port outputs[] = {
    {.name = "viscosity", .unit = "", .doc = "eta(p, T)", .dims = "", .service = FF_VISCOSITY_ID},
};

struct law {
    ff_viscosity service;
    double c[PARAMS];
};

/* Below it, and below Tg, the product (T - Tg) F would turn back: there the free volume keeps this
   share, so that the viscosity of the glass still rises. */
constexpr double least_share = 0.01;

struct point {
    double ln_eta, dp, dT, dpdT;
    bool inside;
};

point at(const double *c, double p, double T)
{
    const double a = 1 + c[A2] * p, b = 1 + c[B2] * p;
    const double above = T - c[TG0] - c[A1] * std::log(a), fall = 1 - c[B1] * std::log(b);
    const bool liquid = above > 0, free = liquid && fall > least_share;
    const double F = free ? fall : least_share, F_p = free ? -c[B1] * c[B2] / b : 0;
    const double x = above * F, x_p = -c[A1] * c[A2] / a * F + above * F_p;
    const double decades = c[C1] * std::log(10.0), room = liquid ? c[C2] + x : c[C2];
    /* the glass goes on along the tangent at Tg */
    const double f = liquid ? x / room : x / c[C2], f_x = liquid ? c[C2] / room / room : 1 / c[C2];
    const double f_xx = liquid ? -2 * c[C2] / room / room / room : 0;
    return {std::log(c[ETA_G]) - decades * f, -decades * f_x * x_p, -decades * f_x * F,
            -decades * (f_xx * F * x_p + f_x * F_p), free};
}

ff_status eval(const void *self, size_t n, const double *p, const double *T, double *ln_eta, double *dln_dp, double *dln_dT)
{
    const double *c = static_cast<const law *>(self)->c;
    bool inside = true;
    for (size_t i = 0; i < n; i++) {
        const double tension = std::fmin(p[i], 0.0), t = T ? std::fmax(T[i], 1.0) : c[TEMPERATURE];
        const point q = at(c, p[i] - tension, t); /* below p = 0 along the tangent there */
        inside = inside && q.inside;
        ln_eta[i] = q.ln_eta + q.dp * tension;
        if (dln_dp)
            dln_dp[i] = q.dp;
        if (dln_dT)
            dln_dT[i] = T && T[i] < 1 ? 0 : q.dT + q.dpdT * tension;
    }
    return inside ? FF_OK : FF_DOMAIN;
}

ff_status create(const ff_host *host, void **self)
{
    law *made = new (std::nothrow) law(); /* no exception leaves a plugin */
    if (!made)
        return ff_failf(host, FF_NOMEM, nullptr, "out of memory");
    made->service = {.size = sizeof made->service, .self = made, .eval = eval};
    *self = made;
    return FF_OK;
}

ff_status set(void *self, uint32_t param, const ff_value *value)
{
    static_cast<law *>(self)->c[param] = value->real;
    return FF_OK;
}

const void *service(void *self, uint32_t output)
{
    return output ? nullptr : &static_cast<law *>(self)->service;
}

void destroy(void *self)
{
    delete static_cast<law *>(self);
}

const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = 0,
    .id = "viscosity/yasutomi",
    .version = "1.0.0",
    .summary = "free volume between glass and hot oil; the constants of 5P4E unless others are given",
    .reference = "Yasutomi, Bair & Winer 1984, J. Tribology 106, 291-303",
    .bibtex = "@article{yasutomi1984, author={Yasutomi, S. and Bair, S. and Winer, W. O.}, title={An application of a free volume model to lubricant rheology {I}: Dependence of viscosity on temperature and pressure}, journal={Journal of Tribology}, volume={106}, pages={291--303}, year={1984}}",
    .licence = "MIT",
    .flags = 0,
    .params = params, .param_count = PARAMS, .param_stride = sizeof params[0],
    .inputs = nullptr, .input_count = 0, .input_stride = 0,
    .outputs = outputs, .output_count = 1, .output_stride = sizeof outputs[0],
    .create = create,
    .set = set,
    .wire = nullptr,
    .ready = nullptr,
    .evaluate = nullptr,
    .service = service,
    .destroy = destroy,
    .carry = nullptr,
    .reserved = {},
    .columns = nullptr, .column_count = 0, .column_stride = 0,
    .self_size = 0,
    .cost = 1e-2, // takes part where a file says viscosity/auto
};

} // namespace

FF_EXPORT const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
