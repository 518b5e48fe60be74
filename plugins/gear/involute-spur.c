/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gear/involute-spur: path of contact, radii of curvature and inertia of a spur gear pair. */
#include "spur-geometry.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

enum {
    P_TEETH,
    P_MODULE,
    P_PRESSURE_ANGLE,
    P_FACE_WIDTH,
    P_PROFILE_SHIFT,
    P_CENTRE_DISTANCE,
    P_TIP_DIAMETER,
    P_ROOT_DIAMETER,
    P_BACKLASH,
    P_BACKLASH_MEASURE,
    P_BORE_DIAMETER,
    P_INERTIA,
    P_ELASTIC_MODULUS,
    P_POISSON_RATIO,
    P_DENSITY,
    P_STATIONS,
    PARAM_COUNT
};

static const ff_param params[] = {
    {.name = "teeth",
     .unit = "1",
     .doc = "numbers of teeth of gear 1 (driving) and gear 2; one value: both the same",
     .type = FF_REALS,
     .flags = FF_REQUIRED | FF_WHOLE,
     .min = 3,
     .max = 1e6,
     .min_count = 1,
     .max_count = 2},
    {.name = "module",
     .unit = "mm",
     .doc = "module: reference diameter over number of teeth",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .min = 1e-3,
     .max = 1e3},
    {.name = "pressure_angle",
     .unit = "deg",
     .doc = "pressure angle of the basic rack",
     .type = FF_REAL,
     .preset = "20 deg",
     .min = 5,
     .max = 45},
    {.name = "face_width",
     .unit = "mm",
     .doc = "width of the teeth in contact",
     .type = FF_REAL,
     .flags = FF_REQUIRED,
     .min = 1e-3,
     .max = 1e5},
    {.name = "profile_shift",
     .unit = "1",
     .doc =
         "profile shift coefficients x1 and x2, outward positive; what leaves a tooth undercut by "
         "more than 0.01 module is refused",
     .type = FF_REALS,
     .preset = "0",
     .min = -10,
     .max = 10,
     .min_count = 1,
     .max_count = 2},
    {.name = "centre_distance",
     .unit = "mm",
     .doc = "working centre distance; left out: where teeth of these profile shifts mesh without "
            "backlash",
     .type = FF_REAL,
     .min = 1e-3,
     .max = 1e9},
    {.name = "tip_diameter",
     .unit = "mm",
     .doc = "tip (outside) diameters; left out: d + 2 m (1 + x), shortened as DIN 3960 says where "
            "the profile shifts do not cancel",
     .type = FF_REALS,
     .min = 1e-3,
     .max = 1e9,
     .min_count = 1,
     .max_count = 2},
    {.name = "root_diameter",
     .unit = "mm",
     .doc = "root diameters; left out: d + 2 m (x - 1.25)",
     .type = FF_REALS,
     .min = 1e-3,
     .max = 1e9,
     .min_count = 1,
     .max_count = 2},
    {.name = "backlash",
     .unit = "mm",
     .doc = "total backlash of the mounted pair, twice the half-gap b; left out: what the centre "
            "distance leaves, 0 where that is left out too",
     .type = FF_REAL,
     .min = 0,
     .max = 1e3},
    {.name = "backlash_measure",
     .unit = "",
     .doc = "where `backlash` is measured: along the line of action, or as an arc of the working "
            "pitch circle",
     .type = FF_CHOICE,
     .preset = "line-of-action",
     .choices = "line-of-action|circular"},
    {.name = "bore_diameter",
     .unit = "mm",
     .doc = "bore diameters, 0: none",
     .type = FF_REALS,
     .preset = "0 mm",
     .min = 0,
     .max = 1e9,
     .min_count = 1,
     .max_count = 2},
    {.name = "inertia",
     .unit = "kg m2",
     .doc = "polar moments of inertia; left out: discs of working pitch diameter and face width, "
            "less the bore",
     .type = FF_REALS,
     .min = 1e-20,
     .max = 1e20,
     .min_count = 1,
     .max_count = 2},
    {.name = "elastic_modulus",
     .unit = "GPa",
     .doc = "Young's moduli E1 and E2",
     .type = FF_REALS,
     .preset = "206 GPa",
     .min = 1e-3,
     .max = 1e4,
     .min_count = 1,
     .max_count = 2},
    {.name = "poisson_ratio",
     .unit = "1",
     .doc = "Poisson's ratios of the gears",
     .type = FF_REALS,
     .preset = "0.3",
     .min = 0,
     .max = 0.5,
     .min_count = 1,
     .max_count = 2},
    {.name = "density",
     .unit = "kg/m3",
     .doc = "densities of the gears, for mass and inertia",
     .type = FF_REALS,
     .preset = "7850 kg/m3",
     .min = 1,
     .max = 1e5,
     .min_count = 1,
     .max_count = 2},
    {.name = "stations",
     .unit = "1",
     .doc = "about how many intervals the path of contact is cut into",
     .type = FF_INT,
     .flags = FF_TUNABLE,
     .preset = "200",
     .min = 8,
     .max = 100000},
};

