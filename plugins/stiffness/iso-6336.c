/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mesh stiffness of ISO 6336-1, method B. The single stiffness c' comes from a series fitted to
   gears on solid blanks. The mesh stiffness is c_gamma = c' (0.75 eps + 0.25). This mean is linear
   in the contact ratio eps if p pairs together have the stiffness c' (0.75 p + 0.25). This
   assumption gives the variation over the mesh cycle, which the standard does not specify. */
#include "inputs.h"
#include "loaded-cycle.h"
#include "outputs.h"
#include "params.h"
#include "references.h"

#include "../numerics/pinion.h"

#include <flankfilm/author.h>

#include <math.h>
#include <stdlib.h>

typedef struct iso_model {
    const ff_host *host;
    int64_t points;
    stiffness_mesh_cycles cycles;
    int32_t definition, shape; /* 1: tangent; 1: trapezoidal */
    double ramp;               /* mesh cycles from no load to full load */
    double blank, correction;  /* C_R, C_M */
} iso_model;

/* The values of the standard for one pair of gears. */
typedef struct iso_pair {
    double contact_ratio, ramp;
    double single; /* c' b, N/m */
} iso_pair;

static const ff_param params[] = {
    STIFFNESS_POINTS_ROW(iso_model),
    STIFFNESS_DEFINITION_ROW(iso_model),
    FF_ONE_OF(
        "rectangular|trapezoidal", "shape", iso_model, shape, 0, "rectangular",
        "rectangular: pairs enter and leave abruptly and share the load equally; trapezoidal: "
        "their stiffness rises and falls over ramps centred on SAP and on the tip, with the same "
        "mean"),
    FF_QUANTITY("ramp", "1", iso_model, ramp, FF_MIN_OPEN, "0.2", NULL, 0, 0.5, 0, 0,
                "length of the ramps in mesh cycles, for shape: trapezoidal"),
    FF_QUANTITY("blank_factor", "1", iso_model, blank, FF_MIN_OPEN, "1", NULL, 0, 1, 0, 0,
                "gear blank factor C_R: 1 for solid disc gears, less for thin rims and webs"),
    FF_QUANTITY("correction_factor", "1", iso_model, correction, FF_MIN_OPEN, "0.8", NULL, 0, 1, 0,
                0, "correction factor C_M from theoretical to measured single stiffness"),
    STIFFNESS_MESH_CYCLE_ROW,
};

static ff_status ready(void *self)
{
    const iso_model *m = self;
    const ff_serving rows[] = {{!m->shape, "ramp", "", NULL, "shape is rectangular"}};
    ff_serve(m->host, rows, sizeof rows / sizeof rows[0]);
    return FF_OK;
}

/* Sets mesh_cycle. */
static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    iso_model *m = self;
    (void)param;
    m->cycles = stiffness_mesh_cycles_set(value);
    return FF_OK;
}

/* Profile shift from the tooth thickness at the reference circle, s = m (pi/2 + 2 x tan a). */
static double profile_shift(const stiffness_gear *g)
{
    double c = g->base_radius / g->reference_radius, tangent = sqrt(1 - c * c) / c;
    double module = 2 * g->reference_radius / g->teeth;
    return (g->full_thickness / module - M_PI / 2) / (2 * tangent);
}

/* ISO 6336-1, clause 9, theoretical single stiffness: the series for q' = 1/c'_th, in mm um/N. For
   spur gears the virtual number of teeth is the number of teeth. The pinion has index 0 here and 1
   in the standard. */
static double theoretical_compliance(const double z[2], const double x[2])
{
    double z1 = z[0], z2 = z[1];
    return 0.04723 + 0.15551 / z1 + 0.25791 / z2 - 0.00635 * x[0] - 0.11654 * x[0] / z1 -
           0.00193 * x[1] - 0.24188 * x[1] / z2 + 0.00529 * x[0] * x[0] + 0.00182 * x[1] * x[1];
}

/* ISO 6336-1, clause 9, basic rack factor C_B = [1 + 0.5 (1.2 - h_fP/m)] [1 - 0.02 (20 deg -
   alpha)]: the mean of both gears, each with its own dedendum h_fP. */
static double rack_factor(const stiffness_gears *g)
{
    double sum = 0;
    for (int i = 0; i < 2; i++) {
        const stiffness_gear *gear = &g->gear[i];
        double module = 2 * gear->reference_radius / gear->teeth;
        double dedendum =
            (gear->reference_radius - gear->root_radius) / module + profile_shift(gear);
        double degrees = acos(gear->base_radius / gear->reference_radius) * 180 / M_PI;
        sum += (1 + 0.5 * (1.2 - dedendum)) * (1 - 0.02 * (20 - degrees)) / 2;
    }
    return sum;
}

/* c' b = c'_th C_M C_R C_B (E/E_steel) b, with E = 2 E1 E2/(E1 + E2). Below a load of 100 N/mm,
 * c' decreases in proportion to the load. */
