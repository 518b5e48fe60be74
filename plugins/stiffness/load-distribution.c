/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Mesh stiffness, transmission errors and tooth forces of a spur pair by the load distribution
 * of Conry & Seireg 1973: bending, shear and compression of teeth, fillets and bodies down to
 * the rim; coupling of neighbouring teeth through the body; load-dependent Hertzian contacts. */
#include "contact-point.h"
#include "elastic-pair.h"
#include "inputs.h"
#include "loaded-cycle.h"
#include "outputs.h"
#include "params.h"
#include "references.h"

#include <flankfilm/author.h>

#include <gsl/gsl_errno.h>

#include <math.h>
#include <stdlib.h>

enum {
    NODES = 32
}; /* nodes of the Gauss-Legendre rule; the integrals are accurate to rounding (see
      potential-energy.c) */

/* The largest contact ratio for which STIFFNESS_RING_PLACES couples all pairs in mesh. */
static const double highest_contact_ratio = 4;

typedef struct distribution {
    const ff_host *host;
    int64_t points;
    stiffness_mesh_cycles cycles;
    int32_t definition, corner; /* 1: tangent */
    ff_reals rim;
    stiffness_elasticity teeth;
} distribution;

static const ff_param params[] = {
    STIFFNESS_POINTS_ROW(distribution),
    FF_ONE_OF("secant|tangent", "definition", distribution, definition, 0, "tangent",
              "tangent: dF/d(e_l), the stiffness for small vibrations about the load; secant: "
              "F/(e_l - e), the definition of Li & Kahraman 2011"),
    FF_ONE_OF("finite-element|analytical", "compliance", distribution, teeth.compliance, 0,
              "finite-element",
              "finite-element: plane elements of the whole gear with all teeth; analytical: beam "
              "with the foundation of Sainsot et al. 2004, without coupling of teeth"),
    FF_COUNT("elements_per_tooth", distribution, teeth.elements, FF_TUNABLE, "900", NULL, 50, 20000,
             0, 0, "approximate number of eight-node elements in one sector of a gear"),
    FF_ONE_OF("strain|stress", "plane", distribution, teeth.plane, 0, "strain",
              "strain: plane strain, for face widths of about five tooth thicknesses or more; "
              "stress: plane stress, for narrower teeth; the contact stays in plane strain"),
    FF_SWITCH("neighbour_coupling", distribution, teeth.coupling, "true",
              "whether a loaded tooth displaces its neighbours through the gear body; for "
              "compliance: finite-element only"),
    FF_SWITCH("corner_contact", distribution, corner, "false",
              "whether to include tip corner contact under load before SAP and after the tip, off "
              "the line of action"),
    STIFFNESS_RIM_RADIUS_ROW(distribution),
    STIFFNESS_MESH_CYCLE_ROW,
};

static void destroy(void *self)
{
    distribution *m = self;
    if (!m)
        return;
    if (m->teeth.rule)
        gsl_integration_glfixed_table_free(m->teeth.rule);
    free(m);
}

static ff_status create(const ff_host *host, void **self)
{
    distribution *m = calloc(1, sizeof *m);
    if (!m)
        return FF_NOMEM;
    m->host = m->teeth.host = host;
    gsl_set_error_handler_off(); /* otherwise it would end the process if memory is short */
    m->teeth.rule = gsl_integration_glfixed_table_alloc(NODES);
    if (!m->teeth.rule) {
        destroy(m);
        return FF_NOMEM;
    }
    *self = m;
    return FF_OK;
}

/* Sets mesh_cycle. */
static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    distribution *m = self;
    (void)param;
    m->cycles = stiffness_mesh_cycles_set(value);
    return FF_OK;
}