enum {
    OUT_CONTACT_RATIO,
    OUT_ROLL_ANGLE,
    OUT_ROLL_SAP,
    OUT_ROLL_LPSTC,
    OUT_ROLL_PITCH,
    OUT_ROLL_HPSTC,
    OUT_ROLL_TIP,
    OUT_RADIUS_1,
    OUT_RADIUS_2,
    OUT_BASE_RADIUS,
    OUT_PITCH_RADIUS,
    OUT_TIP_RADIUS,
    OUT_ROOT_RADIUS,
    OUT_REFERENCE_RADIUS,
    OUT_BORE_RADIUS,
    OUT_BASE_PITCH,
    OUT_PATH_LENGTH,
    OUT_CENTRE_DISTANCE,
    OUT_WORKING_PRESSURE_ANGLE,
    OUT_BACKLASH,
    OUT_TEETH,
    OUT_FACE_WIDTH,
    OUT_MODULE,
    OUT_PRESSURE_ANGLE,
    OUT_PROFILE_SHIFT,
    OUT_TOOTH_THICKNESS,
    OUT_MASS,
    OUT_INERTIA,
    OUT_EQUIVALENT_MASS,
    OUT_ELASTIC_MODULUS,
    OUT_POISSON_RATIO,
    OUT_REDUCED_MODULUS
};

