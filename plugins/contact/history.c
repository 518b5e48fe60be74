/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Outputs of a contact history: Hertz pressure, half width, Moes numbers. */
#include "history.h"

#include "../numerics/isothermal.h"

#include <flankfilm/author.h>

#include <math.h>

const ff_port contact_outputs[CONTACT_OUTPUTS] = {
    {.name = "time", .unit = "s", .doc = "time since the start of the history", .dims = "t"},
    {.name = "radius_1", .unit = "m", .doc = "radius of curvature of surface 1", .dims = "t"},
    {.name = "radius_2", .unit = "m", .doc = "radius of curvature of surface 2", .dims = "t"},
    {.name = "equivalent_radius",
     .unit = "m",
     .doc = "equivalent radius R = R1 R2/(R1 + R2)",
     .dims = "t"},
    {.name = "speed_1", .unit = "m/s", .doc = "surface speed u1 along the contact", .dims = "t"},
    {.name = "speed_2", .unit = "m/s", .doc = "surface speed u2 along the contact", .dims = "t"},
    {.name = "entrainment_speed",
     .label = "entrainment speed",
     .unit = "m/s",
     .doc = "entrainment speed u_r = (u1 + u2)/2",
     .dims = "t"},
    {.name = "sliding_speed",
     .label = "sliding speed",
     .unit = "m/s",
     .doc = "sliding speed u_s = u1 - u2",
     .dims = "t"},
    {.name = "slide_roll_ratio",
     .label = "slide-to-roll ratio",
     .unit = "1",
     .doc = "u_s/u_r",
     .dims = "t"},
    {.name = "load_per_width",
     .label = "load per width",
     .unit = "N/m",
     .doc = "load per width w, never negative",
     .dims = "t",
     .max = INFINITY},
    {.name = "hertz_half_width",
     .unit = "m",
     .doc = "Hertzian half width a = sqrt(8 w R/(pi E')) of the dry contact; 0 without load",
     .dims = "t",
     .max = INFINITY},
    {.name = "hertz_pressure",
     .unit = "Pa",
     .doc = "Hertzian maximum pressure p_H = 2 w/(pi a) of the dry contact; 0 without load",
     .dims = "t",
     .max = INFINITY},
    {.name = "moes_M",
     .unit = "1",
     .doc =
         "Moes' load number M = W/sqrt(2 U), U = eta0 u_r/(E' R), W = w/(E' R); needs a viscosity",
     .dims = "t"},
    {.name = "moes_L",
     .unit = "1",
     .doc = "Moes' lubricant number L = G (2 U)^(1/4), G = alpha* E', 1/alpha* = integral of "
            "eta0/eta over p (Barus: alpha* = alpha); needs a viscosity",
     .dims = "t"},
    {.name = "gap",
     .unit = "m",
     .doc = "separation of the surfaces along the line of action, 0 in contact; while they are "
            "separated, a damping force may still act",
     .dims = "t"},
    {.name = "reduced_modulus",
     .unit = "Pa",
     .doc = "reduced modulus E': 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2",
     .dims = "",
     .max = INFINITY},
    {.name = "roll_angle", .unit = "rad", .doc = "roll angle of gear 1", .dims = "t"},
    {.name = "engagement",
     .unit = "1",
     .doc = "index of the mesh cycle in which the pair enters contact, from 0; where the index "
            "changes, another engagement begins, with its own history",
     .dims = "t"},
    {.name = "engagements_judged",
     .unit = "1",
     .doc = "number of engagements in the history, one after the other",
     .dims = "",
     .max = INFINITY},
    {.name = "mesh_load_mean",
     .unit = "N",
     .doc = "mean over the engagements of the total force of all pairs in mesh",
     .dims = ""},
};

enum { PANELS = 512 }; /* for Simpson's rule, an even number */

/* Film-forming pressure coefficient alpha*, the reciprocal asymptotic isoviscous pressure (Blok
   1963): 1/alpha* = int_0^inf eta0/eta dp. The substitution p = t/((1 - t) slope), with slope = d
   ln eta/dp at p = 0, makes it an integral over t from 0 to 1. If eta does not rise with p, alpha*
   is 0. */
static ff_status film_coefficient(const ff_viscosity *law, double ln_eta0, double slope,
                                  double *alpha)
{
    double p[PANELS], ln_eta[PANELS], sum = 0;
    *alpha = 0;
    if (slope <= 0)
        return FF_OK;
    for (int i = 0; i < PANELS; i++)
        p[i] = i / ((PANELS - i) * slope);
    ff_status status = law->eval(law->self, PANELS, p, NULL, ln_eta, NULL, NULL);
    for (int i = 0; i < PANELS; i++) {
        double weight = i == 0 ? 1 : 2 + 2 * (i % 2), stretch = PANELS / (double)(PANELS - i);
        sum += weight * stretch * stretch * exp(ln_eta0 - ln_eta[i]);
    }
    *alpha = 3 * PANELS * slope / sum;
    return status;
}

/* Reads eta0 and alpha* at the oil temperature, or at the temperature of the law if no oil is
   wired. */
