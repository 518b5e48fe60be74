/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Mesh stiffness, transmission errors and tooth forces of a spur pair from the load distribution of
 * Conry & Seireg 1973: bending, shear and compression of teeth, fillets and bodies down to the
 * rim, the coupling of neighbouring teeth through the body, and load-dependent Hertzian contacts.
 */
#include "assess.h"
#include "quasi-static.h"
#include "ring.h"
#include "tooth-beam.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    POINTS,
    DEFINITION,
    COMPLIANCE,
    ELEMENTS,
    PLANE,
    COUPLING,
    CORNER,
    RIM_RADIUS,
    FILLET,
    MESH_CYCLE
};
enum { FINITE_ELEMENT, ANALYTICAL };
enum { NODES = 32 };

/* Coupling is worked out for the teeth that mesh up to this contact ratio. */
static const double highest_contact_ratio = 4;

/* What the compliance of one gear is made from; equal data, equal compliance. */
typedef struct recipe {
    stiffness_contour_data contour;
    stiffness_material material;
    double rim_radius;
    size_t elements;
} recipe;

typedef struct body {
    bool made;
    recipe recipe;
    stiffness_contour contour;
    stiffness_ring ring;
    double mesh_error; /* of the compliance in the middle of the flank, relative */
} body;

typedef struct distribution {
    const ff_host *host;
    size_t points, elements;
    stiffness_mesh_cycles cycles;
    bool tangent, analytical, plane_strain, coupling, corner;
    stiffness_rim rim;
    double fillet; /* in modules */
    gsl_integration_glfixed_table *rule;
    body body[2]; /* kept from one evaluation to the next */
} distribution;

/* The pair for one evaluation. */
typedef struct pair {
    const distribution *model;
    const stiffness_gears *gears;
    const body *body[2];
    stiffness_tooth tooth[2];
    double yield[2]; /* (1 - nu^2)/(pi E b) */
} pair;

static const ff_param params[] = {
    {.name = "points",
     .unit = "1",
     .doc = "equal steps of the mesh cycle that the outputs are given at",
     .type = FF_INT,
     .flags = FF_TUNABLE,
     .preset = "200",
     .min = 4,
     .max = 100000},
    {.name = "definition",
     .unit = "",
     .doc = "secant F/(e_l - e), or tangent dF/d(e_l), which a small vibration about the load sees",
     .type = FF_CHOICE,
     .preset = "secant",
     .choices = "secant|tangent"},
    {.name = "compliance",
     .unit = "",
     .doc = "finite-element: plane elements of the whole ring of teeth; analytical: beam with the "
            "foundation of Sainsot et al. 2004, teeth uncoupled",
     .type = FF_CHOICE,
     .preset = "finite-element",
     .choices = "finite-element|analytical"},
    {.name = "elements_per_tooth",
     .unit = "1",
     .doc = "about how many elements of eight nodes one sector of a gear has",
     .type = FF_INT,
     .flags = FF_TUNABLE,
     .preset = "900",
     .min = 50,
     .max = 20000},
    {.name = "plane",
     .unit = "",
     .doc = "strain: teeth that are wide against their thickness, some five times or more; "
            "stress: narrow ones, free to bulge sideways, but for the contact, which stays in "
            "plane strain",
     .type = FF_CHOICE,
     .preset = "strain",
     .choices = "strain|stress"},
    {.name = "neighbour_coupling",
     .unit = "",
     .doc = "whether a loaded tooth moves its neighbours through the gear body; with finite "
            "elements alone",
     .type = FF_BOOL,
     .preset = "true"},
    {.name = "corner_contact",
     .unit = "",
     .doc = "whether tip corners touch under load before SAP and after the tip, off the line of "
            "action",
     .type = FF_BOOL,
     .preset = "false"},
    {.name = "rim_radius",
     .unit = "mm",
     .doc = "radius inside which a gear's body is rigid, one value or two; without it the bore "
            "radius, or half the root radius for a gear without a bore",
     .type = FF_REALS,
     .flags = FF_MIN_OPEN,
     .min = 0,
     .max = 1e5,
     .min_count = 1,
     .max_count = 2},
    {.name = "fillet_radius",
     .unit = "1",
     .doc = "tip radius of the rack that cuts the teeth, in modules; made smaller where the tooth "
            "space or the path of contact leaves less room",
     .type = FF_REAL,
     .preset = "0.38",
     .min = 0,
     .max = 1},
    {.name = "mesh_cycle",
     .unit = "1",
     .doc = "which mesh cycle of the hunting period, where teeth have index deviations, from 0; "
            "worst: the one whose pair bears the highest Hertz pressure; all: tooth_force and "
            "load_share of the pairs of all of them, the rest of mesh cycle 0",
     .type = FF_INT,
     .preset = "0",
     .choices = "worst|all",
     .min = 0,
     .max = 1e9},
};

