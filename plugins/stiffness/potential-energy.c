/* SPDX-License-Identifier: GPL-3.0-or-later */
/*
 * Mesh stiffness of a spur pair from the strain energy of its teeth. Every pair is a chain of two
 * teeth, two bodies and one contact; the pairs stand side by side over the geometric path of
 * contact, with perfect involutes: the transmission error without load is 0. Pairs do not bend one
 * another's body, and a contact under load begins and ends where the unloaded one does.
 */
#include "mesh.h"
#include "tooth.h"

#include <math.h>
#include <stdlib.h>

enum { POINTS, RIM_RADIUS, PLANE, DEFINITION };

enum {
    IN_BASE = FF_MESH_INPUTS,
    IN_REFERENCE,
    IN_ROOT,
    IN_BORE,
    IN_THICKNESS,
    IN_ANGLE,
    IN_WIDTH,
    IN_MODULUS,
    IN_POISSON,
    IN_BACKLASH,
    INPUTS
};

/* The integrands are analytic in the parameters chosen: 32 nodes reach rounding. */
enum { NODES = 32, NODES_OF_CHECK = 64 };

/* Root radius over rim radius of a gear without a bore. */
static const double default_body_ratio = 2;

typedef struct energy {
    const ff_host *host;
    gsl_integration_glfixed_table *rule, *check_rule;
    size_t points;
    size_t rims; /* 0: from the gear */
    double rim[2];
    int plane_strain;
} energy;

/* One pair of teeth along the path of contact. */
typedef struct pair {
    ff_tooth tooth[2];
    double roll_sap, pitch, contact_ratio;
    double tangent_length; /* between the base circles' points of tangency, m */
    double contact;        /* compliance of the Hertzian contact, m/N */
    const gsl_integration_glfixed_table *rule;
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
    {.name = "plane",
     .unit = "",
     .doc = "stress: the tooth bends as a narrow beam; strain: as a wide plate, E/(1-nu^2) in "
            "bending and compression",
     .type = FF_CHOICE,
     .preset = "stress",
     .choices = "stress|strain"},
    {.name = "definition",
     .unit = "",
     .doc = "secant F/(e_l - e) or tangent dF/d(e_l); equal here, as all compliances are linear",
     .type = FF_CHOICE,
     .preset = "secant",
     .choices = "secant|tangent"},
};

static const ff_port inputs[INPUTS] = {
    [FF_IN_ROLL] = {.name = "gear.roll_angle",
                    .unit = "rad",
                    .doc = "roll angle of gear 1 at the stations",
                    .dims = "station"},
    [FF_IN_SAP] = {.name = "gear.roll_sap", .unit = "rad", .doc = "roll angle at SAP", .dims = ""},
    [FF_IN_TIP] = {.name = "gear.roll_tip",
                   .unit = "rad",
                   .doc = "roll angle at the tip",
                   .dims = ""},
    [FF_IN_TEETH] = {.name = "gear.teeth", .unit = "1", .doc = "teeth", .dims = "gear"},
    [FF_IN_FORCE] = {.name = "operating.line_force",
                     .unit = "N",
                     .doc = "normal force along the line of action",
                     .dims = ""},
    [IN_BASE] = {.name = "gear.base_radius", .unit = "m", .doc = "base circle", .dims = "gear"},
    [IN_REFERENCE] = {.name = "gear.reference_radius",
                      .unit = "m",
                      .doc = "reference circle",
                      .dims = "gear"},
    [IN_ROOT] = {.name = "gear.root_radius", .unit = "m", .doc = "root circle", .dims = "gear"},
    [IN_BORE] = {.name = "gear.bore_radius", .unit = "m", .doc = "bore; 0: none", .dims = "gear"},
    [IN_THICKNESS] = {.name = "gear.tooth_thickness",
                      .unit = "m",
                      .doc = "arc of the tooth at the reference circle, backlash not deducted",
                      .dims = "gear"},
    [IN_ANGLE] = {.name = "gear.working_pressure_angle",
                  .unit = "rad",
                  .doc = "pressure angle of the line of action",
                  .dims = ""},
    [IN_WIDTH] = {.name = "gear.face_width", .unit = "m", .doc = "width in mesh", .dims = ""},
    [IN_MODULUS] = {.name = "gear.elastic_modulus",
                    .unit = "Pa",
                    .doc = "modulus of elasticity",
                    .dims = "gear"},
    [IN_POISSON] = {.name = "gear.poisson_ratio",
                    .unit = "1",
                    .doc = "Poisson's ratio",
                    .dims = "gear"},
    [IN_BACKLASH] = {.name = "gear.backlash",
                     .unit = "m",
                     .doc = "backlash along the line of action: half of it is taken off each "
                            "gear's tooth",
                     .dims = "",
                     .flags = FF_OPTIONAL},
};