static ff_status read_viscosity(contact_history *h, const ff_viscosity *law, const ff_array *oil)
{
    numerics_answers answers = {.status = FF_OK};
    numerics_viscosity_at at;
    double T = oil[0].data ? *oil[0].data : NAN;
    if (!law)
        return ff_failf(h->host, FF_INVALID, "viscosity",
                        "moes_M and moes_L need a viscosity: wire `viscosity` to a stage of that "
                        "kind, or do not request moes_M and moes_L");
    law = numerics_viscosity_make(&at, law, T, &answers);
    if (oil[0].data) {
        ff_status contradiction = numerics_hold_viscosity(h->host, law, oil[1].data, T);
        if (contradiction != FF_OK)
            return numerics_answers_end(&answers, h->host, contradiction);
    }
    double p = 0, ln_eta = 0, slope = 0;
    ff_status status = law->eval(law->self, 1, &p, NULL, &ln_eta, &slope, NULL);
    if (status >= 0)
        status = film_coefficient(law, ln_eta, slope, &h->alpha);
    h->eta0 = exp(ln_eta);
    if (answers.status != FF_OK)
        return numerics_answers_end(&answers, h->host, status);
    if (status < 0 || !(h->eta0 > 0 && isfinite(h->eta0) && h->alpha >= 0 && isfinite(h->alpha)))
        return ff_failf(h->host, status < 0 ? status : FF_INVALID, "viscosity",
                        "the viscosity law gives no usable viscosity");
    return FF_OK;
}

ff_status contact_history_open(contact_history *h, const ff_host *host, uint64_t wanted,
                               size_t count, double reduced_modulus, const ff_viscosity *law,
                               const ff_array *oil)
{
    *h = (contact_history){.host = host, .reduced_modulus = reduced_modulus};
    if (wanted & (FF_BIT(CONTACT_MOES_M) | FF_BIT(CONTACT_MOES_L))) {
        ff_status status = read_viscosity(h, law, oil);
        if (status != FF_OK)
            return status;
    }
    for (uint32_t i = 0; i < CONTACT_SERIES_END; i++)
        if (wanted & FF_BIT(i) && i != CONTACT_REDUCED_MODULUS &&
            !(h->series[i] = ff_put_series(host, i, count)))
            return FF_NOMEM;
    if (wanted & FF_BIT(CONTACT_REDUCED_MODULUS))
        return ff_put_scalar(host, CONTACT_REDUCED_MODULUS, reduced_modulus);
    return FF_OK;
}

/* Line contact (Johnson 1985, sec. 4.2): a = sqrt(8 w R/(pi E')), p_H = sqrt(w E'/(2 pi R)). Moes
   (Moes 2000): M = W/sqrt(2 U), L = G (2 U)^(1/4) with W = w/(E' R), U = eta0 |u|/(E' R), G =
   alpha* E'. */
static ff_status refuse(const contact_history *h, uint32_t output, size_t i, double u_mean)
{
    const char *name = contact_outputs[output].name;
    int goes_with_speed = output == CONTACT_MOES_M || output == CONTACT_SLIDE_ROLL_RATIO;
    if (goes_with_speed && u_mean == 0)
        return ff_failf(h->host, FF_INVALID, name,
                        "%s is not defined at instant %zu of the history, since the entrainment "
                        "speed is 0 there: do not request it",
                        name, i);
    return ff_failf(h->host, FF_INVALID, name,
                    "%s is not finite at instant %zu of the history: speeds, radii, load or "
                    "viscosity are out of range",
                    name, i);
}

ff_status contact_history_set(contact_history *h, size_t i, const contact_point *point)
{
    const double E = h->reduced_modulus, w = point->load_per_width;
    const double R = 1 / (1 / point->radius_1 + 1 / point->radius_2);
    const double u_mean = (point->speed_1 + point->speed_2) / 2;
    const double u_slide = point->speed_1 - point->speed_2;
    const double a = sqrt(8 * w * R / (M_PI * E)), p = sqrt(w * E / (2 * M_PI * R));
    const double U = h->eta0 * fabs(u_mean) / (E * R);
    const double value[CONTACT_SERIES_END] = {
        [CONTACT_TIME] = point->time,
        [CONTACT_RADIUS_1] = point->radius_1,
        [CONTACT_RADIUS_2] = point->radius_2,
        [CONTACT_EQUIVALENT_RADIUS] = R,
        [CONTACT_SPEED_1] = point->speed_1,
        [CONTACT_SPEED_2] = point->speed_2,
        [CONTACT_ENTRAINMENT_SPEED] = u_mean,
        [CONTACT_SLIDING_SPEED] = u_slide,
        [CONTACT_SLIDE_ROLL_RATIO] = u_slide / u_mean,
        [CONTACT_LOAD_PER_WIDTH] = w,
        [CONTACT_HERTZ_HALF_WIDTH] = a,
        [CONTACT_HERTZ_PRESSURE] = p,
        [CONTACT_MOES_M] = h->series[CONTACT_MOES_M] ? w / (E * R * sqrt(2 * U)) : 0,
        [CONTACT_MOES_L] = h->series[CONTACT_MOES_L] ? h->alpha * E * pow(2 * U, 0.25) : 0,
        [CONTACT_GAP] = point->gap,
        [CONTACT_ROLL_ANGLE] = point->roll_angle,
        [CONTACT_ENGAGEMENT] = point->engagement,
    };
    for (uint32_t k = 0; k < CONTACT_SERIES_END; k++) {
        if (h->series[k] && !isfinite(value[k]))
            return refuse(h, k, i, u_mean);
        if (h->series[k])
            h->series[k][i] = value[k];
    }
    if (w > 1e-200) /* smaller products underflow */
        h->hertz_error = fmax(h->hertz_error, fabs(M_PI / 2 * a * p / w - 1));
    return FF_OK;
}

void contact_history_report(const contact_history *h)
{
    h->host->quality(h->host->ctx, "hertz_error", h->hertz_error, 1e-12,
                     h->hertz_error <= 1e-12 ? FF_GOOD : FF_BAD,
                     "Hertz half width and pressure carry the load");
}