static void destroy(void *self)
{
    distribution *m = self;
    if (!m)
        return;
    if (m->rule)
        gsl_integration_glfixed_table_free(m->rule);
    free(m);
}

static ff_status create(const ff_host *host, void **self)
{
    distribution *m = calloc(1, sizeof *m);
    if (!m)
        return FF_NOMEM;
    m->host = host;
    m->rule = gsl_integration_glfixed_table_alloc(NODES);
    if (!m->rule) {
        destroy(m);
        return FF_NOMEM;
    }
    *self = m;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    distribution *m = self;
    switch (param) {
    case POINTS:
        m->points = (size_t)value->integer;
        return FF_OK;
    case DEFINITION:
        m->tangent = value->integer == 1;
        return FF_OK;
    case COMPLIANCE:
        m->analytical = value->integer == ANALYTICAL;
        return FF_OK;
    case ELEMENTS:
        m->elements = (size_t)value->integer;
        return FF_OK;
    case PLANE:
        m->plane_strain = value->integer == 0;
        return FF_OK;
    case COUPLING:
        m->coupling = value->integer == 1;
        return FF_OK;
    case CORNER:
        m->corner = value->integer == 1;
        return FF_OK;
    case RIM_RADIUS:
        return stiffness_rim_set(m->host, value, &m->rim);
    case FILLET:
        m->fillet = value->real;
        return FF_OK;
    default: /* MESH_CYCLE */
        m->cycles = stiffness_mesh_cycles_set(value);
        return FF_OK;
    }
}

/* Weber 1949, Johnson 1985 eq. 5.57: approach of a surface and a point h below the middle of a
   Hertzian line contact, 2 f (1 - nu^2)/(pi E b) (ln(2 h/a) - nu/(2 (1 - nu))), for both teeth;
   a^2 = 4 f R/(pi E* b). In plane stress E is for E/(1 - nu^2), nu for nu/(1 - nu). */
static stiffness_hertz approach(const pair *p, const double roll[2], double curvature, bool strain)
{
    stiffness_hertz h = {0};
    double yield[2], ratio[2]; /* the sum of yields is 1/(pi E* b) */
    for (int g = 0; g < 2; g++) {
        double nu = p->gears->gear[g].poisson_ratio;
        yield[g] = p->yield[g] / (strain ? 1 : 1 - nu * nu);
        ratio[g] = strain ? nu / (1 - nu) : nu;
    }
    for (int g = 0; g < 2; g++) {
        double depth = stiffness_contour_force(&p->body[g]->contour, roll[g]).depth;
        h.constant +=
            yield[g] * (2 * log(2 * depth) - log(4 * curvature * (yield[0] + yield[1])) - ratio[g]);
        h.slope += yield[g];
    }
    return h;
}

static double own_compliance(const pair *p, const double roll[2])
{
    double sum = 0;
    for (int g = 0; g < 2; g++) {
        if (p->model->analytical) {
            stiffness_compliance c =
                stiffness_tooth_compliance(&p->tooth[g], roll[g], p->model->rule);
            sum += stiffness_compliance_sum(&c);
        } else
            sum += stiffness_ring_own(&p->body[g]->ring, roll[g]);
    }
    return sum;
}

/* Pair i moved by a unit force on pair k. Older pairs are ahead: towards the loaded flank's side on
   the driving gear, away from it on the driven one. */
static double cross_compliance(const pair *p, const stiffness_position *at, size_t i, size_t k)
{
    int ahead = (int)lround(at->age[i] - at->age[k]);
    if (p->model->analytical || !p->model->coupling)
        return 0;
    return stiffness_ring_other(&p->body[0]->ring, ahead, at->roll[k][0], at->roll[i][0]) +
           stiffness_ring_other(&p->body[1]->ring, -ahead, at->roll[k][1], at->roll[i][1]);
}