static void destroy(void *self)
{
    energy *s = self;
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
    energy *s = calloc(1, sizeof *s);
    if (!s)
        return FF_NOMEM;
    s->host = host;
    s->rule = gsl_integration_glfixed_table_alloc(NODES);
    s->check_rule = gsl_integration_glfixed_table_alloc(NODES_OF_CHECK);
    if (!s->rule || !s->check_rule) {
        destroy(s);
        return FF_NOMEM;
    }
    *self = s;
    return FF_OK;
}

static ff_status set(void *self, uint32_t param, const ff_value *value)
{
    energy *s = self;
    switch (param) {
    case POINTS:
        s->points = (size_t)value->integer;
        return FF_OK;
    case RIM_RADIUS:
        if (value->count < 1 || value->count > 2)
            return ff_failf(s->host, FF_INVALID, "rim_radius",
                            "one radius for both gears or two are needed, not %zu", value->count);
        s->rims = value->count;
        s->rim[0] = value->reals[0];
        s->rim[1] = value->reals[value->count - 1];
        return FF_OK;
    case PLANE:
        s->plane_strain = value->integer == 1;
        return FF_OK;
    default: /* DEFINITION: secant and tangent are one */
        return FF_OK;
    }
}

/* Contact of a pair of that age on the flank of either gear: its roll angle. On the line of action
   r_b1 roll_1 + r_b2 roll_2 is the distance between the points of tangency. */
static double roll_of(const pair *p, int gear, double age)
{
    double roll = p->roll_sap + age * p->pitch;
    if (gear == 0)
        return roll;
    return (p->tangent_length - p->tooth[0].base_radius * roll) / p->tooth[1].base_radius;
}

static double pair_stiffness(const pair *p, double age)
{
    double compliance = p->contact;
    for (int gear = 0; gear < 2; gear++) {
        ff_compliance c = ff_tooth_compliance(&p->tooth[gear], roll_of(p, gear, age), p->rule);
        compliance += ff_compliance_sum(&c);
    }
    return 1 / compliance;
}

static double stiffness_at(const void *self, double phase, int side)
{
    const pair *p = self;
    double sum = 0;
    for (double age = phase; age <= p->contact_ratio + 1; age += 1)
        if (ff_touches(p->contact_ratio, age, side))
            sum += pair_stiffness(p, fmin(age, p->contact_ratio));
    return sum;
}

static double share(const void *self, double age, double phase, int side)
{
    const pair *p = self;
    return pair_stiffness(p, fmin(age, p->contact_ratio)) / stiffness_at(self, phase, side);
}

static ff_status read_positive(const energy *s, const ff_array *in, int row, size_t gear,
                               double *value)
{
    ff_status status = ff_input(s->host, &in[row], inputs[row].name, gear, value);
    if (status == FF_OK && !(*value > 0))
        status = ff_failf(s->host, FF_INVALID, inputs[row].name,
                          "gear %zu: a positive value is needed, this is %g", gear + 1, *value);
    return status;
}

static ff_status check_tooth(const energy *s, const ff_tooth_data *d, int gear)
{
    const ff_host *host = s->host;
    if (!(d->poisson_ratio > -1 && d->poisson_ratio <= 0.5))
        return ff_failf(host, FF_INVALID, "gear.poisson_ratio",
                        "gear %d: Poisson's ratio lies between -1 and 0.5, this is %g", gear + 1,
                        d->poisson_ratio);
    if (!(d->reference_radius >= d->base_radius))
        return ff_failf(host, FF_INVALID, "gear.reference_radius",
                        "gear %d: the reference circle lies inside the base circle", gear + 1);
    if (!(d->thickness > 0))
        return ff_failf(host, FF_INVALID, "gear.backlash",
                        "gear %d: the backlash leaves no tooth at the reference circle", gear + 1);
    if (!(d->rim_radius < d->root_radius))
        return ff_failf(host, FF_INVALID, s->rims ? "rim_radius" : "gear.bore_radius",
                        "gear %d: the rim radius %.6g mm must be less than the root radius "
                        "%.6g mm",
                        gear + 1, 1e3 * d->rim_radius, 1e3 * d->root_radius);
    return FF_OK;
}