static ff_status ready(void *self)
{
    static const char text[] = "compliance is analytical";
    const distribution *m = self;
    const int beam = m->teeth.compliance == STIFFNESS_ANALYTICAL;
    const ff_serving rows[] = {
        {beam, "elements_per_tooth", "", NULL, text},
        {beam, "neighbour_coupling", "", NULL, text},
    };
    ff_serve(m->host, rows, sizeof rows / sizeof rows[0]);
    return FF_OK;
}

static ff_status check_range(const distribution *m, const stiffness_path *e)
{
    if (e->contact_ratio <= highest_contact_ratio)
        return FF_OK;
    return ff_failf(m->host, FF_UNSUPPORTED, "gear.roll_tip",
                    "the contact ratio is %.6g; the coupling of teeth is computed for contact "
                    "ratios up to %g",
                    e->contact_ratio, highest_contact_ratio);
}

static void report_mesh(const distribution *m, const stiffness_elastic_pair *p)
{
    const double limit = 2e-3;
    double error = fmax(p->body[0]->mesh_error, p->body[1]->mesh_error);
    double reciprocity = fmax(p->body[0]->ring.reciprocity, p->body[1]->ring.reciprocity);
    m->host->quality(m->host->ctx, "stiffness_mesh_error", error, limit,
                     error <= limit ? FF_GOOD : FF_DOUBTFUL,
                     "relative change of the compliance of a tooth if the number of elements is "
                     "halved");
    m->host->quality(m->host->ctx, "reciprocity", reciprocity, 1e-10,
                     reciprocity <= 1e-10 ? FF_GOOD : FF_BAD,
                     "reciprocity: relative difference between the displacements of two flank "
                     "points, each under a load on the other");
}

/* Reports whether the contact is narrow compared with its distance to the axis of the tooth, since
   the local approach is that of a half plane. */
static void report_contact(const distribution *m, const stiffness_elastic_pair *p,
                           const stiffness_path *e)
{
    const double limit = 0.5;
    double worst = 0;
    for (int i = 0; i <= 4; i++) {
        double age = e->contact_ratio * i / 4;
        double softness = p->half_space[0] + p->half_space[1];
        double width =
            sqrt(4 * e->line_force * stiffness_gears_curvature(p->gears, age) * softness);
        for (int g = 0; g < 2; g++)
            worst =
                fmax(worst, width / stiffness_contour_force(&p->body[g]->contour,
                                                            stiffness_gears_roll(p->gears, g, age))
                                        .depth);
    }
    m->host->quality(m->host->ctx, "contact_width", worst, limit,
                     worst <= limit ? FF_GOOD : FF_DOUBTFUL,
                     "half width of the contact under the whole force, over the depth of the "
                     "tooth's axis; the local approach is computed as for a half plane");
}

/* A pair in the middle of the path of contact that carries the whole force. */
typedef struct mid_path {
    double roll[2], curvature;
    double deflection; /* deflection of the pair over the force, m/N */
    double hertz;      /* part of the deflection due to the Hertzian contact, m/N */
} mid_path;

static mid_path at_mid_path(const stiffness_elastic_pair *p, const stiffness_path *e)
{
    double age = e->contact_ratio / 2;
    mid_path m = {.curvature = stiffness_gears_curvature(p->gears, age)};
    for (int g = 0; g < 2; g++)
        m.roll[g] = stiffness_gears_roll(p->gears, g, age);
    stiffness_hertz h = stiffness_elastic_pair_approach(p, m.roll, m.curvature, true);
    m.hertz = h.constant - h.slope * log(e->line_force);
    m.deflection = stiffness_elastic_pair_teeth(p, m.roll) + m.hertz;
    return m;
}

static void report_half_plane(const distribution *m, const stiffness_elastic_pair *p,
                              const stiffness_path *e)
{
    const double limit = 0.1;
    double thin = 0;
    for (int g = 0; g < 2; g++) {
        const stiffness_ring *ring = &p->body[g]->ring;
        thin += (ring->thin[0] + ring->thin[1]) / 2;
    }
    double share = fabs(thin) / at_mid_path(p, e).deflection;
    m->host->quality(
        m->host->ctx, "half_plane", share, limit, share <= limit ? FF_GOOD : FF_RANGE,
        "share of a pair's deflection that is due to the difference between tooth and half plane");
}

