/* SPDX-License-Identifier: MIT */
/*
 * gear/diametral-pitch: full-depth involute spur gears of ANSI B6.1, by teeth per inch: pitch
 * radius N/(2 P), addendum 1/P, dedendum 1.25/P. No shift and no relief; solid discs without bore.
 *
 * All along the line of action, from the base circle of gear 1 on: the flanks meet from
 * SAP = L - sqrt(ra2^2 - rb2^2) to tip = sqrt(ra1^2 - rb1^2), L = (rb1 + rb2) tan alpha.
 */
#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum { STEPS = 60, COUNT = 3 * (STEPS + 1) };

typedef struct stage {
    const ff_host *host;
    ff_reals teeth;
    double pitch, angle, width, backlash, young, poisson, density;
} stage;

static const ff_param params[] = {
    FF_LIST("teeth", "1", stage, teeth, FF_REQUIRED | FF_WHOLE, NULL, NULL, 8, 1000, 0, 0, 2, 2,
            "teeth of both gears"),
    FF_QUANTITY("diametral_pitch", "1/inch", stage, pitch, FF_REQUIRED, NULL, NULL, 0.25, 400, 0, 0,
                "teeth per inch of pitch diameter"),
    FF_QUANTITY("pressure_angle", "deg", stage, angle, 0, "20 deg", NULL, 14, 30, 0, 0,
                "pressure angle"),
    FF_QUANTITY("face_width", "inch", stage, width, FF_REQUIRED, NULL, NULL, 0.01, 1e3, 0, 0,
                "width of the teeth"),
    FF_QUANTITY("backlash", "inch", stage, backlash, 0, "0 inch", NULL, 0, 1, 0, 0,
                "along the line of action"),
    FF_QUANTITY("elastic_modulus", "GPa", stage, young, 0, "206 GPa", NULL, 1, 1e3, 0, 0,
                "of both gears"),
    FF_QUANTITY("poisson_ratio", "", stage, poisson, 0, "0.3", NULL, 0, 0.5, 0, 0, "of both gears"),
    FF_QUANTITY("density", "kg/m3", stage, density, 0, "7850 kg/m3", NULL, 500, 2e4, 0, 0,
                "of both gears"),
};

enum { ROLL, RADIUS_1, RADIUS_2, TEETH, BASE, PITCH, TIPS, INERTIA };
enum { SAP = INERTIA + 1, LPSTC, HPSTC, TIP, RATIO, LENGTH, BASE_PITCH, ANGLE, CENTRES };
enum { WIDE = CENTRES + 1, GAP, MASS, MODULUS };

#define SERIES(title, units, along, says)                                                          \
    {                                                                                              \
        .name = title, .unit = units, .dims = along, .doc = says                                   \
    }
#define SCALAR(title, units, says) SERIES(title, units, "", says)

static const ff_port outputs[] = {
    [ROLL] = SERIES("roll_angle", "rad", "station", "of gear 1; LPSTC and HPSTC stand twice"),
    [RADIUS_1] = SERIES("radius_1", "m", "station", "radius of curvature of flank 1"),
    [RADIUS_2] = SERIES("radius_2", "m", "station", "radius of curvature of flank 2"),
    [TEETH] = SERIES("teeth", "1", "gear", "numbers of teeth"),
    [BASE] = SERIES("base_radius", "m", "gear", "base circles"),
    [PITCH] = SERIES("pitch_radius", "m", "gear", "pitch circles"),
    [TIPS] = SERIES("tip_radius", "m", "gear", "tip circles"),
    [INERTIA] = SERIES("inertia", "kg m2", "gear", "of solid discs up to the pitch circle"),
    [SAP] = SCALAR("roll_sap", "rad", "where the pair meets"),
    [LPSTC] = SCALAR("roll_lpstc", "rad", "where the pair before it leaves"),
    [HPSTC] = SCALAR("roll_hpstc", "rad", "where the pair behind it meets"),
    [TIP] = SCALAR("roll_tip", "rad", "where the pair leaves"),
    [RATIO] = SCALAR("contact_ratio", "1", "contact ratio"),
    [LENGTH] = SCALAR("path_length", "m", "from SAP to tip"),
    [BASE_PITCH] = SCALAR("base_pitch", "m", "from tooth to tooth along the line of action"),
    [ANGLE] = SCALAR("working_pressure_angle", "rad", "that of the tool"),
    [CENTRES] = SCALAR("centre_distance", "m", "sum of the pitch radii"),
    [WIDE] = SCALAR("face_width", "m", "width of the teeth"),
    [GAP] = SCALAR("backlash", "m", "along the line of action"),
    [MASS] = SCALAR("equivalent_mass", "kg", "J1 J2/(J1 rb2^2 + J2 rb1^2)"),
    [MODULUS] = SCALAR("reduced_modulus", "Pa", "E' of 2/E' = sum (1 - nu^2)/E"),
};