static void compliance(const void *self, const stiffness_position *at, stiffness_contacts *c)
{
    const pair *p = self;
    for (size_t i = 0; i < at->count; i++) {
        c->compliance[i][i] = own_compliance(p, at->roll[i]);
        /* of the width the contact sees no end, whatever the tooth does */
        c->hertz[i] =
            approach(p, at->roll[i], stiffness_gears_curvature(p->gears, at->age[i]), true);
        for (size_t k = 0; k < i; k++)
            c->compliance[i][k] = c->compliance[k][i] = cross_compliance(p, at, i, k);
    }
}

static recipe recipe_of(const distribution *m, const stiffness_gears *gears, int gear)
{
    const stiffness_gear *g = &gears->gear[gear];
    recipe r;
    memset(&r, 0, sizeof r);
    r.contour = (stiffness_contour_data){.teeth = g->teeth,
                                         .base_radius = g->base_radius,
                                         .reference_radius = g->reference_radius,
                                         .root_radius = g->root_radius,
                                         .tip_roll = g->roll_tip,
                                         .thickness = g->thickness,
                                         .contact_roll = g->roll_low,
                                         .round = m->fillet * 2 * g->reference_radius / g->teeth};
    r.material.elastic_modulus = g->elastic_modulus;
    r.material.poisson_ratio = g->poisson_ratio;
    r.material.width = gears->width;
    r.material.plane_strain = m->plane_strain;
    r.rim_radius = g->rim_radius;
    r.elements = m->elements;
    return r;
}

static ff_status fail_ring(const distribution *m, int gear, int result)
{
    if (result == STIFFNESS_RING_MEMORY)
        return ff_failf(m->host, FF_NOMEM, "elements_per_tooth", "out of memory");
    return ff_failf(m->host, FF_NOCONV, "elements_per_tooth",
                    "gear %d: the stiffness matrix of the elements is singular", gear + 1);
}

/* Half as many elements show how far the mesh matters: the error falls at least as elements^-1. */
static ff_status make_ring(const distribution *m, int gear, body *b)
{
    const recipe *r = &b->recipe;
    stiffness_ring *coarse = malloc(sizeof *coarse);
    if (!coarse)
        return FF_NOMEM;
    int result =
        stiffness_ring_make(&b->ring, &b->contour, r->rim_radius, &r->material, r->elements);
    if (result == STIFFNESS_RING_MADE)
        result =
            stiffness_ring_make(coarse, &b->contour, r->rim_radius, &r->material, r->elements / 2);
    if (result == STIFFNESS_RING_MADE) {
        double roll = (b->ring.roll_low + b->ring.roll_high) / 2;
        b->mesh_error =
            fabs(stiffness_ring_own(coarse, roll) / stiffness_ring_own(&b->ring, roll) - 1);
    }
    free(coarse);
    return result == STIFFNESS_RING_MADE ? FF_OK : fail_ring(m, gear, result);
}

static ff_status make_body(const distribution *m, const stiffness_gears *gears, int gear, body *b)
{
    recipe wanted = recipe_of(m, gears, gear);
    if (b->made && !memcmp(&b->recipe, &wanted, sizeof wanted))
        return FF_OK;
    b->made = false;
    b->recipe = wanted;
    const char *why = stiffness_contour_make(&b->contour, &wanted.contour);
    if (why)
        return ff_failf(m->host, FF_INVALID, "gear.root_radius", "gear %d: %s", gear + 1, why);
    if (wanted.material.plane_strain && !(wanted.material.poisson_ratio < 0.49))
        return ff_failf(m->host, FF_INVALID, "plane",
                        "gear %d: plane strain of a material with Poisson's ratio %g is out of "
                        "reach of these elements; use plane stress",
                        gear + 1, wanted.material.poisson_ratio);
    if (!m->analytical) {
        ff_status status = make_ring(m, gear, b);
        if (status != FF_OK)
            return status;
    }
    b->made = !m->analytical;
    return FF_OK;
}

static void make_tooth(const distribution *m, const stiffness_gears *gears, int gear,
                       stiffness_tooth *tooth)
{
    const stiffness_gear *g = &gears->gear[gear];
    stiffness_tooth_data data = {.base_radius = g->base_radius,
                                 .root_radius = g->root_radius,
                                 .reference_radius = g->reference_radius,
                                 .rim_radius = g->rim_radius,
                                 .thickness = g->thickness,
                                 .width = gears->width,
                                 .elastic_modulus = g->elastic_modulus,
                                 .poisson_ratio = g->poisson_ratio,
                                 .plane_strain = m->plane_strain};
    stiffness_tooth_make(tooth, &data);
}

