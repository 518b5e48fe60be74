/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mesh stiffness of a spur pair from the strain energy of its teeth. Two teeth, two bodies and one
   contact act in series; the pairs act in parallel along the geometric path of contact. A pair does
   not deform the body below another pair, and contact begins and ends at the same points as without
   load. */
#include "contact-point.h"
#include "inputs.h"
#include "loaded-cycle.h"
#include "outputs.h"
#include "params.h"
#include "references.h"
#include "tooth-beam.h"

#include <flankfilm/author.h>

#include <gsl/gsl_errno.h>

#include <math.h>
#include <stdlib.h>

/* Nodes of the Gauss-Legendre rules. The integrands are analytic, so 32 nodes are accurate to
 * rounding. */
enum { NODES = 32, NODES_OF_CHECK = 64 };

typedef struct energy_model {
    const ff_host *host;
    gsl_integration_glfixed_table *rule, *check_rule;
    int64_t points;
    stiffness_mesh_cycles cycles;
    ff_reals rim;
    int32_t plane, definition; /* `plane` 1: strain; `definition` 1: tangent */
} energy_model;

/* One pair of teeth along the path of contact. */
typedef struct beam_pair {
    const stiffness_gears *gears;
    stiffness_tooth tooth[2];
    double contact; /* compliance of the Hertzian contact, m/N */
    const gsl_integration_glfixed_table *rule;
} beam_pair;

static const ff_param params[] = {
    STIFFNESS_POINTS_ROW(energy_model),
    STIFFNESS_RIM_RADIUS_ROW(energy_model),
    FF_ONE_OF("stress|strain", "plane", energy_model, plane, 0, "stress",
              "stress: the tooth bends as a narrow beam; strain: it bends as a wide plate, with "
              "E/(1-nu^2) in bending and compression"),
    STIFFNESS_DEFINITION_ROW(energy_model),
    STIFFNESS_MESH_CYCLE_ROW,
};

static void destroy(void *self)
{
    energy_model *s = self;
    if (!s)
        return;
    if (s->rule)
        gsl_integration_glfixed_table_free(s->rule);
    if (s->check_rule)
        gsl_integration_glfixed_table_free(s->check_rule);
    free(s);
}

static ff_status create(const ff_host *host, void **self)
{
    energy_model *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    gsl_set_error_handler_off(); /* otherwise it would end the process if memory is short */
    s->rule = gsl_integration_glfixed_table_alloc(NODES);
    s->check_rule = gsl_integration_glfixed_table_alloc(NODES_OF_CHECK);
    if (!s->rule || !s->check_rule) {
        destroy(s);
        return FF_NOMEM;
    }
    *self = s;
    return FF_OK;
}

/* Sets mesh_cycle. */
static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    energy_model *m = self;
    (void)param;
    m->cycles = stiffness_mesh_cycles_set(value);
    return FF_OK;
}

static double pair_compliance(const beam_pair *p, double age)
{
    double compliance = p->contact;
    for (int gear = 0; gear < 2; gear++) {
        double roll = stiffness_gears_roll(p->gears, gear, age);
        stiffness_compliance c = stiffness_tooth_compliance(&p->tooth[gear], roll, p->rule);
        compliance += stiffness_compliance_sum(&c);
    }
    return compliance;
}

/* The pairs act in parallel, so there is no coupling. */
static void compliance(const void *self, const stiffness_position *at, stiffness_contacts *c)
{
    for (size_t i = 0; i < at->count; i++) {
        for (size_t k = 0; k < at->count; k++)
            c->compliance[i][k] = 0;
        c->compliance[i][i] = pair_compliance(self, at->age[i]);
        c->hertz[i] = (stiffness_hertz){0};
    }
}

/* Checks that contact stays on the involute, and that the tooth is not pointed. */
static ff_status check_flank(const energy_model *s, const beam_pair *p, int gear)
{
    const double slack = 1e-9;
    const stiffness_tooth *tooth = &p->tooth[gear];
    double low = p->gears->gear[gear].roll_low, high = p->gears->gear[gear].roll_tip;
    if (!(tooth->root_half_angle > 0) || !(high - tooth->half_angle < M_PI / 2) ||
        !(stiffness_tooth_involute(tooth, high).half > 0))
        return ff_failf(s->host, FF_INVALID, "gear.tooth_thickness",
                        "gear %d: the tooth is pointed below the end of contact", gear + 1);
    if (!(low >= tooth->root_roll - slack))
        return ff_failf(s->host, FF_INVALID, "gear.root_radius",
                        "gear %d: contact reaches the roll angle %.6g rad, but the involute "
                        "begins at %.6g rad",
                        gear + 1, low, tooth->root_roll);
    return FF_OK;
}