/* Reports the effect of plane stress in the contact. Only the teeth can be in plane stress: over
   the width of the contact, some tenths of a millimetre, steel can expand sideways only at the ends
   of the face. */
static void report_plane(const distribution *m, const stiffness_elastic_pair *p,
                         const stiffness_path *e)
{
    const double limit = 0.1;
    mid_path at = at_mid_path(p, e);
    stiffness_hertz h = stiffness_elastic_pair_approach(p, at.roll, at.curvature, false);
    double more = (h.constant - h.slope * log(e->line_force) - at.hertz) / at.deflection;
    m->host->quality(
        m->host->ctx, "contact_in_plane_strain", more, limit, more <= limit ? FF_GOOD : FF_DOUBTFUL,
        "share of a pair's deflection that plane stress in the contact would add; the contact "
        "stays in plane strain, since it is narrow compared with the face width");
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    distribution *m = self;
    stiffness_conditions conditions;
    stiffness_elastic_pair p;
    ff_status status = stiffness_conditions_read(m->host, in, &m->rim, m->cycles, &conditions);
    if (status == FF_OK)
        status = check_range(m, &conditions.path);
    if (status == FF_OK)
        status = stiffness_elastic_pair_make(&m->teeth, &conditions.gears, &p);
    if (status != FF_OK)
        return status;
    if (m->teeth.compliance != STIFFNESS_ANALYTICAL) {
        report_mesh(m, &p);
        report_half_plane(m, &p, &conditions.path);
    }
    report_contact(m, &p, &conditions.path);
    if (m->teeth.plane != STIFFNESS_STRAIN)
        report_plane(m, &p, &conditions.path);
    stiffness_source source = {.host = m->host,
                               .conditions = &conditions,
                               .points = (size_t)m->points,
                               .cycles = m->cycles,
                               .tangent = m->definition == 1,
                               .corner = m->corner == 1,
                               .before = m->corner ? stiffness_corner_reach : 0,
                               .after = m->corner ? stiffness_corner_reach : 0,
                               .sharp = !m->corner,
                               .compliance = stiffness_elastic_pair_compliance,
                               .self = &p,
                               .fault = "operating.line_force"};
    return stiffness_loaded_cycle_publish(&source, wanted);
}

const ff_model stiffness_load_distribution = {
    FF_HEAD(distribution, create),
    .id = "stiffness/load-distribution",
    .version = "1.0.0",
    .summary = "mesh stiffness, transmission errors and tooth forces from the load distribution "
               "over elastic teeth",
    .reference = "Conry & Seireg 1973, ASME J. Eng. Ind. 95, 1115-1122; Weber 1949, DSIR Sponsored "
                 "Research (Germany) Report 3; Johnson 1985, Contact Mechanics; Thomas 1979, Int. "
                 "J. Numer. Methods Eng. 14, 81-102 (rotational periodicity); Litvin & Fuentes "
                 "2004, Gear Geometry and Applied Theory (fillet)",
    .bibtex = BIB_conry1973 "\n" BIB_weber1949 "\n" BIB_johnson1985 "\n" BIB_thomas1979,
    .licence = "GPL-3.0-or-later",
    .params = FF_TABLE(params),
    .inputs = stiffness_inputs,
    .input_count = STIFFNESS_BODY_INPUTS,
    .input_stride = sizeof stiffness_inputs[0],
    .outputs = FF_TABLE(stiffness_outputs),
    .set = set,
    .ready = ready,
    .evaluate = evaluate,
    .destroy = destroy,
    .cost = 0.5,
};
FF_EXPORT_MODELS(&stiffness_load_distribution);