static ff_status make_pair(distribution *m, const stiffness_gears *gears, pair *p)
{
    *p = (pair){.model = m, .gears = gears};
    for (int g = 0; g < 2; g++) {
        const stiffness_gear *gear = &gears->gear[g];
        recipe wanted = recipe_of(m, gears, g);
        bool twin =
            g == 1 && m->body[0].made && !memcmp(&m->body[0].recipe, &wanted, sizeof wanted);
        ff_status status = twin ? FF_OK : make_body(m, gears, g, &m->body[g]);
        if (status != FF_OK)
            return status;
        p->body[g] = &m->body[twin ? 0 : g];
        make_tooth(m, gears, g, &p->tooth[g]);
        p->yield[g] = (1 - gear->poisson_ratio * gear->poisson_ratio) /
                      (M_PI * gear->elastic_modulus * gears->width);
        if (m->host->progress(m->host->ctx, 0.4 * (g + 1)) != 0)
            return FF_STOPPED;
    }
    return FF_OK;
}

static ff_status check_range(const distribution *m, const stiffness_path *e)
{
    if (e->contact_ratio <= highest_contact_ratio)
        return FF_OK;
    return ff_failf(m->host, FF_UNSUPPORTED, "gear.roll_tip",
                    "the contact ratio is %.6g; the coupling of teeth is worked out up to %g",
                    e->contact_ratio, highest_contact_ratio);
}

static void report_mesh(const distribution *m, const pair *p)
{
    const double limit = 2e-3;
    double error = fmax(p->body[0]->mesh_error, p->body[1]->mesh_error);
    double reciprocity = fmax(p->body[0]->ring.reciprocity, p->body[1]->ring.reciprocity);
    m->host->quality(m->host->ctx, "mesh_error", error, limit,
                     error <= limit ? FF_GOOD : FF_DOUBTFUL,
                     "compliance of a tooth against that of half as many elements");
    m->host->quality(m->host->ctx, "reciprocity", reciprocity, 1e-10,
                     reciprocity <= 1e-10 ? FF_GOOD : FF_BAD,
                     "displacements of two points of a flank under each other's load");
}

/* The contact must stay narrow against the depth of the tooth's axis. */
static void report_contact(const distribution *m, const pair *p, const stiffness_path *e)
{
    const double limit = 0.5;
    double worst = 0;
    for (int i = 0; i <= 4; i++) {
        double age = e->contact_ratio * i / 4;
        double softness = p->yield[0] + p->yield[1];
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
                     "tooth's axis; the local approach is that of a half plane");
}

/* In the middle of the path of contact, where one pair carries all. */
typedef struct middle {
    double roll[2], curvature;
    double deflection; /* of a pair, over the force */
    double hertz;      /* that of it in the contact */
} middle;

static middle in_the_middle(const pair *p, const stiffness_path *e)
{
    double age = e->contact_ratio / 2;
    middle m = {.curvature = stiffness_gears_curvature(p->gears, age)};
    for (int g = 0; g < 2; g++)
        m.roll[g] = stiffness_gears_roll(p->gears, g, age);
    stiffness_hertz h = approach(p, m.roll, m.curvature, true);
    m.hertz = h.constant - h.slope * log(e->line_force);
    m.deflection = own_compliance(p, m.roll) + m.hertz;
    return m;
}

static void report_half_plane(const distribution *m, const pair *p, const stiffness_path *e)
{
    const double limit = 0.1;
    double thin = 0;
    for (int g = 0; g < 2; g++) {
        const stiffness_ring *ring = &p->body[g]->ring;
        thin += (ring->thin[0] + ring->thin[1]) / 2;
    }
    double share = fabs(thin) / in_the_middle(p, e).deflection;
    m->host->quality(m->host->ctx, "half_plane", share, limit,
                     share <= limit ? FF_GOOD : FF_DOUBTFUL,
                     "share of a pair's deflection that is added since a tooth is no half plane");
}

/* Plane stress of the teeth alone: steel bulges over the width of the contact, some tenths of a
   millimetre, at the ends of the face alone. */