static ff_status make_pair(const energy_model *s, const stiffness_gears *gears, beam_pair *p)
{
    *p = (beam_pair){.gears = gears, .rule = s->rule};
    for (int gear = 0; gear < 2; gear++) {
        const stiffness_gear *g = &gears->gear[gear];
        stiffness_tooth_of_gear(&p->tooth[gear], gears, gear, s->plane == 1);
        /* Yang & Sun 1985: pi E b/(4 (1-nu^2)) for equal materials; each gear adds its part */
        p->contact += 2 * (1 - g->poisson_ratio * g->poisson_ratio) /
                      (M_PI * g->elastic_modulus * gears->width);
        ff_status status = check_flank(s, p, gear);
        if (status != FF_OK)
            return status;
    }
    return FF_OK;
}

/* Reports whether the body is in the range of the fit by Sainsot et al.: 1.4 <= h <= 7 and 0.01
 * <= theta <= 0.12. */
static void report_foundation(const energy_model *s, const beam_pair *p)
{
    double worst = 0;
    for (int gear = 0; gear < 2; gear++) {
        double h = p->tooth[gear].body_ratio, theta = p->tooth[gear].root_half_angle;
        worst = fmax(worst, fmax(fmax(h / 7, 1.4 / h), fmax(theta / 0.12, 0.01 / theta)));
    }
    int held = worst <= 1;
    s->host->quality(s->host->ctx, "foundation_range", worst, 1, held ? FF_GOOD : FF_RANGE,
                     held ? "the gear bodies are in the range of the fit by Sainsot et al."
                          : "a gear body is outside the range of the fit by Sainsot et al.: root "
                            "radius over rim radius 1.4 to 7, half angle of the root 0.01 to 0.12 "
                            "rad");
}

static void report_quadrature(const energy_model *s, const beam_pair *p)
{
    const double limit = 1e-9;
    beam_pair finer = *p;
    finer.rule = s->check_rule;
    double worst = 0;
    for (int i = 0; i <= 4; i++) {
        double age = p->gears->contact_ratio * i / 4;
        worst = fmax(worst, fabs(pair_compliance(p, age) / pair_compliance(&finer, age) - 1));
    }
    s->host->quality(s->host->ctx, "quadrature_error", worst, limit,
                     worst <= limit ? FF_GOOD : FF_DOUBTFUL,
                     "relative difference between the strain energy and that of a finer "
                     "integration rule");
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const energy_model *s = self;
    stiffness_conditions conditions;
    beam_pair p;
    ff_status status = stiffness_conditions_read(s->host, in, &s->rim, s->cycles, &conditions);
    if (status == FF_OK)
        status = make_pair(s, &conditions.gears, &p);
    if (status != FF_OK)
        return status;
    report_foundation(s, &p);
    report_quadrature(s, &p);
    stiffness_source source = {.host = s->host,
                               .conditions = &conditions,
                               .points = (size_t)s->points,
                               .cycles = s->cycles,
                               .tangent = s->definition == 1,
                               .sharp = true,
                               .compliance = compliance,
                               .self = &p,
                               .fault = "rim_radius"};
    return stiffness_loaded_cycle_publish(&source, wanted);
}

const ff_model stiffness_potential_energy = {
    FF_HEAD(energy_model, create),
    .id = "stiffness/potential-energy",
    .version = "1.0.0",
    .summary = "mesh stiffness from bending, shear and compression of the teeth, their foundation "
               "and the Hertzian contact",
    .reference =
        "Yang & Lin 1987, ASME J. Mech. Transm. Autom. Des. 109, 189-196; Tian 2004, MSc thesis, "
        "University of Alberta; Sainsot, Velex & Duverger 2004, ASME J. Mech. Des. 126, 748-752; "
        "Yang & Sun 1985, ASME J. Mech. Transm. Autom. Des. 107, 529-535",
    .bibtex = BIB_yang1987 "\n" BIB_tian2004 "\n" BIB_sainsot2004 "\n" BIB_yang1985,
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .inputs = stiffness_inputs,
    .input_count = STIFFNESS_BODY_INPUTS,
    .input_stride = sizeof stiffness_inputs[0],
    .outputs = FF_TABLE(stiffness_outputs),
    .set = set,
    .evaluate = evaluate,
    .destroy = destroy,
    .cost = 5e-3,
};
FF_EXPORT_MODELS(&stiffness_potential_energy);