static const ff_port outputs[] = {
    {.name = "contact_ratio",
     .unit = "1",
     .doc = "profile contact ratio: path of contact over base pitch",
     .dims = ""},
    {.name = "roll_angle",
     .unit = "rad",
     .doc = "roll angle of gear 1 from SAP to tip; LPSTC and HPSTC twice in a row",
     .dims = "station"},
    {.name = "roll_sap",
     .unit = "rad",
     .doc = "roll angle at the start of the active profile",
     .dims = ""},
    {.name = "roll_lpstc",
     .unit = "rad",
     .doc = "roll angle at the lowest point of single tooth contact",
     .dims = ""},
    {.name = "roll_pitch", .unit = "rad", .doc = "roll angle at the pitch point", .dims = ""},
    {.name = "roll_hpstc",
     .unit = "rad",
     .doc = "roll angle at the highest point of single tooth contact",
     .dims = ""},
    {.name = "roll_tip",
     .unit = "rad",
     .doc = "roll angle at the tip, where contact ends",
     .dims = ""},
    {.name = "radius_1",
     .unit = "m",
     .doc = "radius of curvature of the flank of gear 1",
     .dims = "station"},
    {.name = "radius_2",
     .unit = "m",
     .doc = "radius of curvature of the flank of gear 2",
     .dims = "station"},
    {.name = "base_radius", .unit = "m", .doc = "base circle radii", .dims = "gear"},
    {.name = "pitch_radius", .unit = "m", .doc = "working pitch circle radii", .dims = "gear"},
    {.name = "tip_radius", .unit = "m", .doc = "tip circle radii", .dims = "gear"},
    {.name = "root_radius", .unit = "m", .doc = "root circle radii", .dims = "gear"},
    {.name = "reference_radius",
     .unit = "m",
     .doc = "reference circle radii m z/2",
     .dims = "gear"},
    {.name = "bore_radius", .unit = "m", .doc = "bore radii, 0: none", .dims = "gear"},
    {.name = "base_pitch",
     .unit = "m",
     .doc = "pitch of the teeth along the line of action",
     .dims = ""},
    {.name = "path_length", .unit = "m", .doc = "length of the path of contact", .dims = ""},
    {.name = "centre_distance", .unit = "m", .doc = "working centre distance", .dims = ""},
    {.name = "working_pressure_angle",
     .unit = "rad",
     .doc = "transverse working pressure angle",
     .dims = ""},
    {.name = "backlash",
     .unit = "m",
     .doc = "total backlash of the mounted pair along the line of action",
     .dims = ""},
    {.name = "teeth", .unit = "1", .doc = "numbers of teeth", .dims = "gear"},
    {.name = "face_width", .unit = "m", .doc = "width of the teeth in contact", .dims = ""},
    {.name = "module", .unit = "m", .doc = "module", .dims = ""},
    {.name = "pressure_angle",
     .unit = "rad",
     .doc = "pressure angle of the basic rack",
     .dims = ""},
    {.name = "profile_shift", .unit = "1", .doc = "profile shift coefficients", .dims = "gear"},
    {.name = "tooth_thickness",
     .unit = "m",
     .doc = "tooth thickness as an arc of the reference circle, backlash not deducted",
     .dims = "gear"},
    {.name = "mass",
     .unit = "kg",
     .doc = "masses of the discs of working pitch diameter, less the bore",
     .dims = "gear"},
    {.name = "inertia", .unit = "kg m2", .doc = "polar moments of inertia", .dims = "gear"},
    {.name = "equivalent_mass",
     .unit = "kg",
     .doc = "mass of the pair along the line of action, J1 J2/(J1 rb2^2 + J2 rb1^2)",
     .dims = ""},
    {.name = "elastic_modulus", .unit = "Pa", .doc = "Young's moduli", .dims = "gear"},
    {.name = "poisson_ratio", .unit = "1", .doc = "Poisson's ratios", .dims = "gear"},
    {.name = "reduced_modulus",
     .unit = "Pa",
     .doc = "E' of 2/E' = (1 - nu1^2)/E1 + (1 - nu2^2)/E2",
     .dims = ""},
};

typedef struct spur {
    const ff_host *host;
    ff_spur_spec spec;
    double face_width, bore[2], given_inertia[2], elastic[2], poisson[2], density[2];
    size_t stations;
    ff_spur_pair pair;
    double bore_radius[2], mass[2], inertia[2];
} spur;

static ff_status create(const ff_host *host, void **self)
{
    spur *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    *self = s;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    spur *s = self;
    double *const both[PARAM_COUNT] = {
        [P_TEETH] = s->spec.teeth,
        [P_PROFILE_SHIFT] = s->spec.shift,
        [P_TIP_DIAMETER] = s->spec.tip_diameter,
        [P_ROOT_DIAMETER] = s->spec.root_diameter,
        [P_BORE_DIAMETER] = s->bore,
        [P_INERTIA] = s->given_inertia,
        [P_ELASTIC_MODULUS] = s->elastic,
        [P_POISSON_RATIO] = s->poisson,
        [P_DENSITY] = s->density,
    };
    double *const one[PARAM_COUNT] = {
        [P_MODULE] = &s->spec.module,     [P_PRESSURE_ANGLE] = &s->spec.pressure_angle,
        [P_FACE_WIDTH] = &s->face_width,  [P_CENTRE_DISTANCE] = &s->spec.centre_distance,
        [P_BACKLASH] = &s->spec.backlash,
    };
    if (both[param]) {
        both[param][0] = value->reals[0];
        both[param][1] = value->reals[value->count - 1];
    } else if (one[param])
        *one[param] = value->real;
    else if (param == P_BACKLASH_MEASURE)
        s->spec.backlash_circular = value->integer == 1;
    else
        s->stations = (size_t)value->integer;
    if (param == P_BACKLASH)
        s->spec.backlash_given = true;
    return FF_OK;
}