static void report_plane(const distribution *m, const pair *p, const stiffness_path *e)
{
    const double limit = 0.1;
    middle at = in_the_middle(p, e);
    stiffness_hertz h = approach(p, at.roll, at.curvature, false);
    double more = (h.constant - h.slope * log(e->line_force) - at.hertz) / at.deflection;
    m->host->quality(m->host->ctx, "contact_in_plane_strain", more, limit,
                     more <= limit ? FF_GOOD : FF_DOUBTFUL,
                     "the contact stays in plane strain, as its width is small against the face "
                     "width: share of a pair's deflection that plane stress would add there");
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    distribution *m = self;
    stiffness_conditions conditions;
    pair p;
    ff_status status = stiffness_conditions_read(m->host, in, &m->rim, m->cycles, &conditions);
    if (status == FF_OK)
        status = check_range(m, &conditions.path);
    if (status == FF_OK)
        status = make_pair(m, &conditions.gears, &p);
    if (status != FF_OK)
        return status;
    if (!m->analytical) {
        report_mesh(m, &p);
        report_half_plane(m, &p, &conditions.path);
    }
    report_contact(m, &p, &conditions.path);
    if (!m->plane_strain)
        report_plane(m, &p, &conditions.path);
    stiffness_source source = {.host = m->host,
                               .conditions = &conditions,
                               .points = m->points,
                               .cycles = m->cycles,
                               .tangent = m->tangent,
                               .corner = m->corner,
                               .before = m->corner ? stiffness_corner_reach : 0,
                               .after = m->corner ? stiffness_corner_reach : 0,
                               .sharp = !m->corner,
                               .compliance = compliance,
                               .self = &p,
                               .fault = "operating.line_force"};
    return stiffness_source_publish(&source, wanted);
}

static ff_status assess(void *self, uint64_t wanted, double accuracy, const ff_array *in,
                        ff_assessment *a)
{
    static const stiffness_error_estimate estimate = {
        .force = 0.005,
        .stiffness = 0.02,
        .transmission = 0.02,
        .cost = 0.5,
        .reason = "elastic teeth, the most exact of its kind; plane, so that the width does not "
                  "count",
    };
    const distribution *m = self;
    (void)accuracy;
    if (m->analytical)
        return ff_failf(m->host, FF_UNSUPPORTED, "compliance",
                        "the error is known of finite elements alone");
    return stiffness_assess(&estimate, wanted, in, a);
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "stiffness/load-distribution",
    .version = "1.0.0",
    .summary = "mesh stiffness, transmission errors and tooth forces from the load distribution "
               "over elastic teeth",
    .reference = "Conry & Seireg 1973, ASME J. Eng. Ind. 95, 1115-1122; Weber 1949, DSIR "
                 "Sponsored Research (Germany) Report 3; Johnson 1985, Contact Mechanics; Thomas "
                 "1979, Int. J. Numer. Methods Eng. 14, 81-102 (rotational periodicity); Litvin & "
                 "Fuentes 2004, Gear Geometry and Applied Theory (fillet)",
    .bibtex =
        "@article{conry1973, author={Conry, T. F. and Seireg, A.}, title={A mathematical "
        "programming technique for the evaluation of load distribution and optimal modifications "
        "for gear systems}, journal={Journal of Engineering for Industry}, volume={95}, "
        "pages={1115--1122}, year={1973}}\n"
        "@techreport{weber1949, author={Weber, C.}, title={The deformation of loaded gears and the "
        "effect on their load-carrying capacity}, institution={DSIR Sponsored Research (Germany)}, "
        "number={3}, year={1949}}\n"
        "@book{johnson1985, author={Johnson, K. L.}, title={Contact mechanics}, "
        "publisher={Cambridge University Press}, year={1985}}\n"
        "@article{thomas1979, author={Thomas, D. L.}, title={Dynamics of rotationally periodic "
        "structures}, journal={International Journal for Numerical Methods in Engineering}, "
        "volume={14}, pages={81--102}, year={1979}}",
    .licence = "GPL-3.0-or-later",
    .flags = 0,
    FF_TABLE(params),
    FF_TABLE(stiffness_inputs),
    FF_TABLE(stiffness_outputs),
    .create = create,
    .set = set,
    .evaluate = evaluate,
    .destroy = destroy,
    .assess = assess,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
