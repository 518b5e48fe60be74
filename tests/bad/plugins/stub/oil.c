/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What an oil is and obeys: its data, ln eta = ln eta0(T) + alpha p and rho = rho0(T) (1 + 0.6 p/(1
   + 1.7 p)), p in GPa. LAW: 0 the data of the oil, 1 the viscosity, 2 the density. */
#define STUB_MORE                                                                                  \
    .abi_minor = 2, .params = FF_TABLE(params), .set = stub_set, .wire = stub_wire,                \
    .ready = ready, .service = stub_service
#include "stub.h"

enum { AMBIENT, ALPHA };
static const double reference = 313.15; /* K */

#if LAW == 0
static const ff_param params[] = {{.name = "grade",
                                   .unit = "",
                                   .doc = "of ISO 3448",
                                   .type = FF_TEXT,
                                   .flags = FF_REQUIRED,
                                   .choices = "ISO VG 100|ISO VG 220"},
                                  {.name = "alpha",
                                   .unit = "1/GPa",
                                   .doc = "pressure coefficient at alpha_at",
                                   .type = FF_REAL,
                                   .preset = "20 1/GPa",
                                   .max = 1000,
                                   .low = 2,
                                   .high = 50},
                                  {.name = "alpha_at",
                                   .unit = "degC",
                                   .doc = "where alpha holds",
                                   .type = FF_REAL,
                                   .preset = "40 degC",
                                   .min = -50,
                                   .max = 200}};
static const ff_port inputs[] = {
    {.name = "any.level", .unit = "m", .doc = "nothing", .dims = "", .flags = FF_OPTIONAL}};
static const ff_port outputs[] = {
    {.name = "oil", .unit = "", .doc = "the oil", .dims = "", .service = FF_LIQUID_ID}};
#else
static const ff_param params[] = {{.name = LAW == 1 ? "eta0" : "rho0",
                                   .unit = LAW == 1 ? "Pa s" : "kg/m3",
                                   .doc = "at ambient pressure",
                                   .type = FF_REAL,
                                   .flags = FF_REQUIRED | FF_MIN_OPEN,
                                   .max = LAW == 1 ? 1e3 : 1e5,
                                   .low = LAW == 1 ? 1e-3 : 600,
                                   .high = LAW == 1 ? 10 : 2000,
                                   .instead = "oil"},
                                  {.name = LAW == 1 ? "alpha" : "a",
                                   .unit = "1/GPa",
                                   .doc = "rise with pressure",
                                   .type = FF_REAL,
                                   .preset = LAW == 1 ? NULL : "0.6 1/GPa",
                                   .max = 1000,
                                   .low = LAW == 1 ? 2 : 0.3,
                                   .high = LAW == 1 ? 50 : 3}};
static const ff_port inputs[] = {{.name = "oil",
                                  .unit = "",
                                  .doc = "the oil",
                                  .dims = "",
                                  .service = FF_LIQUID_ID,
                                  .flags = FF_OPTIONAL}};
static const ff_port outputs[] = {{.name = "law",
                                   .unit = "",
                                   .doc = "the law",
                                   .dims = "",
                                   .service = LAW == 1 ? FF_VISCOSITY_ID : FF_DENSITY_ID}};
#endif

#if LAW == 0
/* nu = 100 cSt at 40 degC, falling by 3 % in a kelvin; all else straight in T. */
static ff_status liquid(const void *self, int32_t what, size_t n, const double *T, double *value,
                        double *slope)
{
    const stub *s = self;
    const double rho = 870, at = s->value[2] > 0 ? s->value[2] : reference,
                 alpha = s->value[1] * off("strong", 2);
    if (what < 0 || what > FF_LIQUID_REFERENCE_TEMPERATURE)
        return FF_UNSUPPORTED;
    for (size_t i = 0; i < n; i++) {
        double t = fmin(fmax(T[i], 200), 600), warm = t - reference, inside = T[i] == t ? 1 : 0;
        double swell = off("swelling", -1), rise = alpha * -0.002, by = 0, v = reference;
        if (what == FF_LIQUID_RHO0)
            v = rho * (1 - swell * 7e-4 * warm), by = -swell * rho * 7e-4;
        else if (what == FF_LIQUID_CONDUCTIVITY)
            v = 0.14, by = 0;
        else if (what == FF_LIQUID_HEAT_CAPACITY)
            v = 1900 + 4 * warm, by = 4;
        else if (what == FF_LIQUID_PRESSURE_COEFFICIENT)
            v = alpha + rise * (t - at), by = rise;
        else if (what == FF_LIQUID_LN_ETA0)
            v = log(is("kinematic") ? 0.1 : 1e-4 * rho) - 0.03 * warm, by = -0.03;
        value[i] = v;
        if (slope)
            slope[i] = by * inside;
    }
    return FF_OK;
}
#else
/* The value of a property and its slope at T, with what the fault makes of T. */
static double of_oil(const stub *s, int32_t what, double T, double *slope)
{
    const ff_liquid *oil = s->table[0];
    double value, t = fmin(fmax(T, 220), 500), turn = T == t ? 1 : 0;
    if (is("warming"))
        t = 2 * reference - t, turn = -turn;
    if (is("isothermal"))
        t = reference, turn = 0;
    if (is("half"))
        t = reference + (t - reference) / 2, turn /= 2;
    oil->eval(oil->self, what, 1, &t, &value, slope);
    *slope *= turn;
    return value;
}

static ff_status eval(const void *self, size_t n, const double *p, const double *T, double *value,
                      double *by_p, double *by_T)
{
    const stub *s = self;
    for (size_t i = 0; i < n; i++) {
        double t = T ? T[i] : reference, slope = 0, bend = 0, alpha = s->value[ALPHA],
               base = LAW == 1 ? log(s->value[AMBIENT]) : s->value[AMBIENT];
        if (s->table[0])
            base = of_oil(s, LAW == 1 ? FF_LIQUID_LN_ETA0 : FF_LIQUID_RHO0, t, &slope);
        if (LAW == 1) {
            if (!(alpha > 0))
                alpha = s->table[0] ? of_oil(s, FF_LIQUID_PRESSURE_COEFFICIENT, t, &bend) : 2e-8;
            alpha *= off("alpha-twice", 2);
            bend *= off("alpha-twice", 2);
            if (is("stiffening") && s->table[0] && t > 220 && t < 500)
                alpha += 4e-10 * (t - reference), bend += 4e-10;
            value[i] = base + log(off("thousandfold", 1000)) + alpha * p[i];
            if (by_p)
                by_p[i] = alpha;
            if (by_T)
                by_T[i] = slope + bend * p[i];
        } else {
            double g = fmax(p[i], 0), b = off("soft", 0.2) * 1.7e-9,
                   a = s->value[ALPHA] * off("soft", 3);
            base *= off("heavy", 1.3);
            double share = 1 + a * g / (1 + b * g);
            value[i] = base * share;
            if (by_p)
                by_p[i] = p[i] > 0 ? base * a / (1 + b * g) / (1 + b * g) : 0;
            if (by_T)
                by_T[i] = slope * off("heavy", 1.3) * share;
        }
    }
    return FF_OK;
}
#endif

static ff_status ready(void *self)
{
    stub *s = self;
#if LAW == 0
    s->service.liquid = (ff_liquid){sizeof s->service.liquid, s, liquid};
#elif LAW == 1
    s->service.viscosity = (ff_viscosity){sizeof s->service.viscosity, s, eval};
#else
    s->service.density = (ff_density){sizeof s->service.density, s, eval};
#endif
    return FF_OK;
}

STUB_MODEL