/* Both gears, and where their flanks meet along the line of action, m. */
typedef struct pair {
    double teeth[2], pitch[2], base[2], tips[2], inertia[2];
    double line, step, ends[4]; /* SAP, LPSTC, HPSTC, tip */
} pair;

static ff_status measure(const stage *s, pair *g)
{
    const double pi = 3.14159265358979323846;
    for (int i = 0; i < 2; i++) {
        g->teeth[i] = s->teeth.data[i];
        g->pitch[i] = g->teeth[i] / (2 * s->pitch);
        g->base[i] = g->pitch[i] * cos(s->angle);
        g->tips[i] = g->pitch[i] + 1 / s->pitch;
        g->inertia[i] = pi / 2 * s->density * s->width * pow(g->pitch[i], 4);
    }
    g->line = (g->base[0] + g->base[1]) * tan(s->angle);
    g->step = 2 * pi * g->base[0] / g->teeth[0];
    double sap = g->line - sqrt(g->tips[1] * g->tips[1] - g->base[1] * g->base[1]),
           tip = sqrt(g->tips[0] * g->tips[0] - g->base[0] * g->base[0]);
    if (!(sap > 0 && tip < g->line))
        return ff_failf(s->host, FF_INVALID, "teeth",
                        "the tip of one gear cuts below the base circle of the other");
    if (!(tip - sap > g->step && tip - sap < 2 * g->step))
        return ff_failf(s->host, FF_INVALID, "pressure_angle",
                        "the contact ratio is %g, not between 1 and 2", (tip - sap) / g->step);
    const double ends[] = {sap, tip - g->step, sap + g->step, tip};
    for (int i = 0; i < 4; i++)
        g->ends[i] = ends[i];
    return FF_OK;
}

static ff_status put_lists(const ff_host *host, const pair *g)
{
    const double *lists[] = {g->teeth, g->base, g->pitch, g->tips, g->inertia};
    for (uint32_t k = TEETH; k <= INERTIA; k++) {
        double *list = ff_put_series(host, k, 2);
        if (!list)
            return FF_NOMEM;
        list[0] = lists[k - TEETH][0];
        list[1] = lists[k - TEETH][1];
    }
    double *roll = ff_put_series(host, ROLL, COUNT), *r1 = ff_put_series(host, RADIUS_1, COUNT),
           *r2 = ff_put_series(host, RADIUS_2, COUNT);
    if (!roll || !r1 || !r2)
        return FF_NOMEM;
    for (int i = 0; i < COUNT; i++) {
        int part = i / (STEPS + 1);
        double share = (double)(i % (STEPS + 1)) / STEPS;
        r1[i] = (1 - share) * g->ends[part] + share * g->ends[part + 1];
        r2[i] = g->line - r1[i];
        roll[i] = r1[i] / g->base[0];
    }
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const stage *s = self;
    pair g;
    (void)wanted, (void)in;
    ff_status status = measure(s, &g);
    if (status == FF_OK)
        status = put_lists(s->host, &g);
    if (status != FF_OK)
        return status;
    const double path = g.ends[3] - g.ends[0], *J = g.inertia, *b = g.base,
                 value[] = {g.ends[0] / b[0],
                            g.ends[1] / b[0],
                            g.ends[2] / b[0],
                            g.ends[3] / b[0],
                            path / g.step,
                            path,
                            g.step,
                            s->angle,
                            g.pitch[0] + g.pitch[1],
                            s->width,
                            s->backlash,
                            J[0] * J[1] / (J[0] * b[1] * b[1] + J[1] * b[0] * b[0]),
                            s->young / (1 - s->poisson * s->poisson)};
    for (uint32_t i = SAP; i <= MODULUS && status == FF_OK; i++)
        status = ff_put_scalar(s->host, i, value[i - SAP]);
    return status;
}

FF_MODEL(model, stage, .id = "gear/diametral-pitch", .version = "1.0.0",
         .summary = "full-depth spur gears by teeth per inch",
         .reference = "ANSI B6.1-1968, Tooth Proportions for Coarse-Pitch Involute Spur Gears",
         .bibtex = "", .licence = "MIT", .params = FF_TABLE(params), .outputs = FF_TABLE(outputs),
         .evaluate = evaluate, .destroy = free);
FF_EXPORT_MODELS(&model);