static ff_status read_tooth(const energy *s, const ff_array *in, int gear, ff_tooth_data *d)
{
    const struct {
        int row;
        double *to;
    } positive[] = {
        {IN_BASE, &d->base_radius},        {IN_REFERENCE, &d->reference_radius},
        {IN_ROOT, &d->root_radius},        {IN_THICKNESS, &d->thickness},
        {IN_MODULUS, &d->elastic_modulus},
    };
    size_t i = (size_t)gear;
    double bore = 0, backlash = 0;
    ff_status status = FF_OK;
    for (size_t k = 0; k < sizeof positive / sizeof positive[0] && status == FF_OK; k++)
        status = read_positive(s, in, positive[k].row, i, positive[k].to);
    if (status == FF_OK)
        status = read_positive(s, in, IN_WIDTH, 0, &d->width);
    if (status == FF_OK)
        status = ff_input(s->host, &in[IN_POISSON], inputs[IN_POISSON].name, i, &d->poisson_ratio);
    if (status == FF_OK)
        status = ff_input(s->host, &in[IN_BORE], inputs[IN_BORE].name, i, &bore);
    if (status == FF_OK && in[IN_BACKLASH].data)
        status = ff_input(s->host, &in[IN_BACKLASH], inputs[IN_BACKLASH].name, 0, &backlash);
    if (status != FF_OK)
        return status;
    d->rim_radius = s->rims ? s->rim[gear] : bore > 0 ? bore : d->root_radius / default_body_ratio;
    d->plane_strain = s->plane_strain;
    /* the backlash is an arc of the base circle, half of it on either gear */
    d->thickness -= backlash / 2 * d->reference_radius / d->base_radius;
    return check_tooth(s, d, gear);
}

/* The contact must stay on the involute, on a tooth that has not come to a point. */
static ff_status check_flank(const energy *s, const pair *p, int gear)
{
    const double slack = 1e-9;
    const ff_tooth *tooth = &p->tooth[gear];
    double low = roll_of(p, gear, gear == 0 ? 0 : p->contact_ratio);
    double high = roll_of(p, gear, gear == 0 ? p->contact_ratio : 0);
    if (!(tooth->root_half_angle > 0) || !(high - tooth->half_angle < M_PI / 2) ||
        !(ff_tooth_involute(tooth, high).half > 0))
        return ff_failf(s->host, FF_INVALID, "gear.tooth_thickness",
                        "gear %d: the tooth comes to a point below the end of contact", gear + 1);
    if (!(low >= tooth->root_roll - slack && low > 0))
        return ff_failf(s->host, FF_INVALID, "gear.root_radius",
                        "gear %d: contact reaches the roll angle %.6g rad, but the involute "
                        "begins at %.6g rad",
                        gear + 1, low, tooth->root_roll);
    return FF_OK;
}

static ff_status read_pair(const energy *s, const ff_array *in, const ff_engagement *e, pair *p)
{
    *p = (pair){.roll_sap = e->roll_sap,
                .pitch = e->pitch,
                .contact_ratio = e->contact_ratio,
                .rule = s->rule};
    double angle = 0;
    ff_status status = ff_input(s->host, &in[IN_ANGLE], inputs[IN_ANGLE].name, 0, &angle);
    if (status == FF_OK && !(angle > 0 && angle < M_PI / 2))
        status =
            ff_failf(s->host, FF_INVALID, inputs[IN_ANGLE].name,
                     "the working pressure angle lies between 0 and 90 deg, this is %g rad", angle);
    for (int gear = 0; gear < 2 && status == FF_OK; gear++) {
        ff_tooth_data data;
        status = read_tooth(s, in, gear, &data);
        if (status != FF_OK)
            break;
        ff_tooth_make(&p->tooth[gear], &data);
        p->tangent_length += data.base_radius * tan(angle);
        /* Yang & Sun 1985: pi E b/(4 (1-nu^2)) for like materials; each gear adds its part */
        p->contact += 2 * (1 - data.poisson_ratio * data.poisson_ratio) /
                      (M_PI * data.elastic_modulus * data.width);
    }
    for (int gear = 0; gear < 2 && status == FF_OK; gear++)
        status = check_flank(s, p, gear);
    return status;
}

/* Sainsot et al. fitted 1.4 <= h <= 7 and 0.01 <= theta <= 0.12. */
static void judge_foundation(const energy *s, const pair *p)
{
    double worst = 0;
    for (int gear = 0; gear < 2; gear++) {
        double h = p->tooth[gear].body_ratio, theta = p->tooth[gear].root_half_angle;
        worst = fmax(worst, fmax(fmax(h / 7, 1.4 / h), fmax(theta / 0.12, 0.01 / theta)));
    }
    int held = worst <= 1;
    s->host->quality(s->host->ctx, "foundation_range", worst, 1, held ? FF_GOOD : FF_DOUBTFUL,
                     held ? "the gear bodies lie in the range that Sainsot et al. fitted"
                          : "a gear body lies outside the range that Sainsot et al. fitted: root "
                            "over rim radius 1.4 to 7, half angle of the root 0.01 to 0.12 rad");
}

static void judge_quadrature(const energy *s, const pair *p)
{
    const double limit = 1e-9;
    pair finer = *p;
    finer.rule = s->check_rule;
    double worst = 0;
    for (int i = 0; i <= 4; i++) {
        double age = p->contact_ratio * i / 4;
        worst = fmax(worst, fabs(pair_stiffness(p, age) / pair_stiffness(&finer, age) - 1));
    }
    s->host->quality(s->host->ctx, "quadrature_error", worst, limit,
                     worst <= limit ? FF_GOOD : FF_DOUBTFUL,
                     "strain energy against a finer rule, relative");
}