static ff_status set_single(const iso_model *m, const stiffness_gears *g, int pinion,
                            double line_force, double *single)
{
    const double steel = 206e9;    /* Pa */
    const double full_load = 1e5;  /* N/m */
    const double per_micron = 1e9; /* N/(mm um) in N/m per m of width */
    const stiffness_gear *one = &g->gear[pinion], *two = &g->gear[1 - pinion];
    const double z[2] = {one->teeth, two->teeth}, x[2] = {profile_shift(one), profile_shift(two)};
    double e1 = one->elastic_modulus, e2 = two->elastic_modulus;
    double compliance = theoretical_compliance(z, x), rack = rack_factor(g);
    double load = line_force * g->gear[0].base_radius / g->gear[0].reference_radius / g->width;
    if (!(compliance > 0) || !(rack > 0))
        return ff_failf(m->host, FF_INVALID, rack > 0 ? "gear.tooth_thickness" : "gear.root_radius",
                        "the series of ISO 6336-1 gives no stiffness for teeth of this shape: "
                        "q' = %g mm um/N, C_B = %g",
                        compliance, rack);
    if (!(load > 0))
        return ff_failf(m->host, FF_INVALID, "operating.line_force",
                        "in ISO 6336-1 the stiffness vanishes without load: give a torque, or "
                        "reference_torque of the operating stage");
    *single = per_micron / compliance * m->correction * m->blank * rack * 2 * e1 * e2 /
              ((e1 + e2) * steel) * fmin(load / full_load, 1) * g->width;
    int held =
        x[0] >= x[1] - 1e-9 && x[0] + x[1] >= -0.5 && x[0] + x[1] <= 2 && rack > 0.7 && rack < 1.2;
    m->host->quality(m->host->ctx, "rack_factor", rack, 1, held ? FF_GOOD : FF_RANGE,
                     held ? "basic rack factor C_B; the profile shifts are in the range of the "
                            "standard"
                          : "basic rack factor C_B; the dedendum, or the profile shifts x1 >= x2, "
                            "-0.5 <= x1 + x2 <= 2, are outside the range of the standard");
    return FF_OK;
}

/* Returns the stiffness of this number of pairs over the single stiffness. */
static double stiffness_factor(double pairs)
{
    return 0.75 * pairs + 0.25;
}

/* A single pair has the stiffness c'. Several pairs are coupled so that they have c' (0.75 p +
   0.25) together. */
static void couple(const iso_pair *f, stiffness_contacts *c)
{
    double pairs = (double)c->count, own = 1 / f->single;
    double shared = pairs > 1 ? own * (pairs / stiffness_factor(pairs) - 1) / (pairs - 1) : 0;
    for (size_t i = 0; i < c->count; i++)
        for (size_t k = 0; k < c->count; k++)
            c->compliance[i][k] = i == k ? own : shared;
}

/* Returns the factor on the stiffness of a pair of that age, which rises from 0 to 1 over a ramp.
   The factor is at least 1e-9, so that the compliance stays finite. */
static double part(const iso_pair *f, double age)
{
    const double least = 1e-9;
    double in = (age + f->ramp / 2) / f->ramp,
           out = (f->contact_ratio + f->ramp / 2 - age) / f->ramp;
    return fmax(fmin(fmin(in, out), 1), least);
}

static void compliance(const void *self, const stiffness_position *at, stiffness_contacts *c)
{
    const iso_pair *f = self;
    double sum = 0;
    for (size_t i = 0; i < c->count; i++)
        c->hertz[i] = (stiffness_hertz){0};
    couple(f, c);
    if (!(f->ramp > 0))
        return;
    for (size_t i = 0; i < c->count; i++)
        sum += part(f, at->age[i]);
    for (size_t i = 0; i < c->count; i++) {
        for (size_t k = 0; k < c->count; k++)
            c->compliance[i][k] = 0;
        c->compliance[i][i] = sum / (part(f, at->age[i]) * f->single * stiffness_factor(sum));
    }
}

static void report_range(const iso_model *m, const stiffness_path *e)
{
    int held = e->contact_ratio >= 1.2;
    m->host->quality(m->host->ctx, "contact_ratio", e->contact_ratio, 1.2,
                     held ? FF_GOOD : FF_RANGE,
                     "ISO 6336-1 gives the mesh stiffness for contact ratios of 1.2 and more");
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const iso_model *m = self;
    const ff_reals rim = {NULL, 0};
    stiffness_conditions conditions;
    const bool trapezoidal = m->shape == 1;
    iso_pair f = {.ramp = trapezoidal ? m->ramp : 0};
    int pinion = 0;
    ff_status status = stiffness_conditions_read(m->host, in, &rim, m->cycles, &conditions);
    if (status == FF_OK)
        status = numerics_pinion(m->host, &in[STIFFNESS_IN_PINION], in[STIFFNESS_IN_TEETH].data,
                                 &pinion);
    if (status == FF_OK)
        status = set_single(m, &conditions.gears, pinion, conditions.path.line_force, &f.single);
    if (status != FF_OK)
        return status;
    report_range(m, &conditions.path);
    f.contact_ratio = conditions.path.contact_ratio;
    stiffness_source source = {
        .host = m->host,
        .conditions = &conditions,
        .points = (size_t)m->points,
        .cycles = m->cycles,
        .tangent = m->definition == 1,
        .before = f.ramp / 2,
        .after = f.ramp / 2,
        .sharp = !trapezoidal,
        .slope_changes = trapezoidal ? 2 : 0,
        .slope_change = {f.ramp / 2, conditions.path.contact_ratio - f.ramp / 2},
        .compliance = compliance,
        .self = &f,
        .fault = "gear.tooth_thickness"};
    return stiffness_loaded_cycle_publish(&source, wanted);
}

FF_MODEL(
    stiffness_iso_6336, iso_model, .id = "stiffness/iso-6336", .version = "1.0.0",
    .summary =
        "mesh stiffness of ISO 6336-1, method B, with a rectangular or trapezoidal time course",
    .reference =
        "ISO 6336-1:2019, Calculation of load capacity of spur and helical gears, clause 9",
    .bibtex = BIB_iso6336_1, .licence = "GPL-3.0-or-later", .params = FF_TABLE(params),
    .inputs = FF_TABLE(stiffness_inputs), .outputs = STIFFNESS_PLAIN_OUTPUTS, .set = set,
    .ready = ready, .evaluate = evaluate, .destroy = free, .cost = 3e-4);
FF_EXPORT_MODELS(&stiffness_iso_6336);
