/* SPDX-License-Identifier: GPL-3.0-or-later */
/* gear/involute-spur: path of contact, radii of curvature and inertia of a spur gear pair. */
#include "flank-deviations.h"
#include "spur-geometry.h"
#include "spur-rows.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct spur {
    const ff_host *host;
    gear_spur_spec spec;
    double face_width, bore[2], given_inertia[2], elastic[2], poisson[2], density[2];
    size_t stations;
    gear_spur_pair pair;
    double bore_radius[2], mass[2], inertia[2], roughness[2]; /* Rq; 0: not given */
    gear_flank_spec flank_spec;
    gear_flanks flanks;
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

static ff_status set_index_deviations(spur *s, int gear, const ff_value *value)
{
    double *kept = malloc((value->count + 1) * sizeof *kept);
    if (!kept)
        return FF_NOMEM;
    memcpy(kept, value->reals, value->count * sizeof *kept);
    free(s->flank_spec.index[gear]);
    s->flank_spec.index[gear] = kept;
    s->flank_spec.indexed[gear] = value->count;
    return FF_OK;
}

/* The parameters of the flanks that are not numbers for both gears. */
static ff_status set_flanks(spur *s, uint32_t param, const ff_value *value)
{
    gear_flank_spec *f = &s->flank_spec;
    switch (param) {
    case P_TIP_RELIEF_SHAPE:
        f->tip.parabolic = value->integer == 1;
        return FF_OK;
    case P_ROOT_RELIEF_SHAPE:
        f->root.parabolic = value->integer == 1;
        return FF_OK;
    case P_PITCH_ERROR:
        return set_index_deviations(s, 0, value);
    case P_PITCH_ERROR_2:
        return set_index_deviations(s, 1, value);
    default: /* P_PROFILE_FILE */
        free(f->file);
        f->file = strdup(value->text);
        return f->file ? FF_OK : FF_NOMEM;
    }
}

/* Most parameters are a number of the pair or one for each gear; a single one stands for both
 * gears. */
static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    spur *s = self;
    double *const both[GEAR_SPUR_PARAMS] = {
        [P_TEETH] = s->spec.teeth,
        [P_PROFILE_SHIFT] = s->spec.shift,
        [P_TIP_DIAMETER] = s->spec.tip_diameter,
        [P_ROOT_DIAMETER] = s->spec.root_diameter,
        [P_BORE_DIAMETER] = s->bore,
        [P_INERTIA] = s->given_inertia,
        [P_ELASTIC_MODULUS] = s->elastic,
        [P_POISSON_RATIO] = s->poisson,
        [P_DENSITY] = s->density,
        [P_TIP_RELIEF] = s->flank_spec.tip.amount,
        [P_TIP_RELIEF_START] = s->flank_spec.tip.start,
        [P_ROOT_RELIEF] = s->flank_spec.root.amount,
        [P_ROOT_RELIEF_START] = s->flank_spec.root.start,
        [P_CROWNING] = s->flank_spec.crown,
        [P_PROFILE_SLOPE] = s->flank_spec.slope,
        [P_ROUGHNESS_RQ] = s->roughness,
        [P_ROUGHNESS_RA] = s->roughness,
    };
    double *const one[GEAR_SPUR_PARAMS] = {
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
    else if (param == P_STATIONS)
        s->stations = (size_t)value->integer;
    else
        return set_flanks(s, param, value);
    if (param == P_BACKLASH)
        s->spec.backlash_given = true;
    if (param == P_ROUGHNESS_RA) /* Rq of Gaussian heights */
        for (int i = 0; i < 2; i++)
            s->roughness[i] *= sqrt(M_PI / 2);
    if (param == P_TIP_RELIEF_START)
        s->flank_spec.tip.start_given = true;
    if (param == P_ROOT_RELIEF_START)
        s->flank_spec.root.start_given = true;
    return FF_OK;
}