static ff_status sample_cycle(const energy *s, const pair *p, const ff_cycle *cycle, double *k)
{
    for (size_t i = 0; i < cycle->count; i++) {
        if (i % 1024 == 0 && s->host->progress(s->host->ctx, (double)i / (double)cycle->count) != 0)
            return FF_STOPPED;
        k[i] = stiffness_at(p, cycle->phase[i], ff_cycle_side(cycle, i));
        if (!(k[i] > 0 && isfinite(k[i])))
            return ff_failf(s->host, FF_INVALID, "rim_radius",
                            "the stiffness at phase %g comes out as %g N/m: the gear bodies lie "
                            "far outside the range that Sainsot et al. fitted",
                            cycle->phase[i], k[i]);
    }
    return FF_OK;
}

static ff_status evaluate(void *self, uint64_t wanted, const ff_array *in)
{
    const energy *s = self;
    ff_engagement e;
    pair p;
    ff_cycle cycle = {0};
    double *k = NULL;
    ff_status status = ff_engagement_read(s->host, in, &e);
    if (status == FF_OK)
        status = read_pair(s, in, &e, &p);
    if (status != FF_OK)
        return status;
    /* a pair enters at 0, another leaves at the contact ratio's fraction */
    const double breakpoint[] = {0, ff_phase_of(p.contact_ratio, FF_ABOVE)};
    const ff_break exit_of_pair = {breakpoint[1], true};
    status = FF_NOMEM;
    if (!ff_cycle_make(&cycle, s->points, 1, &exit_of_pair))
        goto out;
    k = malloc(cycle.count * sizeof *k);
    if (!k)
        goto out;
    status = sample_cycle(s, &p, &cycle, k);
    if (status != FF_OK)
        goto out;
    ff_mesh mesh = {
        .cycle = cycle,
        .stiffness = k,
        .breaks = breakpoint[1] > 0 ? 2 : 1,
        .breakpoint = breakpoint,
        .stiffness_at = stiffness_at,
        .share = share,
        .self = &p,
        .balance = 1e-12,
    };
    judge_foundation(s, &p);
    judge_quadrature(s, &p);
    status = ff_mesh_publish(s->host, wanted, &mesh, &e);
out:
    free(k);
    ff_cycle_free(&cycle);
    return status;
}

static const ff_model model = {
    .size = sizeof(ff_model),
    .abi_major = FF_ABI_MAJOR,
    .abi_minor = FF_ABI_MINOR,
    .id = "stiffness/potential-energy",
    .version = "1.0.0",
    .summary = "mesh stiffness from bending, shear and compression of the teeth, their foundation "
               "and the Hertzian contact",
    .reference = "Yang & Lin 1987, ASME J. Mech. Transm. Autom. Des. 109, 189-196; Tian 2004, "
                 "MSc thesis, University of Alberta; Sainsot, Velex & Duverger 2004, ASME J. Mech. "
                 "Des. 126, 748-752; Yang & Sun 1985, ASME J. Mech. Transm. Autom. Des. 107, "
                 "529-535",
    .bibtex =
        "@article{yang1987, author={Yang, D. C. H. and Lin, J. Y.}, title={Hertzian damping, tooth "
        "friction and bending elasticity in gear impact dynamics}, journal={Journal of Mechanisms, "
        "Transmissions, and Automation in Design}, volume={109}, pages={189--196}, year={1987}}\n"
        "@mastersthesis{tian2004, author={Tian, X. H.}, title={Dynamic simulation for system "
        "response of gearbox including localized gear faults}, school={University of Alberta}, "
        "year={2004}}\n"
        "@article{sainsot2004, author={Sainsot, P. and Velex, P. and Duverger, O.}, "
        "title={Contribution of gear body to tooth deflections: a new bidimensional analytical "
        "formula}, journal={Journal of Mechanical Design}, volume={126}, pages={748--752}, "
        "year={2004}}\n"
        "@article{yang1985, author={Yang, D. C. H. and Sun, Z. S.}, title={A rotary model for spur "
        "gear dynamics}, journal={Journal of Mechanisms, Transmissions, and Automation in Design}, "
        "volume={107}, pages={529--535}, year={1985}}",
    .licence = "GPL-3.0-or-later",
    .flags = 0,
    FF_TABLE(params),
    FF_TABLE(inputs),
    FF_TABLE(ff_stiffness_outputs),
    .create = create,
    .set = set,
    .evaluate = evaluate,
    .destroy = destroy,
};

const ff_model *flankfilm_model_v1(void)
{
    return &model;
}
