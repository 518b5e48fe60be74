/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the outputs of gear/involute-spur. */
#include "spur-rows.h"
#include "spur.h"
#include "tooth-measures.h"

#include <flankfilm/author.h>

#include <math.h>
#include <string.h>

/* Tip radius of the basic rack of ISO 53 (profile A), in modules. */
static const double standard_tip_radius = 0.38;

static ff_status write_scalars(const spur *s, uint64_t wanted)
{
    const gear_spur_pair *p = &s->pair;
    const double rb1 = p->base_radius[0], rb2 = p->base_radius[1];
    const double *J = s->inertia;
    double compliance = 0; /* sum of (1 - nu^2)/E */
    for (int i = 0; i < 2; i++)
        compliance += (1 - s->made_of[i].poisson * s->made_of[i].poisson) / s->made_of[i].modulus;
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
        {OUT_REDUCED_MODULUS, 2 / compliance},
        {OUT_PINION, ff_of_both(&s->spec.teeth, 1) < ff_of_both(&s->spec.teeth, 0) ? 2 : 1},
    };
    for (size_t i = 0; i < sizeof scalars / sizeof scalars[0]; i++)
        if (wanted & FF_BIT(scalars[i].row) &&
            ff_put_scalar(s->host, scalars[i].row, scalars[i].value) != FF_OK)
            return FF_NOMEM;
    return FF_OK;
}

/* Returns Rq, from Ra if that is given: Rq = sqrt(pi/2) Ra for Gaussian heights. 0: not given. */
static double roughness_of(const spur *s, int gear)
{
    if (s->roughness_ra.count > 0)
        return ff_of_both(&s->roughness_ra, gear) * sqrt(M_PI / 2);
    return s->roughness_rq.count > 0 ? ff_of_both(&s->roughness_rq, gear) : 0;
}

static ff_status put_pair(const spur *s, uint64_t wanted, uint32_t row, const double values[2])
{
    double *data = wanted & FF_BIT(row) ? ff_put_series(s->host, row, 2) : NULL;
    if (data)
        memcpy(data, values, 2 * sizeof *data);
    return data || !(wanted & FF_BIT(row)) ? FF_OK : FF_NOMEM;
}

static ff_status write_pairs(const spur *s, uint64_t wanted)
{
    const gear_spur_pair *p = &s->pair;
    double teeth[2], shift[2], elastic[2], poisson[2], roughness[2], form[2], tool[2], yield[2],
        grade[2] = {0}, active[2], density[2], conductivity[2], heat[2], hardness[2];
    const double lowest[2] = {p->sap, p->line_length - p->tip};
    gear_measures measures;
    gear_measure_teeth(&s->spec, p, &measures);
    for (int i = 0; i < 2; i++) {
        teeth[i] = ff_of_both(&s->spec.teeth, i);
        shift[i] = ff_of_both(&s->spec.shift, i);
        elastic[i] = s->made_of[i].modulus;
        poisson[i] = s->made_of[i].poisson;
        yield[i] = s->made_of[i].yield;
        if (s->quality.count > 0)
            grade[i] = ff_of_both(&s->quality, i);
        density[i] = s->made_of[i].density;
        conductivity[i] = s->made_of[i].conductivity;
        heat[i] = s->made_of[i].specific_heat;
        hardness[i] = s->made_of[i].hardness;
        active[i] = hypot(p->base_radius[i], lowest[i]);
        roughness[i] = roughness_of(s, i);
        form[i] = hypot(p->base_radius[i], fmax(p->form[i], 0));
        tool[i] = s->spec.tool_tip_radius.count > 0 ? ff_of_both(&s->spec.tool_tip_radius, i)
                                                    : standard_tip_radius;
    }
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
        {OUT_TEETH, teeth},
        {OUT_PROFILE_SHIFT, shift},
        {OUT_TOOTH_THICKNESS, p->thickness},
        {OUT_THICKNESS_ALLOWANCE, p->allowance},
        {OUT_ROOT_FORM_RADIUS, form},
        {OUT_TOOL_TIP_RADIUS, tool},
        {OUT_MASS, s->mass},
        {OUT_INERTIA, s->inertia},
        {OUT_ELASTIC_MODULUS, elastic},
        {OUT_POISSON_RATIO, poisson},
        {OUT_ROUGHNESS, roughness},
        {OUT_SPAN_TEETH, measures.span_teeth},
        {OUT_SPAN, measures.span},
        {OUT_PIN_DIAMETER, measures.pin_diameter},
        {OUT_OVER_PINS, measures.over_pins},
        {OUT_TIP_THICKNESS, p->tip_thickness},
        {OUT_ACTIVE_ROOT_RADIUS, active},
        {OUT_YIELD_STRENGTH, yield},
        {OUT_FLANK_CLASS, grade},
        {OUT_DENSITY, density},
        {OUT_THERMAL_CONDUCTIVITY, conductivity},
        {OUT_SPECIFIC_HEAT, heat},
        {OUT_HARDNESS, hardness},
    };
    ff_status status = FF_OK;
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0] && status == FF_OK; i++)
        status = put_pair(s, wanted, pairs[i].row, pairs[i].values);
    return status;
}