/* Solid discs of working pitch diameter with a bore, unless the inertia is given. */
static ff_status set_discs(spur *s)
{
    for (int i = 0; i < 2; i++) {
        double radius = s->pair.pitch_radius[i], bore = s->bore[i] / 2;
        if (!(bore < s->pair.root_radius[i]))
            return ff_failf(s->host, FF_INVALID, "bore_diameter",
                            "gear %d has bore diameter %g mm; it must be less than its root "
                            "diameter %g mm",
                            i + 1, 1e3 * s->bore[i], 2e3 * s->pair.root_radius[i]);
        s->bore_radius[i] = bore;
        s->mass[i] = s->density[i] * M_PI * s->face_width * (radius - bore) * (radius + bore);
        s->inertia[i] = s->given_inertia[i] > 0 ? s->given_inertia[i]
                                                : s->mass[i] * (radius * radius + bore * bore) / 2;
    }
    return FF_OK;
}

static ff_status ready(void *self)
{
    spur *s = self;
    ff_status status = ff_spur_pair_make(s->host, &s->spec, &s->pair);
    return status == FF_OK ? set_discs(s) : status;
}

static ff_status put_scalars(const spur *s, uint64_t wanted)
{
    const ff_spur_pair *p = &s->pair;
    const double rb1 = p->base_radius[0], rb2 = p->base_radius[1];
    const double *J = s->inertia, *nu = s->poisson;
    const struct {
        uint32_t row;
        double value;
    } scalars[] = {
        {OUT_CONTACT_RATIO, p->contact_ratio},
        {OUT_ROLL_SAP, p->sap / rb1},
        {OUT_ROLL_LPSTC, p->lpstc / rb1},
        {OUT_ROLL_PITCH, p->pitch_point / rb1},
        {OUT_ROLL_HPSTC, p->hpstc / rb1},
        {OUT_ROLL_TIP, p->tip / rb1},
        {OUT_BASE_PITCH, p->base_pitch},
        {OUT_PATH_LENGTH, p->tip - p->sap},
        {OUT_CENTRE_DISTANCE, p->centre_distance},
        {OUT_WORKING_PRESSURE_ANGLE, p->working_angle},
        {OUT_BACKLASH, p->backlash},
        {OUT_FACE_WIDTH, s->face_width},
        {OUT_MODULE, s->spec.module},
        {OUT_PRESSURE_ANGLE, s->spec.pressure_angle},
        {OUT_EQUIVALENT_MASS, 1 / (rb1 * rb1 / J[0] + rb2 * rb2 / J[1])},
        {OUT_REDUCED_MODULUS,
         2 / ((1 - nu[0] * nu[0]) / s->elastic[0] + (1 - nu[1] * nu[1]) / s->elastic[1])},
    };
    for (size_t i = 0; i < sizeof scalars / sizeof scalars[0]; i++)
        if (wanted & FF_BIT(scalars[i].row) &&
            ff_put_scalar(s->host, scalars[i].row, scalars[i].value) != FF_OK)
            return FF_NOMEM;
    return FF_OK;
}

static ff_status put_pairs(const spur *s, uint64_t wanted)
{
    const ff_spur_pair *p = &s->pair;
    const struct {
        uint32_t row;
        const double *values;
    } pairs[] = {
        {OUT_BASE_RADIUS, p->base_radius},
        {OUT_PITCH_RADIUS, p->pitch_radius},
        {OUT_TIP_RADIUS, p->tip_radius},
        {OUT_ROOT_RADIUS, p->root_radius},
        {OUT_REFERENCE_RADIUS, p->reference_radius},
        {OUT_BORE_RADIUS, s->bore_radius},
        {OUT_TEETH, s->spec.teeth},
        {OUT_PROFILE_SHIFT, s->spec.shift},
        {OUT_TOOTH_THICKNESS, p->thickness},
        {OUT_MASS, s->mass},
        {OUT_INERTIA, s->inertia},
        {OUT_ELASTIC_MODULUS, s->elastic},
        {OUT_POISSON_RATIO, s->poisson},
    };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        if (!(wanted & FF_BIT(pairs[i].row)))
            continue;
        double *data = ff_put_series(s->host, pairs[i].row, 2);
        if (!data)
            return FF_NOMEM;
        data[0] = pairs[i].values[0];
        data[1] = pairs[i].values[1];
    }
    return FF_OK;
}