/* Mass and inertia of discs of working pitch diameter with a bore; a stated inertia replaces
 * theirs. */
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
    ff_status status = gear_spur_pair_make(s->host, &s->spec, &s->pair);
    if (status == FF_OK)
        status = set_discs(s);
    gear_flanks_free(&s->flanks);
    if (status == FF_OK)
        status = gear_flanks_make(s->host, &s->flank_spec, &s->spec, &s->pair, &s->flanks);
    return status;
}

static ff_status write_scalars(const spur *s, uint64_t wanted)
{
    const gear_spur_pair *p = &s->pair;
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

static ff_status write_pairs(const spur *s, uint64_t wanted)
{
    const gear_spur_pair *p = &s->pair;
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
        {OUT_ROUGHNESS, s->roughness},
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

/* On the path of contact R1 + R2 is the length of the common tangent of the base circles, and the
   roll angle is R1 over the base radius. */
static ff_status write_stations(const spur *s, uint64_t wanted)
{
    gear_spur_run runs[GEAR_SPUR_RUNS];
    size_t run_count = gear_spur_runs(&s->pair, s->stations, runs), count = 0, at = 0;
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
        const gear_spur_run *r = &runs[i];
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

static ff_status write_flanks(const spur *s, uint64_t wanted)
{
    const size_t shape[2] = {2, s->flanks.points};
    double *const *from[] = {s->flanks.roll, s->flanks.deviation};
    for (uint32_t row = 0; row < 2; row++) {
        if (!(wanted & FF_BIT(OUT_PROFILE_ROLL + row)))
            continue;
        double *to = s->host->output(s->host->ctx, OUT_PROFILE_ROLL + row, 2, shape);
        if (!to)
            return FF_NOMEM;
        for (size_t g = 0; g < 2; g++)
            memcpy(to + g * shape[1], from[row][g], shape[1] * sizeof *to);
    }
    for (uint32_t g = 0; g < 2; g++) {
        if (!(wanted & FF_BIT(OUT_PITCH_DEVIATION_1 + g)))
            continue;
        double *to = ff_put_series(s->host, OUT_PITCH_DEVIATION_1 + g, (size_t)s->spec.teeth[g]);
        if (!to)
            return FF_NOMEM;
        if (s->flank_spec.indexed[g] > 0)
            memcpy(to, s->flank_spec.index[g], s->flank_spec.indexed[g] * sizeof *to);
    }
    return FF_OK;
}

static void report_quality(const spur *s)
{
    const gear_spur_pair *p = &s->pair;
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
    ff_status status = write_scalars(s, wanted);
    if (status == FF_OK)
        status = write_pairs(s, wanted);
    if (status == FF_OK)
        status = write_stations(s, wanted);
    return status == FF_OK ? write_flanks(s, wanted) : status;
}

static void destroy(void *self)
{
    spur *s = self;
    if (!s)
        return;
    gear_flanks_free(&s->flanks);
    free(s->flank_spec.index[0]);
    free(s->flank_spec.index[1]);
    free(s->flank_spec.file);
    free(s);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "gear/involute-spur",
    .version = "1.0.0",
    .summary = "external involute spur gear pair: path of contact, radii, inertia, deviations of "
               "the flanks",
    .reference =
        "DIN 3960:1987, definitions and parameters of cylindrical gears; ISO 53:1998 (basic rack); "
        "Litvin and Fuentes 2004, Gear Geometry and Applied Theory",
    .bibtex = "@book{litvin2004, author = {Litvin, Faydor L. and Fuentes, Alfonso}, title = {Gear "
              "Geometry "
              "and Applied Theory}, edition = {2}, publisher = {Cambridge University Press}, year "
              "= {2004}}",
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(gear_spur_params),
    .outputs = FF_TABLE(gear_spur_outputs),
    .create = create,
    .set = set,
    .ready = ready,
    .evaluate = evaluate,
    .destroy = destroy,
    .columns = FF_TABLE(gear_curve_columns),
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