/* Writes the series over the stations. On the path of contact, R1 + R2 is the length of the common
   tangent of the base circles, and the roll angle of gear 1 is R1 over its base radius. */
static ff_status write_stations(const spur *s, uint64_t wanted)
{
    gear_spur_run runs[GEAR_SPUR_RUNS];
    size_t run_count = gear_spur_runs(&s->pair, (size_t)s->stations, runs), count = 0, at = 0;
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
    const gear_flanks *back = s->back.points ? &s->back : &s->flanks;
    double *const *from[] = {s->flanks.roll, s->flanks.deviation, back->roll, back->deviation};
    for (uint32_t row = 0; row < 4; row++) {
        const size_t shape[2] = {2, row < 2 ? s->flanks.points : back->points};
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
        double *to = ff_put_series(s->host, OUT_PITCH_DEVIATION_1 + g,
                                   (size_t)ff_of_both(&s->spec.teeth, (int)g));
        if (!to)
            return FF_NOMEM;
        const ff_reals *index = &s->flank_spec.index[g];
        if (index->count > 0)
            memcpy(to, index->data, index->count * sizeof *to);
    }
    return FF_OK;
}

/* Writes the flank tolerances. If no class is given, outputs that need one are refused. */
static ff_status write_tolerances(const spur *s, uint64_t wanted)
{
    for (uint32_t k = 0; k < 5; k++) {
        const uint32_t row = OUT_SINGLE_PITCH_TOLERANCE + k;
        double values[2];
        if (!(wanted & FF_BIT(row)))
            continue;
        if (s->quality.count == 0)
            return ff_failf(s->host, FF_UNSUPPORTED, gear_spur_outputs[row].name,
                            "this output needs `quality`, the class of ISO 1328-1 of the gears");
        for (int i = 0; i < 2; i++) {
            const gear_tolerances *t = &s->tolerances[i];
            const double of[] = {t->single_pitch, t->total_pitch, t->profile_form, t->profile_slope,
                                 t->profile};
            values[i] = of[k];
        }
        if (put_pair(s, wanted, row, values) != FF_OK)
            return FF_NOMEM;
    }
    return FF_OK;
}

ff_status gear_spur_write(const spur *s, uint64_t wanted)
{
    ff_status status = write_scalars(s, wanted);
    if (status == FF_OK)
        status = write_pairs(s, wanted);
    if (status == FF_OK)
        status = write_stations(s, wanted);
    if (status == FF_OK)
        status = write_tolerances(s, wanted);
    return status == FF_OK ? write_flanks(s, wanted) : status;
}