/* On the path of contact R1 + R2 is the distance between the base circles' tangent points, and
   the roll angle is R1 over the base radius. */
static ff_status put_stations(const spur *s, uint64_t wanted)
{
    ff_spur_run runs[4];
    size_t run_count = ff_spur_runs(&s->pair, s->stations, runs), count = 0, at = 0;
    for (size_t i = 0; i < run_count; i++)
        count += runs[i].intervals + !runs[i].joined;
    double *roll = NULL, *radius_1 = NULL, *radius_2 = NULL;
    if (wanted & FF_BIT(OUT_ROLL_ANGLE) && !(roll = ff_put_series(s->host, OUT_ROLL_ANGLE, count)))
        return FF_NOMEM;
    if (wanted & FF_BIT(OUT_RADIUS_1) && !(radius_1 = ff_put_series(s->host, OUT_RADIUS_1, count)))
        return FF_NOMEM;
    if (wanted & FF_BIT(OUT_RADIUS_2) && !(radius_2 = ff_put_series(s->host, OUT_RADIUS_2, count)))
        return FF_NOMEM;
    for (size_t i = 0; i < run_count; i++) {
        const ff_spur_run *r = &runs[i];
        for (size_t k = r->joined ? 1 : 0; k <= r->intervals; k++, at++) {
            double share = (double)k / (double)r->intervals;
            double curvature =
                k == r->intervals ? r->to : fmin(r->from + (r->to - r->from) * share, r->to);
            if (roll)
                roll[at] = curvature / s->pair.base_radius[0];
            if (radius_1)
                radius_1[at] = curvature;
            if (radius_2)
                radius_2[at] = s->pair.line_length - curvature;
        }
    }
    return FF_OK;
}

static void report_quality(const spur *s)
{
    const ff_spur_pair *p = &s->pair;
    const ff_host *host = s->host;
    const double m = s->spec.module;
    double tip = fmin(p->tip_thickness[0], p->tip_thickness[1]) / m;
    host->quality(host->ctx, "pitch_error", p->pitch_error, 1e-9,
                  p->pitch_error <= 1e-9 ? FF_GOOD : FF_BAD,
                  "tooth thicknesses and backlash fill the working pitch");
    host->quality(host->ctx, "tip_thickness", tip, 0.2, tip >= 0.2 ? FF_GOOD : FF_DOUBTFUL,
                  "least tooth thickness at a tip, in modules; below 0.2 a tip is weak");
    host->quality(host->ctx, "tip_clearance", p->clearance / m, 0.1,
                  p->clearance >= 0.1 * m ? FF_GOOD : FF_DOUBTFUL,
                  "least gap between tip and mating root, in modules");
    host->quality(host->ctx, "involute_margin", p->form_margin / m, 0,
                  p->form_margin >= -1e-9 * m ? FF_GOOD : FF_DOUBTFUL,
                  "from the end of the involute to the contact nearest it, in modules, if the root "
                  "fillet takes up 0.25 m; below 0 a tip may meet a fillet");
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const spur *s = self;
    (void)in;
    report_quality(s);
    ff_status status = put_scalars(s, wanted);
    if (status == FF_OK)
        status = put_pairs(s, wanted);
    return status == FF_OK ? put_stations(s, wanted) : status;
}

static void destroy(void *self)
{
    free(self);
}

static const ff_model model = {
    sizeof(ff_model),
    FF_ABI_MAJOR,
    FF_ABI_MINOR,
    "gear/involute-spur",
    "1.0.0",
    "external involute spur gear pair: path of contact, radii, inertia",
    "DIN 3960:1987, definitions and parameters of cylindrical gears; ISO 53:1998 (basic rack); "
    "Litvin and Fuentes 2004, Gear Geometry and Applied Theory",
    "@book{litvin2004, author = {Litvin, Faydor L. and Fuentes, Alfonso}, title = {Gear Geometry "
    "and Applied Theory}, edition = {2}, publisher = {Cambridge University Press}, year = {2004}}",
    "GPL-3.0-or-later",
    0,
    FF_TABLE(params),
    FF_NO_TABLE,
    FF_TABLE(outputs),
    create,
    set,
    NULL,
    ready,
    evaluate,
    NULL,
    destroy,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
